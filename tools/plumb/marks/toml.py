"""`marks.toml`: marks and distances by name, with how they were made."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any

from plumb.grid.cut_with import settings_as_they_were
from plumb.marks.model import Distance, Mark, Measurements, Point, Round, Typed
from plumb.marks.plausible import Sheet, to_machine
from plumb.settings.files import read_settings
from plumb.settings.machine import CONTROLLERS
from plumb.text.errors import InputError, naming
from plumb.text.files import parsed, read_text
from plumb.text.values import (
    UNITS,
    length,
    number,
    one_of,
    pair,
    point,
    refuse_unknown,
    text_of,
    with_quoted_fractions,
    within,
)

FRAMES = ("sheet-top-left", "machine")
ROUND_FLAGS = ("chains_rezeroed", "new_sheet", "frame_moved")
HEAD_KEYS = (
    "frame",
    "units",
    "date",
    "cut_with",
    "cut_with_digest",
    "controller",
    "tape_sigma_mm",
    "sled_weight_n",
    "steered",
    *ROUND_FLAGS,
    "mark",
    "distance",
)
MARK_KEYS = (
    "name",
    "target",
    "measured",
    "unread",
    "approach",
    "sled_weight_n",
    "chains",
    "chains_swapped",
)
DISTANCE_KEYS = ("between", "mm", "inch")
SLED_WEIGHT_RANGE = (30.0, 1000.0)  # [N] below it somebody wrote kilograms or pounds


@dataclass(frozen=True)
class PlaceFrame:
    """How the places of a file are typed."""

    sheet: Sheet | None  # they count from its top left corner, y down; None: machine frame
    unit: float  # [mm]


TAPE_SIGMA_RANGE = (0.001, 50.0)  # [mm]
CHAIN_RANGE = (0.0, 20000.0)  # [mm]


def read_marks_toml(
    path: str | PathLike[str],
    *,
    sheet: Sheet,
    known: Mapping[str, Sequence[str]] | None = None,
) -> Measurements:
    """Return the marks and distances of a marks.toml, moved to the machine frame; unread
    marks too.
    """
    head = parsed(path, with_quoted_fractions(read_text(path)), tomllib.loads, "TOML")
    with naming(path, "at the top"):
        refuse_unknown(head, HEAD_KEYS)
    if "frame" not in head:
        raise InputError(
            path, "frame is missing", remedy='write frame = "sheet-top-left" or frame = "machine"'
        )
    with naming(path, "frame"):
        top_left = one_of(head["frame"], FRAMES) == "sheet-top-left"
    with naming(path, "units"):
        unit = UNITS[one_of(head.get("units", "mm"), UNITS)]
    weight = _optional_weight(path, "sled_weight_n", head)
    file_round = _round(path, head, known)
    sheet = file_round.cut_with.sheet if file_round.cut_with else sheet
    frame = PlaceFrame(sheet if top_left else None, unit)
    return Measurements(
        marks=_marks(path, head, frame=frame, weight=weight),
        distances=_distances(path, head),
        controller=_controller(path, head),
        tape_sigma=_tape_sigma(path, head),
        sled_weight=weight,
        source=str(path),
        rounds=(file_round,),
        typed=Typed(frame.sheet, head.get("units", "mm")),
        steered=_flag(path, head, "steered"),
    )


def _round(
    path: str | PathLike[str], head: dict[str, Any], known: Mapping[str, Sequence[str]] | None
) -> Round:
    """Return how the file's marks were cut; the path in cut_with starts at the file's folder."""
    cut_with, changed = None, ""
    if "cut_with" in head:
        with naming(path, "cut_with_digest"):
            was = text_of(head.get("cut_with_digest", ""))
        with naming(path, "cut_with"):
            name = text_of(head["cut_with"])
            kept = settings_as_they_were(Path(path).parent / name, was)
            if kept is None:
                changed = name
            else:
                cut_with = read_settings(kept, known=known)
    return Round(
        date=str(head.get("date", "")),
        cut_with=cut_with,
        changed=changed,
        chains_rezeroed=_flag(path, head, "chains_rezeroed"),
        new_sheet=_flag(path, head, "new_sheet"),
        frame_moved=_flag(path, head, "frame_moved"),
    )


def _flag(path: str | PathLike[str], head: dict[str, Any], name: str) -> bool:
    """Return a value that is true or false; false if it is missing."""
    value = head.get(name, False)
    if not isinstance(value, bool):
        raise InputError(path, f"{name} is neither true nor false", remedy="write true or false")
    return value


def _controller(path: str | PathLike[str], head: dict[str, Any]) -> str | None:
    if "controller" not in head:
        return None
    with naming(path, "controller"):
        return one_of(head["controller"], CONTROLLERS)


def _tape_sigma(path: str | PathLike[str], head: dict[str, Any]) -> float | None:
    if "tape_sigma_mm" not in head:
        return None
    with naming(path, "tape_sigma_mm"):
        return within(number(head["tape_sigma_mm"]), *TAPE_SIGMA_RANGE)


def _optional_weight(path: str | PathLike[str], place: str, table: dict[str, Any]) -> float | None:
    """Return the sled weight [N] a table gives."""
    if "sled_weight_n" not in table:
        return None
    with naming(path, place):
        return sled_weight_in_newtons(number(table["sled_weight_n"]))


def sled_weight_in_newtons(weight: float) -> float:
    """Return the weight [N], if a sled can weigh that much."""
    low, high = SLED_WEIGHT_RANGE
    if not low <= weight <= high:
        raise ValueError(
            f"a sled of {weight:g} N is not possible; "
            "newtons are needed: 9.81 times kilograms, 4.448 times pounds"
        )
    return weight


def _tables(path: str | PathLike[str], head: dict[str, Any], key: str) -> list[dict[str, Any]]:
    """Return all tables [[key]] of the file."""
    tables = head.get(key, [])
    if not isinstance(tables, list) or not all(isinstance(table, dict) for table in tables):
        raise InputError(path, f"[{key}] needs double brackets", remedy=f"write [[{key}]]")
    return tables


def _marks(
    path: str | PathLike[str], head: dict[str, Any], *, frame: PlaceFrame, weight: float | None
) -> tuple[Mark, ...]:
    """Return all marks, moved to the machine frame."""
    marks: list[Mark] = []
    names: dict[Point, str] = {}
    for index, table in enumerate(_tables(path, head, "mark"), 1):
        place = f"[[mark]] number {index}"
        with naming(path, place):
            refuse_unknown(table, MARK_KEYS)
            if "target" not in table:
                raise ValueError("target is missing; write target = [x, y] in mm")
            name = _name(table["name"]) if "name" in table else None
        place = f"mark {name}" if name else place
        target = _point(path, place, table["target"], "target", frame)
        name = name or names.setdefault(target, str(index))
        mark_weight = _optional_weight(path, f"{place} sled_weight_n", table)
        marks.append(
            Mark(
                name=name,
                target=target,
                measured=_place(path, place, table, "measured", frame),
                approach=_approach(path, place, table, frame),
                sled_weight=weight if mark_weight is None else mark_weight,
                chains=_chains(path, place, table),
                chains_swapped=_yes_or_no(path, place, table, "chains_swapped"),
                is_unread=_yes_or_no(path, place, table, "unread") and "measured" not in table,
            )
        )
    return tuple(marks)


def _name(value: object) -> str:
    """Return a mark's name; a whole number will do."""
    name = str(value) if isinstance(value, int) and not isinstance(value, bool) else text_of(value)
    if not name.strip():
        raise ValueError("the name is empty; leave it out or fill it in")
    return name.strip()


def _place(
    path: str | PathLike[str], place: str, table: dict[str, Any], key: str, frame: PlaceFrame
) -> Point | None:
    return _point(path, place, table[key], key, frame) if key in table else None


def _point(
    path: str | PathLike[str], place: str, value: object, key: str, frame: PlaceFrame
) -> Point:
    with naming(path, f"{place} {key}"):
        typed = point(value, unit=frame.unit)
    return typed if frame.sheet is None else to_machine(typed, sheet=frame.sheet)


def _approach(
    path: str | PathLike[str], place: str, table: dict[str, Any], frame: PlaceFrame
) -> Point | None:
    """Return the direction of the last move; in the top-left frame y runs down here as well."""
    if "approach" not in table:
        return None
    with naming(path, f"{place} approach"):
        along, across = pair(table["approach"])
        if along == across == 0:
            raise ValueError("[0, 0] is no direction; leave approach out if it is not known")
    return (along, across) if frame.sheet is None else (along, -across)


def _chains(path: str | PathLike[str], place: str, table: dict[str, Any]) -> Point | None:
    if "chains" not in table:
        return None
    with naming(path, f"{place} chains"):
        left, right = pair(table["chains"])
        return within(left, *CHAIN_RANGE), within(right, *CHAIN_RANGE)


def _yes_or_no(path: str | PathLike[str], place: str, table: dict[str, Any], key: str) -> bool:
    value = table.get(key, False)
    with naming(path, f"{place} {key}"):
        if not isinstance(value, bool):
            raise ValueError(f"{value!r} is neither true nor false")
    return value


def _distances(path: str | PathLike[str], head: dict[str, Any]) -> tuple[Distance, ...]:
    """Return all distances, as read."""
    distances: list[Distance] = []
    for index, table in enumerate(_tables(path, head, "distance"), 1):
        with naming(path, f"[[distance]] number {index}"):
            refuse_unknown(table, DISTANCE_KEYS)
            given = [key for key in UNITS if key in table]
            if "between" not in table or len(given) != 1:
                key = "mm or inch" if "between" in table else "between"
                raise ValueError(f'{key} is missing; write between = ["1", "2"] and mm = 500.0')
            ends = table["between"]
            if not isinstance(ends, list) or len(ends) != 2:
                raise ValueError('between needs two names, as ["1", "2"]')
            first, second = _name(ends[0]), _name(ends[1])
            if first == second:
                raise ValueError(f"'{first}' is named twice; two different marks are needed")
            size = length(table[given[0]], unit=UNITS[given[0]])
            if size <= 0:
                raise ValueError(f"{given[0]} = {table[given[0]]}; a distance is above zero")
            distances.append(Distance((first, second), size))
    return tuple(distances)
