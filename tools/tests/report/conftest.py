"""Tests of this room ask the same of the same boards, and open pages without any network."""

import pytest
from asked_again import tried_less  # noqa: F401


@pytest.fixture
def opened(browser):
    """Opens a saved page from its file, offline. It asks nobody and complains of nothing."""
    context = browser.new_context(viewport={"width": 1280, "height": 800}, offline=True)
    page, files, asked, complaints = context.new_page(), [], [], []
    page.on("request", lambda request: asked.append(request.url))
    page.on("console", lambda message: complaints.append(message.text))
    page.on("pageerror", lambda error: complaints.append(str(error)))
    page.on("dialog", lambda dialog: complaints.append(dialog.message))

    def open_file(path):
        files.append(path.as_uri())
        page.goto(path.as_uri())
        page.locator("html[data-rest]").wait_for(state="attached")
        return page

    yield open_file
    context.close()
    assert complaints == [] and asked == files
