"""The first day in a browser: a reversed motor on a serial port is found, and its wire named."""

import pytest
from playwright.sync_api import expect
from plumb.guide.talk import progress_in
from screens import at_rest, await_question

WIDE, PHONE = {"width": 1280, "height": 900}, {"width": 375, "height": 812}


@pytest.fixture
def first_day(page, lab, cable):
    """The first page with the machine at its port connected."""
    page.set_default_timeout(300_000)
    path, _ = cable
    page.goto(lab.url)
    page.get_by_text("Another port").click()
    page.get_by_label("Its name").fill(path)
    page.get_by_role("button", name="Connect", exact=True).click()
    page.get_by_role("heading", name="Its first day, step by step").wait_for()
    return page


def test_a_reversed_motor_is_found_on_the_first_page(first_day, lab, cable_machine):
    page = first_day
    page.get_by_role("button", name="Begin: Read the machine's numbers").click()
    page.get_by_text("The machine answers, and its numbers are in machine.toml.").wait_for()
    page.get_by_role("heading", name="This machine is open").wait_for()
    cable_machine.set_wire("left", "motor_reversed", True)
    page.get_by_role("button", name="Begin: Does each motor turn the right way?").click()
    page.get_by_text("The LEFT motor winds 20 mm of its chain in").wait_for()
    assert not page.get_by_role("button", name="Begin: What do you know").count()
    page.reload()  # the question waits
    page.get_by_role("button", name="Wind 20 mm of the left chain in").click()
    page.get_by_role("button", name="the left chain got longer").click()
    page.get_by_text("The power wires of the left motor are swapped").wait_for()
    assert progress_in(lab.folder).done == ["read"]
    cable_machine.set_wire("left", "motor_reversed", False)
    page.get_by_role("button", name="Begin: Does each motor turn the right way?").click()
    for side in ("left", "right"):
        page.get_by_role("button", name=f"Wind 20 mm of the {side} chain in").click()
        page.get_by_role("button", name=f"the {side} chain got shorter").click()
    page.get_by_role("button", name="Raise the router by 1 mm").click()
    page.get_by_role("button", name="it went up").click()
    page.get_by_role("button", name="Begin: What do you know of the machine?").wait_for()
    assert progress_in(lab.folder).done == ["read", "wires"]
    page.get_by_role("button", name="Begin: What do you know of the machine?").click()
    page.get_by_role("button", name="on a ring").click()
    gap = page.get_by_label("From the middle of the left motor's shaft")
    gap.fill("9")
    expect(page.get_by_role("button", name="Keep it")).to_be_disabled()
    gap.fill("2980,5")
    page.get_by_role("button", name="Keep it").click()
    page.get_by_label("How far may that be wrong").wait_for()
    page.get_by_role("button", name="Leave this step").click()
    page.get_by_text("You left this step.").wait_for()


def test_an_answer_from_before_a_press_is_not_taken_for_the_state_after_it(first_day):
    page, looks, held = first_day, [], [True]

    def hold(route):
        answer = route.fetch()
        if held:
            looks.append((route, answer))
        else:
            route.fulfill(response=answer)

    page.route("**/api/guide", hold)
    await_question(page, looks)  # the page looks every few seconds
    page.get_by_role("button", name="Begin: Read the machine's numbers").click()
    page.get_by_text("The machine works").wait_for()
    route, before = looks[0]
    with page.expect_response("**/api/guide") as shown:
        route.fulfill(response=before)
    shown.value.finished()
    at_rest(page)
    assert page.get_by_text("The machine works").is_visible()
    held.clear()
    for route, answer in looks[1:]:
        route.fulfill(response=answer)
    page.get_by_text("The machine answers, and its numbers are in machine.toml.").wait_for()
    page.get_by_role("button", name="Begin: Does each motor").wait_for()


def test_a_second_tab_sees_the_question_that_the_first_asked_for(first_day, lab):
    second = first_day.context.new_page()
    second.goto(lab.site)
    second.get_by_role("button", name="Begin: Read the machine's numbers").wait_for()
    first_day.get_by_role("button", name="Begin: Read the machine's numbers").click()
    first_day.get_by_role("button", name="Begin: Does each motor").click()
    second.get_by_role("button", name="Wind 20 mm of the left chain in").wait_for()
    second.get_by_role("button", name="Take over").click()
    second.get_by_role("button", name="Not now").click()
    first_day.get_by_role("button", name="Begin: Does each motor").wait_for()


@pytest.mark.parametrize("size", [WIDE, PHONE], ids=["wide", "phone"])
def test_the_guide_fits_the_page(first_day, size):
    first_day.set_viewport_size(size)
    first_day.get_by_role("button", name="Begin: Read the machine's numbers").click()
    first_day.get_by_text("The machine answers").wait_for()
    first_day.get_by_role("button", name="Begin: Does each motor").click()
    press = first_day.get_by_role("button", name="Wind 20 mm of the left chain in")
    press.wait_for()
    assert press.bounding_box()["height"] >= 44
    width = first_day.evaluate("document.documentElement.scrollWidth")
    assert width <= size["width"]
