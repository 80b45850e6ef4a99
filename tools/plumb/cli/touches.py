"""The touches of a command line; a hole may be named as a home mark."""

from __future__ import annotations

import argparse
from collections.abc import Sequence

from plumb.recovery.home import HomeMark, home_file, read_home_marks
from plumb.recovery.touched import Touch, lost_sign, refuse_repeated
from plumb.text.errors import InputError


def touches_of(arguments: argparse.Namespace) -> tuple[Touch, ...]:
    """The touches, numbered, those of home marks by name. Raises InputError for a hole twice."""
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
    """The home mark of that name, kept next to the settings. Raises InputError."""
    path = home_file(settings)
    marks = read_home_marks(path)
    if name not in marks:
        known = f"it has {', '.join(marks)}" if marks else "there is none yet: plumb home --keep"
        raise InputError(f"{path}: no home mark {name!r}; {known}")
    return marks[name]


def asked_signs(touches: Sequence[Touch]) -> list[str]:
    """A question about each touch that seems to have lost a minus sign."""
    return [
        f"Touch {touch.name}: has {name} lost its sign? The other sign lies near the hole."
        for touch in touches
        if (name := lost_sign(touch))
    ]
