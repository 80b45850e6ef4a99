"""The page says when it is at rest, so that nobody who looks at it from outside has to guess."""

from playwright.sync_api import expect
from screens import at_rest, await_question, measured_machine


def test_the_page_is_at_rest_once_all_is_answered_saved_and_drawn(lab, page):
    measured_machine(lab.folder)
    page.goto(f"{lab.url}#/readings")
    rest = page.locator("html[data-rest]")
    at_rest(page)
    for path, press in (
        ("readings", lambda: page.get_by_label("Mark 2 from the left, mm", exact=True).fill("650")),
        ("verdict", lambda: page.evaluate("() => { location.hash = '#/verdict' }")),
    ):
        held = []
        page.route(f"**/api/{path}", held.append)
        press()
        await_question(page, held)
        expect(rest).to_have_count(0)
        page.unroute(f"**/api/{path}")
        held.pop().continue_()
        at_rest(page)
    assert page.locator(".sheet circle.place").count() == 23
