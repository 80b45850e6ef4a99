"""Cutting in a browser: hold, stop, a cable pulled."""

import re

from folder import got, until
from lab_machine import PATIENCE, bar, start_virtual
from playwright.sync_api import expect


def set_speed(lab, speed):
    """Let the lab's virtual machine run this many times as fast as a real machine."""
    got(lab.client().post("/api/machine/speed", json={"speed": speed}))


def test_hold_waits_and_stop_gives_up_and_cutting_again_is_read_rightly(lab, page):
    start_virtual(page, lab, speed=10)
    page.goto(f"{lab.site}#/cut")
    cut = page.get_by_role("button", name="Move the sled and cut 9 marks")
    cut.click()
    bar(page).get_by_text(re.compile(r"runs grid.nc: \d+ of")).wait_for(timeout=PATIENCE)
    set_speed(lab, 1)  # so that it still cuts when a busy page presses Hold
    page.keyboard.press("Escape")
    go_on = bar(page).get_by_role("button", name="Go on")
    go_on.wait_for(timeout=PATIENCE)
    set_speed(lab, 10)
    with lab.client() as client:  # the last move comes to its end
        until(client, lambda machine: machine["holds"] and not machine["moves"])
    expect(bar(page)).to_contain_text("holds")
    go_on.click()
    bar(page).get_by_role("button", name="Stop").click()
    page.get_by_text("then it broke off").wait_for(timeout=PATIENCE)
    set_speed(lab, 1000)
    cut.click()  # which waits until it is enabled
    page.get_by_text("All marks are cut.").wait_for(timeout=PATIENCE)
    page.get_by_role("button", name="Let a tape read the 9 marks").click()
    page.get_by_role("link", name="7 Verdict").wait_for()
    assert (lab.folder / "marks.toml").read_text().count("\nmeasured = [") == 9


def test_a_cable_pulled_in_mid_cut_loses_no_work(lab, page, cable):
    path, pulled = cable
    page.goto(lab.url)
    page.get_by_text("Another port").click()
    page.get_by_label(re.compile("Its name")).fill(path)
    page.get_by_role("button", name="Connect", exact=True).click()
    page.get_by_role("button", name="Read its settings; nothing moves").click()
    page.get_by_role("heading", name="This machine is open").wait_for(timeout=PATIENCE)
    page.goto(f"{lab.site}#/cut")
    page.get_by_role("button", name="Move the sled and cut 9 marks").click()
    bar(page).get_by_text(re.compile(r"runs grid.nc: [5-9] of")).wait_for(timeout=PATIENCE)
    pulled.set()
    page.get_by_text("The line was lost.").wait_for(timeout=PATIENCE)
    said = bar(page).inner_text()
    assert "the line was lost; check the cable" in said
    assert "Where the sled is, is not known" in said
    assert bar(page).get_by_role("button", name="Stop").count() == 0
    assert (lab.folder / "marks.toml").exists() and (lab.folder / "machine.toml").exists()
    assert bar(page).get_by_role("button", name=f"Connect {path} again").is_enabled()
