"""Readings to look at again while the others are still being typed.

A reading too far from its target for any machine is named at once. The others are weighed as a
diagnosis weighs them, however few they are: what is known of frames, effects and slips before any
mark says how far a reading may be off, and each further reading narrows it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from plumb.board.observations import model_and_observations
from plumb.diagnosis.clean import clean_readings, felt_effects
from plumb.diagnosis.explanation import Board, explain
from plumb.diagnosis.noise_sources import noise_on
from plumb.diagnosis.readings import Reading, readings_of
from plumb.diagnosis.slip_cause import Slip, described
from plumb.diagnosis.slips import SURE, shifts
from plumb.diagnosis.weighing import weigh
from plumb.fit.inputs import Inputs
from plumb.fit.problem import USUAL_SIGMA
from plumb.marks.plausible import far_reading
from plumb.marks.read import Measurements
from plumb.model.ranks import greatest
from plumb.text.shown import worded

FEWEST = 4  # marks and distances from which slips are sought as in a diagnosis


@dataclass(frozen=True)
class Doubted:
    """A reading to look at again, by its index among the marks or the distances."""

    index: int
    is_mark: bool
    off: float  # [mm]
    sentence: str
    corrected: tuple[float, ...] | None  # [mm] the reading that was meant, if that is likely


def doubted_readings(inputs: Inputs) -> tuple[Doubted, ...]:
    """The readings so far that no machine explains. Raises InputError for a bad target."""
    far = _far_readings(inputs)
    near = _without(inputs.measurements, {doubt.index for doubt in far})
    if not near.measured_marks and not near.distances:
        return far
    slips = _slips(replace(inputs, measurements=near))
    return (*far, *(_doubted(slip, inputs.measurements) for slip in slips))


def _far_readings(inputs: Inputs) -> tuple[Doubted, ...]:
    measurements = inputs.measurements
    sheet = (measurements.rounds[0].cut_with or inputs.cut_with or inputs.settings).sheet
    doubts = []
    for index, mark in enumerate(measurements.marks):
        far = far_reading(measurements, mark, sheet)
        if far:
            cause = f"; {far.mistake}" if far.mistake else ""
            said = f"it reads {worded(far.error, 0)} from where the mark was sent{cause}"
            doubts.append(Doubted(index, True, far.error, said, far.corrected))
    return tuple(doubts)


def _without(measurements: Measurements, indices: set[int]) -> Measurements:
    """The measurements without the readings of some marks, and without marks that wait."""
    ends = {name for distance in measurements.distances for name in distance.between}
    marks = [
        replace(mark, measured=None) if index in indices else mark
        for index, mark in enumerate(measurements.marks)
    ]
    kept = (mark for mark in marks if mark.measured is not None or mark.name in ends)
    return replace(measurements, marks=tuple(kept))


def _slips(inputs: Inputs) -> tuple[Slip, ...]:
    """Slips among readings that are near enough."""
    model, rows = model_and_observations(
        inputs.settings,
        inputs.measurements,
        cut_with=inputs.cut_with,
        controller=inputs.controller,
    )
    sigma = inputs.stated.sigma if inputs.stated else USUAL_SIGMA
    board = Board.of(model, rows, sigma=sigma, priors=inputs.priors, checked=inputs.checked)
    if len(readings_of(rows)) >= FEWEST:
        return clean_readings(board, inputs).slips
    reading = _slip_of_few(board, inputs)
    if reading is None:
        return ()
    shift = shifts(explain(board))[reading.place(rows)]
    return (described(shift, inputs.measurements, inputs.settings.sheet),)


def _slip_of_few(board: Board, inputs: Inputs) -> Reading | None:
    """The reading that is surely off by what is known before any mark."""
    frame = explain(board)
    noise = noise_on(board, inputs.stated)
    readings = readings_of(board.rows)
    weighed = weigh(frame, felt_effects(frame), noise)
    chances = weighed.slip_chances(np.ones(len(readings), dtype=bool))
    worst = greatest(chances)
    return readings[worst] if chances[worst] > SURE else None


def _doubted(slip: Slip, measurements: Measurements) -> Doubted:
    """A slip among all readings: the marks and distances are those of its name and number."""
    is_mark = len(slip.read) == 2
    places: list[tuple[str, tuple[float, ...] | None]]
    if is_mark:
        places = [(mark.name, mark.measured) for mark in measurements.marks]
    else:
        places = [(" - ".join(each.between), (each.length,)) for each in measurements.distances]
    said = slip.sentence.partition(": ")[2]
    index = places.index((slip.name, slip.read))
    return Doubted(index, is_mark, slip.length, said, slip.corrected)
