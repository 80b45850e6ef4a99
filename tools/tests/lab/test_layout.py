"""What one looks at stays in view, what one does scrolls next to it; a phone has one column."""

import pytest
from lab_machine import bar, start_virtual
from playwright.sync_api import expect
from screens import measured_machine

WIDE, NARROW = {"width": 1280, "height": 800}, {"width": 390, "height": 844}
# What each screen wants first: a field or a button.
FIRST = {
    "open": ".pick",
    "known": ".known input",
    "measure": ".layouts label",
    "cut": ".choice .primary",
    "readings": ".cells input",
    "verdict": ".act button",
    "correct": ".numbers input",
}
ON_PHONE = ("known", "cut", "readings", "verdict", "correct")
# The button of a screen whose fields come before it.
ACTS = {"verdict": "Find the best next", "correct": "Accept a number", "bench": "Write these"}


@pytest.fixture
def measured(lab, page):
    """The page of a machine whose marks are read."""
    measured_machine(lab.folder)
    page.set_viewport_size(WIDE)
    page.goto(f"{lab.url}#/open")
    page.get_by_role("heading", level=1).wait_for()

    def opened(step):
        page.goto(f"{lab.url}#/{step}")
        page.locator("main h1").wait_for()
        return page

    return opened


@pytest.mark.parametrize(
    ("step", "size"),
    [*((step, WIDE) for step in FIRST), *((step, NARROW) for step in ON_PHONE)],
    ids=[*FIRST, *(f"{step}-on-phone" for step in ON_PHONE)],
)
def test_the_first_thing_to_do_is_on_the_first_screen(measured, step, size):
    page = measured(step)
    page.set_viewport_size(size)
    first = page.locator(FIRST[step]).first
    first.wait_for()
    foot = page.locator(".way-on").bounding_box()["y"]
    box = first.bounding_box()
    assert box["y"] + box["height"] <= foot
    expect(page.get_by_role("heading", level=1)).to_be_in_viewport(ratio=1)
    expect(page.locator(".way-on .after")).to_be_in_viewport(ratio=1)


@pytest.mark.parametrize("step", ["known", "readings", "verdict"])
def test_the_picture_stays_while_the_work_scrolls(measured, step):
    page = measured(step)
    picture = page.locator(".stage svg").first
    picture.wait_for()
    page.locator(".work details").last.scroll_into_view_if_needed()
    page.wait_for_function("() => scrollY > 0")
    expect(picture).to_be_in_viewport(ratio=0.9)


def test_the_error_stays_in_view_down_to_the_last_effect(measured):
    page = measured("bench")
    number = page.locator(".fall-now output")
    expect(number).to_contain_text("mm")
    before = number.inner_text()
    for size in (WIDE, NARROW):
        page.set_viewport_size(size)
        last = page.locator(".effect").last
        last.scroll_into_view_if_needed()
        expect(number).to_be_in_viewport(ratio=0.95)
    page.set_viewport_size(WIDE)
    page.get_by_role("checkbox", name="chains too long").check()
    expect(number).not_to_have_text(before)
    expect(page.locator(".sheet svg")).to_be_in_viewport(ratio=0.9)
    fallen = page.locator(".stairs tbody tr").nth(2).locator("td:nth-of-type(2)")
    expect(fallen).to_have_text(number.inner_text().removesuffix(" mm"))


def test_a_phone_has_one_column_and_small_bars(measured):
    page = measured("known")
    page.set_viewport_size(NARROW)
    asks, stage, work = (
        page.locator(f".screen .{part}").bounding_box() for part in ("asks", "stage", "work")
    )
    assert asks["y"] < stage["y"] < work["y"]
    assert {box["x"] for box in (asks, stage, work)} == {asks["x"]}
    foot = page.locator(".way-on")
    expect(foot).to_be_in_viewport(ratio=1)
    page.locator(".known input").last.scroll_into_view_if_needed()
    seen = "each => Math.max(0, each.getBoundingClientRect().bottom)"
    bars = page.locator("header").evaluate(seen) + foot.bounding_box()["height"]
    assert bars <= 0.15 * NARROW["height"]


def test_a_phone_shows_the_first_field_of_the_readings_without_scrolling(measured):
    page = measured("readings")
    page.set_viewport_size(NARROW)
    fields = page.locator(".cells input")
    fields.first.wait_for()
    for field in (fields.nth(0), fields.nth(1)):
        box = field.bounding_box()
        assert box["y"] + box["height"] <= page.locator(".way-on").bounding_box()["y"]
    expect(page.get_by_label("Measured from")).to_be_in_viewport(ratio=1)


def test_the_steps_fold_on_a_phone_when_the_open_step_is_chosen_again(measured):
    page = measured("known")
    page.set_viewport_size(NARROW)
    steps = page.get_by_role("navigation", name="Steps")
    for step in ("What you know", "Reach"):  # the step that is open, and another
        steps.get_by_role("button").click()
        steps.get_by_role("link", name=step).click()
        expect(steps.get_by_role("button")).to_have_attribute("aria-expanded", "false")
        expect(steps.get_by_role("link", name=step)).to_be_hidden()


@pytest.mark.parametrize("size", [WIDE, NARROW], ids=["wide", "narrow"])
@pytest.mark.parametrize("step", ACTS)
def test_the_button_of_a_screen_is_in_view_and_covers_no_foot(measured, step, size):
    page = measured(step)
    page.set_viewport_size(size)
    act = page.get_by_role("button", name=ACTS[step])
    expect(act).to_be_in_viewport(ratio=1)
    page.mouse.wheel(0, 300)
    page.wait_for_function("() => scrollY > 0")
    expect(act).to_be_in_viewport(ratio=1)
    foot = page.locator(".way-on")
    box = act.bounding_box()
    if foot.count():
        assert box["y"] + box["height"] <= foot.bounding_box()["y"]
        assert size == WIDE or page.viewport_size["height"] - box["y"] < 0.16 * size["height"]


def test_a_connected_machine_covers_neither_button_nor_foot(lab, page):
    start_virtual(page, lab)
    page.set_viewport_size(WIDE)
    page.goto(f"{lab.site}#/known")
    on = page.locator(".way-on .after")
    expect(on).to_be_in_viewport(ratio=1)
    box = on.bounding_box()
    assert box["y"] + box["height"] <= bar(page).bounding_box()["y"]
