"""What a game hides: a level for people, or a kind that a row of the matrix is about."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from plumb.bench.boards import size_for
from plumb.bench.causes import CAUSES, OUTSIDE, Cause, Hidden
from plumb.bench.hiding import LARGE, REAL, by_effect
from plumb.model.catalogue import every_effect
from plumb.vm.hiding import BOARD

FIRMWARE = tuple(effect["name"] for effect in every_effect() if effect["where"] == "firmware")
CURABLE = tuple(cause for cause in REAL if cause.effect in FIRMWARE)
CURABLE_LARGE = tuple(cause for cause in LARGE if cause.effect in FIRMWARE)
USUAL_MM = 3.0  # RMS by which a hidden effect moves marks
LARGEST = 4.0  # typical sizes; a machine with more of it would be seen to be broken
SLIP_MM = 10.0  # by which a reading is wrong


@dataclass(frozen=True)
class Secret:
    """What is wrong with a machine, and with a reading of its first sheet."""

    hidden: Hidden
    slip: float = 0.0  # [mm]


@dataclass(frozen=True)
class Level:
    """How hard a game is."""

    words: str
    secret: Callable[[np.random.Generator], Secret]


def _drawn(
    source: np.random.Generator, causes: tuple[Cause, ...], count: int, millimetres: float
) -> Hidden:
    """Some different effects, each with the same RMS."""
    effects = by_effect(causes)
    chosen = [effects[i] for i in source.choice(len(effects), count, replace=False)]
    each = [of_effect[source.integers(len(of_effect))] for of_effect in chosen]
    return Hidden(tuple((cause, size_for(cause, BOARD, millimetres)) for cause in each))


def _unknown(source: np.random.Generator) -> Hidden:
    """What the library has no word for."""
    return Hidden(outside=list(OUTSIDE)[source.integers(len(OUTSIDE))], outside_mm=USUAL_MM)


LEVELS: Mapping[int, Level] = {
    1: Level("one effect, large", lambda source: Secret(_drawn(source, CURABLE_LARGE, 1, 6.0))),
    2: Level("one effect that others look like", lambda s: Secret(_drawn(s, CURABLE, 1, 2.0))),
    3: Level("two effects at once", lambda s: Secret(_drawn(s, CURABLE_LARGE, 2, 4.0))),
    4: Level("something that is not in the library", lambda s: Secret(_unknown(s))),
    5: Level(
        "one effect, and a reading that is wrong",
        lambda s: Secret(_drawn(s, CURABLE, 1, USUAL_MM), SLIP_MM),
    ),
}


def of_level(number: int, seed: int) -> Secret:
    """What a game of a level hides."""
    return LEVELS[number].secret(np.random.default_rng([seed, number, 17]))


def _of_effect(name: str) -> Callable[[np.random.Generator], Secret]:
    """An effect in one of its directions, by as much as usual or as real machines have it."""

    def secret(source: np.random.Generator) -> Secret:
        causes = [cause for cause in CAUSES if cause.effect == name]
        cause = causes[source.integers(len(causes))]
        size = min(LARGEST, size_for(cause, BOARD, USUAL_MM))
        return Secret(Hidden(((cause, size),)))

    return secret


# What the rows of the matrix hide. Friction and backlash are on every machine.
KINDS: Mapping[str, Callable[[np.random.Generator], Secret]] = {
    **{name: _of_effect(name) for name in FIRMWARE},
    "two": lambda source: Secret(_drawn(source, CURABLE_LARGE, 2, USUAL_MM)),
    "none": lambda source: Secret(Hidden()),
    "unknown": lambda source: Secret(_unknown(source)),
}


def of_kind(kind: str, seed: int) -> Secret:
    """What a game of a row of the matrix hides."""
    return KINDS[kind](np.random.default_rng([seed, list(KINDS).index(kind), 19]))
