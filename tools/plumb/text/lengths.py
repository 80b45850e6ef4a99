"""Lengths as people type them: millimetres or inches, decimals or fractions like 47 7/8."""

from __future__ import annotations

import re

from plumb.text.values import number, number_in

INCH = 25.4  # [mm]
UNITS = {"mm": 1.0, "inch": INCH}  # [mm] of each
# A whole number and a fraction, or either: 47 7/8, 47-7/8, 7/8; an inch sign may follow.
_FRACTION = re.compile(r"(?P<sign>[+-]?)(?:(?P<whole>\d+)[ -]+)?(?P<top>\d+)\s*/\s*(?P<below>\d+)")


def length_in(text: str, *, unit: float = 1.0) -> float:
    """The length [mm] that a piece of text writes out, in units of this many mm."""
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


def length(value: object, *, unit: float = 1.0) -> float:
    """The length [mm] that a TOML value is: a number, or a fraction in quotes."""
    if isinstance(value, str) and "/" in value:
        return length_in(value, unit=unit)
    return unit * number(value)


def point(value: object, *, unit: float = 1.0) -> tuple[float, float]:
    """The two lengths [mm] of a TOML array `[x, y]`."""
    if isinstance(value, list) and len(value) in (3, 4):
        raise ValueError(
            "two numbers are needed, as [x, y]; is a comma a decimal point? Write [12.5, 3]"
        )
    if not isinstance(value, list) or len(value) != 2:
        raise ValueError("two numbers are needed, as [x, y]")
    return length(value[0], unit=unit), length(value[1], unit=unit)
