"""plumb flash against the bootloader of a real Mega, on the simulated one."""

import os
import re
import struct
import subprocess
import time
from pathlib import Path

import pytest
from example_machine import ROOT
from intelhex import IntelHex
from numbers_machine import NumbersMachine
from plumb.lab.machine_line import MachineLine
from plumb.line.bootloader import hex_bytes, hex_file, program_in, version_in, write_program
from plumb.text.errors import InputError
from served_machine import plumb

BOOTLOADER = (
    "/usr/share/arduino/hardware/arduino/avr/bootloaders/stk500v2/stk500boot_v2_mega2560.hex"
)
# A row of the published firmware's settings in its EEPROM: its offset, bytes and value.
ROW = re.compile(r"\{\d+, (\d+), (\d), ([-\d.]+)f?\}")
HEARD = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT}  # Wine knows not all files
PULLED = 0.25  # of all that is done: half of it is written


def published_memory():
    """An EEPROM as the published firmware leaves it, by the table of its firmware's tests."""
    memory = bytearray(b"\xff" * 4096)
    memory[300], memory[301], memory[322], memory[494] = 5, 56, 56, 56
    memory[310:322] = struct.pack("<3i", 217533, 217534, -1234)
    table = (ROOT / "test/settings_host/published_image.h").read_text()
    for offset, size, value in ROW.findall(table):
        packed = (
            struct.pack("<f", float(value)) if size == "4" else int(value).to_bytes(4, "little")
        )
        memory[340 + int(offset) : 340 + int(offset) + int(size)] = packed[: int(size)]
    return bytes(memory)


@pytest.fixture
def silent(tmp_path):
    """A program for the Mega that says nothing and leaves its EEPROM alone."""
    source, program = tmp_path / "silent.c", tmp_path / "silent.elf"
    source.write_text("int main(void) { for (;;) ; }\n")
    subprocess.run(["avr-gcc", "-mmcu=atmega2560", source, "-o", program], check=True)
    return str(program)


@pytest.fixture
def port(served, silent, tmp_path):
    """The port of a board with its bootloader, and what the published firmware left in it."""
    (tmp_path / "memory.bin").write_bytes(published_memory())
    # Any faster, the bootloader would not wait for avrdude.
    board = ["--mega", silent, "--bootloader", BOOTLOADER, "--eeprom", "memory.bin"]
    served(*board, "--speed", "1")
    return str(tmp_path / "maslow")


@pytest.mark.slow
def test_a_board_is_flashed_although_its_cable_was_pulled_and_takes_its_settings_over(
    port, elf, tmp_path, monkeypatch
):
    firmware = Path(elf).with_suffix(".hex")

    def pull(share):
        if share > PULLED:
            raise OSError("the cable was pulled")

    with pytest.raises(InputError, match="the line was lost; check the cable"):
        write_program(port, firmware, pull)
    with monkeypatch.context() as without_avrdude:
        without_avrdude.setattr("shutil.which", lambda name: None)
        said = plumb("flash", "--port", port, str(firmware), folder=tmp_path)
    assert said.startswith("On the board: no firmware that answers.\nWritten and read back. Now: ")
    numbers = plumb("read", "--port", port, folder=tmp_path)
    assert re.search(r"sheet_width +2440.5", numbers) and re.search(r"motor_gap +3602.6", numbers)

    other = IntelHex(str(firmware))
    other.puts(hex_bytes(firmware).index(b"Plumb v") + len("Plumb v"), "9")
    other.write_hex_file(tmp_path / "other.hex")
    said = plumb("flash", "--port", port, "other.hex", folder=tmp_path)
    assert re.search(r"On the board: Plumb v(\d).*\nWritten and read back. Now: Plumb v9", said)
    written_by_the_lab(port, monkeypatch)


def written_by_the_lab(port, monkeypatch):
    """The page's Machine names a firmware that is not ours, and writes ours."""
    monkeypatch.chdir(ROOT)  # where it was built
    line = MachineLine()
    line.connect_board(port)
    assert await_board(line).startswith("Plumb v9")
    line.flash()
    assert await_board(line) == version_in(program_in(hex_file()))
    line.disconnect()


def await_board(line):
    """The firmware on the board of a lab, once it is ready."""
    end = time.monotonic() + 300
    while line.state.phase != "ready":
        assert line.state.phase == "connecting" and time.monotonic() < end, line.state
        time.sleep(0.1)
    return line.state.firmware


@pytest.mark.slow
def test_a_windows_python_flashes_it_through_com5(port, elf, tmp_path):
    subprocess.run([ROOT / "tools/setup", "windows"], check=True)

    def windows(*words):
        command = [ROOT / "tools/windows/plumb", *words]
        done = subprocess.run(command, cwd=tmp_path, input="", text=True, **HEARD)
        assert done.returncode == 0, done.stdout
        return done.stdout

    windows("--version")  # Wine makes its folder
    com5 = ROOT / ".build/windows/prefix/dosdevices/com5"
    com5.unlink(missing_ok=True)
    com5.symlink_to(os.path.realpath(port))
    said = windows("flash", "--port", "COM5", str(Path(elf).with_suffix(".hex")))
    before, now = "On the board: no firmware that answers.", "Written and read back. Now: Plumb v"
    assert said.startswith(f"{before}\n{now}")
    assert re.search(r"motor_gap +3602.6", windows("read", "--port", "COM5"))


def test_the_firmware_before_and_after_is_named(tmp_path, monkeypatch):
    board = NumbersMachine()
    board.says = ["Firmware Version 1.29"]

    def flashed(*_, avrdude):
        at_once = board.read
        greeting = [b"Plumb v2.0.0, firmware for the Maslow CNC\r\nready\r\n"]
        board.read = lambda: greeting.pop() if greeting else at_once()

    monkeypatch.setattr("plumb.line.bootloader.SerialPort", lambda path: board)
    monkeypatch.setattr("plumb.cli.flash.write_program", flashed)
    IntelHex({0: 0}).write_hex_file(tmp_path / "program.hex")
    said = plumb("flash", "--port", "here", "program.hex", folder=tmp_path)
    now = "Written and read back. Now: Plumb v2.0.0."
    assert said == f"On the board: Firmware Version 1.29.\n{now}\n"


def test_a_program_that_is_too_large_is_refused(tmp_path):
    too_large = IntelHex()
    too_large.frombytes(bytes(0x3E001))
    too_large.write_hex_file(tmp_path / "program.hex")
    said = plumb("flash", "--port", "absent", "program.hex", folder=tmp_path, code=2)
    assert "program.hex: is larger than the Mega's flash" in said
