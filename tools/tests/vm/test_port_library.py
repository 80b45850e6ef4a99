"""The library that lets clients use the virtual machine's port as they use a board's."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from served_machine import START, plumb

# As GroundControl opens a port: twice, then it drops DTR and raises it again.
DROPS_DTR = """
port = serial.Serial("maslow", 57600, timeout=30)
port.close()
port.open()
greet()
port.dtr = False
port.dtr = True
greet()
port.rts = False
port.rts = True
port.write(b"B05\\n")
port.read_until(b"Firmware Version 1.28")
assert b"PCB" not in port.read_until(b"ok")
"""
# As WebControl does: with odd parity in between.
ASKS_PARITY = """
port = serial.Serial("maslow", 57600, timeout=30)
port.parity = serial.PARITY_ODD
port.close()
port.open()
port.close()
port.parity = serial.PARITY_NONE
port.open()
greet()
"""
GREET = """
import serial
def greet():
    assert port.read_until(b"ok\\r\\n").count(b"PCB v1.2") == 1
"""


def client(program: str, folder: Path, **environment: str) -> subprocess.CompletedProcess:
    """A program that does this at the port."""
    return subprocess.run(
        [sys.executable, "-c", GREET + program],
        cwd=folder,
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        timeout=2 * START,
    )


@pytest.mark.parametrize(
    ("program", "why"), [(DROPS_DTR, "Inappropriate ioctl"), (ASKS_PARITY, "Invalid argument")]
)
def test_a_client_opens_the_port_as_it_opens_a_boards(served, tmp_path, program, why):
    served()
    assert why in client(program, tmp_path).stderr
    done = client(program, tmp_path, LD_PRELOAD=library(tmp_path))
    assert done.returncode == 0, done.stderr


def test_other_files_answer_as_without_it(tmp_path):
    program = """
import fcntl, os, struct, termios
lines = struct.pack("I", termios.TIOCM_DTR)
for file in (os.open("plain", os.O_RDWR | os.O_CREAT), os.pipe()[1]):
    try:
        fcntl.ioctl(file, termios.TIOCMBIC, lines)
        raise SystemExit("no error")
    except OSError as error:
        assert error.errno == 25, error
"""
    done = client(program, tmp_path, LD_PRELOAD=library(tmp_path))
    assert done.returncode == 0, done.stderr


def library(folder: Path) -> str:
    """Where the library is, as the command says."""
    return plumb("vm", "--preload", folder=folder).strip()
