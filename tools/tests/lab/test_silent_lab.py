"""A lab or a machine that says nothing: the page says so, and what stops the machine then."""

import re
import signal

import pytest
from folder import got
from lab_machine import PATIENCE, bar, start_virtual
from playwright.sync_api import expect
from served_lab import serve

UNREACHABLE = "Cannot reach the machine: use its power switch"


@pytest.fixture
def lab(tmp_path):
    """A lab of its test alone, which ends it or lets it stand still."""
    served = serve(tmp_path)
    yield served
    served.process.send_signal(signal.SIGCONT)
    served.end()


@pytest.fixture
def cutting(lab, page):
    """The page of a slow machine in mid-cut."""
    start_virtual(page, lab, speed=10)
    page.goto(f"{lab.site}#/cut")
    page.get_by_role("button", name="Move the sled and cut 9 marks").click()
    bar(page).get_by_text(re.compile(r"runs grid.nc: [3-9] of")).wait_for(timeout=PATIENCE)
    return page


def test_a_lab_that_was_killed_in_a_cut_is_not_taken_for_a_machine_that_runs(lab, cutting):
    lab.process.kill()
    shown = bar(cutting)
    shown.get_by_role("button", name="Stop", exact=True).click()
    expect(shown).to_contain_text("Nobody answers Stop; it is sent again and again.")
    expect(shown).to_contain_text(re.compile(r"last seen \d+ s ago"))
    expect(shown.get_by_role("button", name=UNREACHABLE)).to_be_visible()
    expect(shown.get_by_role("button", name="Stop", exact=True)).to_have_count(0)
    expect(shown.locator(".old .place")).to_be_visible()
    expect(cutting.get_by_role("heading", name="Nobody sees the machine")).to_be_visible()
    assert "runs grid.nc" not in shown.inner_text()
    lab.process = serve(lab.folder, port=lab.port).process
    expect(cutting.get_by_role("region", name="The machine", exact=True)).to_have_count(0)


def test_a_stop_that_nobody_heard_stops_the_machine_as_soon_as_the_lab_hears(lab, cutting):
    lab.process.send_signal(signal.SIGSTOP)
    shown = bar(cutting)
    shown.locator("button.stop").click()
    expect(shown).to_contain_text("Nobody answers Stop; it is sent again and again.")
    expect(shown.get_by_role("button", name=UNREACHABLE)).to_be_visible()
    lab.process.send_signal(signal.SIGCONT)
    expect(shown).to_contain_text("Stop was passed on to the machine.")
    expect(cutting.get_by_text("Stopped. The machine knows")).to_be_visible()
    expect(shown.get_by_role("button", name="Stop", exact=True)).to_be_visible()


def test_stop_comes_through_while_the_browser_has_no_connection_left(lab, cutting):
    """A browser sends six requests at a time: questions that nobody answers take them all."""
    lines = "() => { for (let i = 0; i < 6; i++) void fetch('api/machine/slow' + i); }"
    cutting.route("**/api/machine/s*", lambda route: None)  # held back, Stop as a request too
    cutting.evaluate(lines)
    bar(cutting).get_by_role("button", name="Stop", exact=True).click()
    expect(bar(cutting)).to_contain_text("Stop was passed on to the machine.")
    expect(cutting.get_by_text("Stopped. The machine knows")).to_be_visible()


def test_a_machine_whose_line_is_lost_is_stopped_at_its_power_switch(lab, page, cable):
    path, pulled = cable
    page.goto(lab.url)
    got(lab.client().post("/api/machine/board", json={"port": path}))
    expect(bar(page)).to_contain_text("stands", timeout=PATIENCE)
    pulled.set()
    expect(bar(page)).to_contain_text(f"{UNREACHABLE}.", timeout=PATIENCE)
