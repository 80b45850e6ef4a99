"""What is hidden in a virtual machine: effects by name, or one that is drawn."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from plumb.bench.boards import plan, size_for
from plumb.bench.causes import OUTSIDE, Cause, Hidden, causes_of
from plumb.bench.hiding import REAL
from plumb.text.errors import InputError, to_do
from plumb.text.values import refuse_unknown

Array = np.ndarray
RANDOM = "random"
BOARD = plan(5, 5)  # on which an effect moves marks by this many millimetres RMS


def hide(names: Sequence[str], *, millimetres: float, seed: int) -> Hidden:
    """Effects that move marks by so much RMS each, before a frame is refitted.

    The name `random` draws one that real machines have. Raises InputError for an unknown name.
    """
    known = sorted({cause.effect for cause in REAL})
    try:
        refuse_unknown([name for name in names if name != RANDOM], known)
    except ValueError as error:
        raise InputError(f"{to_do('--hide', page='hidden:')} {error}") from None
    source = np.random.default_rng([seed, 11])
    causes = [_drawn(source) if name == RANDOM else _one_of(name, source) for name in names]
    return Hidden(tuple((cause, size_for(cause, BOARD, millimetres)) for cause in causes))


def astray(hidden: Hidden, places: Array, seed: int) -> Array:
    """How far (n, 2) [mm] the sled is off at places by what the library has no word for."""
    if not hidden.outside:
        return np.zeros_like(places)

    def field(at: Array) -> Array:
        return OUTSIDE[hidden.outside](at, np.random.default_rng([seed, 13]))

    length = np.sqrt(np.mean(np.sum(field(BOARD.targets) ** 2, axis=1)))
    moved: Array = field(places) * hidden.outside_mm / max(float(length), 1e-9)
    return moved


def described(hidden: Hidden) -> str:
    """What is hidden, in a few words."""
    said = [f"{cause.effect} ({cause.label})" for cause, _ in hidden.causes]
    said += [f"a {hidden.outside}, which no effect explains"] if hidden.outside else []
    return " and ".join(said) or "nothing"


def _drawn(source: np.random.Generator) -> Cause:
    """One that the firmware can correct; a wrong tape would stay wrong on the next sheet."""
    effects = sorted({cause.effect for cause in REAL if not (cause.skew or cause.strain)})
    return _one_of(effects[source.integers(len(effects))], source)


def _one_of(effect: str, source: np.random.Generator) -> Cause:
    """One of the directions that an effect has."""
    several = [cause for cause in causes_of(effect) if cause in REAL]
    return several[source.integers(len(several))]
