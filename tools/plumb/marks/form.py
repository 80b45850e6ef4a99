"""A marks.toml while its readings are typed: marks may wait, and any reading can be changed.

Places are in the machine frame [mm]; the file keeps the corner and the unit that it has.
"""

from __future__ import annotations

import json
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import date
from os import PathLike
from typing import Any

from plumb.marks.model import Mark, Measurements, Point
from plumb.marks.plausible import Sheet
from plumb.marks.toml import read_marks_toml
from plumb.text.files import read_text
from plumb.text.values import UNITS, with_quoted_fractions

BLANK = "# measured = [ , ]"  # what a form has where a reading is yet to come
DIGITS = {"mm": 4, "inch": 5}  # a 1/128 inch stays what it is


@dataclass(frozen=True)
class Form:
    """Contents of a marks.toml, as TOML has it and as marks."""

    head: Mapping[str, Any]
    comment: tuple[str, ...]  # the lines before its first key
    measurements: Measurements  # marks that wait are there too


def read_form(
    path: str | PathLike[str],
    *,
    sheet: Sheet,
    known: Mapping[str, Sequence[str]] | None = None,
) -> Form:
    """Return the form in a file. Raises InputError for what is no marks.toml."""
    measurements = read_marks_toml(path, sheet=sheet, known=known)
    text = read_text(path)
    return Form(tomllib.loads(with_quoted_fractions(text)), _comment_of(text), measurements)


def with_readings(form: Form, places: Mapping[int, Point | None]) -> dict[str, Any]:
    """Return the head with other readings, by the marks' indices; None takes a reading out."""
    marks = [dict(mark) for mark in form.head.get("mark", [])]
    for index, place in places.items():
        if not 0 <= index < len(marks):
            raise ValueError(f"there is no mark number {index + 1}")
        marks[index].pop("measured", None)
        if place is not None:
            marks[index].pop("unread", None)
            marks[index]["measured"] = _typed(form, place)
    for mark in marks:
        if "measured" not in mark:
            mark["unread"] = True
    return {**form.head, "mark": marks}


def with_distances(
    form: Form, distances: Sequence[tuple[tuple[str, str], float]]
) -> dict[str, Any]:
    """Return the head with other distances [mm]; a distance that stays is not touched."""
    before = form.head.get("distance", [])
    known = {
        (distance.between, distance.length): table
        for distance, table in zip(form.measurements.distances, before, strict=False)
    }
    tables = [
        known.get((between, length), {"between": list(between), "mm": round(length, 4)})
        for between, length in distances
    ]
    # A mark without reading is an end of a distance, or waits; both are written as waiting.
    return with_readings(Form({**form.head, "distance": tables}, (), form.measurements), {})


def head_of(measurements: Measurements) -> dict[str, Any]:
    """Return what a marks.toml says of measurements that came in another form."""
    said = {
        "controller": measurements.controller,
        "tape_sigma_mm": measurements.tape_sigma,
        "steered": measurements.steered or None,
    }
    marks = [_mark_table(mark) for mark in measurements.marks]
    distances = [
        {"between": list(distance.between), "mm": distance.length}
        for distance in measurements.distances
    ]
    lists = {"mark": marks, "distance": distances}
    kept = {key: value for key, value in (said | lists).items() if value}
    return {"frame": "machine", **kept}


def _mark_table(mark: Mark) -> dict[str, Any]:
    said = {
        "name": mark.name,
        "target": list(mark.target),
        "measured": list(mark.measured) if mark.measured else None,
        "unread": True if mark.measured is None else None,
        "approach": list(mark.approach) if mark.approach else None,
        "sled_weight_n": mark.sled_weight,
        "chains": list(mark.chains) if mark.chains else None,
        "chains_swapped": mark.chains_swapped or None,
    }
    return {key: value for key, value in said.items() if value is not None}


def toml_text(head: Mapping[str, Any], comment: Sequence[str] = ()) -> str:
    """Return the text of a marks.toml."""
    lines = [*comment]
    for key, value in head.items():
        if not _is_table(value):
            lines.append(f"{key} = {_value(value)}")
    for key, value in head.items():
        for table in value if isinstance(value, list) and _is_table(value) else ():
            lines += ["", f"[[{key}]]", *_lines(table)]
        if isinstance(value, Mapping):
            lines += ["", f"[{key}]", *_lines(value)]
    return "\n".join([*lines, ""])


def _is_table(value: object) -> bool:
    is_list = isinstance(value, list) and value and isinstance(value[0], Mapping)
    return isinstance(value, Mapping) or bool(is_list)


def _lines(table: Mapping[str, Any]) -> list[str]:
    lines = [f"{key} = {_value(value)}" for key, value in table.items()]
    return [*lines, BLANK] if table.get("unread") else lines


def _value(value: object) -> str:
    """Return a value as TOML writes it; its texts are those of JSON."""
    if isinstance(value, list):
        return f"[{', '.join(map(_value, value))}]"
    if isinstance(value, date):
        return value.isoformat()
    return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")


def _typed(form: Form, place: Point) -> list[float]:
    """Return a place as the file counts: its corner, its unit."""
    typed = form.measurements.typed
    return [
        round(number / UNITS[typed.unit], DIGITS[typed.unit]) + 0.0 for number in typed.place(place)
    ]


def _comment_of(text: str) -> tuple[str, ...]:
    lines = []
    for line in text.splitlines():
        if line.strip() and not line.startswith("#"):
            break
        lines.append(line.rstrip())
    while lines and not lines[-1]:
        lines.pop()
    return tuple(lines)
