"""The page says when it is at rest, so that nobody who looks at it from outside has to guess."""

from playwright.sync_api import expect
from screens import at_rest, await_question, measured_machine


def test_the_page_is_at_rest_once_all_is_answered_saved_and_drawn(lab, page):
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
