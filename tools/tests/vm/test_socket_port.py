"""The virtual machine behind a socket, as on Windows: plumb opens it like a serial port."""

import re
import subprocess

import pytest
import serial
from served_machine import INTERRUPTIBLE, PLUMB, SPEED, START, plumb


@pytest.fixture
def name(tmp_path):
    """The name of a machine's port; the machine ends with the test."""
    command = [*PLUMB, "vm", "--link", "socket://localhost:0", "--speed", str(SPEED)]
    machine = INTERRUPTIBLE(command, cwd=tmp_path, stdout=subprocess.PIPE, text=True)
    yield re.match(r"The machine is at (socket://localhost:\d+)\.", machine.stdout.readline())[1]
    machine.terminate()
    machine.wait()


def test_a_program_is_sent_through_a_socket_and_each_opening_resets_the_board(name, tmp_path):
    plumb("grid", "--places=0,100 300,100", "--output", "grid.nc", folder=tmp_path)
    assert "the machine took each" in plumb("send", "--port", name, "grid.nc", folder=tmp_path)
    assert "The sled is at x " in plumb("read", "--port", name, folder=tmp_path)
    for _ in range(2):
        with serial.serial_for_url(name, timeout=START) as line:
            assert line.read_until(b"Detected").endswith(b"Detected")


def test_a_socket_that_is_taken_or_is_no_name_is_refused(name, tmp_path):
    said = plumb("vm", "--link", name, folder=tmp_path, code=2)
    assert f"{name}: a virtual machine is at it already; end it or give another number" in said
    said = plumb("vm", "--link", "socket://garage:7000", folder=tmp_path, code=2)
    assert "is not like socket://localhost:7000" in said
