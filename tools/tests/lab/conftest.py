"""A lab that is served, and a browser that looks at it."""

import threading

import pytest
from folder import with_settings
from journeys import Garage
from playwright.sync_api import expect
from plumb.vm.garage import hide, random_garage
from plumb.vm.owner import VirtualOwner
from plumb.vm.pseudo_terminal import Pace, PseudoTerminal
from served_lab import SharedLab

BUSY_MS = 120_000  # of a busy computer
expect.set_options(timeout=BUSY_MS)


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


@pytest.fixture
def page(browser):
    """A page of desktop size. What its scripts complain of fails the test."""
    context = browser.new_context(viewport={"width": 1280, "height": 900})
    context.set_default_timeout(BUSY_MS)
    shown = context.new_page()
    complaints = []
    shown.on("pageerror", lambda error: complaints.append(str(error)))
    yield shown
    # A question that a test holds back may still be on its way.
    for each in context.pages:
        each.unroute_all(behavior="ignoreErrors")
    context.close()
    assert complaints == []


@pytest.fixture
def cable_machine():
    """The virtual machine of the cable."""
    owner = VirtualOwner(random_garage(hide([], millimetres=3, seed=1), 1))
    owner.switch_on()
    owner.machine.advance(10_000)
    return owner.machine


@pytest.fixture
def cable(cable_machine):
    """A virtual machine at a serial port, whose cable can be pulled."""
    terminal, pace, pulled = PseudoTerminal(cable_machine), Pace(20), threading.Event()

    def serve():
        while not pulled.is_set():
            terminal.pass_time(pace.due())
        terminal.close()

    thread = threading.Thread(target=serve)
    thread.start()
    yield terminal.path, pulled
    pulled.set()
    thread.join()


@pytest.fixture
def garage():
    """A machine at a serial port, with an effect hidden in it, its sheet and a tape."""
    garage = Garage()
    yield garage
    garage.pull_out()
