"""The machine's numbers over the line: read all, write some, read back what was written."""

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from plumb.firmware.settings import firmware_numbers, gcode, listed_settings
from plumb.line.sender import QUESTION, REPORTS, Sender, Watch, are_apart
from plumb.settings import MachineSettings
from plumb.text.errors import InputError, to_do
from plumb.text.files import read_text

ROW = re.compile(r"\$(\d+)=([-+\d.eE]+)")
SETTING = re.compile(r"\$(\d+)\s*=\s*(\S+)")
SAME = 1e-5  # of a value: the machine prints seven digits
OURS = "Plumb v"  # how our firmware greets
STORING = 10.0  # [s] of the machine; a new board takes three


@dataclass(frozen=True)
class WrittenNumbers:
    """Numbers that were sent, and the machine's answer to them."""

    before: dict[int, float]  # all numbers of the machine
    changed: dict[int, tuple[float, float]]  # old and new value by number


def read_numbers(sender: Sender) -> dict[int, float]:
    """Return all numbers that the machine lists, by their $-number."""
    rows = (ROW.match(line) for line in sender.ask("$$"))
    numbers = {int(row[1]): float(row[2]) for row in rows if row}
    if not numbers:
        raise InputError("the machine lists no numbers: is it a Maslow's firmware?")
    return numbers


def version_of(sender: Sender) -> str:
    """Return what the machine says of its firmware, like `Firmware Version 1.28`; empty if
    nothing.
    """
    return next((line for line in sender.ask(QUESTION) if line.startswith("Firmware")), "")


def firmware_of(sender: Sender) -> str:
    """Return the firmware's name with its version; empty if the machine says neither."""
    ours = [line for line in sender.greeting if line.startswith(OURS)]
    # Ours answers with the version that clients expect.
    return ours[0].partition(",")[0] if ours else version_of(sender)


def write_numbers(
    sender: Sender,
    lines: list[str],
    *,
    keep: Callable[[dict[int, float]], None] = lambda before: None,
) -> WrittenNumbers:
    """Send lines `$N=VALUE`, read all numbers back, and compare.

    `keep` gets all numbers that the machine has, before any is sent.
    Returns when they are in the machine's EEPROM: who opens its line next resets it. Raises
    InputError while the machine moves, for a line of something else, and if the machine holds
    another number than was sent.
    """
    wanted = {}
    for line in lines:
        row = SETTING.fullmatch(line)
        if not row:
            raise InputError(f"{line!r} is not a number for the machine: $N=VALUE")
        wanted[int(row[1])] = float(row[2])
    refuse_while_moving(sender)
    before = read_numbers(sender)
    keep(before)
    sender.stream(lines)
    after = read_numbers(sender)
    for number, value in wanted.items():
        if number not in after or not _same(after[number], value):
            raise InputError(
                f"the machine holds ${number}={after.get(number)} though {value} was sent: send "
                "the numbers again"
            )
    _await_stored(sender)
    changed = {
        number: (value, after[number])
        for number, value in before.items()
        if number in after and not _same(after[number], value)
    }
    return WrittenNumbers(before, changed)


def _await_stored(sender: Sender) -> None:
    watch = Watch(sender)
    while any("|eeprom:writing|" in line for line in sender.ask("B30")):
        if watch.has_lasted(STORING):
            raise InputError("the machine does not store its numbers: send them again")
        sender.listen()


def _same(printed: float, value: float) -> bool:
    """Return whether two numbers are the same as far as the machine prints them."""
    return abs(printed - value) <= SAME * abs(value)


def refuse_while_moving(sender: Sender) -> None:
    """InputError if the sled is not where it was a moment ago."""
    sender.await_start()
    first, watch = sender.status, Watch(sender)
    while not watch.has_lasted(REPORTS):
        sender.listen()
    if first and sender.status and are_apart(first.place, sender.status.place):
        raise InputError("the machine moves: wait until it stands, then send the numbers")


def as_lines(numbers: Mapping[int, float]) -> str:
    """Return numbers as lines that can be sent again; those that no line may set are left out."""
    rows = listed_settings()
    return "".join(
        f"${number}={value:.9g}\n" for number, value in numbers.items() if number in rows
    )


# Lines with numbers for the machine: those of a machine.toml, and those that it had before.


def lines_for(settings: MachineSettings, source: str) -> list[str]:
    """Return the lines that write a machine's numbers; InputError for the published numbers."""
    if settings.controller != "plumb":
        why = "holds the published numbers, which a client sends"
        remedy = to_do("give a machine.toml that plumb add wrote", page="write a correction first")
        raise InputError(source, why, remedy=remedy)
    return gcode(firmware_numbers(settings)).decode().splitlines()


def kept_before(path: Path) -> list[str]:
    """Return the lines of the newest file that kept the machine's numbers before `path` was
    sent.
    """
    kept = sorted(path.parent.glob(f"{path.stem}-before-*.nc"))
    if not kept:
        raise InputError(path, "nothing was kept when it was sent", remedy="send it first")
    return read_text(kept[-1]).splitlines()
