"""Single checks on values that people type; each raises ValueError with a sentence for them."""

import math
import re
from collections.abc import Iterable
from dataclasses import dataclass
from difflib import get_close_matches

_DECIMAL = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?", re.ASCII)


def number_in(text: str) -> float:
    """Return the finite number that a piece of text writes out, and nothing else."""
    stripped = text.strip()
    if not stripped:
        raise ValueError("a number is missing")
    if stripped.lower().lstrip("+-") in ("nan", "inf", "infinity"):
        raise ValueError(f"'{stripped}' is not a usable number")
    if re.fullmatch(r"[+-]?\d+,\d+", stripped):
        raise ValueError(f"'{stripped}' has a decimal comma; write a decimal point")
    if not _DECIMAL.fullmatch(stripped):
        raise ValueError(
            f"'{shortened(stripped)}' is not a number; write it with digits and a point"
        )
    return _finite(float(stripped))


def number(value: object) -> float:
    """Return the finite number that a TOML value is; text and true/false are refused."""
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        shown = f"'{shortened(value)}'" if isinstance(value, str) else type(value).__name__
        raise ValueError(f"a number is needed, not {shown}; write it without quotes")
    try:
        return _finite(float(value))
    except OverflowError:
        raise ValueError("the number is too large") from None


def pair(value: object) -> tuple[float, float]:
    """Return the two finite numbers of a TOML array `[a, b]`."""
    if not isinstance(value, list) or len(value) != 2:
        raise ValueError("two numbers are needed, as [x, y]")
    return number(value[0]), number(value[1])


def numbers(value: object, count: int) -> tuple[float, ...]:
    """Return the finite numbers of a TOML array of that length."""
    if not isinstance(value, list) or len(value) != count:
        raise ValueError(f"an array of {count} numbers is needed")
    return tuple(number(each) for each in value)


def refuse_unknown(keys: Iterable[str], allowed: Iterable[str]) -> None:
    """Refuse the first key that is not allowed, with the nearest allowed key as a hint."""
    words = tuple(allowed)
    for key in keys:
        if key not in words:
            near = get_close_matches(key.lower(), words, 1)
            known = ", ".join(words) or "none"
            hint = f"did you mean {near[0]}?" if near else f"known are: {known}"
            raise ValueError(f"unknown name '{shortened(key)}'; {hint}")


def within(value: float, low: float, high: float) -> float:
    """Return the value, if it lies between the two limits."""
    if not low <= value <= high:
        raise ValueError(f"{value:g} is out of range; {low:g} to {high:g} is possible")
    return value


def _finite(value: float) -> float:
    if not math.isfinite(value):
        raise ValueError(f"{value} is not a usable number")
    return value


def shortened(value: object) -> str:
    """Return a typed value, as a message can show it."""
    text = " ".join(str(value).split())
    return text if len(text) <= 40 else text[:37] + "..."


# Lengths as people are shown them: in mm, or in inches where they ask for or type those.
#
# Files, JSON and pictures stay in mm.

INCH = 25.4  # [mm]


@dataclass(frozen=True)
class Unit:
    """The unit in which lengths are shown."""

    name: str
    size: float  # [mm]
    finer: int = 0  # decimals more than in mm: a size stays as fine as it was

    def of(self, length: float) -> float:
        """Return a length [mm] in this unit."""
        return length / self.size

    def bare(self, length: float | None, digits: int = 2) -> str:
        """Return a length [mm] without the unit, with this many decimals if it is in mm; a dash
        for none.
        """
        if length is None or not math.isfinite(length):
            return "-"
        # No zero has a sign: that of a rounded number is chance.
        return f"{self.of(length):z.{digits + self.finer}f}"

    def signed(self, length: float | None) -> str:
        """Return the same with its sign."""
        return "-" if length is None else f"{self.of(length):+z.{2 + self.finer}f}"

    def worded(self, length: float | None, digits: int = 2) -> str:
        """Return a length [mm] with the unit."""
        return f"{self.bare(length, digits)} {self.name}"

    def brief(self, length: float) -> str:
        """Return a chosen length [mm], with the unit and no more decimals than it needs."""
        return f"{round(self.of(length), 2):g} {self.name}"

    def reading(self, words: str) -> str:
        """Return words that hold their lengths in both units, in this one."""
        return words.inches if self.finer and isinstance(words, _InBoth) else words


MM, INCHES = Unit("mm", 1.0), Unit("inch", INCH, finer=1)


def unit_called(name: str) -> Unit:
    """Return the unit of this name, of UNITS."""
    return INCHES if name == INCHES.name else MM


# Words with chosen lengths, each in both units: `read to {0.2 mm|0.0079 inch}`.

_LENGTH = re.compile(r"\{(.*?)\|(.*?)\}")


class _InBoth(str):
    """Words with lengths in mm, which know those in inches; in an f-string they lose these."""

    inches: str


def in_both_units(words: str) -> str:
    """Return words as they read in mm; Unit.reading() has them in inches."""
    said = _InBoth(_LENGTH.sub(r"\1", words))
    said.inches = _LENGTH.sub(r"\2", words)
    return said


# Lengths as people type them: millimetres or inches, decimals or fractions like 47 7/8.

UNITS = {unit.name: unit.size for unit in (MM, INCHES)}  # [mm] of each
# A whole number and a fraction, or either: 47 7/8, 47-7/8, 7/8; an inch sign may follow.
_FRACTION = re.compile(r"(?P<sign>[+-]?)(?:(?P<whole>\d+)[ -]+)?(?P<top>\d+)\s*/\s*(?P<below>\d+)")


def length_in(text: str, *, unit: float = 1.0) -> float:
    """Return the length [mm] that a piece of text writes out, in units of this many mm."""
    stripped = text.strip()
    if unit != 1.0:
        stripped = stripped.removesuffix("in").removesuffix('"').strip()
    match = _FRACTION.fullmatch(stripped)
    if not match:
        return unit * number_in(stripped)
    below = int(match["below"])
    if not below:
        raise ValueError(f"'{stripped}' divides by zero")
    size = int(match["whole"] or 0) + int(match["top"]) / below
    return unit * (-size if match["sign"] == "-" else size)


_TYPED = re.compile(r"(.*?)\s*(mm|in|inch|inches|\")?")


def typed_length(text: str) -> float:
    """Return the length [mm] that an option takes: `120`, `120mm`, `4-3/4in` or `3/4"`; without a
    unit it is in mm. ValueError for anything else.
    """
    match = _TYPED.fullmatch(text.strip())
    size, unit = match.groups() if match else ("", None)
    if unit in (None, "mm") and "/" in size:
        raise ValueError(f"'{text}' is a fraction: write {size}in")
    return length_in(size, unit=1.0 if unit in (None, "mm") else INCH)


def length(value: object, *, unit: float = 1.0) -> float:
    """Return the length [mm] that a TOML value is: a number, or a fraction of inches in quotes."""
    if isinstance(value, str) and "/" in value:
        if unit == 1.0:
            raise ValueError(
                f"'{shortened(value)}' is a fraction, and this is in mm; write units = \"inch\" at "
                "the top of the file (or inch = for a distance)"
            )
        return length_in(value, unit=unit)
    return unit * number(value)


_ASIDE = re.compile(r"(\"(?:[^\"\\]|\\.)*\"|'[^']*'|#[^\n]*)")  # what TOML quotes, and comments
_BARE_FRACTION = re.compile(
    r"(?<=[\[,=])([ \t]*)([+-]?(?:\d+[ -]+)?\d+[ \t]*/[ \t]*\d+)(?=[ \t]*(?:[\],\r\n]|$))"
)


def with_quoted_fractions(text: str) -> str:
    """Return TOML in which fractions are quoted; a maker writes [3 7/8, 4 3/16]."""
    parts = _ASIDE.split(text)
    parts[::2] = [_BARE_FRACTION.sub(r'\1"\2"', part) for part in parts[::2]]
    return "".join(parts)


def point(value: object, *, unit: float = 1.0) -> tuple[float, float]:
    """Return the two lengths [mm] of a TOML array `[x, y]`."""
    if isinstance(value, list) and len(value) in (3, 4):
        raise ValueError(
            "two numbers are needed, as [x, y]; is a comma a decimal point? Write [12.5, 3]"
        )
    if not isinstance(value, list) or len(value) != 2:
        raise ValueError("two numbers are needed, as [x, y]")
    return length(value[0], unit=unit), length(value[1], unit=unit)


def time_text(seconds: float) -> str:
    """Return a time for people."""
    whole = round(seconds)
    hours, minutes = whole // 3600, whole // 60 % 60
    if hours:
        return f"{hours} h {minutes} min"
    return f"{minutes} min {whole % 60} s" if minutes else f"{whole} s"
