"""Small things that the page said and that were not so."""

import re

import pytest
from folder import got, until
from lab_machine import PATIENCE, bar, start_virtual
from playwright.sync_api import expect
from screens import at_rest, measured_machine

SPOKEN = """() => {
  window.spoken = [];
  new MutationObserver((all) => all.forEach((each) => {
    const place = each.target.parentElement?.closest("[role=status]");
    if (place) window.spoken.push(place.textContent);
  })).observe(document.querySelector(".machine-bar"), { subtree: true, characterData: true });
}"""


def test_an_address_that_names_no_screen_shows_none(lab, page):
    page.goto(f"{lab.url}#/verdikt")
    expect(page.locator("main h1")).to_have_text("No such screen")
    page.get_by_role("link", name="To the machine").click()
    expect(page.locator("main h1")).to_have_text("Which machine is it?")


def test_a_file_that_is_open_is_named_where_another_is_picked(lab, page):
    measured_machine(lab.folder)
    page.goto(lab.url)
    expect(page.locator("label.pick")).to_contain_text("groundcontrol.ini is open")
    colour = page.locator("label.pick input").evaluate("(each) => getComputedStyle(each).color")
    assert colour == "rgba(0, 0, 0, 0)"  # the browser says "No file chosen" next to its button


def test_the_question_for_the_next_measurement_outlasts_a_reload(lab, page):
    measured_machine(lab.folder)
    page.goto(f"{lab.url}#/verdict")
    page.get_by_role("button", name="Find the best next measurement").click(timeout=PATIENCE)
    page.get_by_label("The next measurement").first.wait_for(timeout=PATIENCE)
    page.reload()
    page.get_by_label("The next measurement").first.wait_for(timeout=PATIENCE)
    assert page.get_by_role("button", name="Find the best next measurement").count() == 0


def test_a_screen_reader_is_told_states_and_no_places_or_counts(lab, page):
    start_virtual(page, lab, number=9)
    page.goto(f"{lab.site}#/cut")
    page.evaluate(SPOKEN)
    page.get_by_role("button", name="Move the sled and cut 9 marks").click()
    page.get_by_text("All marks are cut.").wait_for(timeout=PATIENCE)
    expect(bar(page).locator("[role=status]").first).to_have_text("The virtual machine stands")
    spoken = page.evaluate("() => window.spoken")
    assert any("runs grid.nc" in line for line in spoken)
    assert not [line for line in spoken if re.search(r"\d+ of \d+|\d mm", line)]
    assert len(spoken) < 12


def test_the_drawing_of_the_machine_has_the_sled_where_the_bar_says(lab, page):
    measured_machine(lab.folder)
    with lab.client() as client:
        got(client.post("/api/machine/virtual", json={"seed": 9, "speed": 1000}))
        until(client, lambda machine: machine["phase"] == "ready")
        got(client.post("/api/machine/settings"))
        got(client.post("/api/grid/cut"))
        until(client, lambda machine: machine["program"]["outcome"] == "done")
    for screen in ("known", "open"):
        page.goto(f"{lab.url}#/{screen}")
        at_rest(page)
        said = re.findall(
            r"-?\d+\.\d", bar(page).locator(".place").inner_text().replace("\u2212", "-")
        )
        sled = page.locator(".machine-picture .bit")
        drawn = [float(sled.get_attribute("cx")), -float(sled.get_attribute("cy"))]
        assert drawn == pytest.approx([float(mm) for mm in said[:2]], abs=0.06)


def test_a_height_has_a_name_that_says_from_where_it_is_measured(lab, page):
    measured_machine(lab.folder)
    page.goto(f"{lab.url}#/known")
    known = page.locator(".known").first
    expect(known).to_contain_text("the motors above the top edge of the sheet")
    page.goto(f"{lab.site}#/correct")
    numbers = page.locator(".numbers")
    expect(numbers).to_contain_text("motors above the middle of the sheet", timeout=PATIENCE)
