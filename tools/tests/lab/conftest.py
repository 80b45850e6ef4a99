"""A lab that is served, and a browser that looks at it."""

from contextlib import contextmanager, suppress
from urllib.parse import urljoin

import pytest
from asked_again import tried_less  # noqa: F401
from folder import with_settings
from served_lab import SharedLab

BUSY_MS = 300_000  # of a busy computer


@pytest.fixture(scope="session")
def shared(tmp_path_factory):
    """The lab of those tests that do not end it, or start it again."""
    shared = SharedLab(tmp_path_factory.mktemp("lab"))
    yield shared
    shared.end()


@pytest.fixture
def lab(shared):
    """A lab on an empty folder."""
    return shared.emptied()


@pytest.fixture
def client(tmp_path):
    """A lab that is asked without a network, with the example's settings open."""
    with with_settings(tmp_path) as client:
        yield client


@contextmanager
def looked_at(page):
    """A page of desktop size. What its scripts complain of fails the test."""
    from playwright.sync_api import expect  # Windows' Python has no browser under Wine

    expect.set_options(timeout=BUSY_MS)
    page.set_viewport_size({"width": 1280, "height": 900})
    page.context.set_default_timeout(BUSY_MS)
    page.set_default_timeout(BUSY_MS)
    complaints = []

    def note(error):
        complaints.append(str(error))

    page.on("pageerror", note)
    yield page
    for each in page.context.pages:
        # A question that a test holds back may still be on its way.
        each.unroute_all(behavior="ignoreErrors")
    page.remove_listener("pageerror", note)
    assert complaints == []


@pytest.fixture(scope="session")
def used_page(browser):
    """A page for many tests: to make one costs more than to load a screen."""
    context = browser.new_context(reduced_motion="reduce")
    yield context.new_page()
    context.close()


@pytest.fixture
def page(used_page):
    """The page that tests before have used; nothing of them is left in it."""
    from playwright.sync_api import Error

    used_page.mouse.move(0, 0)
    try:
        with looked_at(used_page):
            yield used_page
    finally:
        for other in used_page.context.pages:
            if other is not used_page:
                other.close()
        with suppress(Error):  # a lab that has ended comes back at another address
            used_page.goto(urljoin(used_page.url, "/index.css"))  # where no script runs
            used_page.evaluate("() => { localStorage.clear(); sessionStorage.clear(); }")
        used_page.goto("about:blank")


@pytest.fixture
def fresh_page(browser):
    """A page for a test that changes its clock or its live line, or ends its lab."""
    context = browser.new_context(reduced_motion="reduce")
    with looked_at(context.new_page()) as page:
        yield page
    context.close()


@pytest.fixture
def open_page(browser):
    """Opens a page of another browser, of some size or scheme."""
    contexts = []

    def opened(**how):
        contexts.append(browser.new_context(**how))
        contexts[-1].set_default_timeout(BUSY_MS)
        return contexts[-1].new_page()

    yield opened
    for context in contexts:
        for each in context.pages:
            each.unroute_all(behavior="ignoreErrors")
        context.close()


@pytest.fixture
def cable():
    """A virtual machine at a serial port, whose cable can be pulled; it hurries at rest too."""
    from garage_at_port import Garage  # at a pseudo terminal

    garage = Garage(20, at_rest=20)
    yield garage
    garage.pull_out()


@pytest.fixture
def garage():
    """A machine at a serial port, and its sheet."""
    from garage_at_port import Garage

    garage = Garage()
    yield garage
    garage.pull_out()
