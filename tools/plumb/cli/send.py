"""`plumb send`: streams a program to the machine, or writes its numbers."""

from __future__ import annotations

import argparse
import signal
import sys
from datetime import datetime
from pathlib import Path
from threading import Event

from plumb.cli.screen import Bar, sentences
from plumb.firmware.client_files import gcode
from plumb.firmware.numbers import firmware_numbers
from plumb.line.memory import Written, as_lines, write_numbers
from plumb.line.sender import Sender, StoppedError, cleaned
from plumb.line.serial_port import SerialPort, port_for
from plumb.settings.files import read_settings
from plumb.text.errors import refusal
from plumb.text.files import read_text, write_whole

SHOWN = 20  # changed numbers in the answer


def run(arguments: argparse.Namespace) -> int:
    """Send it, print what the machine says, and return the exit code."""
    what = arguments.what
    is_file = Path(what).is_file()
    if not is_file and (what.endswith((".nc", ".toml", ".gcode", ".ngc")) or "/" in what):
        raise refusal(what, "there is no such file", remedy="check the name")
    numbers = _numbers(what) if what.endswith(".toml") else None
    if arguments.undo:
        numbers = _kept_before(what)
    lines = list(cleaned(read_text(what).splitlines() if is_file else [what]))
    port = SerialPort(port_for(arguments.port))
    try:
        sender = Sender(port, said=print)
        sender.await_start()
        if numbers is not None:
            _print_written(_write(sender, what, numbers))
            return 0
        code = _stream(sender, lines)
        sender.await_rest()
        return code
    finally:
        port.close()


def _numbers(path: str) -> list[str]:
    """The lines that write a machine's numbers."""
    settings = read_settings(path)
    if settings.controller != "plumb":
        why = "holds the published numbers, which a client sends"
        raise refusal(path, why, remedy="give a machine.toml that plumb add wrote")
    return gcode(firmware_numbers(settings)).decode().splitlines()


def _write(sender: Sender, path: str, lines: list[str]) -> tuple[Written, str]:
    """Write numbers; the file that keeps the old numbers."""
    written = write_numbers(sender, lines)
    kept = f"{Path(path).with_suffix('')}-before-{datetime.now():%Y-%m-%d-%H%M%S}.nc"
    write_whole(kept, as_lines(written.before).encode())
    return written, kept


def _kept_before(path: str) -> list[str]:
    """The lines of the newest file that kept the machine's numbers before `path` was sent."""
    stem = Path(path).with_suffix("")
    kept = sorted(stem.parent.glob(f"{stem.name}-before-*.nc"))
    if not kept:
        raise refusal(path, "nothing was kept when it was sent", remedy="send it first")
    return read_text(kept[-1]).splitlines()


def _print_written(done: tuple[Written, str]) -> None:
    written, kept = done
    rows = [f"${number}: {old:g} -> {new:g}" for number, (old, new) in written.changed.items()]
    more = len(rows) - SHOWN
    rows = rows[:SHOWN] + ([f"and {more} more"] if more > 0 else [])
    print("The machine holds the numbers; each was read back.")
    print(sentences(rows) if rows else "- none had to change")
    print(f"The old numbers are in {kept}. To bring them back: plumb send --undo, with this file.")


def _hold(sender: Sender) -> None:
    """Hold the machine, and ask what now; where nobody can answer, stop."""
    sender.hold()
    if not sys.stdin.isatty():
        sender.stop()
    answer = input("The machine holds. Enter goes on; s and Enter stops: ")
    if answer.strip().lower().startswith("s"):
        sender.stop()
    sender.go_on()


def _stream(sender: Sender, lines: list[str]) -> int:
    """Stream a program; Ctrl-C holds the machine where it is."""
    bar = Bar("sending", patience=0.5)
    total = len(lines)
    pressed = Event()

    def attend(sender: Sender) -> None:
        if pressed.is_set():
            pressed.clear()
            bar.clear()
            _hold(sender)

    sender.attend = attend
    before = signal.signal(signal.SIGINT, lambda *_: pressed.set())
    try:
        sender.stream(lines, answered=lambda done: bar.show(done / total))
    except StoppedError:
        print("The machine has stopped. It knows where it is; the rest was not sent.")
        return 1
    finally:
        bar.clear()
        signal.signal(signal.SIGINT, before)
    if total > 1:
        print(f"{total} lines were sent, and the machine took each.")
    return 0
