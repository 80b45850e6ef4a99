"""What is left at the sled all over the sheet: by settings, and at best, the truth being known."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from plumb.bench import judge
from plumb.bench.causes import SLED
from plumb.bench.judged_board import sheet
from plumb.cure.add import Addition, add
from plumb.fit.compare import best_pose
from plumb.fit.fit import rms
from plumb.fit.inputs import Inputs
from plumb.model.predict import FOUND, lengths
from plumb.settings.machine import MachineSettings
from plumb.vm.garage import Garage


@dataclass(frozen=True)
class SledError:
    """RMS [mm] of the sled's error all over the sheet, the sheet laid at its best."""

    before: float  # by the settings as they were
    frame: float  # by a fit of the frame alone
    after: float  # by the settings that were chosen
    known: float  # by a fit with what is hidden


def sled_error(garage: Garage, settings: MachineSettings) -> float:
    """The error of a garage's machine with these settings. Nothing rubs: no setting knows of it."""
    wanted = sheet()
    chains, outcome = lengths(settings, wanted)
    if not (outcome == FOUND).all():
        return float("inf")
    weights = np.full(len(wanted), garage.numbers.get("sled_weight", SLED))
    still = np.zeros_like(wanted)
    places = judge.places(garage.numbers, chains, pushes=still, weights=weights)
    pose = best_pose(wanted, garage.read(places))
    return rms(pose.errors) if pose else 0.0


def with_truth(inputs: Inputs, garage: Garage) -> Addition:
    """The fit of somebody who knows what is hidden."""
    return add(inputs, effects=garage.hidden.effects)


def sled_errors(inputs: Inputs, garage: Garage, settings: MachineSettings) -> SledError:
    """What settings are worth, against what the same marks allow."""
    frame, known = add(inputs, effects=()).settings, with_truth(inputs, garage).settings
    each = (inputs.settings, frame, settings, known)
    return SledError(*(sled_error(garage, machine) for machine in each))
