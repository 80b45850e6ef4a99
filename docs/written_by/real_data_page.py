"""Contents of docs/real-data.md: the published sets of real machines in tools/plumb/examples."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations
from pathlib import Path

import numpy as np
from plumb.cure.add import Addition, Parameter, add
from plumb.cure.decision import Decision, decide
from plumb.diagnosis import Diagnosis, diagnose
from plumb.diagnosis.nearest import left_out, left_out_refitted
from plumb.fit.compare import Comparison, compare
from plumb.fit.inputs import Inputs
from plumb.fit.observations import rms
from plumb.marks.read import Measurements, join_measurements, read_marks
from plumb.model.predict import known_effects
from plumb.settings.files import read_settings
from plumb.settings.machine import MachineSettings
from template import filled

PAGE = "docs/real-data.md"
TOOLS = Path(__file__).resolve().parents[2] / "tools"
EXAMPLES = TOOLS / "plumb/examples"
BOARDS = TOOLS / "tests/data/boards"
HOLES = (
    "madgrizzle-2018-08-30",
    "madgrizzle-2018-09-01",
    "madgrizzle-2018-09-02",
    "madgrizzle-2018-09-04",
)
CUTS = "madgrizzle-2018-08-27"
PAIRS = ((HOLES[0], HOLES[1]), (HOLES[2], HOLES[3]))  # before and after a fit of the owner
MOST_FORCED = 3  # effects of a set that is tried by force
REFITTED = 25  # of these sets, the best by the slopes at the frame's fit


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
        """What `plumb diagnose` says."""
        return diagnose(Inputs(self.settings, self.marks))

    @cached_property
    def decision(self) -> Decision:
        """What `plumb add --effect auto` does."""
        return decide(Inputs(self.settings, self.marks), diagnosis=self.diagnosis)

    @property
    def written(self) -> str:
        """The effects that are written."""
        decision = self.decision
        if decision.addition is None:
            return "nothing"
        return ", ".join(decision.chosen) or "the frame"

    @property
    def left_out(self) -> float:
        """Error [mm] of readings left out by what is written; as set where nothing is."""
        addition = self.decision.addition
        return addition.after.left_out_rms if addition else self.raw.rms

    @cached_property
    def forced(self) -> tuple[float, Sequence[str]]:
        """Least error [mm] of readings left out, and the set of effects that has it."""
        readings = self.diagnosis.readings
        frame, felt = readings.frame, readings.posterior.felt
        every = [few for size in range(MOST_FORCED + 1) for few in combinations(felt, size)]
        best = sorted(every, key=lambda few: left_out(frame, few))[:REFITTED]
        return min((left_out_refitted(frame, few), few) for few in best)

    @cached_property
    def pitched(self) -> Addition:
        """Frame and chain pitch fitted."""
        return _with_pitch(self.settings, self.marks)

    @property
    def nominal_rms(self) -> float:
        """RMS [mm] of measured less nominal distances: what the settings in force left."""
        ends = self.marks.distance_targets
        nominal = np.linalg.norm(np.diff(ends, axis=1)[:, 0], axis=1)
        return rms(self.marks.distance_lengths - nominal)


@dataclass(frozen=True)
class Pooled:
    """All hole sets fitted together: a single machine, the settings of each set in force."""

    fitted: Addition
    errors: Mapping[str, np.ndarray]  # errors [mm] of each set's distances


def real_set(
    name: str,
    marks: str = "marks.toml",
    settings: str = "groundcontrol.ini",
    *,
    folder: Path = EXAMPLES,
) -> RealSet:
    """Return a set by its folder, of examples/ unless it is said otherwise."""
    known = known_effects()
    machine = read_settings(folder / name / settings, known=known)
    marks_path = folder / name / marks
    return RealSet(name, machine, read_marks(marks_path, sheet=machine.sheet, known=known))


def other_boards() -> list[RealSet]:
    """Return the sets of marks whose places were read."""
    return [
        real_set("mibproj", "Calibration Measurements.ini"),
        real_set("c0depr1sm-2019-01-03", "marks.csv", "machine.toml"),
    ]


def pooled(sets: Sequence[RealSet]) -> Pooled:
    """Fit several hole sets at once."""
    marks = join_measurements([holes.marks for holes in sets])
    fitted = _with_pitch(sets[0].settings, marks)
    ends = np.cumsum([len(holes.marks.distances) for holes in sets])[:-1]
    several = np.split(fitted.after_fit.distance_errors, ends)
    return Pooled(fitted, {holes.name: part for holes, part in zip(sets, several, strict=True)})


def predicted(settings: MachineSettings, other: RealSet) -> Comparison:
    """Return how well a machine predicts a set that took no part in its fit."""
    return compare(Inputs(settings, other.marks))


def pages() -> dict[str, str]:
    """Return the page by its name below the project's root."""
    holes = {name: real_set(name) for name in HOLES}
    boards = other_boards()
    together = pooled(list(holes.values()))
    cuts = real_set(CUTS)
    text = filled(
        "real-data.md",
        sets=[*holes.values(), *boards],
        left_out=left_out,
        every=[*holes.values(), *boards, real_set("real-25", folder=BOARDS)],
        pairs=[(holes[before], holes[after]) for before, after in PAIRS],
        together=together,
        in_force=cuts.raw.distances,
        foretold=predicted(together.fitted.settings, cuts).distances,
        pitch=_pitch,
        predicted=predicted,
        rms=rms,
        mm=lambda value: f"{value + 0.0:.2f}",
        percent=lambda strain: f"{100 * strain + 0.0:.2f}",
    )
    return {PAGE: text}


def _with_pitch(settings: MachineSettings, marks: Measurements) -> Addition:
    return add(Inputs(settings, marks), effects=("chain_pitch",))


def _pitch(fitted: Addition) -> list[Parameter]:
    """Return how long both chains are by a fit."""
    return [each for each in fitted.parameters if each.name.startswith("chain_pitch.")]
