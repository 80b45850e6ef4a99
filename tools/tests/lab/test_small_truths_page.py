"""Small things that the page says, that they are so; and when it is at rest."""

import re

import pytest
from lab_machine import bar, start_virtual, with_machine
from playwright.sync_api import expect
from screens import at_rest, await_question, measured_machine, with_virtual_machine

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


def test_the_question_for_the_next_measurement_outlasts_a_reload(lab, page):
    measured_machine(lab.folder)
    page.goto(f"{lab.url}#/verdict")
    page.get_by_role("button", name="Find the best next measurement").click()
    page.get_by_label("The next measurement").first.wait_for()
    page.reload()
    page.get_by_label("The next measurement").first.wait_for()
    assert page.get_by_role("button", name="Find the best next measurement").count() == 0


def test_a_screen_reader_is_told_states_and_no_places_or_counts(lab, page):
    start_virtual(page, lab, number=9)
    page.goto(f"{lab.site}#/cut")
    page.evaluate(SPOKEN)
    page.get_by_role("button", name="Move the sled and cut 9 marks").click()
    page.get_by_text("All marks are cut.").wait_for()
    expect(bar(page).locator("[role=status]").first).to_have_text("The virtual machine stands")
    spoken = page.evaluate("() => window.spoken")
    assert any("runs grid.nc" in line for line in spoken)
    assert not [line for line in spoken if re.search(r"\d+ of \d+|\d mm", line)]
    assert len(spoken) < 12


def test_the_drawing_of_the_machine_has_the_sled_where_the_bar_says(lab, page):
    with_virtual_machine(lab, lambda program: program["outcome"] == "done")
    for screen in ("known", "open"):
        page.goto(f"{lab.url}#/{screen}")
        at_rest(page)
        place = bar(page).locator(".place").inner_text().replace("\u2212", "-")
        said = re.findall(r"-?\d+\.\d", place)
        sled = page.locator(".machine-picture .bit")
        drawn = [float(sled.get_attribute("cx")), -float(sled.get_attribute("cy"))]
        assert drawn == pytest.approx([float(mm) for mm in said[:2]], abs=0.06)


def test_the_page_is_at_rest_once_everything_is_answered_saved_and_drawn(lab, page):
    measured_machine(lab.folder)
    page.goto(f"{lab.url}#/readings")
    rest = page.locator("html[data-rest]")
    at_rest(page)
    held = []
    field = page.get_by_label("Mark 2 from the left, mm", exact=True)
    for path, press in (
        ("readings", lambda: field.fill("650")),
        ("verdict", lambda: page.evaluate("() => { location.hash = '#/verdict' }")),
    ):
        page.route(f"**/api/{path}", lambda route: held.append(route))
        press()
        await_question(page, held)
        expect(rest).to_have_count(0)
        held.pop().continue_()
        page.unroute(f"**/api/{path}")
        at_rest(page)
    assert page.locator(".sheet circle.place").count() == 23


def test_the_page_reveals_what_its_virtual_machine_hides(lab, page):
    page.goto(f"{lab.url}#/practice")
    page.get_by_text("No virtual machine was started in this folder").wait_for()
    terminal = page.locator("details.command code")
    expect(terminal).to_have_text("plumb practice start .")
    start_virtual(page, lab, number=7)
    page.get_by_role("link", name="Practice").click()
    expect(terminal).to_have_text("plumb practice reveal . machine.toml")
    page.get_by_role("button", name="Reveal what was hidden").click()
    score = page.get_by_role("region", name="Score")
    expect(score).to_contain_text("Hidden was sled_swing (right and up). You missed")
    expect(score).not_to_contain_text("You added")  # its numbers are as it listed them
    expect(score).to_contain_text("2.13 → 2.13 mm error all over the sheet")


def test_a_board_with_another_firmware_is_offered_ours_and_the_owner_asked_first(lab, fresh_page):
    with_machine(fresh_page, firmware="Firmware Version 1.29", brought="Plumb v1.0.0")
    fresh_page.goto(lab.url)
    expect(fresh_page.get_by_text("On the board: Firmware Version 1.29")).to_be_visible()
    write = fresh_page.get_by_role("button", name="Write Plumb v1.0.0 to this board")
    write.click()
    fresh_page.get_by_role("button", name="Leave it as it is").click()
    write.click()
    now = fresh_page.get_by_role("button", name="Write it now")
    now.click()
    expect(fresh_page.get_by_role("alert")).to_contain_text("no machine is connected")
