"""A line that a program has: another is refused before the line is touched."""

import os
import subprocess
import sys
import termios
from types import SimpleNamespace

import pytest
import serial
from plumb.line import port
from plumb.line.port import LineLock, SerialPort, TakenError, refuse_others
from plumb.text.errors import InputError

HAS_LINE = """
import sys
from plumb.line.port import LineLock
lock = LineLock(sys.argv[1])
print("taken", flush=True)
sys.stdin.read()
"""


@pytest.fixture(autouse=True)
def locks(tmp_path, monkeypatch):
    """Locks in a folder of the test."""
    monkeypatch.setattr(port.tempfile, "gettempdir", lambda: str(tmp_path))


@pytest.fixture
def openings(monkeypatch):
    """Each opening of a line, which succeeds, and which handles got the kernel's refusal."""
    seen = SimpleNamespace(paths=[], asked=[], closed=0)

    def opened(path, *_, **__):
        seen.paths.append(path)
        return SimpleNamespace(fileno=lambda: 77, close=lambda: None)

    monkeypatch.setattr(port.serial, "serial_for_url", opened)
    monkeypatch.setattr("fcntl.ioctl", lambda *words: seen.asked.append(words))
    return seen


def test_a_second_program_is_refused_before_it_opens_the_line(openings, tmp_path):
    first = SerialPort("/dev/ttyACM7")
    (tmp_path / "maslow").symlink_to("/dev/ttyACM7")
    for name in ("/dev/ttyACM7", str(tmp_path / "maslow")):
        with pytest.raises(InputError, match="another plumb has the line; wait until it is done"):
            SerialPort(name)
    assert openings.paths == ["/dev/ttyACM7"]
    SerialPort("/dev/ttyACM8").close()
    first.close()
    SerialPort("/dev/ttyACM7").close()


def test_the_kernel_refuses_other_programs_as_long_as_a_board_is_open(openings):
    SerialPort("/dev/ttyACM7").close()
    assert openings.asked == [(77, termios.TIOCEXCL)]
    refuse_others("/dev/pts/7", None)  # which would be refused for good
    assert len(openings.asked) == 1


def test_a_line_that_could_not_be_opened_is_left_to_others(monkeypatch):
    def refuse(*_, **__):
        raise serial.SerialException("no such file")

    monkeypatch.setattr(port.serial, "Serial", refuse)
    with pytest.raises(InputError, match="cannot be opened"):
        SerialPort("/dev/ttyACM7")
    LineLock("/dev/ttyACM7").release()


def test_the_lock_of_a_program_that_was_killed_is_released(tmp_path, monkeypatch):
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    command = [sys.executable, "-c", HAS_LINE, "/dev/ttyACM7"]
    pipe = subprocess.PIPE
    with subprocess.Popen(command, stdin=pipe, stdout=pipe, text=True) as other:
        assert other.stdout.readline() == "taken\n"
        with pytest.raises(TakenError):
            LineLock("/dev/ttyACM7")
        other.kill()
        other.wait()
    LineLock("/dev/ttyACM7").release()


def test_an_unreadable_lock_of_another_user_is_ignored(monkeypatch):
    def refuse(*_):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(port, "_opened", refuse)
    LineLock("/dev/ttyACM7").release()


def test_a_readable_lock_of_another_user_is_respected(monkeypatch):
    open_file = os.open

    def opened(path, flags, *mode):
        if flags & os.O_CREAT:
            raise PermissionError(13, "Permission denied")
        return open_file(path, flags, *mode)

    first = LineLock("/dev/ttyACM7")
    monkeypatch.setattr(port.os, "open", opened)
    with pytest.raises(TakenError):
        LineLock("/dev/ttyACM7")
    first.release()
