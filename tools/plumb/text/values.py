"""Single checks on values that people type; each raises ValueError with a sentence for them."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from difflib import get_close_matches

_DECIMAL = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?", re.ASCII)


def number_in(text: str) -> float:
    """The finite number that a piece of text writes out, and nothing else."""
    stripped = text.strip()
    if not stripped:
        raise ValueError("a number is missing")
    if stripped.lower().lstrip("+-") in ("nan", "inf", "infinity"):
        raise ValueError(f"'{stripped}' is not a usable number")
    if re.fullmatch(r"[+-]?\d+,\d+", stripped):
        raise ValueError(f"'{stripped}' has a decimal comma; write a decimal point")
    if not _DECIMAL.fullmatch(stripped):
        raise ValueError(f"'{_short(stripped)}' is not a number; write it with digits and a point")
    return _finite(float(stripped))


def number(value: object) -> float:
    """The finite number that a TOML value is; text and true/false are refused."""
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        shown = f"'{_short(value)}'" if isinstance(value, str) else type(value).__name__
        raise ValueError(f"a number is needed, not {shown}; write it without quotes")
    try:
        return _finite(float(value))
    except OverflowError:
        raise ValueError("the number is too large") from None


def pair(value: object) -> tuple[float, float]:
    """The two finite numbers of a TOML array `[a, b]`."""
    if not isinstance(value, list) or len(value) != 2:
        raise ValueError("two numbers are needed, as [x, y]")
    return number(value[0]), number(value[1])


def numbers(value: object, count: int) -> tuple[float, ...]:
    """The finite numbers of a TOML array of that length."""
    if not isinstance(value, list) or len(value) != count:
        raise ValueError(f"an array of {count} numbers is needed")
    return tuple(number(each) for each in value)


def texts(value: object) -> tuple[str, ...]:
    """The texts of a TOML array."""
    if not isinstance(value, list):
        raise ValueError("an array of texts in quotes is needed")
    return tuple(text_of(each) for each in value)


def text_of(value: object) -> str:
    """The text of a TOML string."""
    if not isinstance(value, str):
        raise ValueError("text in quotes is needed")
    return value


def one_of(value: object, allowed: Iterable[str]) -> str:
    """The value, if it is an allowed word."""
    words = tuple(allowed)
    if not isinstance(value, str) or value not in words:
        raise ValueError(f"'{_short(value)}' is not known; write one of {', '.join(words)}")
    return value


def refuse_unknown(keys: Iterable[str], allowed: Iterable[str]) -> None:
    """Refuse the first key that is not allowed, with the nearest allowed key as a hint."""
    words = tuple(allowed)
    for key in keys:
        if key not in words:
            near = get_close_matches(key.lower(), words, 1)
            known = ", ".join(words) or "none"
            hint = f"did you mean {near[0]}?" if near else f"known are: {known}"
            raise ValueError(f"unknown name '{_short(key)}'; {hint}")


def within(value: float, low: float, high: float) -> float:
    """The value, if it lies between the two limits."""
    if not low <= value <= high:
        raise ValueError(f"{value:g} is out of range; {low:g} to {high:g} is possible")
    return value


def _finite(value: float) -> float:
    if not math.isfinite(value):
        raise ValueError(f"{value} is not a usable number")
    return value


def _short(value: object) -> str:
    text = " ".join(str(value).split())
    return text if len(text) <= 40 else text[:37] + "..."
