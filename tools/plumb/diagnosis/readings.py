"""The readings that can be trusted: mix-ups put right, outliers set aside, the noise known."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from plumb.diagnosis.evidence import KNOWN_QUANTILE, Noise, explain_account
from plumb.diagnosis.explanation import Board, Explanation, board_of, explain
from plumb.diagnosis.outliers import (
    EXPLANATIONS,
    REPEATS,
    Outlier,
    Reading,
    Shift,
    described,
    find_mixed_up,
    mixed_up_outliers,
    readings_of,
    without,
)
from plumb.diagnosis.posterior import Account, Posterior, posterior_of
from plumb.fit.inputs import Inputs, Stated
from plumb.fit.observations import model_and_observations
from plumb.marks.read import Measurements, far_reading
from plumb.model.plain import greatest

DOUBTED = 1 / 3  # chance from which on a reading is read again: that costs a minute
SHARE_OF_OUTLIERS = 12  # with more than one in this many readings outliers are not the story


@dataclass(frozen=True)
class CleanReadings:
    """Readings without outliers, and their posterior."""

    outliers: tuple[Outlier, ...]  # readings to look at again
    posterior: Posterior  # of what is left
    frame: Explanation  # of what is left, whitened by its noise

    @property
    def noise(self) -> Noise:
        """The diagnosis of the remaining readings."""
        return self.posterior.noise

    def explained(self, account: Account) -> Explanation:
        """Return the fit of an account; each is fitted once."""
        if account not in self._fits:
            self._fits[account] = explain_account(self.frame, account.effects, account.acting)
        return self._fits[account]

    @cached_property
    def _fits(self) -> dict[Account, Explanation]:
        return {}


def clean_readings(board: Board, inputs: Inputs) -> CleanReadings:
    """Set the readings aside that are so likely off that they are read again."""
    mixed_up = find_mixed_up(board)
    shifts, posterior = clear_outliers(mixed_up.board, inputs.stated)
    measurements = inputs.measurements
    outliers = (
        *mixed_up_outliers(mixed_up, measurements),
        *(described(shift, inputs) for shift in shifts),
    )
    left = posterior.frame.board
    frame = explain(left.with_rows(left.rows, sigma=posterior.noise.sigma), start=posterior.frame)
    return CleanReadings(outliers, posterior, frame)


def clear_outliers(board: Board, stated: Stated | None) -> tuple[tuple[Shift, ...], Posterior]:
    """Set outliers aside one after the other, the likeliest first, and return how far each is off
    by all others; its reading is counted among all.
    """
    whole = posterior = posterior_of(board, stated)
    indices = readings_of(board.rows)
    most = max(1, len(indices) // SHARE_OF_OUTLIERS)
    outliers: list[Shift] = []
    while len(outliers) <= most:
        reading = outlier_of(posterior)
        if reading is None:
            return tuple(outliers), posterior
        before = posterior.frame.board
        posterior = posterior_of(before.with_rows(without(before.rows, reading)), stated)
        shift = _shift_by_rest(before, posterior, reading)
        outliers.append(replace(shift, reading=indices.pop(reading.place(before.rows))))
    return (), whole


def outlier_of(posterior: Posterior) -> Reading | None:
    """Return the reading that is so likely off that it is read again; of several readings of the
    same mark the likeliest, if one of them is.
    """
    rows, chances = posterior.frame.board.rows, posterior.outlier_chances
    readings = readings_of(rows)
    together: dict[object, float] = {}
    for reading, chance in zip(readings, chances, strict=True):
        what = _what(posterior.frame.board, reading)
        together[what] = together.get(what, 0.0) + float(chance)
    worst = readings[greatest(chances)]
    return worst if together[_what(posterior.frame.board, worst)] > DOUBTED else None


def _what(board: Board, reading: Reading) -> object:
    """Return what was read: a mark's name, or both ends of a distance."""
    rows = board.rows
    if reading.is_mark:
        return rows.names[reading.index]
    return frozenset(rows.distance_rows[reading.index].tolist())


def _shift_by_rest(before: Board, rest: Posterior, reading: Reading) -> Shift:
    """Return how far a reading is off by the likeliest account of all others."""
    board = before.with_rows(before.rows, sigma=rest.noise.sigma)
    account = rest.accounts[0]
    fitted = explain_account(explain(board), account.effects, account.acting)
    shift = shifts(fitted)[reading.place(board.rows)]
    others = [
        other
        for other in readings_of(board.rows)
        if other != reading and _what(board, other) == _what(board, reading)
    ]
    return replace(
        shift,
        # A noise that is hardly known says as little of what was meant.
        sigma=shift.sigma * rest.noise.quantile / KNOWN_QUANTILE,
        against=REPEATS if others else EXPLANATIONS,
        is_one_of_two=len(others) == 1,
    )


def shifts(explanation: Explanation) -> list[Shift]:
    """Return what each reading is off by when it takes no part in the fit.

    With P = 1 - basis basis^T and r = P y, setting the numbers b free lowers chi-square by
    r_b^T (P_bb)^-1 r_b and moves them by (P_bb)^-1 r_b.
    """
    board, basis = explanation.board, explanation.basis
    of_readings = []
    for reading in readings_of(board.rows):
        numbers = reading.numbers(board.rows)
        kept = np.eye(reading.size) - basis[numbers] @ basis[numbers].T
        inverse = np.linalg.pinv(kept, rcond=1e-6, hermitian=True)
        offset = inverse @ explanation.residual[numbers]
        drop = float(explanation.residual[numbers] @ offset)
        sigma = np.sqrt(np.diag(inverse))
        of_readings.append(Shift(reading, offset * board.sigma, sigma * board.sigma, drop))
    return of_readings


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


def look_over(inputs: Inputs) -> tuple[Doubted, ...]:
    """Return which readings so far no machine explains. Raises InputError for a bad target."""
    far = _far_readings(inputs)
    near = _without(inputs.measurements, {doubt.index for doubt in far})
    if not near.measured_marks and not near.distances:
        return far
    clean = _clean(replace(inputs, measurements=near))
    return (*far, *(_doubted(outlier, inputs.measurements) for outlier in clean.outliers))


def _far_readings(inputs: Inputs) -> tuple[Doubted, ...]:
    measurements = inputs.measurements
    sheet = (measurements.rounds[0].cut_with or inputs.cut_with or inputs.settings).sheet
    doubts = []
    for index, mark in enumerate(measurements.marks):
        far = far_reading(measurements, mark, sheet)
        if far:
            cause = f"; {far.mistake}" if far.mistake else ""
            said = (
                f"it reads {inputs.unit.worded(far.error, 0)} from where the mark was sent{cause}"
            )
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


def _clean(inputs: Inputs) -> CleanReadings:
    """Return what is left of readings that are near enough, however few they are."""
    model, rows = model_and_observations(
        inputs.settings,
        inputs.measurements,
        cut_with=inputs.cut_with,
        controller=inputs.controller,
    )
    return clean_readings(board_of(inputs, model, rows), inputs)


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
