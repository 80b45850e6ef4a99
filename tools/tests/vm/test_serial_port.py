"""The virtual machine behind a serial port, driven by the commands that drive a board."""

import os
import subprocess
import time

import pytest
import serial
from plumb.line.serial_port import port_for
from plumb.text.errors import InputError
from served_machine import INTERRUPTIBLE, PLUMB, START, plumb


def test_a_program_is_cut_read_with_a_tape_and_the_machine_tells_its_place(served, tmp_path):
    grid = ["grid", "--columns", "2", "--rows", "2", "--margin", "550", "--repeats", "0"]
    plumb(*grid, "--marks", "form.toml", "--output", "grid.nc", folder=tmp_path)
    server = served("--form", "form.toml", "--readings", "read.toml", "--reveal")
    sent = plumb("send", "--port", "maslow", "grid.nc", folder=tmp_path)
    assert "and the machine took each" in sent
    printed = plumb("read", "--port", "maslow", "-o", "machine.toml", folder=tmp_path)
    assert "The sled is at x " in printed and "$160" in printed and "$210" not in printed
    readings = (tmp_path / "read.toml").read_text()
    assert readings.count("\nmeasured = [") == 4
    compared = plumb("compare", "machine.toml", "read.toml", folder=tmp_path)
    assert "RMS" in compared
    assert "Hidden was: nothing." in server.stop()
    assert not os.path.lexists(tmp_path / "maslow")


def test_numbers_are_written_read_back_kept_and_brought_back(served, tmp_path):
    served()
    plumb("read", "--port", "maslow", "-o", "machine.toml", folder=tmp_path)
    text = (tmp_path / "machine.toml").read_text()
    (tmp_path / "machine.toml").write_text(text.replace("2978.4", "2980.5"))
    said = plumb("send", "--port", "maslow", "machine.toml", folder=tmp_path)
    assert "$2: 2978.4 -> 2980.5" in said
    assert len(list(tmp_path.glob("machine-before-*.nc"))) == 1
    said = plumb("send", "--undo", "--port", "maslow", "machine.toml", folder=tmp_path)
    assert "$2: 2980.5 -> 2978.4" in said


def test_a_refused_line_stops_the_program(served, tmp_path):
    served()
    (tmp_path / "job.nc").write_text("G21\nG0 X--5\nG0 X10\n")
    said = plumb("send", "--port", "maslow", "job.nc", folder=tmp_path, code=2)
    assert "'G0 X--5': the machine says: ALARM: Halted" in said


def test_ctrl_c_stops_the_machine_and_it_knows_where_it_is(served, tmp_path):
    served()
    (tmp_path / "job.nc").write_text("G21\nG1 X900 F300\n")
    command = [*PLUMB, "send", "--port", "maslow", "job.nc"]
    sending = INTERRUPTIBLE(
        command, cwd=tmp_path, stdout=subprocess.PIPE, stdin=subprocess.DEVNULL, text=True
    )
    time.sleep(4)
    sending.send_signal(2)
    assert "The machine has stopped." in sending.communicate(timeout=START)[0]
    assert sending.returncode == 1
    said = plumb("read", "--port", "maslow", folder=tmp_path)
    assert "ALARM" not in said
    assert "The sled is at x 0.00" not in said and "The sled is at x 900" not in said


def test_opening_the_port_resets_the_board_each_time(served, tmp_path):
    served()
    for _ in range(3):
        with serial.Serial(str(tmp_path / "maslow"), 57600, timeout=START) as line:
            assert b"PCB v1.2" in line.read_until(b"Detected")


def test_the_memory_outlives_the_program(served, tmp_path):
    first = served("--eeprom", "memory.bin")
    plumb("send", "--port", "maslow", "$2=2981", folder=tmp_path)
    first.stop()
    served("--eeprom", "memory.bin")
    assert "2981" in plumb("read", "--port", "maslow", folder=tmp_path)


def test_a_fresh_machine_knows_no_chains(served, tmp_path):
    server = served("--fresh")
    said = plumb("send", "--port", "maslow", "B15", folder=tmp_path, code=2)
    assert "the machine says" in said
    server.stop()


@pytest.mark.parametrize(
    ("words", "why"),
    [
        (["vm", "--hide", "wind"], "--hide unknown name 'wind'"),
        (["vm", "--mega", "absent.elf"], "--mega: cannot read absent.elf"),
        (["vm", "--form", "here"], "--form and --readings go together"),
        (["vm", "--link", "here"], "cannot be the name of the port"),
        (["vm", "--eeprom", "here"], "is no memory of 4096 bytes"),
        (["send", "--port", "absent", "G0 X1"], "absent: cannot be opened; check the cable"),
        (["send", "absent.nc"], "absent.nc: there is no such file"),
        (["read", "--port", "absent"], "absent: cannot be opened"),
        (["flash", "--port", "absent"], "absent: there is no such line"),
    ],
)
def test_what_cannot_be_is_refused_in_a_line(tmp_path, words, why):
    (tmp_path / "here").write_text("something\n")
    said = plumb(*words, folder=tmp_path, code=2)
    assert why in said
    assert said.count("\n") == 1
    assert (tmp_path / "here").read_text() == "something\n"


def test_no_board_or_several_are_named(monkeypatch):
    class Board:
        def __init__(self, device, vid):
            self.device, self.vid = device, vid

    boards = [Board("/dev/ttyS0", None)]
    monkeypatch.setattr("plumb.line.serial_port.list_ports.comports", lambda: boards)
    with pytest.raises(InputError, match="no board on USB: connect the Mega"):
        port_for(None)
    boards.append(Board("/dev/ttyACM0", 0x2341))
    assert port_for(None) == "/dev/ttyACM0"
    assert port_for("other") == "other"
    boards.append(Board("/dev/ttyACM1", 0x2341))
    with pytest.raises(InputError, match=r"several boards on USB \(/dev/ttyACM0, /dev/ttyACM1\)"):
        port_for(None)
