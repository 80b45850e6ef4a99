"""Several files of marks as one board: what is a repeat, what is another mark, what contradicts."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

from plumb.marks.model import Mark, Measurements, Round
from plumb.text.errors import refusal

FEWEST_COPIED = 5  # readings that agree to the last digit before a file passes for a copy


def join_measurements(parts: Iterable[Measurements]) -> Measurements:
    """Several files as one board, in the order in which they were cut.

    A name with the same target, made in the same way, is a repeat. Otherwise it is a new mark, and
    all names of its file get the file's name in front.
    """
    several = tuple(parts)
    if len(several) == 1:
        return several[0]
    labels = _labels(several)
    rounds: list[Round] = []
    known: dict[str, list[tuple]] = {}
    joined: list[Measurements] = []
    for number, part in enumerate(several):
        rounds.append(_next_round(part, labels[number], rounds))
        _refuse_a_copy(part, several[:number])
        own = replace(part, marks=tuple(replace(mark, round=number) for mark in part.marks))
        made = [(mark.name, _made(mark, rounds[number])) for mark in own.marks]
        clash = any(how not in known.get(name, [how]) for name, how in made)
        joined.append(_renamed(own, f"{labels[number]}:") if clash else own)
        for mark, (_, how) in zip(joined[-1].marks, made, strict=True):
            known.setdefault(mark.name, []).append(how)
    return Measurements(
        marks=tuple(mark for part in joined for mark in part.marks),
        distances=tuple(one for part in joined for one in part.distances),
        controller=_agreed(several, "controller", "controller"),
        tape_sigma=_agreed(several, "tape_sigma", "tape_sigma_mm"),
        sled_weight=_one_weight(several),
        source=" + ".join(part.source for part in several),
        rounds=tuple(rounds),
    )


def _refuse_a_copy(part: Measurements, before: tuple[Measurements, ...]) -> None:
    """Refuse a file that only repeats another one's numbers: it would pass for no noise at all."""
    for other in before:
        same = _readings(part).items() & _readings(other).items()
        common = _readings(part).keys() & _readings(other).keys()
        if len(same) == len(common) >= FEWEST_COPIED:
            raise refusal(
                part.source,
                f"its {len(same)} readings are those of {other.source} to the last digit",
                remedy="a copy is no repeat: leave one of the files out",
            )


def _readings(part: Measurements) -> dict[tuple, tuple]:
    """What was read, by targets and sled weight: the first reading of each."""
    found: dict[tuple, tuple] = {}
    for mark in part.measured_marks:
        read = tuple(round(one, 6) for one in mark.measured)
        found.setdefault((_rounded(mark.target), mark.sled_weight), read)
    for one in part.distances:
        ends = frozenset(_rounded(part.target_of(name)) for name in one.between)
        found.setdefault((ends, part.sled_weight), (one.length,))
    return found


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
    """The round of a file after others; refuses one whose frame is another."""
    own = part.rounds[0]
    if not before:
        return replace(own, name=name)
    if own.frame_moved:
        raise refusal(
            part.source,
            "frame_moved is true, so it cannot share a frame with the files before it",
            remedy="use it in a command of its own",
        )
    last = before[-1]
    return replace(
        own,
        name=name,
        zero_group=last.zero_group + own.chains_rezeroed,
        sheet_group=last.sheet_group + own.new_sheet,
    )


def _made(mark: Mark, own: Round) -> tuple:
    """Everything that must be equal for two readings of one name to be repeats."""
    cut = (own.cut_with, own.zero_group, own.sheet_group)
    return (mark.target, mark.sled_weight, mark.chains, mark.approach, *cut)


def _renamed(part: Measurements, prefix: str) -> Measurements:
    return replace(
        part,
        marks=tuple(replace(mark, name=prefix + mark.name) for mark in part.marks),
        distances=tuple(
            replace(one, between=(prefix + one.between[0], prefix + one.between[1]))
            for one in part.distances
        ),
    )


def _agreed(parts: tuple[Measurements, ...], name: str, key: str) -> str | float | None:
    """What all files that say anything about it say."""
    said = [(part, getattr(part, name)) for part in parts if getattr(part, name) is not None]
    for part, value in said[1:]:
        if value != said[0][1]:
            raise refusal(
                part.source,
                f"{key} is {value} here and {said[0][1]} in {said[0][0].source}",
                remedy="make them equal, or use the files one at a time",
            )
    return said[0][1] if said else None


def _one_weight(parts: tuple[Measurements, ...]) -> float | None:
    """The sled weight [N] of the files if they all share it; each mark carries its own."""
    weights = {part.sled_weight for part in parts}
    return weights.pop() if len(weights) == 1 else None
