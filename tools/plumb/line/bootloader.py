"""Writes a program into the Mega's flash: its bootloader takes it over the serial line (STK500v2).

A reset starts the bootloader, which waits a second for a programmer. It never overwrites itself,
and leaves the EEPROM alone. So a board whose cable was pulled in the middle can be flashed again.
"""

from __future__ import annotations

import re
import subprocess
import time
from collections.abc import Callable
from contextlib import suppress
from io import StringIO
from pathlib import Path

import serial
from arduinobootloader import ArduinoBootloader
from intelhex import IntelHex, IntelHexError

from plumb.line.memory import OURS, firmware_of
from plumb.line.port import SerialPort
from plumb.line.sender import Sender
from plumb.text.errors import InputError
from plumb.text.files import read_text

# Programs for the Mega as HEX files of Intel's form.


MOST = 0x3E000  # [bytes] of the Mega's flash below its bootloader


def hex_bytes(path: str | Path) -> bytes:
    """Return the bytes of a HEX file from its first address on; raises InputError."""
    records = IntelHex()
    with suppress(IntelHexError):
        records.loadhex(StringIO(read_text(path)))
    content = bytes(records.tobinarray())
    if not content:
        raise InputError(path, "is not a HEX file with a program", remedy="give that of a build")
    return content


def program_in(path: Path) -> bytes:
    """Return the program of a HEX file; InputError also where it does not fit below the Mega's
    bootloader.
    """
    program = hex_bytes(path)
    if len(program) > MOST:
        raise InputError(path, f"is larger than the Mega's flash ({len(program)} bytes)")
    return program


# What the bootloader understands.

BAUD = 115_200
PAGE = 256  # [bytes] written at once
MEGA = "ATmega2560"
WAITS = (0.1, 0.3, 0.6, 0.3, 0.1)  # [s] from a reset until the bootloader is asked, in turns
SILENT, PATIENCE = 0.1, 3.0  # [s] to wait for a byte: of the first answer, and of all others
AVRDUDE = ("-p", "atmega2560", "-c", "wiring", "-b", str(BAUD), "-D")
BUILT = Path(".pio/build/megaatmega2560/firmware.hex")
BROUGHT = Path(__file__).parents[1] / "firmware.hex"  # by the package


def hex_file(named: str | None = None) -> Path:
    """Return the file to write; InputError if there is none."""
    there = [Path(named)] if named else [path for path in (BUILT, BROUGHT) if path.is_file()]
    if not there:
        remedy = "build it with .venv/bin/pio run -e megaatmega2560"
        raise InputError(BUILT, "there is no such file", remedy=remedy)
    return there[0]


def version_in(program: bytes) -> str:
    """Return how a program will greet; empty if it is not our firmware."""
    greeting = re.search(OURS.encode() + rb"[\w.]+", program)
    return greeting[0].decode() if greeting else ""


def firmware_on(path: str) -> tuple[str, tuple[str, ...]]:
    """Return the firmware of a board with its version, and all that it says at its start; an empty
    name if it says nothing.
    """
    port = SerialPort(path)
    sender, name = Sender(port), ""
    try:
        with suppress(InputError):  # an empty board is silent
            sender.await_start()
            name = firmware_of(sender)
    finally:
        port.close()
    return name, sender.greeting


def write_program(
    path: str, file: Path, progress: Callable[[float], None], *, avrdude: str | None = None
) -> None:
    """Write a program and read it back: by avrdude if its path is given, else by a library. Raises
    InputError.
    """
    program = program_in(file)
    if avrdude:
        _by_avrdude(avrdude, path, file)
        return
    try:
        _by_library(path, program, progress)
    except OSError:  # of which serial's errors are some
        raise InputError(
            path, "the line was lost", remedy="check the cable and try again"
        ) from None


def _by_avrdude(avrdude: str, path: str, file: Path) -> None:
    """Let avrdude write it, which shows how far it is."""
    if subprocess.run([avrdude, *AVRDUDE, "-P", path, "-U", f"flash:w:{file}:i"]).returncode:
        raise InputError(
            path,
            "avrdude could not write it",
            remedy="close GroundControl and WebControl, check the cable, and try again",
        )


def _by_library(path: str, program: bytes, progress: Callable[[float], None]) -> None:
    """Write page after page, and read all of them back."""
    board = ArduinoBootloader()
    bootloader = board.select_programmer("Stk500v2")
    try:
        if not any(_found(board, bootloader, path, wait) for wait in WAITS):
            raise InputError(path, "no bootloader answers", remedy="connect a Mega and try again")
        if not bootloader.cpu_signature() or board.cpu_name != MEGA:
            raise InputError(path, f"is {board.cpu_name or 'another board'}, not an {MEGA}")
        pages = range(0, len(program), PAGE)
        for done, at in enumerate(pages):
            page = program[at : at + PAGE].ljust(PAGE, b"\xff")
            if not bootloader.write_memory(bytearray(page), at):
                raise InputError(
                    path, f"stopped at byte {at}", remedy="check the cable and try again"
                )
            progress(0.5 * done / len(pages))
        for done, at in enumerate(pages):
            page = program[at : at + PAGE]
            if (bootloader.read_memory(at, PAGE) or b"")[: len(page)] != page:
                raise InputError(
                    path, f"reads back differently at byte {at}", remedy="flash it again"
                )
            progress(0.5 + 0.5 * done / len(pages))
        bootloader.leave_bootloader()
        progress(1.0)
    finally:
        if board.device:
            board.device.close()


def _found(
    board: ArduinoBootloader, bootloader: ArduinoBootloader.Stk500v2, path: str, wait: float
) -> bool:
    """Reset the board, and return whether its bootloader answers."""
    if board.device:
        board.device.close()
    line = board.device = serial.Serial(path, BAUD, timeout=SILENT)
    with suppress(OSError):  # a pseudo terminal has no such lines; opening it resets its machine
        line.dtr = line.rts = False
        time.sleep(0.05)
        line.dtr = line.rts = True
        line.reset_input_buffer()
    time.sleep(wait)
    is_found: bool = bootloader.get_sync()
    line.timeout = PATIENCE
    return is_found
