"""The readings that can be trusted: mix-ups put right, and outliers set aside with their causes."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Annotated

import numpy as np

from plumb.diagnosis.evidence import (
    KNOWN_QUANTILE,
    Noise,
    Reading,
    explain_account,
    library_basis,
    readings_of,
)
from plumb.diagnosis.explanation import Board, Explanation, board_of, explain
from plumb.diagnosis.posterior import Account, Posterior, posterior_of
from plumb.fit.compare import Comparison
from plumb.fit.inputs import Inputs, Stated
from plumb.fit.observations import Observations, model_and_observations
from plumb.marks.read import Measurements, far_reading
from plumb.model.plain import greatest
from plumb.text.answers import Internal, in_json, key
from plumb.text.values import MM, Unit

# How far a reading is off, and its likely cause: axes exchanged, digits transposed, a round number.

Array = np.ndarray
EXPLANATIONS, REPEATS = "every explanation", "its repeats"  # what a reading may disagree with


@dataclass(frozen=True)
class Shift:
    """The error of a reading by an explanation, or by its repeats."""

    reading: Reading
    offset: Array  # (2,) or (1,) [mm] read less what the rest says
    sigma: Array  # of each [mm]
    drop: float  # of chi-square when the reading is set free
    against: str = EXPLANATIONS  # what it disagrees with, for people
    is_one_of_two: bool = False  # of the same mark, and the other may be the wrong one


def without(rows: Observations, reading: Reading) -> Observations:
    """Return the observations without a reading; the visit itself stays."""
    if not reading.is_mark:
        return replace(
            rows,
            distance_rows=np.delete(rows.distance_rows, reading.index, axis=0),
            distances=np.delete(rows.distances, reading.index),
            distance_rounds=np.delete(rows.distance_rounds, reading.index),
        )
    return replace(
        rows,
        mark_rows=np.delete(rows.mark_rows, reading.index),
        measured=np.delete(rows.measured, reading.index, axis=0),
        targets=np.delete(rows.targets, reading.index, axis=0),
        names=rows.names[: reading.index] + rows.names[reading.index + 1 :],
    )


def sure_readings(measurements: Measurements, outliers: Collection[Outlier]) -> Measurements:
    """Return the measurements without these readings; the visits stay."""
    off = {(outlier.name, outlier.read) for outlier in outliers}
    return replace(
        measurements,
        marks=tuple(
            replace(mark, measured=None) if (mark.name, mark.measured) in off else mark
            for mark in measurements.marks
        ),
        distances=tuple(
            each
            for each in measurements.distances
            if (" - ".join(each.between), (each.length,)) not in off
        ),
    )


@dataclass(frozen=True)
class Doubts:
    """Readings to look at again, by their places among the compared marks and distances."""

    marks: tuple[int, ...] = ()
    spans: tuple[int, ...] = ()

    @staticmethod
    def of(outliers: Collection[Outlier], raw: Comparison) -> Doubts:
        """Return which of the readings these are."""
        off = {(outlier.name, outlier.read) for outlier in outliers}
        spans = [(" - ".join(each.between), (each.measured,)) for each in raw.distances]
        return Doubts(
            tuple(i for i, mark in enumerate(raw.marks) if (mark.name, mark.measured) in off),
            tuple(i for i, span in enumerate(spans) if span in off),
        )

    def rms(self, raw: Comparison) -> float:
        """RMS error of the others [mm]: of the marks, or of the distances without marks."""
        lengths, doubted = [mark.length for mark in raw.marks], self.marks
        if not lengths:
            lengths, doubted = [each.error for each in raw.distances], self.spans
        sure = [length for i, length in enumerate(lengths) if i not in doubted]
        return float(np.sqrt(np.mean(np.square(sure or lengths))))


NOTHING_DOUBTED = Doubts()
ROUND = (1.0, 2.0, 5.0, 10.0, 20.0, 25.4, 40.0, 50.0, 100.0)  # [mm] off by a tick, a hook, an inch
_EITHER = "its other reading may be the wrong one"
CLOSE = 2.5  # [deviations] within which a guess agrees with the shift
SURELY = 5.0  # [deviations] beyond which a coordinate is surely wrong


@dataclass(frozen=True)
class Outlier:
    """A reading to look at again."""

    name: str  # of the mark, or "1 - 2" of a distance
    # [mm] read less what all the rest says: (x, y), or of a distance
    offset: Annotated[tuple[float, ...], key("offset_mm")]
    sigma: Annotated[tuple[float, ...], key("sigma_mm")]
    read: tuple[float, ...]  # [mm] as it was read, in the machine frame
    expected: tuple[float, ...]  # [mm] what the rest says
    guess: str  # the likely cause, or nothing
    against: Internal[str] = EXPLANATIONS  # what it disagrees with
    corrected: Internal[tuple[float, ...] | None] = None  # [mm] what was meant, if that is right
    unit: Internal[Unit] = MM  # in which its length is said

    @property
    def length(self) -> float:
        """Its error [mm]."""
        return float(np.hypot(*self.offset)) if len(self.offset) == 2 else abs(self.offset[0])

    @property
    def called(self) -> str:
        """Kind and name."""
        return f"{'distance' if len(self.offset) == 1 else 'mark'} {self.name}"

    @in_json
    def sentence(self) -> str:
        """Advice for people."""
        because = f"; {self.guess}" if self.guess else self._advice
        off = f"{self.unit.worded(self.length, 1)} {self.way}"
        return f"remeasure {self.called}: it reads {off}{because}"

    @property
    def _advice(self) -> str:
        """Other cause if it is no outlier: where nothing was read twice, the marks cannot know."""
        if self.against != EXPLANATIONS or len(self.offset) == 1:
            return ""
        return "; if it stays, it is the machine there"

    @property
    def way(self) -> str:
        """Its direction in words."""
        if len(self.offset) == 1:
            return "too long" if self.offset[0] > 0 else "too short"
        x, y = self.offset
        across, along = "right" if x > 0 else "left", "up" if y > 0 else "down"
        if abs(y) < 0.4 * abs(x):
            return f"off to the {across}"
        if abs(x) < 0.4 * abs(y):
            return f"too far {along}"
        return f"off ({abs(x):.1f} {across}, {abs(y):.1f} {along})"


def described(shift: Shift, inputs: Inputs) -> Outlier:
    """Return the outlier for people."""
    index, measurements = shift.reading.index, inputs.measurements
    offset = tuple(float(value) for value in shift.offset)
    sigma = tuple(float(value) for value in shift.sigma)
    if shift.reading.is_mark:
        name = measurements.measured_marks[index].name
        read = tuple(float(value) for value in measurements.measured[index])
    else:
        name = " - ".join(measurements.distances[index].between)
        read = (measurements.distances[index].length,)
    expected = tuple(a - b for a, b in zip(read, offset, strict=True))
    sheet = inputs.settings.sheet
    guess = Guess(_EITHER) if shift.is_one_of_two else _guess(read, offset, sigma, sheet)
    against, corrected = shift.against, guess.corrected
    return Outlier(
        name, offset, sigma, read, expected, guess.said, against, corrected, unit=inputs.unit
    )


@dataclass(frozen=True)
class Guess:
    """Likely cause of an outlier."""

    said: str = ""  # for people; empty if unknown
    corrected: tuple[float, ...] | None = None  # [mm] the reading that was meant


def _guess(
    read: tuple[float, ...],
    offset: tuple[float, ...],
    sigma: tuple[float, ...],
    sheet: tuple[float, float],
) -> Guess:
    """Return the first usual mistake that agrees with the shift in every coordinate."""
    expected = np.subtract(read, offset)
    for frame in _as_read(np.array(read), sheet):
        meant = frame.back(frame.numbers[::-1])
        if len(read) == 2 and _agree(meant, expected, sigma):
            return Guess("x and y may be exchanged", _places(meant))
        wrong = [i for i in range(len(read)) if abs(offset[i]) > SURELY * sigma[i]]
        if len(wrong) != 1:
            continue
        number = frame.numbers[wrong[0]]
        for other in _transposed(number):
            changed = frame.numbers.copy()
            changed[wrong[0]] = other
            meant = frame.back(changed)
            if _agree(meant, expected, sigma):
                return Guess(f"{_shown(number)} written for {_shown(other)}?", _places(meant))
    return _round_number(read, offset, sigma)


def _places(numbers: np.ndarray) -> tuple[float, ...]:
    return tuple(float(number) for number in numbers)


@dataclass(frozen=True)
class _Frame:
    """Numbers as they may have been written down, and their way back to the machine frame."""

    numbers: np.ndarray
    middle: np.ndarray  # machine = sign * (numbers - middle)
    sign: np.ndarray

    def back(self, numbers: np.ndarray) -> np.ndarray:
        """Return the places in the machine frame."""
        places: np.ndarray = self.sign * (numbers - self.middle)
        return places


def _as_read(read: np.ndarray, sheet: tuple[float, float]) -> list[_Frame]:
    """Return the reading as counted from the middle of the sheet, and from its top-left corner."""
    if len(read) == 1:
        return [_Frame(read, np.zeros(1), np.ones(1))]
    sign, middle = np.array([1.0, -1.0]), np.array(sheet) / 2
    return [_Frame(read, np.zeros(2), np.ones(2)), _Frame(sign * read + middle, middle, sign)]


def _transposed(number: float) -> list[float]:
    """Return the number with two neighbouring digits transposed, whole millimetres and tenths."""
    text = _shown(abs(number))
    numbers = []
    for i in range(len(text) - 1):
        for j in (i + 1, i + 2):
            if j >= len(text) or not (text[i].isdigit() and text[j].isdigit()):
                continue
            if j == i + 2 and text[i + 1] != ".":
                continue
            digits = list(text)
            digits[i], digits[j] = digits[j], digits[i]
            if digits != list(text):
                numbers.append(float(np.copysign(float("".join(digits)), number)))
    return numbers


def _shown(number: float) -> str:
    return f"{number:.1f}".removesuffix(".0")


def _agree(guess: np.ndarray, expected: np.ndarray, sigma: tuple[float, ...]) -> bool:
    return bool(np.all(np.abs(guess - expected) <= CLOSE * np.array(sigma)))


def _round_number(
    read: tuple[float, ...], offset: tuple[float, ...], sigma: tuple[float, ...]
) -> Guess:
    """Return a single coordinate off by what a tape or a ruler is misread by."""
    wrong = [i for i in range(len(offset)) if abs(offset[i]) > SURELY * sigma[i]]
    if len(wrong) != 1:
        return Guess()
    i = wrong[0]
    for size in ROUND:
        if size >= 5 and abs(abs(offset[i]) - size) <= min(CLOSE * sigma[i], size / 8):
            said = "an inch" if size == 25.4 else f"{size:g} mm"
            axis = "" if len(offset) == 1 else f" in {'xy'[i]}"
            meant = np.array(read)
            meant[i] -= np.copysign(size, offset[i])
            return Guess(f"misread by {said}{axis}?", _places(meant))
    return Guess()


# Readings that were written down for each other: two marks, or two distances, mixed up.
#
# Either of the two looks like an outlier, and one outlier at a time does not clear both. To undo it
# is one guess without a free number, so a large drop of chi-square is hardly ever luck.

LUCK = 0.001  # chance that noise alone makes any pair look mixed up
APART = 6.0  # [sigma] readings closer than this are not worth a thought
SHARE = 0.8  # of what setting both readings free would gain: then it was no two separate outliers
MOST = 3  # pairs; with more the list is in disorder


@dataclass(frozen=True)
class MixedPair:
    """Two readings of one kind, by their indices among the marks or the distances."""

    first: int
    second: int
    is_mark: bool


@dataclass(frozen=True)
class MixedUp:
    """The pairs that were mixed up, and the board with their readings put right."""

    pairs: tuple[MixedPair, ...]
    board: Board


def find_mixed_up(board: Board) -> MixedUp:
    """Put pairs right, one after the other, the surest first."""
    pairs: list[MixedPair] = []
    while len(pairs) < MOST:
        best = _best(board)
        if best is None:
            break
        pairs.append(best)
        board = _undone(board, best)
    return MixedUp(tuple(pairs), board)


def mixed_up_outliers(mixed_up: MixedUp, measurements: Measurements) -> list[Outlier]:
    """Return both readings of every exchange, each to be looked at again."""
    outliers = []
    for pair in mixed_up.pairs:
        for index, other in ((pair.first, pair.second), (pair.second, pair.first)):
            outliers.append(_outlier(mixed_up, measurements, pair.is_mark, index, other))
    return outliers


def _outlier(
    mixed_up: MixedUp, measurements: Measurements, is_mark: bool, index: int, other: int
) -> Outlier:
    if is_mark:
        marks = measurements.measured_marks
        names = [marks[i].name for i in (index, other)]
        read, expected = (measurements.measured[i] for i in (index, other))
    else:
        names = [" - ".join(measurements.distances[i].between) for i in (index, other)]
        read, expected = (measurements.distance_lengths[[i]] for i in (index, other))
    sigma = mixed_up.board.sigma
    both = f"its reading and that of {names[1]}" if names[0] != names[1] else "its two readings"
    return Outlier(
        name=names[0],
        offset=tuple((read - expected).tolist()),
        sigma=(sigma,) * len(read),
        read=tuple(read.tolist()),
        expected=tuple(expected.tolist()),
        guess=f"{both} may be exchanged",
        corrected=tuple(expected.tolist()),
        unit=mixed_up.board.unit,
    )


def _best(board: Board) -> MixedPair | None:
    """Return the pair whose mix-up explains most of what the library cannot draw."""
    frame, rows = board.fitted, board.rows
    basis = library_basis(frame)
    left = frame.residual - basis @ (basis.T @ frame.residual)
    marks = np.arange(rows.measured.size).reshape(-1, 2)
    spans = rows.measured.size + np.arange(len(rows.distances)).reshape(-1, 1)
    best, most, tried = None, 0.0, 0
    for numbers, readings, rounds, is_mark in (
        (marks, rows.measured, rows.rounds[rows.mark_rows], True),
        (spans, rows.distances.reshape(-1, 1), rows.distance_rounds, False),
    ):
        drops = _drops(basis, left, numbers, readings / board.sigma)
        # Nobody writes a reading into another file; what changed between them is no exchange.
        drops[rounds[:, np.newaxis] != rounds] = -np.inf
        tried += int(np.sum(drops > -np.inf))
        if drops.size and drops.max() > most:
            i, j = (int(at) for at in np.unravel_index(greatest(drops), drops.shape))
            if drops[i, j] > _needed(basis, left, numbers[[i, j]]):
                best, most = MixedPair(i, j, is_mark), float(drops[i, j])
    # exp(-drop / 2) is the ratio of likelihoods of a guess that has no free number.
    return best if best and tried * np.exp(-most / 2) < LUCK else None


def _drops(basis: Array, left: Array, numbers: Array, readings: Array) -> Array:
    """Drop of chi-square (n, n) when two readings change places; -inf where it is no question.

    With P = 1 - basis basis^T and c = +-(read_j - read_i) on the numbers of both, it is
    -(2 c . left + c^T P c).
    """
    apart = readings[np.newaxis] - readings[:, np.newaxis]
    kept = np.eye(numbers.size) - basis[numbers.ravel()] @ basis[numbers.ravel()].T
    kept = kept.reshape(*numbers.shape, *numbers.shape)
    alone = np.einsum("iaib->iab", kept)
    both = np.einsum("iajb->ijab", kept)
    bent = alone[:, np.newaxis] + alone[np.newaxis] - both - both.transpose(0, 1, 3, 2)
    pull = left[numbers][:, np.newaxis] - left[numbers][np.newaxis]
    drops = -2 * np.sum(apart * pull, axis=-1) - np.einsum("ija,ijab,ijb->ij", apart, bent, apart)
    question = np.triu(np.abs(apart).max(axis=-1, initial=0.0) > APART, 1)
    return np.where(question, drops, -np.inf)


def _needed(basis: Array, left: Array, pair: Array) -> float:
    """Return the drop from which on two readings were mixed up, and none misread.

    The library can bend much of the board to two neighbours that are off alike. So a misread repeat
    of a mark gains by an exchange too, but less than by setting it alone free.
    """
    alone = max(_free(basis, left, numbers) for numbers in pair)
    return max(SHARE * _free(basis, left, pair.ravel()), alone)


def _free(basis: Array, left: Array, numbers: Array) -> float:
    """Drop of chi-square when these numbers are set free."""
    kept = np.eye(len(numbers)) - basis[numbers] @ basis[numbers].T
    return float(left[numbers] @ np.linalg.pinv(kept, rcond=1e-6, hermitian=True) @ left[numbers])


def _undone(board: Board, pair: MixedPair) -> Board:
    rows, order = board.rows, [pair.second, pair.first]
    measured, distances = rows.measured.copy(), rows.distances.copy()
    if pair.is_mark:
        measured[[pair.first, pair.second]] = measured[order]
    else:
        distances[[pair.first, pair.second]] = distances[order]
    return board.with_rows(replace(rows, measured=measured, distances=distances))


# Mix-ups put right, outliers set aside, the noise known.


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
    expected: tuple[float, ...] | None = None  # [mm] what the others say; None: it is far off


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
        inputs.settings, inputs.measurements, cut_with=inputs.cut_with, controller=inputs.controller
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
    return Doubted(
        index, is_mark, outlier.length, said, outlier.corrected, expected=outlier.expected
    )
