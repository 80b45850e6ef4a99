"""Several files of marks become a board: repeats, other marks, and what contradicts."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path
from typing import TypeVar

from plumb.marks.model import Mark, Measurements, Point, Round, Typed
from plumb.settings.machine import MachineSettings
from plumb.text.errors import refusal

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
    """A file whose marks and distances belong to the round with this number."""
    return replace(
        part,
        marks=tuple(replace(mark, round=number) for mark in part.marks),
        distances=tuple(replace(distance, round=number) for distance in part.distances),
    )


def _typed(parts: tuple[Measurements, ...]) -> Typed:
    """How the places were typed, if it was alike in all files."""
    first, *others = [part.typed for part in parts]
    return first if all(other == first for other in others) else Typed()


def _refuse_a_copy(part: Measurements, before: tuple[Measurements, ...]) -> None:
    """Refuse a file with the numbers of another: the board would seem to have no noise."""
    for other in before:
        same = _readings(part).items() & _readings(other).items()
        common = _readings(part).keys() & _readings(other).keys()
        if len(same) == len(common) >= FEWEST_COPIED:
            raise refusal(
                part.source,
                f"its {len(same)} readings are those of {other.source} to the last digit",
                remedy="a copy is no repeat: leave the copy out",
            )


def _readings(part: Measurements) -> dict[ReadingKey, tuple[float, ...]]:
    """What was read, by targets and sled weight: the first reading of each."""
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
    """A short name of each file, no two alike."""
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
    """The round of a file after others; refuses a file whose frame moved."""
    file_round = part.rounds[0]
    if not before:
        return replace(file_round, name=name)
    if file_round.frame_moved:
        raise refusal(
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
    """Everything that must be equal for two readings with the same name to be repeats."""
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
    """The value of all files that give it."""
    said = [(part, value) for part, value in values if value is not None]
    for part, value in said[1:]:
        if value != said[0][1]:
            raise refusal(
                part.source,
                f"{key} is {value} here and {said[0][1]} in {said[0][0].source}",
                remedy="make them equal, or use each file alone",
            )
    return said[0][1] if said else None


def _shared_weight(parts: tuple[Measurements, ...]) -> float | None:
    """The sled weight [N] of the files if they all share it; each mark carries its weight."""
    weights = {part.sled_weight for part in parts}
    return weights.pop() if len(weights) == 1 else None
