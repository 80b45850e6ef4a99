"""The published sets of real machines in examples/, and what the lab finds in each."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np
from plumb.cure.add import Addition, add
from plumb.diagnosis import Diagnosis, diagnose
from plumb.diagnosis.sizes import Room
from plumb.fit.compare import Comparison, compare
from plumb.fit.inputs import Inputs
from plumb.fit.observations import rms
from plumb.marks.read import Measurements, join_measurements, read_marks
from plumb.model.predict import believed_lengths, known_effects, places
from plumb.settings.files import read_settings
from plumb.settings.machine import MachineSettings
from plumb.text.errors import InputError

EXAMPLES = Path(__file__).resolve().parents[2] / "tools/plumb/examples"
HOLES = (
    "madgrizzle-2018-08-30",
    "madgrizzle-2018-09-01",
    "madgrizzle-2018-09-02",
    "madgrizzle-2018-09-04",
)
CUTS = "madgrizzle-2018-08-27"
PAIRS = ((HOLES[0], HOLES[1]), (HOLES[2], HOLES[3]))  # before and after a fit of the owner
NINE = "mibproj"
BRACKETS = ("gero-2017-04-26", "blsteinhauer88-2017-06-18")
HOLE_EFFECTS = ("chain_pitch",)


@dataclass(frozen=True)
class RealSet:
    """A published set: settings said to be in force, and marks."""

    name: str
    settings: MachineSettings
    marks: Measurements

    @cached_property
    def raw(self) -> Comparison:
        """Against the settings as they stand."""
        return compare(Inputs(self.settings, self.marks))

    @cached_property
    def diagnosis(self) -> Diagnosis:
        """Answer of `plumb diagnose`."""
        return self.diagnosed()

    @cached_property
    def pitched(self) -> Addition:
        """Frame and chain pitch fitted."""
        return self.with_effects(*HOLE_EFFECTS)

    @property
    def nominal_rms(self) -> float:
        """RMS [mm] of measured less nominal distances: what the settings in force left."""
        ends = self.marks.distance_targets
        nominal = np.linalg.norm(np.diff(ends, axis=1)[:, 0], axis=1)
        return rms(self.marks.distance_lengths - nominal)

    def could_hide(self, effect: str) -> Room:
        """Return how much of an effect the marks leave room for."""
        return next(each for each in self.diagnosis.could_hide if each.effect == effect)

    def diagnosed(self, *, sigma: float | None = None) -> Diagnosis:
        """Return what `plumb diagnose` says; sigma is the reading error [mm]."""
        return diagnose(Inputs(self.settings, self.marks, sigma=sigma))

    def with_effects(self, *effects: str) -> Addition:
        """Return what `plumb add` makes of it."""
        return add(Inputs(self.settings, self.marks), effects=effects)


@dataclass(frozen=True)
class Pooled:
    """All hole sets fitted together: a single machine, the settings of each set in force."""

    fitted: Addition
    errors: Mapping[str, np.ndarray]  # errors [mm] of each set's distances
    scatter: float  # [mm] of a distance from set to set
    scatter_degrees: int
    steady: float  # [mm] RMS of what is the same in all sets


def real_set(name: str, marks: str = "marks.toml", settings: str = "groundcontrol.ini") -> RealSet:
    """Return a set of examples/ by its folder."""
    folder, known = EXAMPLES / name, known_effects()
    machine = read_settings(folder / settings, known=known)
    return RealSet(name, machine, read_marks(folder / marks, sheet=machine.sheet, known=known))


def refusal_of(name: str) -> str:
    """Return what the lab says of the groundcontrol.ini of a set; empty if it takes it."""
    path = EXAMPLES / name / "groundcontrol.ini"
    try:
        read_settings(path, known=known_effects())
    except InputError as error:
        return str(error).replace(str(path), f"{name}/groundcontrol.ini")
    return ""


def pooled(sets: Sequence[RealSet], effects: Sequence[str] = HOLE_EFFECTS) -> Pooled:
    """Fit several hole sets at once."""
    marks = join_measurements([holes.marks for holes in sets])
    fitted = add(Inputs(sets[0].settings, marks), effects=effects)
    ends = np.cumsum([len(holes.marks.distances) for holes in sets])[:-1]
    several = np.split(fitted.after_fit.distance_errors, ends)
    errors = {holes.name: part for holes, part in zip(sets, several, strict=True)}
    groups = list(_by_span(sets, errors).values())
    squares = sum(float(np.sum((repeats - repeats.mean()) ** 2)) for repeats in groups)
    degrees = sum(len(repeats) - 1 for repeats in groups)
    return Pooled(
        fitted=fitted,
        errors=errors,
        scatter=float(np.sqrt(squares / degrees)),
        scatter_degrees=degrees,
        steady=rms(np.array([repeats.mean() for repeats in groups])),
    )


def predicted(settings: MachineSettings, other: RealSet) -> Comparison:
    """Return how well a machine predicts a set that took no part in its fit."""
    return compare(Inputs(settings, other.marks))


def mirrored(holes: RealSet, across: float, up: float) -> RealSet:
    """Return the set with its holes named the other way round: across or up is -1."""
    marks = tuple(
        replace(mark, target=(across * mark.target[0], up * mark.target[1]))
        for mark in holes.marks.marks
    )
    return replace(holes, marks=replace(holes.marks, marks=marks))


def middle_shift(machine: MachineSettings) -> float:
    """Return how far right [mm] of the middle the bit goes if the controller knows no chain
    pitch.
    """
    effects = {
        name: parameters for name, parameters in machine.effects.items() if name != "chain_pitch"
    }
    chains = believed_lengths(replace(machine, effects=effects), np.zeros((1, 2)))
    where, _ = places(machine, chains)
    return float(where[0, 0])


def _by_span(
    sets: Sequence[RealSet], errors_of: Mapping[str, np.ndarray]
) -> dict[frozenset[str], np.ndarray]:
    """Errors of each distance that several sets have [mm], in the order of the sets."""
    groups: dict[frozenset[str], list[float]] = {}
    for holes in sets:
        for span, error in zip(holes.marks.distances, errors_of[holes.name], strict=True):
            groups.setdefault(frozenset(span.between), []).append(float(error))
    return {ends: np.array(errors) for ends, errors in groups.items() if len(errors) > 1}


def with_y_errors_flipped(measurements: Measurements) -> Measurements:
    """Return the same marks, each as far below its target as it was above it."""
    flipped = []
    for mark in measurements.marks:
        x, y = mark.measured or mark.target
        measured = (x, 2 * mark.target[1] - y) if mark.measured else None
        flipped.append(replace(mark, measured=measured))
    return replace(measurements, marks=tuple(flipped))
