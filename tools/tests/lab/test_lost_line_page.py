"""A line that is lost, a lab that says nothing: what the page says, and what stops the machine."""

import re
import signal

import pytest
from folder import got
from lab_machine import bar, start_virtual
from playwright.sync_api import expect
from served_lab import serve

UNREACHABLE = "Cannot reach the machine: use its power switch"
NEAR = 160  # CSS pixels between a button and what is said of it


@pytest.fixture
def lost(lab, page, cable):
    """The page of a machine whose cable was pulled; at which port it was."""
    path = cable.path
    page.goto(lab.url)
    got(lab.client().post("/api/machine/board", json={"port": path}))
    connected = page.get_by_role("heading", name=f"{path} is connected")
    expect(connected).to_be_visible()
    expect(bar(page)).to_contain_text("stands")
    cable.pull_out()
    expect(bar(page)).to_contain_text("the line is lost")
    expect(bar(page)).to_contain_text(f"{UNREACHABLE}.")
    return path


def test_the_bar_reconnects_and_offers_new_ports(page, lost):
    port = {"path": "/dev/ttyACM9", "title": "Mega", "is_board": True}
    modem = {"path": "/dev/ttyS0", "title": "", "is_board": False}
    page.route("**/api/machine/ports", lambda route: route.fulfill(json=[port, modem]))
    new = bar(page).get_by_role("button", name="Connect /dev/ttyACM9")
    expect(new).to_be_visible()
    assert bar(page).get_by_role("button", name="ttyS0").count() == 0
    with page.expect_request("**/api/machine/board") as asked:
        bar(page).get_by_role("button", name=f"Connect {lost} again").click()
    assert asked.value.post_data_json == {"port": lost}
    expect(new).to_be_visible()  # it is not there, so the line is lost again
    with page.expect_request("**/api/machine/board") as asked:
        new.click()
    assert asked.value.post_data_json == {"port": "/dev/ttyACM9"}


def test_the_bar_connects_at_any_port_whose_name_is_typed(page, lost):
    modem = {"path": "/dev/ttyS0", "title": "", "is_board": False}
    page.route("**/api/machine/ports", lambda route: route.fulfill(json=[modem]))
    bar(page).get_by_text("Another port").click()
    expect(bar(page).get_by_role("button", name="Connect /dev/ttyS0")).to_be_visible()
    bar(page).get_by_label("Its name").fill("/dev/ttyACM7")
    with page.expect_request("**/api/machine/board") as asked:
        bar(page).get_by_role("button", name="Connect", exact=True).click()
    assert asked.value.post_data_json == {"port": "/dev/ttyACM7"}
    expect(bar(page)).to_contain_text("Connect /dev/ttyACM7 again")


def test_a_refusal_stands_at_its_button(page, lab):
    page.goto(lab.url)
    page.get_by_text("Another port").click()
    page.get_by_label("Its name, like COM3").fill("maslow")
    button = page.get_by_role("button", name="Connect", exact=True)
    button.click()
    said = page.get_by_role("alert").filter(has_text="'maslow' is not a serial port")
    expect(said).to_be_visible()
    pressed, words = button.bounding_box(), said.bounding_box()
    assert abs(words["y"] - pressed["y"]) < NEAR


@pytest.fixture
def cutting(lab, page):
    """The page of a slow machine in mid-cut."""
    start_virtual(page, lab, speed=10)
    page.goto(f"{lab.site}#/cut")
    page.get_by_role("button", name="Move the sled and cut 9 marks").click()
    bar(page).get_by_text(re.compile(r"runs grid.nc: [3-9] of")).wait_for()
    return page


def test_a_killed_lab_is_not_mistaken_for_a_running_machine(lab, cutting):
    lab.process.kill()
    shown = bar(cutting)
    shown.get_by_role("button", name="Stop", exact=True).click()
    expect(cutting.get_by_text("Stop did not get through. Switch off")).to_be_visible()
    expect(cutting.get_by_role("row", name="It was doing grid.nc, line")).to_be_visible()
    expect(shown).to_contain_text(re.compile(r"last seen \d+ s ago"))
    expect(shown.get_by_role("button", name="Try Stop again")).to_be_visible()
    expect(shown.get_by_role("button", name="Stop", exact=True)).to_have_count(0)
    expect(shown.locator(".old .place")).to_be_visible()
    expect(cutting.get_by_role("heading", name="Nobody sees the machine")).to_be_visible()
    assert "runs grid.nc" not in shown.inner_text()
    lab.process = serve(lab.folder, port=lab.port).process
    expect(cutting.get_by_role("region", name="The machine", exact=True)).to_have_count(0)


def test_a_stop_pressed_while_the_lab_is_down_acts_once_it_is_back(lab, cutting):
    shown = bar(cutting)
    lab.process.send_signal(signal.SIGSTOP)
    try:
        shown.locator("button.stop").click()
        expect(cutting.get_by_text("Stop did not get through. Switch off")).to_be_visible()
        expect(shown.get_by_role("button", name="Try Stop again")).to_be_visible()
    finally:
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
