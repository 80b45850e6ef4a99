"""The published `Calibration Measurements.ini`: marks in mm from the sheet's top-left corner.

[global] numpositions, [actual_positions] x0 y0 ..., [target_positions] tx0 ty0 ...; y runs down.
"""

from __future__ import annotations

import re
from os import PathLike

from plumb.marks.model import Mark, Measurements, Point
from plumb.marks.plausible import Sheet, to_machine
from plumb.text.errors import naming, refusal
from plumb.text.ini import IniText, read_ini
from plumb.text.values import number_in

_NUMBERED = re.compile(r"t?[xy](\d+)", re.IGNORECASE)


def read_marks_ini(path: str | PathLike[str], *, sheet: Sheet) -> Measurements:
    """The marks of a published measurement file, moved to the machine frame."""
    ini = read_ini(path)
    count = _count(ini)
    marks: list[Mark] = []
    names: dict[Point, str] = {}
    for index in range(count):
        target = to_machine(_point(ini, "target_positions", "t", index), sheet=sheet)
        measured = to_machine(_point(ini, "actual_positions", "", index), sheet=sheet)
        # The format has no names; the same target again is a repeat of the same mark.
        marks.append(Mark(names.setdefault(target, str(index)), target, measured))
    return Measurements(marks=tuple(marks), source=str(path))


def _count(ini: IniText) -> int:
    """How many positions the file says it has, if it has exactly those."""
    entry = ini.find("numpositions", section="global")
    if entry is None:
        raise refusal(
            ini.source,
            "numpositions is missing",
            remedy="add [global] numpositions = how many marks there are",
        )
    if not entry.value.isascii() or not entry.value.isdigit() or int(entry.value) == 0:
        raise refusal(
            ini.source,
            f"'{entry.value}' is not a count",
            place=entry.place,
            remedy="write how many marks there are",
        )
    count = int(entry.value)
    for other in ini.entries:
        numbered = _NUMBERED.fullmatch(other.key)
        if numbered and int(numbered[1]) >= count:
            raise refusal(
                ini.source,
                f"is beyond numpositions = {count}",
                place=other.place,
                remedy="numbers start at 0; correct numpositions or remove the mark",
            )
    return count


def _point(ini: IniText, section: str, prefix: str, index: int) -> Point:
    """A point of the file, as written [mm]."""
    values = []
    for axis in ("x", "y"):
        key = f"{prefix}{axis}{index}"
        entry = ini.find(key, section=section)
        if entry is None:
            raise refusal(
                ini.source,
                f"{key} is missing in [{section}]",
                remedy="add it, or correct numpositions",
            )
        with naming(ini.source, entry.place):
            values.append(number_in(entry.value))
    return values[0], values[1]
