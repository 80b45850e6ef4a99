"""Answers that come late, as on a busy computer: the page goes by the newest question."""

import re

import pytest
from folder import example_form
from lab_machine import start_virtual
from playwright.sync_api import expect
from screens import at_rest, await_question, fitted_machine

PATIENCE = 300_000  # [ms] of a busy computer


@pytest.fixture
def open_machine(lab, page):
    """Opens a screen of a machine with readings, some of which are to come."""
    fitted_machine(lab.folder)
    (lab.folder / "marks.toml").write_text(example_form(read=20))

    def opened(screen):
        page.goto(f"{lab.url}#/{screen}")
        return page

    return opened


@pytest.mark.parametrize(("screen", "shown"), [("reach", ".say"), ("diary", ".course")])
def test_an_answer_to_an_older_question_changes_nothing(open_machine, page, screen, shown):
    asked, late = [], []

    def first_late(route):
        asked.append(route)
        if len(asked) > 1:
            return route.continue_()
        late.append(route.fetch())

    page.route(f"**/api/{screen}", first_late)
    open_machine(screen)
    await_question(page, late)
    page.get_by_label("inch").check()
    expect(page.locator(shown).first).to_contain_text(" inch", timeout=PATIENCE)
    with page.expect_response(f"**/api/{screen}"):
        asked[0].fulfill(response=late[0])
    at_rest(page)
    expect(page.locator(shown).first).to_contain_text(" inch", timeout=PATIENCE)


def test_readings_count_from_the_edges_that_are_named_with_them(open_machine, page):
    saves = []
    # The choice is on its way for long.
    page.route("**/api/choices", lambda route: route.continue_() if saves else saves.append(route))
    open_machine("readings")
    left = page.get_by_label("Mark 1 from the left, mm", exact=True)
    x = float(left.input_value(timeout=PATIENCE))
    page.get_by_label("Measured from").select_option("top-right")
    await_question(page, saves)
    # What the page would ask then is answered before this.
    page.evaluate("() => fetch('/').then((answer) => answer.text())")
    assert float(left.input_value()) == x
    saves[0].continue_()
    right = page.get_by_label("Mark 1 from the right, mm", exact=True)
    expect(right).to_have_value(re.compile(r"2\d\d\d"), timeout=PATIENCE)
    assert float(right.input_value()) + x == pytest.approx(2438.4)


def test_a_question_that_nobody_answers_is_said_and_asked_again(lab, page):
    never = []
    page.clock.install()
    start_virtual(page, lab)
    page.get_by_role("heading", name="Its first day").wait_for(timeout=PATIENCE)
    page.route("**/api/guide", lambda route: never.append(route))
    await_question(page, never)
    said = page.get_by_text("The lab does not answer, so this may be old")
    assert said.count() == 0
    page.clock.fast_forward(10_000)
    said.wait_for(timeout=PATIENCE)
    page.unroute("**/api/guide")
    page.clock.fast_forward(3_000)
    expect(said).to_have_count(0, timeout=PATIENCE)
