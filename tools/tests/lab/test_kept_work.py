"""Choices and typed readings survive a dead server, a reload and other tabs."""

import json

import pytest
from folder import example_form, got
from playwright.sync_api import expect
from screens import at_rest, await_question
from served_lab import serve
from test_readings_page import LEFT, await_saved, open_readings, saved, type_in, with_form


def choices(lab):
    """The choices that the folder keeps."""
    file = lab.folder / "lab.json"
    return json.loads(file.read_text()) if file.exists() else {}


@pytest.fixture
def page_open(lab, fresh_page):
    fresh_page.goto(lab.url)
    fresh_page.get_by_label("inch").wait_for(state="attached")
    return fresh_page


def choose_inches_while_it_is_down(lab, page):
    """The lab is killed, and what is chosen then is kept in the browser."""
    lab.process.kill()
    page.get_by_label("inch").check()
    page.get_by_role("alert").get_by_text("The lab does not answer").wait_for()


def test_an_open_page_goes_on_with_a_server_that_was_killed_and_started(lab, page_open):
    choose_inches_while_it_is_down(lab, page_open)
    page_open.get_by_role("status").get_by_text("kept in this browser").wait_for()
    assert page_open.get_by_label("inch").is_checked()
    assert choices(lab) == {}
    lab.process = serve(lab.folder, port=lab.port).process
    at_rest(page_open)
    assert choices(lab).get("units") == "inch"
    page_open.get_by_role("alert").wait_for(state="detached")
    assert "kept" not in page_open.get_by_role("status").inner_text()


def test_a_reload_keeps_choices_made_while_the_server_was_down(lab, page_open):
    choose_inches_while_it_is_down(lab, page_open)
    page_open.goto("about:blank")
    lab.process = serve(lab.folder, port=lab.port).process
    page_open.goto(lab.url)
    at_rest(page_open)
    assert choices(lab).get("units") == "inch"
    assert page_open.get_by_label("inch").is_checked()


def test_a_file_saved_by_another_program_during_a_save_is_kept(lab, page_open):
    late = []

    def answer_late(route):
        if late:
            route.continue_()
        else:
            route.fetch()
            late.append(route)

    page_open.route("**/api/choices", answer_late)
    page_open.get_by_label("inch").check()
    await_question(page_open, late)
    (lab.folder / "lab.json").write_text(json.dumps({**choices(lab), "fineness": 0.25}))
    page_open.get_by_label("mm").check()
    late[0].fulfill(json=got(lab.client().get("/api/project")))
    at_rest(page_open)
    assert choices(lab).get("units") == "mm"
    assert choices(lab)["fineness"] == 0.25


MINE, THEIRS = (98, 106), (660, 111)


@pytest.fixture
def elsewhere(open_page):
    """A tab of another browser."""
    return open_page(viewport={"width": 1280, "height": 900})


@pytest.fixture
def first(lab, page):
    """A tab that shows a form."""
    with_form(lab, example_form())
    open_readings(lab, page)
    return page


def cell(page, mark=1):
    return page.get_by_label(LEFT.format(mark), exact=True)


def type_unsaved(page):
    """Type a reading whose saves are lost on their way."""
    page.route("**/api/readings", lambda route: route.abort())
    with page.expect_request("**/api/readings"):
        type_in(page, 1, *map(str, MINE))


def test_two_tabs_type_at_once_and_each_shows_all(lab, first, elsewhere):
    open_readings(lab, elsewhere)
    type_in(first, 1, *map(str, MINE))
    type_in(elsewhere, 2, *map(str, THEIRS))
    both = {"1": MINE, "2": THEIRS}
    await_saved(lab, first, both)
    await_saved(lab, elsewhere, both)
    expect(cell(elsewhere)).to_have_value("98")
    expect(cell(first, 2)).to_have_value("660")


def test_a_tab_of_the_same_browser_saves_what_a_tab_could_not(lab, first):
    type_unsaved(first)
    second = first.context.new_page()
    open_readings(lab, second)
    await_saved(lab, second, {"1": MINE})
    first.unroute("**/api/readings")
    first.bring_to_front()  # a tab behind another draws nothing, so it never rests
    await_saved(lab, first, {"1": MINE})


@pytest.mark.parametrize(("answer", "kept"), [("Keep mine", MINE), ("Take the file's", THEIRS)])
def test_a_mark_changed_by_another_program_while_it_is_typed_is_asked_about(
    lab, first, answer, kept
):
    type_unsaved(first)
    form = example_form().replace("# measured = [ , ]", "measured = [660, 111]", 1)
    (lab.folder / "marks.toml").write_text(form)
    first.unroute("**/api/readings")
    first.get_by_role("alert").get_by_text("The file has changed on disk").wait_for()
    expect(cell(first)).to_have_value("98")
    assert saved(lab) == {"1": THEIRS}
    first.get_by_role("button", name=answer).click()
    expect(first.get_by_text("The file has changed on disk")).to_have_count(0)
    at_rest(first)
    expect(cell(first)).to_have_value(str(kept[0]))
    assert saved(lab) == {"1": kept}
