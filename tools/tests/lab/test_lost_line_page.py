"""A line that is lost, and a port that is refused: one state, and help at the control."""

import pytest
from folder import got
from lab_machine import PATIENCE, bar
from playwright.sync_api import expect

NEAR = 160  # CSS pixels between a button and what is said of it


@pytest.fixture
def lost(lab, page, cable):
    """The page of a machine whose cable was pulled; at which port it was."""
    path, pulled = cable
    page.goto(lab.url)
    got(lab.client().post("/api/machine/board", json={"port": path}))
    connected = page.get_by_role("heading", name=f"{path} is connected")
    expect(connected).to_be_visible(timeout=PATIENCE)
    expect(bar(page)).to_contain_text("stands", timeout=PATIENCE)
    pulled.set()
    expect(bar(page)).to_contain_text("the line is lost", timeout=PATIENCE)
    return path


def test_a_line_that_is_lost_is_not_called_connected(page, lost):
    expect(page.get_by_role("heading", name=f"The line to {lost} is lost")).to_be_visible()
    assert page.get_by_text("is connected").count() == 0
    assert page.get_by_role("button", name=f"Connect {lost} again").count() == 1


def test_the_bar_connects_again_and_offers_what_is_plugged_in_by_now(page, lost):
    port = {"path": "/dev/ttyACM9", "title": "Mega", "is_board": True}
    modem = {"path": "/dev/ttyS0", "title": "", "is_board": False}
    page.route("**/api/machine/ports", lambda route: route.fulfill(json=[port, modem]))
    new = bar(page).get_by_role("button", name="Connect /dev/ttyACM9")
    expect(new).to_be_visible(timeout=PATIENCE)
    assert bar(page).get_by_role("button", name="ttyS0").count() == 0
    with page.expect_request("**/api/machine/board") as asked:
        bar(page).get_by_role("button", name=f"Connect {lost} again").click()
    assert asked.value.post_data_json == {"port": lost}
    expect(new).to_be_visible(timeout=PATIENCE)  # it is not there, so the line is lost again
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
    expect(bar(page)).to_contain_text("/dev/ttyACM7: the line is lost", timeout=PATIENCE)


def test_a_port_is_on_usb_or_it_is_another_port(page, lab):
    modem = {"path": "/dev/ttyS0", "title": "", "is_board": False}
    page.route("**/api/machine/ports", lambda route: route.fulfill(json=[modem]))
    page.goto(lab.url)
    expect(page.get_by_text("No board is there")).to_be_visible()
    page.get_by_text("Another port").click()
    expect(page.get_by_role("button", name="Connect /dev/ttyS0")).to_be_visible()


def test_what_is_refused_stands_at_its_button(page, lab):
    page.goto(lab.url)
    page.get_by_text("Another port").click()
    page.get_by_label("Its name, like COM3").fill("maslow")
    button = page.get_by_role("button", name="Connect", exact=True)
    button.click()
    said = page.get_by_role("alert").filter(has_text="'maslow' is no serial port")
    expect(said).to_be_visible()
    pressed, words = button.bounding_box(), said.bounding_box()
    assert abs(words["y"] - pressed["y"]) < NEAR
