"""From the verdict to more marks and back in a browser: taken, cut, typed, counted."""

import pytest
from folder import got
from lab_machine import PATIENCE, bar, start_virtual
from playwright.sync_api import expect
from plumb.marks.form import read_form
from plumb.marks.read import read_marks
from plumb.settings.files import read_settings
from screens import measured_machine

MACHINE = 9  # the number of a virtual machine
SHEET = (2438.4, 1219.2)
WANTED = "4 marks with 5 kg more"
KILOGRAM = 9.81  # [N]


def go_to(page, step):
    page.get_by_role("navigation").get_by_role("link", name=step).click()


def cut_nine(page):
    go_to(page, "Cut")
    page.get_by_role("button", name="Move the sled and cut 9 marks").click(timeout=PATIENCE)
    page.get_by_role("button", name="Let a tape read the 9 marks").click(timeout=PATIENCE)
    page.get_by_text("9 of 9 marks are read").wait_for(timeout=PATIENCE)


def take(page, title):
    go_to(page, "Verdict")
    page.get_by_role("button", name="Find the best next measurement").click(timeout=PATIENCE)
    page.get_by_role("button", name=f"Take: {title}").click(timeout=PATIENCE)
    page.get_by_role("heading", name="Cut 4 more marks").wait_for(timeout=PATIENCE)
    assert page.get_by_text("All marks are cut.").count() == 0  # which was of the nine


def go_on(page, *, when):
    """Press Go on in the pause in which the page asks for something."""
    expect(page.locator(".say")).to_contain_text(when, timeout=PATIENCE)
    expect(bar(page)).to_contain_text("The virtual machine waits for you")
    expect(bar(page).get_by_role("alert")).to_contain_text(when[1:])
    bar(page).get_by_role("button", name="Go on").click()


def what_the_tape_says(lab, form):
    """The readings of a form that waits, by their marks; the folder stays as it is."""
    kept = {name: (lab.folder / name).read_bytes() for name in (form, "lab.json")}
    got(lab.client().post("/api/machine/readings", json={"form": form}))
    readings = read_marks(lab.folder / form, sheet=SHEET).readings
    for name, content in kept.items():
        (lab.folder / name).write_bytes(content)
    return [(mark.name, x + SHEET[0] / 2, SHEET[1] / 2 - y) for mark, (x, y) in readings]


def type_readings(page, readings):
    for name, x, y in readings:
        page.get_by_label(f"Mark {name} from the left, mm", exact=True).fill(f"{x:.1f}")
        page.get_by_label(f"Mark {name} from the top, mm", exact=True).fill(f"{y:.1f}")


def test_marks_that_the_verdict_proposes_are_cut_typed_and_counted(lab, page):
    start_virtual(page, lab, number=MACHINE)
    cut_nine(page)
    take(page, WANTED)
    planned = read_form(lab.folder / "more.toml", sheet=SHEET).measurements.marks
    expect(page.locator(".pauses li")).to_have_count(2)
    page.get_by_role("button", name="Move the sled and cut 4 marks").click()
    go_on(page, when="Let 5.0 kg more hang on the sled")
    go_on(page, when="Take off what hangs on the sled")
    page.get_by_text("All marks are cut.").wait_for(timeout=PATIENCE)
    readings = what_the_tape_says(lab, "more.toml")
    page.get_by_role("link", name="Type what your tape says").click()
    page.get_by_text("0 of 4 marks are read").wait_for(timeout=PATIENCE)
    type_readings(page, readings)
    page.get_by_text("4 of 4 marks are read").wait_for(timeout=PATIENCE)
    read = read_marks(lab.folder / "more.toml", sheet=SHEET)
    assert [mark.target for mark in read.measured_marks] == [mark.target for mark in planned]
    usual = read_settings(lab.folder / "machine.toml").sled_weight
    assert all(
        mark.sled_weight == pytest.approx(usual + 5 * KILOGRAM, abs=0.1)
        for mark in read.measured_marks
    )
    go_to(page, "Verdict")
    page.get_by_role("heading", name="One suspect").wait_for(timeout=PATIENCE)
    arrows = page.locator(".stage .sheet circle.place")
    expect(arrows).to_have_count(13, timeout=PATIENCE)
    expect(page.locator(".command code").last).to_contain_text("marks.toml more.toml")


def test_a_question_for_the_next_measurement_outlasts_a_verdict_that_is_made_again(lab, page):
    measured_machine(lab.folder)
    page.goto(f"{lab.url}#/verdict")
    page.get_by_role("button", name="Find the best next measurement").click(timeout=PATIENCE)
    page.get_by_label("The next measurement").wait_for(timeout=PATIENCE)
    form = lab.folder / "marks.toml"
    form.write_text(form.read_text().replace("[659.5, 110.5]", "[659.5, 110.0]"))
    page.get_by_role("heading", name="Why are the marks off?").wait_for(timeout=PATIENCE)
    page.get_by_role("region", name="The next measurement").wait_for(timeout=PATIENCE)
