"""The noise of the readings to which effects are fitted, by the rule of the diagnosis."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from plumb.board.observations import Observations
from plumb.diagnosis.explanation import Board
from plumb.diagnosis.noise_sources import known_noise, repeats_of
from plumb.diagnosis.slip_cause import described
from plumb.diagnosis.slips_in_repeats import clear_repeats
from plumb.fit.inputs import Inputs
from plumb.fit.problem import USUAL_SIGMA
from plumb.settings.machine import MachineSettings


@dataclass(frozen=True)
class FitNoise:
    """How good a reading is, as far as it is known before the fit."""

    sigma: float | None  # [mm] None: from what the fit leaves
    degrees: float  # of freedom with which sigma is known
    source: str  # of noise_sources.py, or "residuals"
    said: tuple[str, ...]  # a sentence for each thing that does not go together


def noise_of(inputs: Inputs, model: MachineSettings, rows: Observations) -> FitNoise:
    """What is known of the noise; readings that disagree with their repeats do not count."""
    stated = inputs.stated
    board = Board.of(model, rows, sigma=stated.sigma if stated else USUAL_SIGMA)
    cleared = clear_repeats(board, stated)
    said = tuple(
        described(shift, inputs.measurements, inputs.settings.sheet).sentence
        for shift in cleared.slips
    )
    noise = known_noise(repeats_of(cleared.rows), stated)
    if noise is None:
        return FitNoise(None, np.inf, "residuals", said)
    return FitNoise(noise.sigma, noise.degrees, noise.source, (*said, *noise.notes))
