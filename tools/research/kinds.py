"""What a game hides: a kind that a row of the matrix is about."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from plumb.bench.boards import size_for
from plumb.bench.causes import CAUSES, OUTSIDE, Cause, Hidden
from plumb.bench.hiding import LARGE, REAL, by_effect
from plumb.model.catalogue import every_effect
from plumb.vm.garage import BOARD

FIRMWARE = tuple(effect["name"] for effect in every_effect() if effect["where"] == "firmware")
CURABLE = tuple(cause for cause in REAL if cause.effect in FIRMWARE)
CURABLE_LARGE = tuple(cause for cause in LARGE if cause.effect in FIRMWARE)
USUAL_MM = 3.0  # RMS by which a hidden effect moves marks
LARGEST = 4.0  # typical sizes; a machine with more of it would be seen to be broken


def _drawn(
    source: np.random.Generator, causes: tuple[Cause, ...], count: int, millimetres: float
) -> Hidden:
    """Return some different effects, each with the same RMS."""
    effects = by_effect(causes)
    chosen = [effects[i] for i in source.choice(len(effects), count, replace=False)]
    each = [of_effect[source.integers(len(of_effect))] for of_effect in chosen]
    return Hidden(tuple((cause, size_for(cause, BOARD, millimetres)) for cause in each))


def _unknown(source: np.random.Generator) -> Hidden:
    """Return what the library has no word for."""
    return Hidden(outside=list(OUTSIDE)[source.integers(len(OUTSIDE))], outside_mm=USUAL_MM)


def _of_effect(name: str) -> Callable[[np.random.Generator], Hidden]:
    """Return an effect in one of its directions, by as much as usual or as real machines
    have it.
    """

    def hidden(source: np.random.Generator) -> Hidden:
        causes = [cause for cause in CAUSES if cause.effect == name]
        cause = causes[source.integers(len(causes))]
        size = min(LARGEST, size_for(cause, BOARD, USUAL_MM))
        return Hidden(((cause, size),))

    return hidden


# What the rows of the matrix hide. Friction and backlash are on every machine.
KINDS: Mapping[str, Callable[[np.random.Generator], Hidden]] = {
    **{name: _of_effect(name) for name in FIRMWARE},
    "two": lambda source: _drawn(source, CURABLE_LARGE, 2, USUAL_MM),
    "none": lambda source: Hidden(),
    "unknown": _unknown,
}


def of_kind(kind: str, seed: int) -> Hidden:
    """Return what a game of a row of the matrix hides."""
    return KINDS[kind](np.random.default_rng([seed, list(KINDS).index(kind), 19]))
