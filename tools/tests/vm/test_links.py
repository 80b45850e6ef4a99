"""The port of a virtual machine: its name, and whole lines for who reads it."""

import os

import pytest
import serial
from plumb.line import port
from plumb.text.errors import InputError
from plumb.vm.pseudo_terminal import PseudoTerminal
from plumb.vm.served_port import LONGEST_PAUSE


@pytest.fixture(autouse=True)
def locks(tmp_path, monkeypatch):
    """Locks in a folder of the test."""
    (tmp_path / "locks").mkdir()
    monkeypatch.setattr(port.tempfile, "gettempdir", lambda: str(tmp_path / "locks"))


@pytest.fixture
def terminal():
    """Makes a port without a machine behind it."""
    return lambda: PseudoTerminal(None)


def test_the_name_of_a_machine_that_runs_is_refused_and_stays(terminal, tmp_path):
    link = tmp_path / "maslow"
    first, second = terminal(), terminal()
    first.link_as(str(link))
    with pytest.raises(InputError, match="maslow: a virtual machine is at it already; end it or"):
        second.link_as(str(link))
    second.close()
    assert os.readlink(link) == first.path
    first.close()
    assert not os.path.lexists(link)


def test_a_link_of_a_killed_machine_is_replaced_even_if_its_number_is_used_again(
    terminal, tmp_path
):
    link = tmp_path / "maslow"
    _, shell = os.openpty()
    for left in ("/dev/pts/987654", os.ttyname(shell), str(tmp_path / "nothing")):
        link.unlink(missing_ok=True)
        link.symlink_to(left)
        ours = terminal()
        ours.link_as(str(link))
        assert os.readlink(link) == ours.path
        ours.close()


def test_a_link_that_is_not_a_machines_is_kept(terminal, tmp_path):
    (tmp_path / "job.nc").write_text("G21\n")
    link = tmp_path / "maslow"
    link.symlink_to(tmp_path / "job.nc")
    for name in (link, tmp_path / "job.nc"):
        with pytest.raises(InputError, match="give another --link"):
            terminal().link_as(str(name))
    assert (tmp_path / "job.nc").read_text() == "G21\n" and link.is_symlink()


def test_a_link_that_something_else_replaced_is_kept(terminal, tmp_path):
    link = tmp_path / "maslow"
    ours = terminal()
    ours.link_as(str(link))
    link.unlink()
    link.symlink_to("/dev/ttyACM0")
    ours.close()
    assert link.is_symlink()


class SlowSpeaker:
    """A machine that says the next part each time its time passes."""

    def __init__(self, *parts: bytes):
        self.parts = list(parts)

    def advance(self, milliseconds: int) -> None:
        pass

    def start(self) -> None:
        pass

    def stop(self) -> None:
        pass

    def send(self, characters: bytes) -> None:
        pass

    def take_said(self) -> bytes:
        return self.parts.pop(0) if self.parts else b""


def test_the_port_hands_over_whole_lines():
    terminal = PseudoTerminal(SlowSpeaker(b"", b"$30=0 (z", b" axis)\r\nok", b"\r\n"))
    client = serial.Serial(terminal.path, 57600, timeout=0)
    heard = []
    for _ in range(4):
        terminal.pass_time(1)
        heard.append(client.read(100))
    client.close()
    terminal.close()
    assert heard == [b"", b"", b"$30=0 (z axis)\r\n", b"ok\r\n"]


def test_a_client_does_not_get_lines_begun_for_the_last_one():
    terminal = PseudoTerminal(SlowSpeaker(b"", b"$30=0 (z"))
    serial.Serial(terminal.path, 57600, timeout=0).close()
    terminal.pass_time(1)
    first = serial.Serial(terminal.path, 57600, timeout=0)
    terminal.pass_time(1)
    first.close()
    with serial.Serial(terminal.path, 57600, timeout=0) as second:
        for _ in range(3):
            terminal.pass_time(LONGEST_PAUSE)
            assert second.read(100) == b""
    terminal.close()


def test_a_client_that_stood_still_loses_no_line():
    said = [b"<Idle,MPos:%d.00,0.00,0.00,WPos:0,0,0>\r\n" % number for number in range(3000)]
    terminal = PseudoTerminal(SlowSpeaker(b"", *said))
    client = serial.Serial(terminal.path, 57600, timeout=0)
    for _ in said:
        terminal.pass_time(1)
    stood_at = len(terminal.machine.parts)
    heard = b""
    for _ in said:
        heard += client.read(100)
        terminal.pass_time(1)
    heard += client.read(100_000)
    client.close()
    terminal.close()
    # A program that does not read holds the machine's time, so nothing has to be thrown away.
    assert stood_at > 0
    assert heard == b"".join(said)


def test_a_client_that_opens_the_port_gets_no_old_lines():
    """The old machine speaks on until the opening shows; that takes long on a busy computer."""

    class Opened(SlowSpeaker):
        client = None

        def advance(self, milliseconds: int) -> None:
            if len(self.parts) == 1 and not self.client:
                self.client = serial.Serial(terminal.path, 57600, timeout=0)

    terminal = PseudoTerminal(Opened(b"", b"<Idle,MPos:1.00,0.00,0.00,WPos:0,0,0>\r\n"))
    with serial.Serial(terminal.path, 57600, timeout=0):
        terminal.pass_time(1)
        terminal.pass_time(1)
    with terminal.machine.client as client:
        assert client.read(100) == b""
    terminal.close()
