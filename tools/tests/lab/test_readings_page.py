"""Typing readings in a real browser: they are saved, ringed, corrected, and never lost."""

import re
import shutil

import pytest
from folder import EXAMPLE, example_form
from playwright.sync_api import expect
from plumb.cli.main import main
from plumb.grid.pattern import spans_line
from plumb.marks.read import read_marks
from screens import at_rest

SHEET = (2438.4, 1219.2)
PATIENCE = 300_000  # [ms] of a busy computer
LEFT, TOP = "Mark {} from the left, mm", "Mark {} from the top, mm"


def with_form(lab, form):
    """The lab's folder with the example's machine and a form."""
    shutil.copy(EXAMPLE / "groundcontrol.ini", lab.folder)
    (lab.folder / "marks.toml").write_text(form)
    (lab.folder / "lab.json").write_text('{"settings": "groundcontrol.ini"}')


def open_readings(lab, page):
    page.goto(f"{lab.url}#/readings")
    page.get_by_label(LEFT.format(1), exact=True).wait_for()


def type_in(page, mark, x, y):
    page.get_by_label(LEFT.format(mark), exact=True).fill(x)
    page.get_by_label(TOP.format(mark), exact=True).fill(y)


def saved(lab):
    """The readings on disk, from the top left corner, by name."""
    try:
        marks = read_marks(lab.folder / "marks.toml", sheet=SHEET).readings
    except Exception:
        return {}
    return {
        mark.name: (round(x + SHEET[0] / 2, 2), round(SHEET[1] / 2 - y, 2))
        for mark, (x, y) in marks
    }


def await_saved(lab, page, expected):
    at_rest(page)
    assert saved(lab) == expected


def test_what_is_typed_is_saved_and_a_reload_keeps_the_rest(lab, page):
    with_form(lab, example_form())
    open_readings(lab, page)
    type_in(page, 1, "98", "106,5")
    type_in(page, 4, "1783", "109.5")
    page.get_by_label(LEFT.format(5), exact=True).fill("2344.5")
    await_saved(lab, page, {"1": (98, 106.5), "4": (1783, 109.5)})
    page.reload()
    half = page.get_by_label(LEFT.format(5), exact=True)
    half.wait_for()
    assert half.input_value() == "2344.5"
    assert page.get_by_label(TOP.format(1), exact=True).input_value() == "106.5"
    page.get_by_label(TOP.format(5), exact=True).fill("106.5")
    page.get_by_label(LEFT.format(1), exact=True).fill("98.5")
    await_saved(lab, page, {"1": (98.5, 106.5), "4": (1783, 109.5), "5": (2344.5, 106.5)})


def test_fractions_of_an_inch_stay_as_they_were_typed(lab, page):
    with_form(lab, example_form())
    open_readings(lab, page)
    page.get_by_role("radio", name="inch").check()
    cell = page.get_by_label("Mark 2 from the left, inch", exact=True)
    cell.fill("26 1/16")
    page.get_by_label("Mark 2 from the top, inch", exact=True).fill("4,25")
    await_saved(lab, page, {"2": (round(26.0625 * 25.4, 2), round(4.25 * 25.4, 2))})
    page.reload()
    cell.wait_for()
    assert cell.input_value() == "26 1/16"
    assert page.get_by_label("Mark 2 from the top, inch", exact=True).input_value() == "4 1/4"


def test_a_slip_is_ringed_and_its_correction_taken(lab, page):
    with_form(lab, example_form(read=12))
    open_readings(lab, page)
    type_in(page, 8, "1211", "618")
    ring = page.get_by_role("list", name="Readings that disagree")
    ring.get_by_text("Mark 8").wait_for(timeout=PATIENCE)
    assert page.locator(".cell.doubted legend").inner_text().startswith("8")
    at_rest(page)
    assert saved(lab)["8"] == (1211, 618)  # nothing is changed unless somebody says so
    ring.get_by_role("button", name="Take 1221, 618").click()
    ring.wait_for(state="detached", timeout=PATIENCE)
    at_rest(page)
    assert saved(lab)["8"] == (1221, 618)


def disagreeing(page):
    return page.get_by_role("list", name="Readings that disagree")


def test_each_distance_that_is_asked_has_its_field(lab, page):
    spans = [("2", "4"), ("4", "12"), ("8", "12")]
    with_form(lab, f"{spans_line(spans)}\n{example_form()}")
    page.goto(f"{lab.url}#/readings")
    fields = page.get_by_role("list", name="Distances to measure").get_by_role("textbox")
    expect(fields).to_have_count(len(spans))
    first = page.get_by_label("Distance 2 to 4, mm", exact=True)
    first.fill("1123,5")
    first.press("Enter")
    expect(fields.nth(1)).to_be_focused()
    fields.nth(1).fill("about two")
    fields.nth(2).fill("757")
    fields.nth(2).press("Enter")
    page.get_by_text("2 of 3 distances are read.").wait_for()
    expect(fields.nth(1)).to_have_attribute("aria-invalid", "true")
    page.get_by_text("More distances (0)").wait_for()
    assert not page.get_by_label(LEFT.format(1), exact=True).is_visible()
    assert not page.get_by_label("Measured from").count()
    read = read_marks(lab.folder / "marks.toml", sheet=SHEET).distances
    assert {each.between: each.length for each in read} == {spans[0]: 1123.5, spans[2]: 757}
    first.fill("")
    first.press("Tab")
    page.get_by_text("1 of 3 distances are read.").wait_for()


def test_a_slip_in_a_distance_is_named_and_its_correction_taken(lab, page):
    with_form(lab, example_form(read=23))
    open_readings(lab, page)
    page.get_by_text("Distances between marks (0)").click()
    ends = page.get_by_label("from mark"), page.get_by_label("to mark")
    assert "1" not in ends[0].locator("option").all_inner_texts()  # it is at two places
    for first, second, length in (("2", "4", "1123,5"), ("4", "12", "1415"), ("8", "12", "757")):
        ends[0].select_option(first)
        ends[1].select_option(second)
        page.locator(".distances form input").fill(length)
        page.get_by_role("button", name="Add the distance").click()
        page.get_by_text(f"{first} to {second}: ").wait_for(timeout=PATIENCE)
    disagreeing(page).get_by_text("Distance 4 to 12").wait_for(timeout=PATIENCE)
    assert page.locator(".distances li.doubted").inner_text().startswith("4 to 12: 1415.0 mm")
    disagreeing(page).get_by_role("button", name="Look at it").click()
    change = page.locator("#distance-1 button")
    expect(change).to_be_focused()
    disagreeing(page).get_by_role("button", name="Take 1515").click()
    disagreeing(page).wait_for(state="detached", timeout=PATIENCE)
    at_rest(page)
    read = read_marks(lab.folder / "marks.toml", sheet=SHEET)
    assert [each.length for each in read.distances] == [1123.5, 1515.0, 757.0]
    assert read.distances[1].between == ("4", "12")


def test_exchanged_readings_are_named_and_put_right(lab, page):
    with_form(lab, example_form(read=23))
    before = saved(lab)
    open_readings(lab, page)
    type_in(page, 8, "1782.5", "618")
    type_in(page, 9, "1221", "618")
    disagreeing(page).get_by_text("the readings of 8 and 9 may be exchanged").wait_for(
        timeout=PATIENCE
    )
    at_rest(page)
    assert saved(lab) != before
    disagreeing(page).get_by_role("button", name="Take 1221, 618").click()
    disagreeing(page).get_by_role("button", name="Take 1782.5, 618").click()
    disagreeing(page).wait_for(state="detached", timeout=PATIENCE)
    await_saved(lab, page, before)


def test_columns_of_a_spreadsheet_can_be_pasted(lab, page):
    with_form(lab, example_form())
    open_readings(lab, page)
    cell = page.get_by_label(LEFT.format(1), exact=True)
    cell.evaluate(
        """(input) => {
          const clipboardData = new DataTransfer();
          clipboardData.setData("text", "98\\t106\\n659,5\\t110.5");
          input.dispatchEvent(new ClipboardEvent("paste", { clipboardData, bubbles: true }));
        }"""
    )
    await_saved(lab, page, {"1": (98, 106), "2": (659.5, 110.5)})


@pytest.fixture
def phone(browser):
    """A page as wide as a phone."""
    context = browser.new_context(viewport={"width": 375, "height": 740})
    context.set_default_timeout(120_000)
    yield context.new_page()
    context.close()


def twenty_five(lab):
    """The lab's folder with the example's machine and a form of 25 marks that wait."""
    with_form(lab, example_form())
    words = ["grid", "--preset", "twenty-five", "--force"]
    settings, form = lab.folder / "groundcontrol.ini", lab.folder / "marks.toml"
    program = lab.folder / "grid.nc"
    files = ["--settings", settings, "--marks", form, "--output", program]
    assert main([*words, *map(str, files)]) == 0


def test_on_a_phone_the_mark_that_is_typed_is_open_and_the_others_are_a_map(lab, phone):
    twenty_five(lab)
    open_readings(lab, phone)
    marks = phone.get_by_role("group", name="Marks on the sheet")
    assert marks.get_by_role("button").count() == 25 and phone.locator(".cell").count() == 1
    assert phone.evaluate("document.documentElement.scrollHeight") < 1800
    phone.get_by_label(LEFT.format(1), exact=True).click()
    for number in ("98", "106,5", "659.5", "110"):  # Enter goes on, from mark to mark
        phone.keyboard.type(number)
        phone.keyboard.press("Enter")
    await_saved(lab, phone, {"1": (98, 106.5), "2": (659.5, 110)})
    third = phone.get_by_label(LEFT.format(3), exact=True)
    assert third.evaluate("input => input === document.activeElement")
    read = marks.get_by_role("button", name="Mark 2: read")
    assert read.get_attribute("aria-pressed") == "false"
    assert marks.get_by_role("button", name=re.compile("waits")).count() == 23
    read.click()
    again = phone.get_by_label(LEFT.format(2), exact=True)
    assert again.input_value() == "659.5"
    assert again.evaluate("input => input === document.activeElement")


def test_on_a_phone_a_reading_that_disagrees_opens(lab, phone):
    with_form(lab, example_form(read=23).replace("[1221, 618]", "[1211, 618]"))
    open_readings(lab, phone)
    disagreeing(phone).get_by_text("Mark 8").wait_for(timeout=PATIENCE)
    assert phone.get_by_label(LEFT.format(8), exact=True).count() == 0
    assert phone.get_by_role("button", name="Mark 8: look again").count() == 1
    disagreeing(phone).get_by_role("button", name="Look at it").first.click()
    field = phone.get_by_label(LEFT.format(8), exact=True)
    assert field.evaluate("input => input === document.activeElement")


def test_all_cells_lie_beside_the_map_and_enter_goes_on(lab, page):
    twenty_five(lab)
    open_readings(lab, page)
    assert page.locator(".cell").count() == 25 and page.locator(".picker").count() == 0
    boxes = [page.locator(f"#mark-{index}").bounding_box() for index in (0, 1, 2)]
    assert boxes[0]["y"] == boxes[1]["y"] < boxes[2]["y"] and boxes[0]["x"] == boxes[2]["x"]
    picture = page.locator(".stage svg").bounding_box()
    assert picture["x"] + picture["width"] <= boxes[0]["x"] < boxes[1]["x"]
    page.get_by_label(LEFT.format(5), exact=True).click()
    for number in ("2340", "100", "100", "350"):
        page.keyboard.type(number)
        page.keyboard.press("Enter")
    await_saved(lab, page, {"5": (2340, 100), "6": (100, 350)})
