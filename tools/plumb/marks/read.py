"""Reading measured marks, whatever the file's form; the front door to this room."""

import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import TypeVar

from plumb.marks.csv import NEEDED, read_marks_csv, read_marks_ini
from plumb.marks.model import Distance, Mark, Measurements, Point, Round, Typed, digest_of
from plumb.marks.plausible import Sheet, checked
from plumb.marks.toml import read_marks_toml
from plumb.settings.machine import MachineSettings
from plumb.settings.toml import Known
from plumb.text.errors import InputError, Source, to_do
from plumb.text.files import CODE, read_bytes
from plumb.text.values import refuse_unknown

__all__ = [
    "Distance",
    "Mark",
    "Measurements",
    "Round",
    "join_measurements",
    "read_marks",
    "without_marks",
]


def read_marks(path: Source, *, sheet: Sheet, known: Known = None) -> Measurements:
    """Return the marks of a file, in the machine frame [mm]; sheet is its width and height [mm].

    Marks that wait for their reading (`unread = true`) take no part. A file that names the settings
    it was cut with lies on the sheet of these; `known` lists each effect's parameters for them.
    """
    measurements = _without_unread(_read(path, sheet, known))
    named = replace(measurements.rounds[0], digest=digest_of(measurements))
    measurements = replace(measurements, rounds=(named, *measurements.rounds[1:]))
    return checked(measurements, sheet=_sheet_of(measurements, sheet))


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


# How a file is read, by the form that _form_of() finds.
READERS: Mapping[str, Callable[[Source, Sheet, Known], Measurements]] = {
    "ini": lambda path, sheet, _: read_marks_ini(path, sheet=sheet),
    "toml": lambda path, sheet, known: read_marks_toml(path, sheet=sheet, known=known),
    "csv": lambda path, *_: read_marks_csv(path),
}


def _read(path: Source, sheet: Sheet, known: Known = None) -> Measurements:
    return READERS[_form_of(path)](path, sheet, known)


def _sheet_of(measurements: Measurements, sheet: Sheet) -> Sheet:
    """Return the sheet of the settings that a file names, else the usual sheet."""
    cut_with = measurements.rounds[0].cut_with if measurements.rounds else None
    return cut_with.sheet if cut_with else sheet


def _form_of(path: Source) -> str:
    """`ini`, `toml` or `csv`, by what the file says first and by its ending second."""
    text = read_bytes(path).decode("utf-8-sig", "replace").lower()
    lines = [line.strip() for line in text.splitlines()]
    lines = [line for line in lines if line and line[0] not in "#;"]
    if any(re.match(r"\[(maslow settings|sheet|effects\..*)\]", line) for line in lines):
        raise InputError(
            path, "holds settings, not marks", remedy="give SETTINGS first, then MARKS"
        )
    if any(re.match(r"numpositions\s*[=:]", line) for line in lines):
        return "ini"
    if any(re.match(r"\[\[(mark|distance)\]\]|frame\s*=", line) for line in lines):
        return "toml"
    if lines and any(column in lines[0] for column in NEEDED):
        return "csv"
    ending = Path(path).suffix.lower().lstrip(".")
    if ending in READERS:
        return ending
    if any(map(CODE.match, lines)):
        form = to_do("give the form that plumb grid --marks wrote", page="give a form of marks")
        raise InputError(path, "holds a program, not marks", remedy=form)
    raise InputError(
        path,
        "is none of the known forms of marks",
        remedy="give a Calibration Measurements.ini, a marks.toml or a marks.csv",
    )


# Several files of marks become a board: repeats, other marks, and what contradicts.

# How a reading is looked up in another file: target, or both ends of a distance, and sled weight.
ReadingKey = tuple[Point | frozenset[Point], float | None]
# What repeats of a mark share: target, sled weight, chains, approach, settings, zero, sheet.
MadeBy = tuple[Point, float | None, Point | None, Point | None, MachineSettings | None, int, int]
Value = TypeVar("Value", str, float)
FEWEST_COPIED = 5  # readings that agree to the last digit before a file passes for a copy


def join_measurements(parts: Iterable[Measurements]) -> Measurements:
    """Several files as a single board, in the order in which they were cut.

    A name with the same target, made in the same way, is a repeat. Otherwise it is a new mark, and
    all names of its file get the file's name in front.
    """
    several = tuple(parts)
    if len(several) == 1:
        return several[0]
    labels = _labels(several)
    rounds: list[Round] = []
    known: dict[str, list[MadeBy]] = {}
    joined: list[Measurements] = []
    for number, part in enumerate(several):
        rounds.append(_next_round(part, labels[number], rounds))
        _refuse_a_copy(part, several[:number])
        numbered = _numbered(part, number)
        made = [(mark.name, _made(mark, rounds[number])) for mark in numbered.marks]
        clash = any(how not in known.get(name, [how]) for name, how in made)
        joined.append(_renamed(numbered, f"{labels[number]}:") if clash else numbered)
        for mark, (_, how) in zip(joined[-1].marks, made, strict=True):
            known.setdefault(mark.name, []).append(how)
    return Measurements(
        marks=tuple(mark for part in joined for mark in part.marks),
        distances=tuple(distance for part in joined for distance in part.distances),
        controller=_agreed([(part, part.controller) for part in several], "controller"),
        tape_sigma=_agreed([(part, part.tape_sigma) for part in several], "tape_sigma_mm"),
        sled_weight=_shared_weight(several),
        source=" + ".join(part.source for part in several),
        typed=_typed(several),
        rounds=tuple(rounds),
    )


def _numbered(part: Measurements, number: int) -> Measurements:
    """Return a file whose marks and distances belong to the round with this number."""
    return replace(
        part,
        marks=tuple(replace(mark, round=number) for mark in part.marks),
        distances=tuple(replace(distance, round=number) for distance in part.distances),
    )


def _typed(parts: tuple[Measurements, ...]) -> Typed:
    """Return how the places were typed, if it was alike in all files."""
    first, *others = [part.typed for part in parts]
    return first if all(other == first for other in others) else Typed()


def _refuse_a_copy(part: Measurements, before: tuple[Measurements, ...]) -> None:
    """Refuse a file with the numbers of another: the board would seem to have no noise."""
    for other in before:
        same = _readings(part).items() & _readings(other).items()
        common = _readings(part).keys() & _readings(other).keys()
        if len(same) == len(common) >= FEWEST_COPIED:
            raise InputError(
                part.source,
                f"its {len(same)} readings are those of {other.source} to the last digit",
                remedy="a copy is not a repeat: leave the copy out",
            )


def _readings(part: Measurements) -> dict[ReadingKey, tuple[float, ...]]:
    """Return what was read, by targets and sled weight: the first reading of each."""
    readings: dict[ReadingKey, tuple[float, ...]] = {}
    for mark, measured in part.readings:
        read = tuple(round(number, 6) for number in measured)
        readings.setdefault((_rounded(mark.target), mark.sled_weight), read)
    for distance in part.distances:
        ends = frozenset(_rounded(part.target_of(name)) for name in distance.between)
        readings.setdefault((ends, part.sled_weight), (distance.length,))
    return readings


def _rounded(point: tuple[float, float]) -> tuple[float, float]:
    return round(point[0], 3), round(point[1], 3)


def _labels(parts: tuple[Measurements, ...]) -> list[str]:
    """Return a short name of each file, no two alike."""
    paths = [Path(part.source) for part in parts]
    labels = [path.stem for path in paths]
    if len(set(labels)) == 1:
        labels = [path.parent.name or path.stem for path in paths]
    elif len(set(labels)) < len(labels):
        labels = [f"{path.parent.name}/{path.stem}" for path in paths]
    if len(set(labels)) < len(labels):
        labels = [f"{label} {number}" for number, label in enumerate(labels, 1)]
    return labels


def _next_round(part: Measurements, name: str, before: list[Round]) -> Round:
    """Return the round of a file after others; refuses a file whose frame moved."""
    file_round = part.rounds[0]
    if not before:
        return replace(file_round, name=name)
    if file_round.frame_moved:
        raise InputError(
            part.source,
            "frame_moved is true, so it cannot share a frame with the files before it",
            remedy="give it alone",
        )
    last = before[-1]
    return replace(
        file_round,
        name=name,
        zero_group=last.zero_group + file_round.chains_rezeroed,
        sheet_group=last.sheet_group + file_round.new_sheet,
    )


def _made(mark: Mark, file_round: Round) -> MadeBy:
    """Return everything that must be equal for two readings with the same name to be repeats."""
    made = (mark.target, mark.sled_weight, mark.chains, mark.approach)
    return (*made, file_round.cut_with, file_round.zero_group, file_round.sheet_group)


def _renamed(part: Measurements, prefix: str) -> Measurements:
    return replace(
        part,
        marks=tuple(replace(mark, name=prefix + mark.name) for mark in part.marks),
        distances=tuple(
            replace(distance, between=(prefix + distance.between[0], prefix + distance.between[1]))
            for distance in part.distances
        ),
    )


def _agreed(values: list[tuple[Measurements, Value | None]], key: str) -> Value | None:
    """Return the value of all files that give it."""
    said = [(part, value) for part, value in values if value is not None]
    for part, value in said[1:]:
        if value != said[0][1]:
            raise InputError(
                part.source,
                f"{key} is {value} here and {said[0][1]} in {said[0][0].source}",
                remedy="make them equal, or use each file alone",
            )
    return said[0][1] if said else None


def _shared_weight(parts: tuple[Measurements, ...]) -> float | None:
    """Return the sled weight [N] of the files if they all share it; each mark carries its
    weight.
    """
    weights = {part.sled_weight for part in parts}
    return weights.pop() if len(weights) == 1 else None


def without_marks(measurements: Measurements, names: Iterable[str]) -> Measurements:
    """Return the measurements without the readings of some marks, and without distances from or to
    them.

    Raises InputError for a name that is not there.
    """
    gone = tuple(names)
    known = [mark.name for mark in measurements.marks]
    try:
        refuse_unknown(gone, known)
    except ValueError as error:
        raise InputError(to_do("--without", page="left out:") + f" {error}") from None
    return replace(
        measurements,
        marks=tuple(mark for mark in measurements.marks if mark.name not in gone),
        distances=tuple(
            distance for distance in measurements.distances if not {*distance.between} & {*gone}
        ),
    )
