"""The published sets of real machines in examples/, and what the lab finds in each."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from plumb.cure.add import Addition, add
from plumb.diagnose import Diagnosis, diagnose
from plumb.fit.compare import Comparison, compare
from plumb.fit.fit import rms
from plumb.fit.inputs import Inputs
from plumb.marks.read import Measurements, join_measurements, read_marks
from plumb.model.predict import FOUND, believed_lengths, known_effects, places
from plumb.settings.files import read_settings
from plumb.settings.machine import MachineSettings
from plumb.text.errors import InputError

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"
HOLES = (
    "madgrizzle-2018-08-30",
    "madgrizzle-2018-09-01",
    "madgrizzle-2018-09-02",
    "madgrizzle-2018-09-04",
)
CUTS = "madgrizzle-2018-08-27"
PAIRS = ((HOLES[0], HOLES[1]), (HOLES[2], HOLES[3]))  # before and after a fit of the owner
BRACKETS = ("gero-2017-04-26", "blsteinhauer88-2017-06-18")
HOLE_EFFECTS = ("chain_pitch",)


@dataclass(frozen=True)
class RealSet:
    """One published set: settings said to be in force, and marks."""

    name: str
    settings: MachineSettings
    marks: Measurements

    @property
    def raw(self) -> Comparison:
        """Against the settings as they stand."""
        return compare(self.settings, self.marks)

    def diagnosed(self, **how: float) -> Diagnosis:
        """What `plumb diagnose` says."""
        return diagnose(Inputs(self.settings, self.marks, **how))

    def with_effects(self, *effects: str) -> Addition:
        """What `plumb add` makes of it."""
        return add(Inputs(self.settings, self.marks), effects=effects)


@dataclass(frozen=True)
class Pooled:
    """All hole sets fitted together: one machine, the settings of each set in force."""

    fitted: Addition
    own: Mapping[str, np.ndarray]  # errors [mm] of each set's distances
    scatter: float  # [mm] of one distance from set to set
    scatter_degrees: int
    steady: float  # [mm] RMS of what is the same in all sets

    @property
    def settings(self) -> MachineSettings:
        """The one machine."""
        return self.fitted.settings


def real_set(name: str, marks: str = "marks.toml", settings: str = "groundcontrol.ini") -> RealSet:
    """One set of examples/ by its folder."""
    folder, known = EXAMPLES / name, known_effects()
    machine = read_settings(folder / settings, known=known)
    return RealSet(name, machine, read_marks(folder / marks, sheet=machine.sheet, known=known))


def refusal_of(name: str) -> str:
    """What the lab says of a set's own groundcontrol.ini; empty if it takes it."""
    path = EXAMPLES / name / "groundcontrol.ini"
    try:
        read_settings(path, known=known_effects())
    except InputError as error:
        return str(error).replace(str(path), f"{name}/groundcontrol.ini")
    return ""


def pooled(sets: Sequence[RealSet], effects: Sequence[str] = HOLE_EFFECTS) -> Pooled:
    """Fit several hole sets at once."""
    marks = join_measurements([one.marks for one in sets])
    fitted = add(Inputs(sets[0].settings, marks), effects=effects)
    own, first = {}, 0
    for one in sets:
        count = len(one.marks.distances)
        own[one.name] = fitted.after_fit.distance_errors[first : first + count]
        first += count
    groups = list(_by_span(sets, own).values())
    squares = sum(float(np.sum((each - each.mean()) ** 2)) for each in groups)
    degrees = sum(len(each) - 1 for each in groups)
    return Pooled(
        fitted=fitted,
        own=own,
        scatter=float(np.sqrt(squares / degrees)),
        scatter_degrees=degrees,
        steady=rms(np.array([each.mean() for each in groups])),
    )


def predicted(settings: MachineSettings, other: RealSet) -> Comparison:
    """How well one machine predicts a set that took no part in its fit."""
    return compare(settings, other.marks)


def mirrored(one: RealSet, across: float, up: float) -> RealSet:
    """The set with its holes named the other way round: across or up is -1."""
    marks = tuple(
        replace(mark, target=(across * mark.target[0], up * mark.target[1]))
        for mark in one.marks.marks
    )
    return replace(one, marks=replace(one.marks, marks=marks))


def middle_shift(machine: MachineSettings) -> float:
    """How far right [mm] of the middle the bit goes if the controller knows no chain pitch."""
    effects = {name: own for name, own in machine.effects.items() if name != "chain_pitch"}
    chains = believed_lengths(replace(machine, effects=effects), np.zeros((1, 2)))
    where, found = places(machine, chains)
    if found[0] != FOUND:
        raise InputError("the sled cannot hang in the middle of the sheet")
    return float(where[0, 0])


def _by_span(sets: Sequence[RealSet], own: Mapping[str, np.ndarray]) -> dict[frozenset, np.ndarray]:
    """Errors of each distance that several sets have, one for each set [mm]."""
    groups: dict[frozenset, list[float]] = {}
    for one in sets:
        for span, error in zip(one.marks.distances, own[one.name], strict=True):
            groups.setdefault(frozenset(span.between), []).append(float(error))
    return {ends: np.array(errors) for ends, errors in groups.items() if len(errors) > 1}
