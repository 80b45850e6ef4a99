"""What settings leave at the sled all over the sheet."""

from __future__ import annotations

import numpy as np

from plumb.bench import judge
from plumb.bench.causes import SLED
from plumb.bench.judged_board import sheet
from plumb.fit.compare import best_pose
from plumb.fit.fit import rms
from plumb.model.predict import FOUND, lengths
from plumb.settings.machine import MachineSettings
from plumb.vm.garage import Garage


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
