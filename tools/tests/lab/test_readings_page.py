"""Typing readings in a real browser: saved in turn, ringed, corrected, never lost; half a reading
is none; an answer that comes late is not taken for the newest.
"""

import json
import re
import shutil

import pytest
from example_machine import EXAMPLE
from folder import example_form
from lab_machine import start_virtual
from playwright.sync_api import expect
from plumb.cli.main import main
from plumb.marks.form import read_form
from screens import at_rest, await_question, fitted_machine
from synthetic import SHEET

LEFT, TOP = "Mark {} from the left, mm", "Mark {} from the top, mm"


def with_form(lab, form, *marks):
    """The lab's folder with the example's machine and a form, which counts if it is among marks."""
    shutil.copy(EXAMPLE / "groundcontrol.ini", lab.folder)
    (lab.folder / "marks.toml").write_text(form)
    choices = {"settings": "groundcontrol.ini", "marks": marks}
    (lab.folder / "lab.json").write_text(json.dumps(choices))


def open_readings(lab, page):
    page.goto(f"{lab.url}#/readings")
    page.get_by_label(LEFT.format(1), exact=True).wait_for()


def type_in(page, mark, x, y):
    page.get_by_label(LEFT.format(mark), exact=True).fill(x)
    page.get_by_label(TOP.format(mark), exact=True).fill(y)


def read(lab):
    """What the form on disk says."""
    return read_form(lab.folder / "marks.toml", sheet=SHEET).measurements


def saved(lab):
    """The readings on disk, from the top left corner, by name."""
    return {
        mark.name: (round(x + SHEET[0] / 2, 2), round(SHEET[1] / 2 - y, 2))
        for mark, (x, y) in read(lab).readings
    }


def await_saved(lab, page, expected):
    at_rest(page)
    assert saved(lab) == expected


def test_typed_readings_are_saved_and_a_reload_keeps_the_rest(lab, page):
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


def test_columns_of_a_spreadsheet_are_pasted_from_a_cell_on(lab, page):
    with_form(lab, example_form())
    open_readings(lab, page)
    page.get_by_label(LEFT.format(1), exact=True).click()
    page.evaluate(
        """() => { const data = new DataTransfer();
        data.setData("text", "98\\t106,5\\n659.5\\t110");
        document.activeElement.dispatchEvent(
          new ClipboardEvent("paste", {clipboardData: data, bubbles: true, cancelable: true})); }"""
    )
    await_saved(lab, page, {"1": (98, 106.5), "2": (659.5, 110)})


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


def test_a_slip_is_ringed_and_its_correction_can_be_accepted(lab, page):
    with_form(lab, example_form(read=12))
    open_readings(lab, page)
    type_in(page, 8, "1211", "618")
    ring = disagreeing(page)
    others = (
        r"Mark 8: it reads .* The other marks say 12[12]\d\.\d mm from the left and 61\d\.\d mm"
    )
    expect(ring).to_contain_text(re.compile(others))
    assert page.locator(".cell.doubted legend").inner_text().startswith("8")
    at_rest(page)
    assert saved(lab)["8"] == (1211, 618)  # nothing is changed unless somebody says so
    ring.get_by_role("button", name="Take 1221, 618").click()
    ring.wait_for(state="detached")
    at_rest(page)
    assert saved(lab)["8"] == (1221, 618)


def disagreeing(page):
    return page.get_by_role("status").filter(has_text="Look at it")


FEW = ("2", "4", 1123.5), ("4", "12", 1415.0), ("8", "12", 757.0)


def distances(*lines):
    """Distances as a form has them."""
    return "".join(
        f'\n[[distance]]\nbetween = ["{first}", "{second}"]\nmm = {length}\n'
        for first, second, length in lines
    )


def test_a_slip_in_a_distance_is_named_and_its_correction_can_be_accepted(lab, page):
    with_form(lab, example_form(read=23) + distances(*FEW))
    open_readings(lab, page)
    said = re.compile(r"Distance 4 to 12: .* The other marks say 151\d\.\d mm\.")
    expect(disagreeing(page)).to_contain_text(said)
    doubted = page.get_by_label("Distance 4 to 12, mm", exact=True)
    expect(page.locator(".spans li.doubted")).to_contain_text("4 to 12")
    disagreeing(page).get_by_role("button", name="Look at it").click()
    expect(doubted).to_be_focused()
    disagreeing(page).get_by_role("button", name="Take 1515").click()
    disagreeing(page).wait_for(state="detached")
    at_rest(page)
    lengths = {each.between: each.length for each in read(lab).distances}
    assert lengths == {("2", "4"): 1123.5, ("4", "12"): 1515.0, ("8", "12"): 757.0}
    fields = page.get_by_role("list", name="Distances").get_by_role("textbox")
    fields.nth(0).fill("about two")
    fields.nth(0).press("Enter")
    expect(fields.nth(1)).to_be_focused()
    expect(fields.nth(0)).to_have_attribute("aria-invalid", "true")
    fields.nth(2).fill("")
    fields.nth(2).press("Tab")
    expect(fields).to_have_count(2)
    at_rest(page)
    assert {each.between for each in read(lab).distances} == {("2", "4"), ("4", "12")}


@pytest.fixture
def phone(open_page):
    """A page as wide as a phone."""
    return open_page(viewport={"width": 375, "height": 740})


def twenty_five(lab):
    """The lab's folder with the example's machine and a form of 25 marks that wait."""
    with_form(lab, example_form())
    words = ["grid", "--preset", "twenty-five", "--force"]
    settings, form = lab.folder / "groundcontrol.ini", lab.folder / "marks.toml"
    program = lab.folder / "grid.nc"
    files = ["--settings", settings, "--marks", form, "--output", program]
    assert main([*words, *map(str, files)]) == 0


def test_on_a_phone_the_mark_that_is_typed_is_open_and_the_sheet_opens_another(lab, phone):
    twenty_five(lab)
    open_readings(lab, phone)
    assert phone.locator(".cell:visible").count() == 1
    assert phone.evaluate("document.documentElement.scrollHeight") < 1800
    phone.get_by_label(LEFT.format(1), exact=True).click()
    for number in ("98", "106,5", "659.5", "110"):  # Enter goes on, from mark to mark
        phone.keyboard.type(number)
        phone.keyboard.press("Enter")
    await_saved(lab, phone, {"1": (98, 106.5), "2": (659.5, 110)})
    third = phone.get_by_label(LEFT.format(3), exact=True)
    assert third.evaluate("input => input === document.activeElement")
    assert phone.locator(".sheet circle.waits").count() == 23
    again = phone.get_by_label(LEFT.format(2), exact=True)
    phone.locator(".sheet circle.place").nth(1).click(force=True)
    expect(again).to_be_focused()
    assert again.input_value() == "659.5"
    phone.locator(".sheet .frame").focus()
    phone.keyboard.press("Home")
    phone.keyboard.press("Enter")
    expect(phone.get_by_label(LEFT.format(1), exact=True)).to_be_focused()


def test_on_a_phone_a_reading_that_disagrees_opens(lab, phone):
    with_form(lab, example_form(read=23).replace("[1221, 618]", "[1211, 618]"))
    open_readings(lab, phone)
    disagreeing(phone).get_by_text("Mark 8").wait_for()
    expect(phone.get_by_label(LEFT.format(8), exact=True)).to_be_hidden()
    disagreeing(phone).get_by_role("button", name="Look at it").first.click()
    field = phone.get_by_label(LEFT.format(8), exact=True)
    assert field.evaluate("input => input === document.activeElement")


LEFT_OF_2, TOP_OF_2 = "Mark 2 from the left, mm", "Mark 2 from the top, mm"


@pytest.fixture
def readings(lab, page):
    """The page of readings, all typed."""
    with_form(lab, example_form(read=99), "marks.toml")
    page.goto(f"{lab.url}#/readings")
    expect(page.locator(".count")).to_contain_text("23 of 23 marks are read")
    return page


def field(page, name):
    return page.get_by_label(name, exact=True)


def reason(page, name):
    """The description of a field, as a screen reader finds it."""
    return page.locator(f"#{field(page, name).get_attribute('aria-describedby')}")


def test_half_a_reading_does_not_count_not_even_after_a_reload(lab, readings):
    page, typed, said = readings, "11l.9", "“11l.9” is not a length: type it like 11.9"
    other = field(page, TOP_OF_2).input_value()
    field(page, LEFT_OF_2).fill(typed)
    expect(page.locator(".count")).to_contain_text("22 of 23 marks are read")
    field(page, "Mark 1 from the left, mm").focus()
    expect(reason(page, LEFT_OF_2)).to_have_text(said)
    expect(reason(page, LEFT_OF_2)).to_be_visible()
    expect(field(page, LEFT_OF_2)).to_have_attribute("aria-invalid", "true")
    assert len(read(lab).measured_marks) == 22
    page.reload()
    expect(page.locator(".count")).to_contain_text("22 of 23 marks are read")
    expect(field(page, LEFT_OF_2)).to_have_value(typed)
    expect(field(page, TOP_OF_2)).to_have_value(other)
    expect(reason(page, LEFT_OF_2)).to_have_text(said)
    field(page, LEFT_OF_2).fill("659.5")
    expect(page.locator(".count")).to_contain_text("23 of 23 marks are read")
    expect(field(page, LEFT_OF_2)).not_to_have_attribute("aria-describedby", re.compile("."))


def test_a_file_that_went_back_before_the_page_looked_is_loaded_again(lab, readings):
    """The page typed, another program undid it, and only then the page saw the folder."""
    page = readings
    whole = (lab.folder / "marks.toml").read_text()
    holds, held = True, []
    page.route("**/api/project", lambda look: held.append(look) if holds else look.continue_())
    with page.expect_response("**/api/readings"):
        field(page, LEFT_OF_2).fill("")
    assert len(read(lab).measured_marks) == 22
    await_question(page, held)
    (lab.folder / "marks.toml").write_text(whole)
    holds = False
    for look in held:
        look.continue_()
    expect(page.locator(".count")).to_contain_text("23 of 23 marks are read")


@pytest.fixture
def form(lab, page):
    """The form of the example with a few readings, on the page."""
    with_form(lab, example_form(read=5) + distances(*FEW), "marks.toml")
    page.goto(f"{lab.url}#/readings")
    page.get_by_label("Distance 2 to 4, mm").wait_for()
    return page


@pytest.fixture
def late(form):
    """Answers to saves of the form, which come when the test lets them."""
    waiting = []
    for part in ("distances", "fineness", "readings"):
        form.route(
            f"**/api/{part}",
            lambda route: waiting.append(route) if route.request.method == "PUT" else None,
        )
    return waiting


def let_go(page, late, count):
    """Let saves go on as they come; each is asked once that before it is answered."""
    for _ in range(count):
        await_question(page, late)
        assert len(late) == 1
        late.pop().continue_()


def test_a_reading_a_distance_and_the_tape_are_saved_together(lab, form, late):
    form.get_by_label("Finest lines of the tape").select_option("1")
    form.get_by_label(LEFT.format(6), exact=True).fill("98")
    form.get_by_label(TOP.format(6), exact=True).fill("360")
    for length in ("1120.5", "1120"):  # the second before the first is saved
        form.get_by_label("Distance 2 to 4, mm").fill(length)
        form.keyboard.press("Tab")
    let_go(form, late, 4)
    at_rest(form)
    assert len(read(lab).readings) == 6
    assert [each.length for each in read(lab).distances] == [1120, 1415, 757]
    assert read(lab).tape_sigma == pytest.approx(0.5, abs=0.3)
    assert form.get_by_role("alert").count() == 0


@pytest.fixture
def open_machine(lab, page):
    """Opens a screen of a machine with readings, some of which are to come."""
    fitted_machine(lab.folder)
    (lab.folder / "marks.toml").write_text(example_form(read=20))

    def opened(screen):
        page.goto(f"{lab.url}#/{screen}")
        return page

    return opened


def test_an_answer_to_an_older_question_changes_nothing(open_machine, page):
    asked, late = [], []

    def first_late(route):
        asked.append(route)
        if len(asked) > 1:
            return route.continue_()
        late.append(route.fetch())

    page.route("**/api/diary", first_late)
    open_machine("diary")
    await_question(page, late)
    page.get_by_label("inch").check()
    number = page.locator(".course").first
    expect(number).to_contain_text(" inch")
    with page.expect_response("**/api/diary"):
        asked[0].fulfill(response=late[0])
    at_rest(page)
    expect(number).to_contain_text(" inch")


def test_readings_count_from_the_edges_that_are_named_with_them(open_machine, page):
    saves = []
    # The choice is on its way for long.
    page.route("**/api/choices", lambda route: route.continue_() if saves else saves.append(route))
    open_machine("readings")
    left = page.get_by_label("Mark 1 from the left, mm", exact=True)
    x = float(left.input_value())
    page.get_by_label("Measured from").select_option("top-right")
    await_question(page, saves)
    # What the page would ask then is answered before this.
    page.evaluate("() => fetch('/').then((answer) => answer.text())")
    assert float(left.input_value()) == x
    saves[0].continue_()
    right = page.get_by_label("Mark 1 from the right, mm", exact=True)
    expect(right).to_have_value(re.compile(r"2\d\d\d"))
    assert float(right.input_value()) + x == pytest.approx(2438.4)


def test_a_question_without_an_answer_is_reported_and_asked_again(lab, fresh_page):
    page, never = fresh_page, []
    page.clock.install()
    start_virtual(page, lab)
    page.get_by_role("heading", name="Its first day").wait_for()
    page.route("**/api/guide", lambda route: never.append(route))
    await_question(page, never)
    said = page.get_by_text("The lab does not answer, so this may be old")
    assert said.count() == 0
    page.clock.fast_forward(10_000)
    said.wait_for()
    page.unroute("**/api/guide")
    page.clock.fast_forward(3_000)
    expect(said).to_have_count(0)
