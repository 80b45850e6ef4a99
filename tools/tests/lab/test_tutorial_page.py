"""The part of the tutorial that is done in a browser: all that the reader presses is there."""

import re
from pathlib import Path

import pytest
from playwright.sync_api import expect
from screens import at_rest

PAGE = Path(__file__).resolve().parents[3] / "docs/tutorial.md"


def steps() -> str:
    """The numbered steps of that part."""
    part = PAGE.read_text(encoding="utf-8").split("\n## The same in your browser\n")[1]
    return " ".join(re.findall(r"^\d\..*(?:\n .*)*", part.split("\n## ")[0], re.MULTILINE))


@pytest.mark.slow
def test_the_tutorial_leads_through_the_page(lab, page):
    page.goto(lab.url)
    text = " ".join(steps().split())
    machine = re.search(r"type (\d+) under \*Its number\*", text)[1]
    for name in re.findall(r"\*([^*]+)\*", text):
        at_rest(page)
        if name == "Its number":
            page.get_by_label(name).fill(machine)
            continue
        screen = page.get_by_role("navigation").get_by_role("link", name=name)
        button = page.locator("main button, main summary", has_text=name)
        (screen if screen.count() else button).first.click()
    score = page.get_by_role("region", name="Score")
    expect(score).to_contain_text("You found chain sag.")
