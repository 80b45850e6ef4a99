"""What to doubt of a verdict: parts that do not go together, signs, and readings as they come."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from plumb.diagnosis.clean import CleanReadings, clean_readings, shifts
from plumb.diagnosis.explanation import Board, Explanation
from plumb.diagnosis.outliers import Outlier
from plumb.diagnosis.priors import LIKELIER
from plumb.fit.inputs import Inputs
from plumb.fit.observations import model_and_observations
from plumb.fit.problem import USUAL_SIGMA
from plumb.marks.model import Round
from plumb.marks.plausible import far_reading
from plumb.marks.read import Measurements
from plumb.model.plain import ranked
from plumb.text.values import worded


@dataclass(frozen=True)
class Doubts:
    """Sentences on what does not go together."""

    warnings: tuple[str, ...]
    disagreements: tuple[str, ...]  # rounds


def doubts_of(
    readings: CleanReadings, verdict: str, best: Explanation, rounds: Sequence[Round]
) -> Doubts:
    """Return all doubts about a verdict; `rounds` are the files of marks."""
    return Doubts(
        warnings=(
            *readings.noise.notes,
            *(_place_warnings(best) if verdict == "not_in_library" else []),
            *_unsettled_warnings((readings.frame, best)),
            *_sign_warnings(readings),
        ),
        disagreements=tuple(_round_warnings(readings, [part.name for part in rounds])),
    )


def _place_warnings(nearest: Explanation) -> list[str]:
    """Return where to look first if nothing in the library explains the marks."""
    board = nearest.board
    of_marks = [shift for shift in shifts(nearest) if shift.reading.is_mark]
    if not of_marks:
        return []
    worst = ranked(of_marks, lambda shift: -shift.drop)[0]
    name, off = board.rows.names[worst.reading.index], float(np.hypot(*worst.offset))
    if board.rows.names.count(name) > 1:
        return [
            f"mark {name} stays {worded(off, 1)} off when it is read again: it is the machine there"
        ]
    return [
        f"the marks are farthest off at {name}, by {worded(off, 1)}: read it again; if it stays, "
        "it is the machine there"
    ]


def _unsettled_warnings(explanations: Sequence[Explanation]) -> list[str]:
    unsettled = [fitted for fitted in explanations if not fitted.settled]
    names = ", ".join(" + ".join(fitted.effects) or "frame" for fitted in unsettled)
    return [f"the fit did not come to rest: {names}"] if unsettled else []


def _sign_warnings(readings: CleanReadings) -> list[str]:
    """Return whether the other sign of y would explain the marks better than anything does."""
    if readings.posterior.turned_chance < LIKELIER:
        return []
    return [
        "with all y errors the other way round these marks would be explained better: check that "
        "measured and target count y in the same direction"
    ]


_WAYS_OUT = {
    "new_sheet": "new_sheet = true in {name} would explain it; if it is not so, use one at a time",
    "chains_rezeroed": "chains_rezeroed = true in {name} would explain it; if it is not so, use "
    "one at a time",
    "": "use one file at a time and compare what they say",
}


def _round_warnings(readings: CleanReadings, names: Sequence[str]) -> list[str]:
    """Return a sentence for each round that likely does not go with the others."""
    chances: dict[int, float] = {}
    causes: dict[int, tuple[float, str]] = {}
    for move, chance in readings.posterior.moved_chances.items():
        chances[move.number] = chances.get(move.number, 0.0) + chance
        causes[move.number] = max(causes.get(move.number, (0.0, "")), (chance, move.cause))
    return [
        f"{names[number]} does not go with the other rounds: do not pool them; "
        + _WAYS_OUT[causes[number][1]].format(name=names[number])
        for number, chance in chances.items()
        if chance > LIKELIER
    ]


# Readings to look at again while the others are still being typed.
#
# A reading too far from its target for any machine is named at once. The others are weighed as a
# diagnosis weighs them, however few they are: what is known of frames, effects and outliers before
# any mark says how far a reading may be off, and each further reading narrows it.


@dataclass(frozen=True)
class Doubted:
    """A reading to look at again, by its index among the marks or the distances."""

    index: int
    is_mark: bool
    off: float  # [mm]
    sentence: str
    corrected: tuple[float, ...] | None  # [mm] the reading that was meant, if that is likely


def doubted_readings(inputs: Inputs) -> tuple[Doubted, ...]:
    """Return the readings so far that no machine explains. Raises InputError for a bad target."""
    far = _far_readings(inputs)
    near = _without(inputs.measurements, {doubt.index for doubt in far})
    if not near.measured_marks and not near.distances:
        return far
    outliers = _outliers(replace(inputs, measurements=near))
    return (*far, *(_doubted(outlier, inputs.measurements) for outlier in outliers))


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
    """Return the measurements without the readings of some marks, and without marks that wait."""
    ends = {name for distance in measurements.distances for name in distance.between}
    marks = [
        replace(mark, measured=None) if index in indices else mark
        for index, mark in enumerate(measurements.marks)
    ]
    kept = (mark for mark in marks if mark.measured is not None or mark.name in ends)
    return replace(measurements, marks=tuple(kept))


def _outliers(inputs: Inputs) -> tuple[Outlier, ...]:
    """Outliers among readings that are near enough, however few they are."""
    model, rows = model_and_observations(
        inputs.settings,
        inputs.measurements,
        cut_with=inputs.cut_with,
        controller=inputs.controller,
    )
    sigma = inputs.stated.sigma if inputs.stated else USUAL_SIGMA
    board = Board.of(model, rows, sigma=sigma, priors=inputs.priors, checked=inputs.checked)
    return clean_readings(board, inputs).outliers


def _doubted(outlier: Outlier, measurements: Measurements) -> Doubted:
    """Return an outlier among all readings: the marks and distances are those of its name and
    number.
    """
    is_mark = len(outlier.read) == 2
    places: list[tuple[str, tuple[float, ...] | None]]
    if is_mark:
        places = [(mark.name, mark.measured) for mark in measurements.marks]
    else:
        places = [(" - ".join(each.between), (each.length,)) for each in measurements.distances]
    said = outlier.sentence.partition(": ")[2]
    index = places.index((outlier.name, outlier.read))
    return Doubted(index, is_mark, outlier.length, said, outlier.corrected)
