"""The option --touch: a mark with the bit in it, and what the machine shows there."""

from __future__ import annotations

import argparse
import math

Point = tuple[float, float]


def add_touch(parser: argparse.ArgumentParser, *, meaning: str) -> None:
    """The option --touch."""
    parser.add_argument(
        "--touch",
        metavar="HOLE:SHOWN",
        action="append",
        type=touch,
        default=[],
        help=f"{meaning}, like --touch=-900,250:-896.2,253.1 (x,y of the hole, or the name of a "
        "home mark; then what the machine shows with the bit in it)",
    )


def touch(text: str) -> tuple[str | Point, Point]:
    """Reads HOLE:SHOWN; a hole is a place or a name."""
    hole, separator, shown = text.rpartition(":")
    if not (separator and hole):
        raise argparse.ArgumentTypeError(f"'{text}' is not HOLE:SHOWN, like -900,250:-896.2,253.1")
    return (point(hole) if "," in hole else hole), point(shown)


def point(text: str) -> Point:
    """Reads x,y [mm, from the middle of the sheet, y up]."""
    try:
        x, y = map(float, text.split(","))
    except ValueError:
        x = y = math.nan
    if not (math.isfinite(x) and math.isfinite(y)):
        raise argparse.ArgumentTypeError(f"'{text}' is no place x,y in mm, like -900,250")
    return x, y
