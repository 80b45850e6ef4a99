"""A correction that is written: the page says so, asks no question again, and sends it next."""

import re

from folder import choose, finished, got
from lab_machine import PATIENCE
from playwright.sync_api import expect
from screens import measured_machine

TITLE = "main h1"
WANTED = "main .primary"
ALL = ("motor_gap", "motor_height", "motor_center_x", "chain_stretch.compliance")


def write(page, lab, *names):
    """Numbers of the example's correction, into a file."""
    measured_machine(lab.folder)
    with lab.client() as client:
        choose(client, accepted=list(names))
        finished(client, "correction")
    page.goto(f"{lab.url}#/correct")
    expect(page.locator(TITLE)).to_have_text("What would change?")
    page.get_by_role("button", name=re.compile(r"Write \d numbers? into machine")).click()
    expect(page.locator(TITLE)).to_have_text("The numbers are written")
    expect(page.locator("dl.errors[aria-busy=false]")).to_be_visible(timeout=PATIENCE)
    expect(page.locator(TITLE)).to_have_text("The numbers are written")


def test_what_is_written_is_not_asked_again_and_goes_to_the_machine_next(lab, page):
    write(page, lab, *ALL)
    assert page.get_by_role("checkbox").count() == 0
    assert page.get_by_role("button", name="Accept all").count() == 0
    expect(page.locator(WANTED)).to_have_text("Connect the machine, then send machine.toml")
    page.reload()
    expect(page.locator(WANTED)).to_have_text("Connect the machine, then send machine.toml")
    page.get_by_role("button", name="Go back to groundcontrol.ini").click()
    expect(page.locator(TITLE)).to_have_text("What would change?")


def test_what_was_not_accepted_is_folded_away_and_can_be_accepted_later(lab, page):
    write(page, lab, "motor_height")
    assert page.get_by_role("checkbox").count() == 0
    page.get_by_text("What would still change").click()
    gap = page.get_by_role("checkbox", name="gap between the motors")
    gap.check()
    wanted = page.locator(WANTED)
    expect(wanted).to_have_text("Write 1 number into machine-2.toml", timeout=PATIENCE)


def test_a_reading_that_changes_after_the_writing_says_what_is_stale_and_leads_back(lab, page):
    write(page, lab, *ALL)
    form = lab.folder / "marks.toml"
    form.write_text(form.read_text().replace("[659.5, 110.5]", "[659.5, 111.5]"))
    for step in ("verdict", "check", "correct"):
        page.goto(f"{lab.site}#/{step}")
        expect(page.locator(TITLE)).to_have_text("Your readings have changed", timeout=PATIENCE)
    expect(page.locator(".say")).to_contain_text("The numbers in machine.toml are stale")
    page.get_by_role("button", name="Go back to groundcontrol.ini and fit again").click()
    expect(page.locator(TITLE)).to_have_text("What would change?", timeout=PATIENCE)
    expect(page.locator(WANTED)).to_have_count(1, timeout=PATIENCE)


def test_readings_that_are_those_of_the_fit_are_never_called_changed(lab, page):
    write(page, lab, *ALL)
    with lab.client() as client:
        assert got(client.get("/api/project"))["changed_since_fit"] == ""
    page.route("**/api/check", lambda route: None)  # as long as it is not answered
    page.goto(f"{lab.site}#/check")
    expect(page.get_by_text("One moment …")).to_be_visible()
    expect(page.locator(TITLE)).to_have_text("Is it true?")


def test_what_noise_alone_would_leave_stands_at_each_error_of_a_fit(lab, page):
    measured_machine(lab.folder)
    page.goto(f"{lab.url}#/correct")
    page.get_by_role("button", name="Accept all").click(timeout=PATIENCE)
    errors = page.locator("dl.errors > div")
    for place in (1, 2):
        expect(errors.nth(place)).to_contain_text(
            re.compile(r"0\.\d\d mm\s*noise alone leaves 0\.\d\d"), timeout=PATIENCE
        )
    expect(errors.nth(0)).not_to_contain_text("noise")
    # The sheet compares the same three, each mark with its circle of noise.
    states = page.get_by_role("group", name="What is drawn").locator("label")
    expect(states).to_have_count(3)
    for place, state in enumerate(states.all()):
        state.click()
        expect(state.get_by_role("radio")).to_be_checked()
        assert state.locator("b").inner_text() in errors.nth(place).inner_text()
        expect(page.locator(".sheet svg > g > g circle.noise")).to_have_count(23)
    by_hand = page.get_by_role("region", name="By hand").inner_text()
    assert "too long: no firmware" in by_hand and "_" not in by_hand


def test_the_sheet_shows_what_the_new_numbers_would_do_and_what_is_written(lab, page):
    measured_machine(lab.folder)
    page.goto(f"{lab.url}#/correct")
    errors = page.locator("dl.errors dd")
    states = page.get_by_role("group", name="What is drawn").get_by_role("radio")
    expect(states).to_have_count(2, timeout=PATIENCE)  # nothing is accepted yet
    expect(states.nth(1)).to_be_checked()
    page.get_by_role("checkbox", name="gap between the motors").check()
    expect(states).to_have_count(3, timeout=PATIENCE)
    expect(states.nth(1)).to_be_checked()
    said = page.get_by_role("group", name="What is drawn").locator("b").all_inner_texts()
    assert said == [figure.partition("\n")[0].strip() for figure in errors.all_inner_texts()]
    beyond = page.locator(".sheet .arrow.beyond")
    assert beyond.count() > 20
    page.locator(".sheet .board").press("]")
    expect(states.nth(2)).to_be_checked()
    assert beyond.count() < 4
