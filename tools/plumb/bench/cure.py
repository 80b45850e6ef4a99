"""What a diagnosis is worth at the sled: the shape error over the whole sheet before and after."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from plumb.bench.boards import TrueMachine
from plumb.bench.causes import HALF
from plumb.fit.fit import fit, rms
from plumb.fit.inputs import Inputs
from plumb.fit.shape import best_pose
from plumb.model.predict import FOUND, lengths
from plumb.settings.machine import MachineSettings

COLUMNS, ROWS = 15, 9  # places of the sheet at which the sled is asked for
MARGIN = 50.0  # [mm] of the sheet's edge that is left out


@dataclass(frozen=True)
class Cure:
    """RMS shape errors [mm] of the judge's sled over the whole sheet."""

    before: float  # by the maker's settings
    frame: float  # by a fit of the frame alone
    after: float  # by a fit with what was named
    known: float  # by a fit with what was hidden


def sheet() -> np.ndarray:
    """Places (n, 2) [mm] all over the sheet."""
    across = np.linspace(-HALF[0] + MARGIN, HALF[0] - MARGIN, COLUMNS)
    up = np.linspace(-HALF[1] + MARGIN, HALF[1] - MARGIN, ROWS)
    return np.array([(x, y) for y in up for x in across])


def shape_error(machine: TrueMachine, settings: MachineSettings) -> float:
    """RMS [mm] of how far the judge's sled, sent by these settings to places all over the sheet,
    is from them once the sheet is laid at its best. Nothing rubs: no setting knows of friction."""
    wanted = sheet()
    chains, outcome = lengths(settings, wanted)
    if not (outcome == FOUND).all():
        return float("inf")
    pose = best_pose(wanted, machine.sleds(chains))
    return rms(pose.errors) if pose else 0.0


def refitted(inputs: Inputs, effects: Sequence[str], sigma: float) -> MachineSettings:
    """The settings with the frame and these effects fitted, as `plumb add` does it."""
    model, rows = inputs.model_and_observations()
    return fit(model, rows, effects=effects, sigma=sigma, checked=inputs.checked).settings


def cure_of(machine: TrueMachine, inputs: Inputs, effects: Sequence[str], *, sigma: float) -> Cure:
    """What naming these effects is worth on a board; sigma [mm] as the diagnosis took it."""
    truth = machine.hidden.effects
    fits = {
        named: shape_error(machine, refitted(inputs, named, sigma))
        for named in {(), tuple(effects), truth}
    }
    before = shape_error(machine, inputs.settings)
    return Cure(before, fits[()], fits[tuple(effects)], fits[truth])
