"""The measured board of a diagnosis: readings as numbers with weights, every effect an unknown."""

from __future__ import annotations

from plumb.board.observations import Observations, different_numbers
from plumb.diagnosis.explanation import Board
from plumb.fit.inputs import Inputs
from plumb.fit.problem import USUAL_SIGMA
from plumb.marks.read import Measurements
from plumb.text.errors import InputError

FEWEST_NUMBERS = 6  # three marks: below that the frame explains everything


def measured_board(inputs: Inputs) -> Board:
    """The board of these inputs; raises InputError for too few marks, and for bad targets."""
    model, rows = inputs.model_and_observations()
    _refuse_too_few(inputs.measurements, rows)
    sigma = inputs.stated.sigma if inputs.stated else USUAL_SIGMA
    return Board.of(model, rows, sigma=sigma, priors=inputs.priors, checked=inputs.checked)


def _refuse_too_few(measurements: Measurements, rows: Observations) -> None:
    count = different_numbers(measurements, rows)
    if count < FEWEST_NUMBERS:
        raise InputError(
            f"{measurements.source}: {count} measured numbers are too few for a diagnosis; measure "
            "at least three marks, better nine or more all over the sheet"
        )
