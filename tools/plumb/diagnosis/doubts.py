"""What to doubt of a verdict: sizes that no machine has, mixed-up signs, parts that disagree."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from plumb.diagnosis.answer import Ranked
from plumb.diagnosis.clean import (
    SURE,
    CleanReadings,
    clean_readings,
    felt_effects,
    shifts,
    twins_that_agree,
)
from plumb.diagnosis.explanation import Board, Explanation, explain, span, tail
from plumb.diagnosis.gain import Search
from plumb.diagnosis.judgement import Judgement
from plumb.diagnosis.noise import Noise, library_basis, noise_on
from plumb.diagnosis.outliers import Outlier, Reading, described, readings_of
from plumb.diagnosis.sizes import Room, room_for, sign_warning
from plumb.diagnosis.weighing import weigh
from plumb.fit.inputs import Inputs
from plumb.fit.observations import model_and_observations
from plumb.fit.problem import USUAL_SIGMA
from plumb.fit.sighting import SHEET_ROTATION
from plumb.marks.plausible import far_reading
from plumb.marks.read import Measurements
from plumb.model.catalogue import ZEROING_NAMES, effect_names
from plumb.model.plain import greatest, ranked
from plumb.text.values import worded

_IMPOSSIBLE = (
    "every explanation needs sizes that no real machine has, so each takes the place of another "
    "cause: check which settings were in force, the signs of the marks, the stated frame, and that "
    "the sled hangs on one ring, not on two brackets"
)


@dataclass(frozen=True)
class Doubts:
    """What could hide, and sentences on what does not go together."""

    could_hide: tuple[Room, ...]
    warnings: tuple[str, ...]
    disagreements: tuple[str, ...]  # rounds, or halves of the sheet


def find_doubts(
    readings: CleanReadings,
    detection: Search,
    judgement: Judgement,
    ranking: Sequence[Ranked],
    rounds: Sequence[str],
) -> Doubts:
    """Return all doubts about a judgement; `rounds` are the names of the files of marks."""
    accepted = judgement.explanations or (readings.frame,)
    return Doubts(
        could_hide=tuple(room_for(name, accepted, readings.noise) for name in effect_names()),
        warnings=(
            *readings.noise.notes,
            *([_IMPOSSIBLE] if judgement.none_possible else []),
            *_place_warnings(readings, judgement),
            *_order_warnings(detection, ranking),
            *_unsettled_warnings((readings.frame, *judgement.explanations)),
            *_sign_warnings(readings, judgement),
        ),
        disagreements=() if readings.outliers else _disagreements(readings, accepted[0], rounds),
    )


def _order_warnings(detection: Search, ranking: Sequence[Ranked]) -> list[str]:
    """Return where a full refit ranks effects otherwise than the slopes did."""
    first = detection.gains[0].effect if detection.proved else None
    if first in (None, ranking[0].effect):
        return []
    return [
        f"the full refit puts {ranking[0].effect} before {first}, which the "
        "slopes at the frame's fit put first: the error is large; fit one and diagnose again"
    ]


def _place_warnings(readings: CleanReadings, judgement: Judgement) -> list[str]:
    """Return where to look first if nothing in the library explains the marks."""
    board = readings.frame.board
    if judgement.verdict != "not_in_library" or not len(board.rows.measured):
        return []
    nearest = explain(board, judgement.to_add, start=readings.frame)
    of_marks = [shift for shift in shifts(nearest) if shift.reading.is_mark]
    worst = ranked(of_marks, lambda shift: -shift.drop)[0]
    name, off = board.rows.names[worst.reading.index], float(np.hypot(*worst.offset))
    if worst.reading in twins_that_agree(board.rows, board.sigma):
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


def _sign_warnings(readings: CleanReadings, judgement: Judgement) -> list[str]:
    """Return what the other sign of y would change, where the verdict leaves doubts."""
    if judgement.verdict in ("slip", "nothing_provable") or judgement.shares:
        return []
    board = readings.frame.board
    warning = sign_warning(board, readings.felt, readings.noise, judgement.explanations)
    return [warning] if warning else []


def _disagreements(
    readings: CleanReadings, best: Explanation, rounds: Sequence[str]
) -> tuple[str, ...]:
    """Return rounds that do not go together, else halves of the sheet."""
    by_round = round_warnings(best, readings.noise, rounds)
    return tuple(by_round or half_warnings(best, readings.noise))


# Readings to look at again while the others are still being typed.
#
# A reading too far from its target for any machine is named at once. The others are weighed as a
# diagnosis weighs them, however few they are: what is known of frames, effects and outliers before
# any mark says how far a reading may be off, and each further reading narrows it.

FEWEST = 4  # marks and distances from which outliers are sought as in a diagnosis


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
        return clean_readings(board, inputs).outliers
    reading = _outlier_of_few(board, inputs)
    if reading is None:
        return ()
    shift = shifts(explain(board))[reading.place(rows)]
    return (described(shift, inputs.measurements, inputs.settings.sheet),)


def _outlier_of_few(board: Board, inputs: Inputs) -> Reading | None:
    """Return the reading that is surely off by what is known before any mark."""
    frame = explain(board)
    noise = noise_on(board, inputs.stated)
    readings = readings_of(board.rows)
    weighed = weigh(frame, felt_effects(frame), noise)
    chances = weighed.outlier_chances(np.ones(len(readings), dtype=bool))
    worst = greatest(chances)
    return readings[worst] if chances[worst] > SURE else None


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


# Parts of a board that want different numbers: halves of the sheet, and rounds of marks.
#
# If parameters move by more than 3 sigma from one part to the other, physics is missing even where
# each part by itself fits well, or the rounds were not cut by the same machine.

Array = np.ndarray
CHANCE = 0.0027  # of a move beyond 3 sigma from noise alone
FEWEST_IN_PART = 6  # measured numbers in a part: fewer tell nothing of it


@dataclass(frozen=True)
class Move:
    """How a parameter differs between two parts of a board."""

    parameter: str
    deviations: float  # by how many sigma
    chance: float  # that noise alone moves the parameters together as much


def half_warnings(explanation: Explanation, noise: Noise) -> list[str]:
    """Return a sentence for each pair of halves of the sheet that want different parameters."""
    rows = explanation.board.rows
    if not len(rows.targets):
        return []
    said = []
    for axis, names in ((0, "left and right"), (1, "lower and upper")):
        beyond = rows.targets[:, axis] > np.median(rows.targets[:, axis])
        mask = np.zeros(rows.count, dtype=bool)
        mask[: rows.measured.size] = np.repeat(beyond, 2)
        move = _move(explanation, explanation.basis, mask, noise)
        if move:
            said.append(
                f"the {names} half of the sheet want different numbers ({_words(move)}): physics "
                "is missing even where each half fits, so do not trust a size to its interval"
            )
    return said


def round_warnings(explanation: Explanation, noise: Noise, rounds: Sequence[str]) -> list[str]:
    """Return a sentence for each round (by its name) that does not go with all others.

    Judged beyond everything that the library can draw, so that no effect is blamed on a round.
    """
    if len(rounds) < 2:
        return []
    basis, said = library_basis(explanation), []
    for number, name in enumerate(rounds):
        mask = _numbers_of(explanation, number)
        move = _move(explanation, basis, mask, noise)
        if move:
            said.append(
                f"{name} does not go with the other rounds ({_words(move)}): do not pool them; "
                f"{_way_out(explanation, basis, mask, noise, name)}"
            )
    # Of two rounds either may differ.
    return said[-1:] if len(rounds) == 2 else said


def _words(move: Move) -> str:
    if move.deviations < 3:
        return f"all fitted numbers together; {move.parameter} by {move.deviations:.1f} sigma"
    return f"{move.parameter} by {move.deviations:.1f} sigma"


def _way_out(explanation: Explanation, basis: Array, mask: Array, noise: Noise, name: str) -> str:
    """Return what would explain the difference, as far as a marks file can say it."""
    for flag, columns in (
        ("chains_rezeroed", _columns(explanation, ZEROING_NAMES, mask)),
        ("new_sheet", _pose(explanation, mask)),
    ):
        wider = np.hstack([basis, span(columns - basis @ (basis.T @ columns), against=columns)])
        if not _move(explanation, wider, mask, noise):
            return f"{flag} = true in {name} would explain it; if it is not so, use one at a time"
    return "use one file at a time and compare what they say"


def _numbers_of(explanation: Explanation, number: int) -> Array:
    """Return which measured numbers (n,) belong to a round."""
    rows = explanation.board.rows
    marks = np.repeat(rows.rounds[rows.mark_rows] == number, 2)
    return np.concatenate([marks, rows.distance_rounds == number])


def _move(explanation: Explanation, basis: Array, mask: Array, noise: Noise) -> Move | None:
    """Return the parameter that moves most between the masked numbers and the rest, if any surely
    does.
    """
    if min(mask.sum(), (~mask).sum()) < FEWEST_IN_PART or not np.isfinite(noise.sigma):
        return None
    names = explanation.board.problem.names
    free = [i for i in explanation.free if np.any(explanation.slopes[: mask.size, i])]
    masked = _columns(explanation, [names[i] for i in free], mask)
    beyond = masked - basis @ (basis.T @ masked)
    left = explanation.residual - basis @ (basis.T @ explanation.residual)
    together = span(beyond, against=masked)
    if not together.shape[1]:
        return None
    chance = float(tail(np.sum((together.T @ left) ** 2), together.shape[1], noise.degrees))
    lengths = np.linalg.norm(beyond, axis=0)
    felt = lengths > 1e-5 * np.linalg.norm(masked, axis=0)
    pulls = np.where(felt, np.abs(beyond.T @ left) / np.where(felt, lengths, 1.0), 0.0)
    most = greatest(pulls)
    single = float(tail(pulls[most] ** 2, 1, noise.degrees)) * len(free)
    if min(chance, single) > CHANCE:
        return None
    return Move(names[free[most]], float(pulls[most]), min(chance, single))


def _columns(explanation: Explanation, names: Sequence[str], mask: Array) -> Array:
    """Slopes by some unknowns, on the masked numbers only (rows of the priors are zero)."""
    known = explanation.board.problem.names
    masked = explanation.slopes[:, [known.index(name) for name in names]].copy()
    masked[: mask.size][~mask] = 0.0
    masked[mask.size :] = 0.0
    return masked


def _pose(explanation: Explanation, mask: Array) -> Array:
    """Columns that shift and turn the masked marks on their sheet."""
    marks = explanation.board.rows.measured.size
    shifts = np.zeros((len(explanation.residual), 2))
    for axis in (0, 1):
        shifts[axis:marks:2, axis] = 1.0
    shifts[: mask.size][~mask] = 0.0
    turns = [SHEET_ROTATION] if SHEET_ROTATION in explanation.board.problem.names else []
    return np.hstack([shifts, _columns(explanation, turns, mask)])
