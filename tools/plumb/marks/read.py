"""Reading measured marks, whatever the file's form; the front door to this room."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from os import PathLike
from pathlib import Path

from plumb.marks.csv import NEEDED, read_marks_csv
from plumb.marks.digest import digest_of
from plumb.marks.ini import read_marks_ini
from plumb.marks.join import join_measurements
from plumb.marks.model import Distance, Mark, Measurements, Round
from plumb.marks.plausible import Sheet, checked
from plumb.marks.toml import read_marks_toml
from plumb.text.errors import refusal
from plumb.text.files import read_bytes

__all__ = [
    "Distance",
    "Mark",
    "Measurements",
    "Round",
    "join_measurements",
    "read_marks",
    "read_plan",
]


def read_marks(
    path: str | PathLike[str],
    *,
    sheet: Sheet,
    known: Mapping[str, Sequence[str]] | None = None,
) -> Measurements:
    """The marks of a file, in the machine frame [mm]; sheet is its width and height [mm].

    Marks that wait for their reading (`unread = true`) take no part. A file that names the settings
    it was cut with lies on the sheet of these; `known` lists each effect's parameters for them.
    """
    measurements = _without_unread(_read(path, sheet, known))
    named = replace(measurements.rounds[0], digest=digest_of(measurements))
    measurements = replace(measurements, rounds=(named, *measurements.rounds[1:]))
    return checked(measurements, sheet=_sheet_of(measurements, sheet))


def read_plan(path: str | PathLike[str], *, sheet: Sheet) -> Measurements:
    """The marks of a file as they are planned: each as if it were measured where it was sent.

    A mark without reading that is the end of a distance stays without. A repeat with
    another target, as plumb grid places it, is another mark here.
    """
    plan = _read(path, sheet)
    ends = {name for distance in plan.distances for name in distance.between}
    marks = []
    for mark in plan.marks:
        read = mark.measured is not None or mark.name not in ends
        moved = mark.target != plan.target_of(mark.name)
        name = f"{mark.name} at {mark.target[0]:g}/{mark.target[1]:g}" if moved else mark.name
        marks.append(replace(mark, name=name, measured=mark.target if read else None))
    known = {mark.name for mark in marks}
    spans = tuple(
        replace(distance, length=math.dist(*(plan.target_of(name) for name in distance.between)))
        if known.issuperset(distance.between)
        else distance
        for distance in plan.distances
    )
    meant = replace(plan, marks=tuple(marks), distances=spans)
    return checked(meant, sheet=_sheet_of(plan, sheet))


def _without_unread(measurements: Measurements) -> Measurements:
    """Without the marks whose readings are yet to come; an end of distances stays, once."""
    ends = {name for distance in measurements.distances for name in distance.between}
    ends -= {mark.name for mark in measurements.marks if not mark.is_unread}
    kept = []
    for mark in measurements.marks:
        if not mark.is_unread or mark.name in ends:
            kept.append(mark)
            ends.discard(mark.name)
    return replace(measurements, marks=tuple(kept))


Source = str | PathLike[str]
Known = Mapping[str, Sequence[str]] | None
# How a file is read, by the form that _form_of() finds.
READERS: Mapping[str, Callable[[Source, Sheet, Known], Measurements]] = {
    "ini": lambda path, sheet, _: read_marks_ini(path, sheet=sheet),
    "toml": lambda path, sheet, known: read_marks_toml(path, sheet=sheet, known=known),
    "csv": lambda path, *_: read_marks_csv(path),
}


def _read(
    path: str | PathLike[str], sheet: Sheet, known: Mapping[str, Sequence[str]] | None = None
) -> Measurements:
    return READERS[_form_of(path)](path, sheet, known)


def _sheet_of(measurements: Measurements, sheet: Sheet) -> Sheet:
    """The sheet of the settings that a file names, else the usual sheet."""
    cut_with = measurements.rounds[0].cut_with if measurements.rounds else None
    return cut_with.sheet if cut_with else sheet


def _form_of(path: str | PathLike[str]) -> str:
    """`ini`, `toml` or `csv`, by what the file says first and by its ending second."""
    text = read_bytes(path).decode("utf-8-sig", "replace").lower()
    lines = [line.strip() for line in text.splitlines()]
    lines = [line for line in lines if line and line[0] not in "#;"]
    if any(line.startswith("[maslow settings]") for line in lines):
        raise refusal(path, "holds settings, not marks", remedy="give SETTINGS first, then MARKS")
    if any(re.match(r"\[(sheet|effects\..*)\]", line) for line in lines):
        raise refusal(path, "holds settings, not marks", remedy="give SETTINGS first, then MARKS")
    if any(re.match(r"numpositions\s*[=:]", line) for line in lines):
        return "ini"
    if any(re.match(r"\[\[(mark|distance)\]\]|frame\s*=", line) for line in lines):
        return "toml"
    if lines and any(column in lines[0] for column in NEEDED):
        return "csv"
    ending = Path(path).suffix.lower().lstrip(".")
    if ending in READERS:
        return ending
    raise refusal(
        path,
        "is none of the known forms of marks",
        remedy="give a Calibration Measurements.ini, a marks.toml or a marks.csv",
    )
