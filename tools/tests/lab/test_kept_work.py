"""What somebody chose or typed survives a dead server, a reload and other tabs: one tab edits."""

import json

import pytest
from folder import asked, example_form, got, with_settings
from playwright.sync_api import expect
from plumb.lab.guard import Editor, OtherTabError
from plumb.marks.form import read_form
from screens import at_rest, await_question
from served_lab import serve
from test_readings_page import LEFT, SHEET, await_saved, open_readings, saved, type_in, with_form


def choices(lab):
    """What the folder keeps by now."""
    file = lab.folder / "lab.json"
    return json.loads(file.read_text()) if file.exists() else {}


@pytest.fixture
def page_open(lab, fresh_page):
    fresh_page.goto(lab.url)
    fresh_page.get_by_label("inch").wait_for(state="attached")
    return fresh_page


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


SAID = "This folder is open in another tab."
MINE, THEIRS = (98, 106), (660, 111)


@pytest.fixture
def elsewhere(browser):
    """A tab of another browser."""
    context = browser.new_context(viewport={"width": 1280, "height": 900})
    context.set_default_timeout(120_000)
    yield context.new_page()
    for each in context.pages:
        each.unroute_all(behavior="ignoreErrors")
    context.close()


@pytest.fixture
def first(lab, page):
    """The tab that edits."""
    with_form(lab, example_form())
    open_readings(lab, page)
    expect(page.get_by_text(SAID)).to_have_count(0)
    return page


def cell(page, mark=1):
    return page.get_by_label(LEFT.format(mark), exact=True)


def type_unsaved(page):
    """Type a reading whose saves are lost on their way."""
    page.route("**/api/readings", lambda route: route.abort())
    with page.expect_request("**/api/readings"):
        type_in(page, 1, *map(str, MINE))


def on_disk(lab):
    """The readings of a form whose first mark may wait."""
    corner = SHEET[0] / 2, SHEET[1] / 2
    readings = read_form(lab.folder / "marks.toml", sheet=SHEET).measurements.readings
    return {
        mark.name: (round(x + corner[0], 2), round(corner[1] - y, 2)) for mark, (x, y) in readings
    }


def take_over(page):
    page.get_by_role("button", name="Take over").click()
    expect(page.get_by_text(SAID)).to_have_count(0)


def test_a_second_tab_shows_takes_over_and_leaves_the_first_to_show(lab, first, elsewhere):
    open_readings(lab, elsewhere)
    elsewhere.get_by_role("alert").get_by_text(SAID).wait_for()
    expect(cell(elsewhere)).to_be_disabled()
    expect(elsewhere.get_by_role("radio", name="inch")).to_be_disabled()
    type_in(first, 1, *map(str, MINE))
    await_saved(lab, first, {"1": MINE})
    expect(cell(elsewhere)).to_have_value("98")
    take_over(elsewhere)
    first.get_by_role("alert").get_by_text(SAID).wait_for()
    expect(cell(first)).to_be_disabled()
    assert first.get_by_text("is not saved").count() == 0
    type_in(elsewhere, 2, "660", "111")
    await_saved(lab, elsewhere, {"1": MINE, "2": (660, 111)})
    expect(cell(first, 2)).to_have_value("660")
    elsewhere.close()  # the first inherits it
    expect(first.get_by_text(SAID)).to_have_count(0)
    expect(cell(first)).to_be_enabled()


def test_a_tab_of_the_same_browser_saves_what_the_losing_tab_left(lab, first):
    type_unsaved(first)
    second = first.context.new_page()
    open_readings(lab, second)
    second.get_by_role("alert").get_by_text(SAID).wait_for()
    assert saved(lab) == {} and cell(second).input_value() == ""
    take_over(second)
    await_saved(lab, second, {"1": MINE})
    first.unroute("**/api/readings")
    expect(first.get_by_text("is not saved")).to_have_count(0)


@pytest.mark.parametrize(
    ("answer", "kept"),
    [("Keep mine", {"1": MINE, "2": THEIRS}), ("Take the file's", {"2": THEIRS})],
)
def test_a_file_that_a_program_changes_while_somebody_types_is_asked_about(
    lab, first, answer, kept
):
    type_unsaved(first)
    head, mark, second, *more = example_form().split("\n[[mark]]\n")
    second = second.replace("# measured = [ , ]", "measured = [660, 111]")
    (lab.folder / "marks.toml").write_text("\n[[mark]]\n".join([head, mark, second, *more]))
    first.unroute("**/api/readings")
    first.get_by_role("alert").get_by_text("The file has changed on disk").wait_for()
    expect(cell(first)).to_have_value("98")
    expect(cell(first, 2)).to_have_value("660")
    assert on_disk(lab) == {"2": THEIRS}
    first.get_by_role("button", name=answer).click()
    expect(first.get_by_text("The file has changed on disk")).to_have_count(0)
    expect(cell(first)).to_have_value("98" if "1" in kept else "")
    at_rest(first)
    assert on_disk(lab) == kept


def test_the_right_goes_to_the_next_tab_that_is_open():
    editor = Editor()
    for tab in ("a", "b", "a", "c"):
        editor.opened(tab)
    assert editor.tab == "a"
    editor.closed("a")
    assert editor.tab == "a"  # its second line is open
    editor.closed("a")
    assert editor.tab == "b"
    editor.take_over("c")
    editor.closed("b")
    assert editor.tab == "c"
    for tab in ("c", ""):
        editor.refuse_other(tab)
    with pytest.raises(OtherTabError, match="take over"):
        editor.refuse_other("b")
    editor.closed("c")
    assert editor.tab == ""
    editor.refuse_other("b")


def test_a_change_by_another_tab_is_refused_and_stop_is_not(tmp_path):
    client = with_settings(tmp_path)
    mine, theirs = {"X-Plumb-Tab": "a"}, {"X-Plumb-Tab": "b"}
    choices = client.get("/api/project").json()
    body = {"choices": choices["choices"], "read": choices["choices_digest"]}
    assert client.post("/api/editor", headers=mine).json() == {"editor": "a"}
    refused = client.put("/api/choices", json=body, headers=theirs)
    assert refused.status_code == 423 and "open in another tab" in refused.json()["error"]
    assert client.get("/api/project", headers=theirs).status_code == 200
    for way in ("stop", "hold", "go-on"):  # no machine is there, which is another refusal
        assert client.post(f"/api/machine/{way}", headers=theirs).status_code == 422
    assert client.post("/api/machine/disconnect", headers=theirs).status_code == 423
    for headers in (mine, {}):
        assert client.put("/api/choices", json=body, headers=headers).status_code == 200
    assert client.post("/api/editor").status_code == 422
    assert asked(tmp_path).put("/api/choices", json=body, headers=theirs).status_code == 200
