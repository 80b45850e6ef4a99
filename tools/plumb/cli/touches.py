"""The touches of a command line; a hole may be named as a home mark."""

from __future__ import annotations

import argparse
import math
from collections.abc import Sequence

from plumb.job.home import HomeMark, Touch, home_file, lost_sign, read_home_marks, refuse_repeated
from plumb.text.errors import InputError


def touches_of(arguments: argparse.Namespace) -> tuple[Touch, ...]:
    """Return the touches, numbered, those of home marks by name. Raises InputError for a hole
    twice.
    """
    touches = []
    for number, (hole, shown) in enumerate(arguments.touch, 1):
        if isinstance(hole, str):
            mark = home_mark(arguments.settings, hole)
            touches.append(Touch(hole, mark.place, shown))
        else:
            touches.append(Touch(str(number), hole, shown))
    refuse_repeated(touches)
    return tuple(touches)


def home_mark(settings: str, name: str) -> HomeMark:
    """Return the home mark of that name, kept next to the settings. Raises InputError."""
    path = home_file(settings)
    marks = read_home_marks(path)
    if name not in marks:
        known = f"it has {', '.join(marks)}" if marks else "there is none yet: plumb home --keep"
        raise InputError(f"{path}: no home mark {name!r}; {known}")
    return marks[name]


def asked_signs(touches: Sequence[Touch]) -> list[str]:
    """Return a question about each touch that seems to have lost a minus sign."""
    return [
        f"Touch {touch.name}: has {name} lost its sign? The other sign lies near the hole."
        for touch in touches
        if (name := lost_sign(touch))
    ]


# The option --touch: a mark with the bit in it, and what the machine shows there.

Point = tuple[float, float]


def add_touch(parser: argparse.ArgumentParser, *, meaning: str) -> None:
    """Add the option --touch."""
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
    """Read HOLE:SHOWN; a hole is a place or a name."""
    hole, separator, shown = text.rpartition(":")
    if not (separator and hole):
        raise argparse.ArgumentTypeError(f"'{text}' is not HOLE:SHOWN, like -900,250:-896.2,253.1")
    return (point(hole) if "," in hole else hole), point(shown)


def point(text: str) -> Point:
    """Read x,y [mm, from the middle of the sheet, y up]."""
    try:
        x, y = map(float, text.split(","))
    except ValueError:
        x = y = math.nan
    if not (math.isfinite(x) and math.isfinite(y)):
        raise argparse.ArgumentTypeError(f"'{text}' is no place x,y in mm, like -900,250")
    return x, y
