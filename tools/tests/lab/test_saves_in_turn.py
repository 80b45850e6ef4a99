"""Saves of a tab that come before the answer to its last save: each is done, in turn."""

import json

import pytest
from folder import EXAMPLE, example_form
from playwright.sync_api import expect
from plumb.marks.form import read_form
from screens import at_rest, await_question

SHEET = (2438.4, 1219.2)
LEFT, TOP = "Mark {} from the left, mm", "Mark {} from the top, mm"
FEW = ("2", "4", "1123.5"), ("4", "12", "1515"), ("8", "12", "757")


@pytest.fixture
def form(lab, page):
    """The form of the example with a few readings, on the page."""
    (lab.folder / "groundcontrol.ini").write_bytes((EXAMPLE / "groundcontrol.ini").read_bytes())
    (lab.folder / "marks.toml").write_text(example_form(read=5))
    choices = {"settings": "groundcontrol.ini", "marks": ["marks.toml"]}
    (lab.folder / "lab.json").write_text(json.dumps(choices))
    page.goto(f"{lab.url}#/readings")
    page.get_by_text("Distances between marks (0)").click()
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


def add(page, first, second, length):
    page.get_by_label("from mark").select_option(first)
    page.get_by_label("to mark").select_option(second)
    page.locator(".distances form input").fill(length)
    page.get_by_role("button", name="Add the distance").click()


def read(lab):
    return read_form(lab.folder / "marks.toml", sheet=SHEET).measurements


def let_go(page, late, count):
    """Let saves go on as they come; each is asked once that before it is answered."""
    for _ in range(count):
        await_question(page, late)
        assert len(late) == 1
        late.pop().continue_()


def test_distances_that_are_added_faster_than_they_are_saved_are_all_there(lab, form, late):
    for distance in FEW:
        add(form, *distance)
    form.get_by_role("button", name="Add the distance").click()  # once more: it is on its way
    let_go(form, late, len(FEW))
    expect(form.locator(".distances li")).to_have_count(len(FEW))
    assert [f"{each.length:g}" for each in read(lab).distances] == [each[2] for each in FEW]
    assert form.get_by_role("alert").count() == 0


def test_a_reading_a_distance_and_the_tape_are_saved_together(lab, form, late):
    form.get_by_label("Finest lines of the tape").select_option("1")
    form.get_by_label(LEFT.format(6), exact=True).fill("98")
    form.get_by_label(TOP.format(6), exact=True).fill("360")
    add(form, *FEW[0])
    let_go(form, late, 3)
    at_rest(form)
    assert len(read(lab).readings) == 6 and read(lab).distances
    assert read(lab).tape_sigma == pytest.approx(0.5, abs=0.3)
    assert form.get_by_role("alert").count() == 0


def test_what_another_tab_saved_in_between_is_not_replaced(lab, form, late):
    add(form, *FEW[0])
    await_question(form, late)
    (lab.folder / "marks.toml").write_text(example_form(read=9))
    late.pop().continue_()
    form.get_by_role("alert").get_by_text("marks.toml has changed in the meantime").wait_for()
    assert len(read(lab).readings) == 9 and not read(lab).distances
    assert form.locator(".distances form input").input_value() == FEW[0][2]
    form.get_by_text("9 of 23 marks are read").wait_for()
    at_rest(form)
    assert form.get_by_role("alert").get_by_text("in the meantime").is_visible(), "it stays"
    form.get_by_role("button", name="Add the distance").click()
    let_go(form, late, 1)
    expect(form.get_by_role("alert")).to_have_count(0)
    expect(form.locator(".distances li")).to_have_count(1)
    assert len(read(lab).readings) == 9


def test_a_reading_is_saved_though_other_edges_are_chosen_before_its_turn(lab, form, late):
    """What waits goes out when its cells are shown no more."""
    for mark, x, y in ((6, "98", "360"), (7, "660", "361")):
        form.get_by_label(LEFT.format(mark), exact=True).fill(x)
        form.get_by_label(TOP.format(mark), exact=True).fill(y)
        await_question(form, late)
    form.get_by_label("Measured from").select_option("bottom-right")
    form.get_by_label("Mark 6 from the right, mm", exact=True).wait_for()
    let_go(form, late, 2)
    at_rest(form)
    assert len(read(lab).readings) == 7
    x, y = {mark.name: place for mark, place in read(lab).readings}["7"]
    assert (x + SHEET[0] / 2, SHEET[1] / 2 - y) == pytest.approx((660, 361), abs=0.1)
