"""Contents of docs/real-data.md: the published sets of real machines in tools/plumb/examples."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations
from pathlib import Path

import numpy as np
from plumb.cure.add import Addition, add
from plumb.cure.decision import Decision, decide
from plumb.diagnosis.diagnosis import left_out, left_out_refitted
from plumb.fit.compare import Comparison, compare
from plumb.fit.inputs import Inputs, read_inputs
from plumb.fit.observations import rms
from plumb.settings import MachineSettings
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
    inputs: Inputs

    @cached_property
    def raw(self) -> Comparison:
        """Against the settings as they stand."""
        return compare(self.inputs)

    @cached_property
    def decision(self) -> Decision:
        """What `plumb add --effect auto` does, and what `plumb diagnose` says."""
        return decide(self.inputs)

    @property
    def written(self) -> str:
        """The effects that are written."""
        if self.decision.addition is None:
            return "nothing"
        return ", ".join(self.decision.chosen) or "the frame"

    @property
    def left_out(self) -> float:
        """Error [mm] of readings left out by what is written; as set where nothing is."""
        addition = self.decision.addition
        return addition.after.left_out_rms if addition else self.raw.rms

    @cached_property
    def forced(self) -> tuple[float, Sequence[str]]:
        """Least error [mm] of readings left out, and the set of effects that has it."""
        readings = self.decision.diagnosis.readings
        frame, felt = readings.frame, readings.posterior.felt
        every = [few for size in range(MOST_FORCED + 1) for few in combinations(felt, size)]
        best = sorted(every, key=lambda few: left_out(frame, few))[:REFITTED]
        return min((left_out_refitted(frame, few), few) for few in best)

    @cached_property
    def pitched(self) -> Addition:
        """Frame and chain pitch fitted."""
        return add(self.inputs, effects=("chain_pitch",))

    @property
    def nominal_rms(self) -> float:
        """RMS [mm] of measured less nominal distances: what the settings in force left."""
        measured = self.inputs.measurements
        nominal = np.linalg.norm(np.diff(measured.distance_targets, axis=1)[:, 0], axis=1)
        return rms(measured.distance_lengths - nominal)


def real_set(
    name: str, *marks: str | Path, settings: str = "groundcontrol.ini", folder: Path = EXAMPLES
) -> RealSet:
    """Return a set by its folder, of examples/ unless it is said otherwise."""
    files = [folder / name / each for each in marks or ("marks.toml",)]
    return RealSet(name, read_inputs(folder / name / settings, files))


def other_boards() -> list[RealSet]:
    """Return the sets of marks whose places were read."""
    return [
        real_set("mibproj", "Calibration Measurements.ini"),
        real_set("c0depr1sm-2019-01-03", "marks.csv", settings="machine.toml"),
    ]


def pooled() -> RealSet:
    """Return all hole sets as one board of a single machine."""
    return real_set(HOLES[0], *(EXAMPLES / name / "marks.toml" for name in HOLES))


def errors_by_set(together: RealSet) -> dict[str, float]:
    """Return the error [mm RMS] of the distances of each hole set in a fit of all."""
    errors, sets = together.pitched.after_fit.distance_errors, together.inputs.measurements
    of = np.array([distance.round for distance in sets.distances])
    return {name: rms(errors[of == i]) for i, name in enumerate(HOLES)}


def predicted(settings: MachineSettings, other: RealSet) -> Comparison:
    """Return how well a machine predicts a set that took no part in its fit."""
    return compare(Inputs(settings, other.inputs.measurements))


def pages() -> dict[str, str]:
    """Return the page by its name below the project's root."""
    holes = {name: real_set(name) for name in HOLES}
    boards = other_boards()
    together, cuts = pooled(), real_set(CUTS)
    text = filled(
        "real-data.md",
        sets=[*holes.values(), *boards],
        left_out=left_out,
        every=[*holes.values(), *boards, real_set("real-25", folder=BOARDS)],
        pairs=[(holes[before], holes[after]) for before, after in PAIRS],
        together=together.pitched,
        by_set=errors_by_set(together),
        in_force=cuts.raw.distances,
        foretold=predicted(together.pitched.settings, cuts).distances,
        predicted=predicted,
    )
    return {PAGE: text}
