"""Half a reading is none: it does not count, and each screen says what is missing."""

import re
import shutil

import pytest
from folder import EXAMPLE, example_form
from playwright.sync_api import expect
from plumb.grid.pattern import spans_line
from plumb.marks.form import read_form
from screens import at_rest, await_question

SHEET = (2438.4, 1219.2)
LEFT, TOP = "Mark 2 from the left, mm", "Mark 2 from the top, mm"
PATIENCE = 300_000  # [ms] of a busy computer


@pytest.fixture
def readings(lab, page):
    """The page of readings, all typed."""
    shutil.copy(EXAMPLE / "groundcontrol.ini", lab.folder)
    (lab.folder / "marks.toml").write_text(example_form(read=99))
    (lab.folder / "lab.json").write_text(
        '{"settings": "groundcontrol.ini", "marks": ["marks.toml"]}'
    )
    page.goto(f"{lab.url}#/readings")
    expect(page.locator(".count")).to_contain_text("23 of 23 marks are read")
    return page


def field(page, name):
    return page.get_by_label(name, exact=True)


def reason(page, name):
    """What stands next to a field, as a screen reader finds it."""
    return page.locator(f"#{field(page, name).get_attribute('aria-describedby')}")


def read_on_disk(lab):
    form = read_form(lab.folder / "marks.toml", sheet=SHEET)
    return len(form.measurements.measured_marks)


@pytest.mark.parametrize(
    ("typed", "said"),
    [("", "not read: from the left?"), ("11l.9", "“11l.9” is no length: type it like 11.9")],
)
def test_half_a_reading_does_not_count_not_even_after_a_reload(lab, readings, typed, said):
    page = readings
    other = field(page, TOP).input_value()
    field(page, LEFT).fill(typed)
    expect(page.locator(".count")).to_contain_text("22 of 23 marks are read")
    field(page, "Mark 1 from the left, mm").focus()
    expect(reason(page, LEFT)).to_have_text(said)
    expect(reason(page, LEFT)).to_be_visible()
    expect(field(page, LEFT)).to_have_attribute("aria-invalid", "true")
    assert read_on_disk(lab) == 22
    page.reload()
    expect(page.locator(".count")).to_contain_text("22 of 23 marks are read")
    expect(field(page, LEFT)).to_have_value(typed)
    expect(field(page, TOP)).to_have_value(other)
    expect(reason(page, LEFT)).to_have_text(said)
    page.goto(f"{lab.site}#/verdict")
    half = page.get_by_text("1 mark is half typed and does not count.")
    expect(half).to_be_visible(timeout=PATIENCE)
    page.goto(f"{lab.site}#/readings")
    field(page, LEFT).fill("659.5")
    expect(page.locator(".count")).to_contain_text("23 of 23 marks are read")
    expect(field(page, LEFT)).not_to_have_attribute("aria-describedby", re.compile("."))
    page.goto(f"{lab.site}#/verdict")
    states = page.get_by_role("group", name="What is drawn")
    expect(states.get_by_text("as set")).to_be_visible(timeout=PATIENCE)
    expect(half).to_have_count(0)


def test_what_another_program_read_meanwhile_is_no_half_any_more(lab, readings):
    page = readings
    whole = (lab.folder / "marks.toml").read_text()
    field(page, LEFT).fill("")
    expect(page.locator(".count")).to_contain_text("22 of 23 marks are read")
    at_rest(page)
    assert read_on_disk(lab) == 22
    (lab.folder / "marks.toml").write_text(whole)
    expect(page.locator(".count")).to_contain_text("23 of 23 marks are read")
    expect(field(page, LEFT)).not_to_have_value("")
    page.goto(f"{lab.site}#/verdict")
    states = page.get_by_role("group", name="What is drawn")
    expect(states.get_by_text("as set")).to_be_visible(timeout=PATIENCE)
    expect(page.get_by_text("half typed")).to_have_count(0)


def test_a_file_that_went_back_before_the_page_looked_is_loaded_again(lab, readings):
    """The page typed, another program undid it, and only then the page saw the folder."""
    page = readings
    whole = (lab.folder / "marks.toml").read_text()
    holds, held = True, []
    page.route("**/api/project", lambda look: held.append(look) if holds else look.continue_())
    with page.expect_response("**/api/readings"):
        field(page, LEFT).fill("")
    assert read_on_disk(lab) == 22
    await_question(page, held)
    (lab.folder / "marks.toml").write_text(whole)
    holds = False
    for look in held:
        look.continue_()
    expect(page.locator(".count")).to_contain_text("23 of 23 marks are read")


def test_half_a_reading_belongs_to_the_edges_from_which_it_was_typed(lab, readings):
    page = readings
    field(page, LEFT).fill("x")
    expect(page.locator(".count")).to_contain_text("22 of 23 marks are read")
    page.get_by_label("Measured from").select_option("top-right")
    expect(field(page, "Mark 2 from the right, mm")).to_have_value("")
    page.get_by_label("Measured from").select_option("top-left")
    expect(field(page, LEFT)).to_have_value("x")


def test_the_sign_of_the_inch_means_inch(lab, readings):
    page = readings
    field(page, LEFT).fill('4 13/32"')
    field(page, TOP).fill("26 1/16 in")
    expect(page.locator(".count")).to_contain_text("23 of 23 marks are read")
    wanted = (4 + 13 / 32) * 25.4, (26 + 1 / 16) * 25.4

    def place():
        form = read_form(lab.folder / "marks.toml", sheet=SHEET)
        x, y = form.measurements.marks[1].measured
        return x + SHEET[0] / 2, SHEET[1] / 2 - y

    at_rest(page)
    assert place() == pytest.approx(wanted, abs=0.01)


def test_a_distance_that_is_no_length_does_not_count(lab, page):
    shutil.copy(EXAMPLE / "groundcontrol.ini", lab.folder)
    form = f"{spans_line([('2', '4')])}\n{example_form()}"
    (lab.folder / "marks.toml").write_text(form)
    (lab.folder / "lab.json").write_text('{"settings": "groundcontrol.ini"}')
    page.goto(f"{lab.url}#/readings")
    name = "Distance 2 to 4, mm"
    field(page, name).fill("1123")
    field(page, name).press("Enter")
    expect(page.locator(".count")).to_contain_text("1 of 1 distances are read")
    field(page, name).fill("112l")
    field(page, name).press("Enter")
    expect(page.locator(".count")).to_contain_text("0 of 1 distances are read")
    expect(field(page, name)).to_have_value("112l")
    expect(reason(page, name)).to_contain_text("“112l” is no length")
    field(page, name).fill("1124")
    field(page, name).press("Enter")
    expect(page.locator(".count")).to_contain_text("1 of 1 distances are read")
