"""Lines with numbers for the machine: those of a machine.toml, and those that it had before."""

from __future__ import annotations

from os import PathLike
from pathlib import Path

from plumb.firmware.client_files import gcode
from plumb.firmware.numbers import firmware_numbers
from plumb.settings.machine import MachineSettings
from plumb.text.errors import refusal
from plumb.text.files import read_text
from plumb.text.readers import to_do


def lines_for(settings: MachineSettings, source: str) -> list[str]:
    """The lines that write a machine's numbers; InputError for the published numbers."""
    if settings.controller != "plumb":
        why = "holds the published numbers, which a client sends"
        remedy = to_do("give a machine.toml that plumb add wrote", page="write a correction first")
        raise refusal(source, why, remedy=remedy)
    return gcode(firmware_numbers(settings)).decode().splitlines()


def kept_before(path: str | PathLike[str]) -> list[str]:
    """The lines of the newest file that kept the machine's numbers before `path` was sent."""
    stem = Path(path).with_suffix("")
    kept = sorted(stem.parent.glob(f"{stem.name}-before-*.nc"))
    if not kept:
        raise refusal(path, "nothing was kept when it was sent", remedy="send it first")
    return read_text(kept[-1]).splitlines()
