"""What somebody chose or typed survives a dead server, a reload and a second tab."""

import json

import pytest
from folder import got
from playwright.sync_api import expect
from screens import at_rest, await_question
from served_lab import serve


def choices(lab):
    """What the folder keeps by now."""
    file = lab.folder / "lab.json"
    return json.loads(file.read_text()) if file.exists() else {}


@pytest.fixture
def page_open(lab, page):
    page.goto(lab.url)
    page.get_by_label("inch").wait_for(state="attached")
    return page


def test_a_choice_is_saved_at_once(lab, page_open):
    page_open.get_by_label("inch").check()
    at_rest(page_open)
    assert choices(lab).get("units") == "inch"


def test_an_open_page_goes_on_with_a_server_that_was_killed_and_started(lab, page_open):
    lab.process.kill()
    page_open.get_by_label("inch").check()
    page_open.get_by_role("alert").get_by_text("The lab does not answer").wait_for()
    page_open.get_by_role("status").get_by_text("kept in this browser").wait_for()
    assert page_open.get_by_label("inch").is_checked()
    assert choices(lab) == {}
    again = serve(lab.folder, port=lab.port)
    try:
        at_rest(page_open)
        assert choices(lab).get("units") == "inch"
        page_open.get_by_role("alert").wait_for(state="detached")
        assert "kept" not in page_open.get_by_role("status").inner_text()
    finally:
        again.end()


def test_a_reload_takes_up_what_was_chosen_while_nobody_answered(lab, page_open):
    lab.process.kill()
    page_open.get_by_label("inch").check()
    page_open.get_by_role("alert").get_by_text("The lab does not answer").wait_for()
    page_open.goto("about:blank")
    again = serve(lab.folder, port=lab.port)
    try:
        page_open.goto(lab.url)
        at_rest(page_open)
        assert choices(lab).get("units") == "inch"
        assert page_open.get_by_label("inch").is_checked()
    finally:
        again.end()


def test_a_choice_taken_back_while_it_is_saved_stays_taken_back(lab, page_open):
    saves = []
    # The first save is on its way for long.
    page_open.route(
        "**/api/choices", lambda route: route.continue_() if saves else saves.append(route)
    )
    page_open.get_by_label("inch").check()
    await_question(page_open, saves)
    page_open.get_by_label("mm").check()
    saves[0].continue_()
    at_rest(page_open)
    assert choices(lab).get("units") == "mm"
    assert page_open.get_by_label("mm").is_checked()


def test_a_save_keeps_what_another_program_saved_in_the_meantime(lab, page_open):
    page_open.get_by_label("inch").check()
    at_rest(page_open)
    assert choices(lab).get("units") == "inch"
    (lab.folder / "lab.json").write_text(json.dumps({**choices(lab), "fineness": 0.25}))
    page_open.get_by_label("mm").check()
    at_rest(page_open)
    assert choices(lab).get("units") == "mm"
    assert choices(lab)["fineness"] == 0.25


def test_what_another_program_saves_while_a_save_is_under_way_is_kept(lab, page_open):
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


def test_a_second_tab_of_the_same_browser_needs_no_key_and_sees_the_choice(lab, page_open):
    second = page_open.context.new_page()
    second.goto(lab.site)
    page_open.get_by_label("inch").check()
    expect(second.get_by_label("inch")).to_be_checked()
