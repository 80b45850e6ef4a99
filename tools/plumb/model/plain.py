"""Sizes and effects in a maker's words: `left chain 0.24 % too long (0.21 to 0.27)`.

The words of an effect are in its file (`plain`); here they become sentences.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from plumb.model.catalogue import every_effect, parameter_words
from plumb.model.predict import frame_words
from plumb.text.values import INCHES, Unit

if TYPE_CHECKING:
    from plumb.model.predict import PlainWords


PER_METRE, PER_FOOT = "for each metre", "for each foot"
FOOT = 0.3048  # [m]

# The origin of the marks is not a number of the machine, so its words are here.
SHEET: dict[str, PlainWords] = {
    "sheet_rotation": {
        "more": f"sheet turned by # {PER_METRE}",
        "less": "",
        "unit": "mm",
        "times": 1000.0,
        "shown": "as is",
    }
}


def plain_name(name: str) -> str:
    """Return a number of the frame in a maker's words; `effect.parameter` stays as it is."""
    nouns = {words["name"]: words["noun"] for words in frame_words()}
    return {**nouns, "sheet_rotation": "turn of the sheet"}.get(name, name)


def noun_of(effect: str) -> str:
    """Return the effect in a maker's words, like `chain sag`."""
    return next((words["noun"] for words in every_effect() if words["name"] == effect), effect)


def plainly(effects: Iterable[str]) -> str:
    """Effects that act together in a maker's words; an explanation may have no effect."""
    *others, final = [noun_of(effect) for effect in effects] or ["the frame alone"]
    return f"{', '.join(others)} and {final}" if others else final


def plain_size(
    name: str, value: float, low: float | None = None, high: float | None = None, *, unit: Unit
) -> str:
    """Return a parameter of an effect with its size and, in brackets, its interval."""
    words = words_of(name)
    below = value < 0 and bool(words["less"])
    sign = -1.0 if below else 1.0
    shown, *ends = [
        shown_size(words, sign * number, unit)
        for number in (value, *((low, high) if low is not None and high is not None else ()))
    ]
    digits = digits_for(shown, ends)
    said = in_feet(words["less"] if below else words["more"], unit)
    said = said.replace("#", f"{_rounded(shown, digits)} {_unit(words, unit)}")
    if not ends:
        return said
    least, most = (_rounded(end, digits) for end in sorted(ends))
    return f"{said} ({least} to {most})"


def plain_before(
    name: str, value: float, low: float | None = None, high: float | None = None, *, unit: Unit
) -> str:
    """Return a size as it was before, in the unit of its words; as fine as the interval that it has
    now, or nobody could tell how far it moved.
    """
    words = words_of(name)
    shown = shown_size(words, value, unit)
    ends = [shown_size(words, end, unit) for end in (low, high) if end is not None]
    return f"{_rounded(shown, digits_for(shown, ends))} {_unit(words, unit)}" if shown else "0"


def plain_range(name: str, low: float, high: float, unit: Unit) -> str:
    """From the smallest to the largest size that real machines have, in the unit of its words."""
    words = words_of(name)
    ends = sorted(shown_size(words, end, unit) for end in (low, high))
    digits = digits_for(max(map(abs, ends)), [])
    return f"{_rounded(ends[0], digits)} to {_rounded(ends[1], digits)} {_unit(words, unit)}"


def words_of(name: str) -> PlainWords:
    """Return the words of `effect.parameter`; its name where it has none."""
    if name in SHEET:
        return SHEET[name]
    parameter = parameter_words().get(name)
    if parameter and parameter["plain"]:
        return parameter["plain"]
    frame = {words["name"]: words for words in frame_words()}
    if name in frame:
        noun, shown = frame[name]["noun"], frame[name]["unit"]
    else:
        noun, shown = name, parameter["unit"] if parameter else ""
    return {"more": f"{noun} #", "less": "", "unit": shown, "times": 1.0, "shown": "as is"}


def shown_size(words: PlainWords, value: float, unit: Unit) -> float:
    """Return the size as it is shown, in the unit of its words; the sign stays."""
    size = value * words["times"]
    if words["shown"] != "as is":
        size = math.copysign(math.sqrt(abs(size)), size)
    if words["shown"] not in ("as is", "root"):
        return math.degrees(math.atan(size))
    if words["unit"] != "mm":
        return size
    per_foot = FOOT if PER_METRE in words["more"] and unit == INCHES else 1.0
    return unit.of(size) * per_foot


def in_feet(said: str, unit: Unit) -> str:
    """Return words for a length of a metre for a foot, where lengths are shown in inches."""
    return said.replace(PER_METRE, PER_FOOT) if unit == INCHES else said


def _unit(words: PlainWords, unit: Unit) -> str:
    """Return the unit of the words; a length has the unit in which lengths are shown."""
    return unit.name if words["unit"] == "mm" else words["unit"]


def digits_for(shown: float, ends: list[float]) -> int:
    """Decimals that are worth showing: two figures of the interval's half, three of the size."""
    scale = abs(ends[1] - ends[0]) / 2 / 3 if ends else abs(shown) / 100
    if scale <= 0 or not math.isfinite(scale):
        return 2
    return max(0, min(6, -math.floor(math.log10(scale))))


def _rounded(value: float, digits: int) -> str:
    return f"{round(value, digits) + 0.0:.{digits}f}"


@dataclass(frozen=True)
class PlainChange:
    """A number before and after, with its 95 % margin, as text in a single unit."""

    noun: str
    before: str
    after: str
    margin: str
    unit: str

    @property
    def shift(self) -> str:
        """The signed distance that it moved."""
        digits = len(self.after.partition(".")[2])
        return f"{float(self.after) - float(self.before):+.{digits}f}"


def plain_change(
    name: str, before: float, value: float, low: float, high: float, unit: Unit
) -> PlainChange:
    """Return how a number changes, in a maker's words."""
    words = words_of(name)
    was, now, *ends = (shown_size(words, number, unit) for number in (before, value, low, high))
    digits = digits_for(now, ends)
    noun = " ".join(in_feet(words["more"], unit).replace("#", "").split())
    margin = _rounded(abs(ends[1] - ends[0]) / 2, digits)
    return PlainChange(
        noun, _rounded(was, digits), _rounded(now, digits), margin, _unit(words, unit)
    )


# The order of computed numbers, the same on every processor.
#
# Rounding differs between processors. So numbers that are equal but for rounding tie, and what ties
# keeps the order in which it came: give it in an order that means something.

Item = TypeVar("Item")
# Of chi-squares, logarithms, mm or shares: above the rounding of a fit, and nothing to anybody.
TIE = 1e-7  # as a difference, and as a share of numbers above 1


def ranked(items: Iterable[Item], key: Callable[[Item], float]) -> list[Item]:
    """Return the items, that with the least number first."""
    each = list(items)
    return [each[i] for i in ascending([key(item) for item in each])]


def ascending(numbers: ArrayLike) -> NDArray[np.int_]:
    """Return the places of the numbers, the least first."""
    flat = np.asarray(numbers, dtype=float).ravel()
    order = np.argsort(flat, kind="stable")
    low, high = flat[order][:-1], flat[order][1:]
    with np.errstate(invalid="ignore"):  # infinite numbers tie
        apart = high - low > TIE * np.maximum(1.0, np.minimum(np.abs(low), np.abs(high)))
    if apart.all():
        return order
    ties = np.zeros(len(flat), dtype=int)
    np.cumsum(apart, out=ties[1:])
    return order[np.lexsort((order, ties))]


def least(numbers: ArrayLike) -> int:
    """Return the place of the least number, counted through the rows of a table."""
    return int(ascending(numbers)[0])


def greatest(numbers: ArrayLike) -> int:
    """Return the place of the greatest number, counted likewise."""
    return least(-np.asarray(numbers, dtype=float))
