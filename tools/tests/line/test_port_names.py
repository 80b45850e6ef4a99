"""Tests of the line that a command takes, and of lines that cannot be opened."""

from types import SimpleNamespace

import pytest
import serial
from plumb.line import port
from plumb.line.port import SerialPort, port_for
from plumb.text.errors import InputError

BOARD = SimpleNamespace(device="/dev/ttyACM0", vid=0x2341)
OTHER = SimpleNamespace(device="/dev/ttyACM1", vid=0x1A86)
BUILT_IN = SimpleNamespace(device="/dev/ttyS0", vid=None)  # of the computer, not on USB


@pytest.fixture
def plug(monkeypatch):
    def plugged(*ports):
        monkeypatch.setattr(port.list_ports, "comports", lambda: list(ports))

    return plugged


def test_a_named_line_is_taken_as_it_is(plug):
    plug(BOARD)
    assert port_for("/tmp/maslow") == "/tmp/maslow"


def test_the_only_board_on_usb_is_taken(plug):
    plug(BUILT_IN, BOARD)
    assert port_for(None) == "/dev/ttyACM0"


def test_without_a_board_the_remedy_is_named(plug):
    plug(BUILT_IN)
    with pytest.raises(InputError, match="no board on USB: connect the Mega"):
        port_for(None)


def test_with_several_boards_the_port_must_be_named(plug):
    plug(BOARD, OTHER)
    with pytest.raises(InputError, match=r"several boards on USB \(/dev/ttyACM0, /dev/ttyACM1\)"):
        port_for(None)


@pytest.mark.parametrize(
    ("error", "remedy"),
    [
        ("[Errno 16] Device or resource busy", "close the program that has it"),
        ("Could not exclusively lock port", "close the program that has it"),
        ("could not open port: PermissionError(13, 'Zugriff', None, 5)", "close the program"),
        ("[Errno 2] No such file or directory", "check the cable and the name"),
    ],
)
def test_the_remedy_depends_on_why_a_line_cannot_be_opened(monkeypatch, error, remedy):
    def refuse(*_, **__):
        raise serial.SerialException(error)

    monkeypatch.setattr(port.serial, "Serial", refuse)
    with pytest.raises(InputError, match=f"^COM3: cannot be opened; {remedy}"):
        SerialPort("COM3")
