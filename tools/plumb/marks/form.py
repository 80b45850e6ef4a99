"""A marks.toml while its readings are typed: marks may wait, and any reading can be changed.

Places are in the machine frame [mm]; the file keeps its corner, its unit and its comments.
"""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import tomlkit

from plumb.grid import BLANK
from plumb.marks.model import Mark, Measurements, Point
from plumb.marks.read import Sheet, read_marks_toml
from plumb.settings import Known
from plumb.text.errors import Source
from plumb.text.files import read_text
from plumb.text.values import UNITS, with_quoted_fractions

DIGITS = {"mm": 4, "inch": 5}  # a 1/128 inch stays what it is


@dataclass(frozen=True)
class Form:
    """A marks.toml as text, its fractions in quotes, and as marks."""

    text: str
    measurements: Measurements  # marks that wait are there too


def read_form(path: Source, *, sheet: Sheet, known: Known = None) -> Form:
    """Return the form in a file. Raises InputError for what is no marks.toml."""
    measurements = read_marks_toml(path, sheet=sheet, known=known)
    return Form(with_quoted_fractions(read_text(path)), measurements)


def with_readings(form: Form, places: Mapping[int, Point | None]) -> str:
    """Return the text with other readings, by the marks' indices; None takes a reading out."""
    document = tomlkit.parse(form.text)
    marks = document.get("mark", [])
    for index, place in places.items():
        if not 0 <= index < len(marks):
            raise ValueError(f"there is no mark number {index + 1}")
        _say(marks[index], "measured", place and _typed(form, place), instead_of="unread")
    return _as_form(document)


def with_distances(form: Form, distances: Sequence[tuple[tuple[str, str], float]]) -> str:
    """Return the text with other distances [mm]; a distance that stays is not touched."""
    document = tomlkit.parse(form.text)
    known = {
        (distance.between, distance.length): table
        for distance, table in zip(
            form.measurements.distances, document.get("distance", []), strict=False
        )
    }
    tables = tomlkit.aot()
    for between, length in distances:
        new = tomlkit.item({"between": list(between), "mm": round(length, 4)})
        tables.append(known.get((between, length), new))
    if distances:
        document["distance"] = tables
    else:
        document.pop("distance", None)
    # A mark without reading is an end of a distance, or waits; both are written as waiting.
    return _as_form(document)


def with_tape_sigma(form: Form, sigma: float | None) -> str:
    """Return the text with how well the tape is read [mm]; None: nothing is stated."""
    document = tomlkit.parse(form.text)
    if sigma is None:
        document.pop("tape_sigma_mm", None)
    else:
        document["tape_sigma_mm"] = sigma
    return _as_form(document)


def marks_toml(measurements: Measurements) -> str:
    """Return a marks.toml that says what measurements say that came in another form."""
    head = {
        "frame": "machine",
        "controller": measurements.controller,
        "tape_sigma_mm": measurements.tape_sigma,
        "steered": measurements.steered or None,
        "mark": [_mark_table(mark) for mark in measurements.marks],
        "distance": [
            {"between": list(distance.between), "mm": distance.length}
            for distance in measurements.distances
        ],
    }
    return _as_form(tomlkit.item({key: value for key, value in head.items() if value}))


def _mark_table(mark: Mark) -> dict[str, Any]:
    said = {
        "name": mark.name,
        "target": list(mark.target),
        "measured": mark.measured and list(mark.measured),
        "approach": mark.approach and list(mark.approach),
        "sled_weight_n": mark.sled_weight,
        "chains": mark.chains and list(mark.chains),
    }
    return {key: value for key, value in said.items() if value is not None}


def _as_form(document: tomlkit.TOMLDocument) -> str:
    """Return the text of a form, in which each mark without reading has a line for it."""
    for mark in document.get("mark", []):
        if "measured" not in mark:
            _say(mark, "unread", True, instead_of="measured")
    text = re.sub(rf"(?m)^{re.escape(BLANK)}\r?\n", "", document.as_string())
    return re.sub(r"(?m)^(unread\s*=\s*true\b.*?)(\r?)$", rf"\1\2\n{BLANK}\2", text)


def _say(mark: Any, key: str, value: object, *, instead_of: str) -> None:
    """Say something of a mark in the place where it said something else."""
    if value is None:
        mark.pop(key, None)
    elif instead_of in mark:
        mark.value._replace(instead_of, key, value)
    else:
        mark[key] = value


def _typed(form: Form, place: Point) -> list[float]:
    """Return a place as the file counts: its corner, its unit."""
    typed = form.measurements.typed
    return [
        round(number / UNITS[typed.unit], DIGITS[typed.unit]) + 0.0 for number in typed.place(place)
    ]
