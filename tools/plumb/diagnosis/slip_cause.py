"""What a slip most likely was: axes exchanged, digits transposed, a round number off."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from plumb.diagnosis.readings import EXPLANATIONS, Shift
from plumb.marks.read import Measurements
from plumb.text.shown import worded

ROUND = (1.0, 2.0, 5.0, 10.0, 20.0, 25.4, 40.0, 50.0, 100.0)  # [mm] off by a tick, a hook, an inch
_EITHER = "its other reading may be the wrong one"
CLOSE = 2.5  # [deviations] within which a guess agrees with the shift
SURELY = 5.0  # [deviations] beyond which a coordinate is surely wrong


@dataclass(frozen=True)
class Slip:
    """A reading to look at again."""

    name: str  # of the mark, or "1 - 2" of a distance
    offset: tuple[float, ...]  # [mm] read less what all the rest says: (x, y), or of a distance
    sigma: tuple[float, ...]  # [mm]
    read: tuple[float, ...]  # [mm] as it was read, in the machine frame
    expected: tuple[float, ...]  # [mm] what the rest says
    guess: str  # the likely cause, or nothing
    against: str = EXPLANATIONS  # what it disagrees with
    corrected: tuple[float, ...] | None = None  # [mm] what was meant, if the guess is right

    @property
    def length(self) -> float:
        """How far it is off [mm]."""
        return float(np.hypot(*self.offset)) if len(self.offset) == 2 else abs(self.offset[0])

    @property
    def sentence(self) -> str:
        """What to do, for people."""
        what = "distance" if len(self.offset) == 1 else "mark"
        cause = f"; {self.guess}" if self.guess else ""
        advice = "" if self.guess else self._advice
        said = f"it reads {worded(self.length, 1)} {self.way}{cause}{advice}"
        return f"remeasure {what} {self.name}: {said}"

    @property
    def _advice(self) -> str:
        """What it is if it is no slip: where nothing was read twice, the marks cannot know."""
        if self.against != EXPLANATIONS or len(self.offset) == 1:
            return ""
        return "; if it stays, it is the machine there"

    @property
    def way(self) -> str:
        """Its direction in words."""
        if len(self.offset) == 1:
            return "too long" if self.offset[0] > 0 else "too short"
        x, y = self.offset
        across = "right" if x > 0 else "left"
        along = "up" if y > 0 else "down"
        if abs(y) < 0.4 * abs(x):
            return f"off to the {across}"
        if abs(x) < 0.4 * abs(y):
            return f"too far {along}"
        return f"off ({abs(x):.1f} {across}, {abs(y):.1f} {along})"


def described(shift: Shift, measurements: Measurements, sheet: tuple[float, float]) -> Slip:
    """The slip for people; sheet is its width and height [mm]."""
    index = shift.reading.index
    offset = tuple(float(value) for value in shift.offset)
    sigma = tuple(float(value) for value in shift.sigma)
    if shift.reading.is_mark:
        name = measurements.measured_marks[index].name
        read = tuple(float(value) for value in measurements.measured[index])
    else:
        name = " - ".join(measurements.distances[index].between)
        read = (measurements.distances[index].length,)
    expected = tuple(a - b for a, b in zip(read, offset, strict=True))
    guess = Guess(_EITHER) if shift.is_one_of_two else _guess(read, offset, sigma, sheet)
    return Slip(name, offset, sigma, read, expected, guess.said, shift.against, guess.corrected)


@dataclass(frozen=True)
class Guess:
    """What a slip most likely was."""

    said: str = ""  # for people; nothing if nobody knows
    corrected: tuple[float, ...] | None = None  # [mm] the reading that was meant


def _guess(
    read: tuple[float, ...],
    offset: tuple[float, ...],
    sigma: tuple[float, ...],
    sheet: tuple[float, float],
) -> Guess:
    """The first usual mistake that agrees with the shift in every coordinate."""
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
        """In the machine frame."""
        places: np.ndarray = self.sign * (numbers - self.middle)
        return places


def _as_read(read: np.ndarray, sheet: tuple[float, float]) -> list[_Frame]:
    """The reading as counted from the middle of the sheet, and from its top-left corner."""
    if len(read) == 1:
        return [_Frame(read, np.zeros(1), np.ones(1))]
    sign, middle = np.array([1.0, -1.0]), np.array(sheet) / 2
    return [
        _Frame(read, np.zeros(2), np.ones(2)),
        _Frame(sign * read + middle, middle, sign),
    ]


def _transposed(number: float) -> list[float]:
    """The number with two neighbouring digits transposed, whole millimetres and tenths."""
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
    """A single coordinate off by what a tape or a ruler is misread by."""
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
