"""What is hidden in the boards of a scenario, one board after the other, and slips of the pen."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from plumb.bench.boards import BoardCut, size_for
from plumb.bench.causes import CAUSES, OUTSIDE, Cause, Hidden, Plan, causes_of

LARGEST_DRAG = 1.5  # typical sizes of friction beyond which lower corners stick for centimetres
SLIP_MM = 5.0

# What is hidden in board number i of a scenario, on this plan.
Hide = Callable[[int, Plan], Hidden]
REAL_MM, LARGE_MM = 3.0, 6.0  # how far marks are moved
# What real machines can have by so much; friction by millimetres sticks for centimetres elsewhere.
OUTSIDE_FRAME = tuple(cause for cause in CAUSES if not cause.in_frame)
REAL = tuple(cause for cause in OUTSIDE_FRAME if cause.most >= REAL_MM and not cause.drag)
HUGE = tuple(cause for cause in OUTSIDE_FRAME if cause.most < REAL_MM)
LARGE = tuple(cause for cause in REAL if cause.most >= LARGE_MM)
SMALL = OUTSIDE_FRAME


def nothing(index: int, plan: Plan) -> Hidden:
    """Only the frame is off."""
    return Hidden()


def by_effect(causes: tuple[Cause, ...]) -> tuple[tuple[Cause, ...], ...]:
    """Return the causes of each effect."""
    return tuple(
        tuple(cause for cause in causes if cause.effect == effect)
        for effect in dict.fromkeys(cause.effect for cause in causes)
    )


def _turns(causes: tuple[Cause, ...], index: int) -> Cause:
    """Effects take turns, and so do the causes of each."""
    effects = by_effect(causes)
    of_effect = effects[index % len(effects)]
    return of_effect[index // len(effects) % len(of_effect)]


def raw(millimetres: float, causes: tuple[Cause, ...]) -> Hide:
    """Return one cause after the other, as large as moves marks by so much RMS before any refit."""

    def hide(index: int, plan: Plan) -> Hidden:
        cause = _turns(causes, index)
        return Hidden(((cause, size_for(cause, plan, millimetres)),))

    return hide


def typical(low: float, high: float, causes: tuple[Cause, ...]) -> Hide:
    """Return one cause after the other, of some typical sizes."""

    def hide(index: int, plan: Plan) -> Hidden:
        cause = _turns(causes, index)
        share = np.random.default_rng(index).uniform()
        size = low + (high - low) * share
        return Hidden(((cause, min(size, LARGEST_DRAG) if cause.drag else size),))

    return hide


def pairs(millimetres: float, causes: tuple[Cause, ...]) -> Hide:
    """Two effects at once, each of so much RMS; all pairs take turns."""
    both = list(combinations(causes, 2))
    both = [both[i] for i in np.random.default_rng(7).permutation(len(both))]
    both = [(a, b) for a, b in both if a.effect != b.effect]

    def hide(index: int, plan: Plan) -> Hidden:
        return Hidden(
            tuple((cause, size_for(cause, plan, millimetres)) for cause in both[index % len(both)])
        )

    return hide


def several(count: int, low: float, high: float, causes: tuple[Cause, ...]) -> Hide:
    """Several effects at once, drawn by chance, each of some typical sizes."""
    effects = by_effect(causes)

    def hide(index: int, plan: Plan) -> Hidden:
        source = np.random.default_rng(1000 + index)
        hidden = []
        for i in source.choice(len(effects), count, replace=False):
            cause = effects[i][int(source.integers(len(effects[i])))]
            size = float(source.uniform(low, high))
            hidden.append((cause, min(size, LARGEST_DRAG) if cause.drag else size))
        return Hidden(tuple(hidden))

    return hide


def usual_machine(index: int, plan: Plan) -> Hidden:
    """Return what every machine has: a chain that stretches more or less than usual, which
    published settings leave out, a chain a bit heavier or lighter, friction and backlash; and next
    to that one or two effects of usual size.
    """
    source = np.random.default_rng(5000 + index)
    (stretch,), (sag,) = causes_of("chain_stretch"), causes_of("chain_sag")
    friction = causes_of("sled_friction")[0]
    others = tuple(cause for cause in SMALL if cause.effect not in ("chain_stretch", "chain_sag"))
    anomalies = several(1 + index % 2, 1.0, 2.0, others)(index, plan)
    rubs = 0.0 if friction.effect in anomalies.effects else 0.3
    return Hidden(
        ((stretch, float(source.uniform(-0.4, 0.6))), *anomalies.causes),
        usual=((sag, float(source.uniform(-0.1, 0.1))), (friction, rubs)),
        backlash=float(source.uniform(0.0, 0.2)),
    )


def outside(millimetres: float) -> Hide:
    """Return what the library has no word for."""

    def hide(index: int, plan: Plan) -> Hidden:
        return Hidden(outside=list(OUTSIDE)[index % len(OUTSIDE)], outside_mm=millimetres)

    return hide


@dataclass(frozen=True)
class Slip:
    """How a reading is written down wrongly."""

    kind: str  # "turned": by `millimetres` in any direction; "digits"; "axes"
    millimetres: float = SLIP_MM
    where: str = ""  # "once": at a mark that is read once; "repeated": at one read again


def slip(
    board: BoardCut, kind: Slip, source: np.random.Generator
) -> tuple[BoardCut, tuple[str, ...]]:
    """Return the board with one reading written down wrongly, and the mark's name."""
    marks = list(board.measurements.marks)
    index = _slipped(board, kind.where, source)
    x, y = marks[index].measured or marks[index].target
    if kind.kind == "axes":
        moved = (y, x)
    elif kind.kind == "digits":
        moved = (_digits_swapped(x, source), y)
    else:
        turn, length = source.uniform(0, 2 * np.pi), kind.millimetres
        moved = (x + length * np.cos(turn), y + length * np.sin(turn))
    marks[index] = replace(marks[index], measured=moved)
    return replace(board, measurements=replace(board.measurements, marks=tuple(marks))), (
        marks[index].name,
    )


def _slipped(board: BoardCut, where: str, source: np.random.Generator) -> int:
    """Return the mark whose reading is wrong."""
    names = [mark.name for mark in board.measurements.marks]
    if not where:
        return int(source.integers(len(names)))
    again = [names.count(name) > 1 for name in names]
    return int(source.choice(np.flatnonzero(np.array(again) == (where == "repeated"))))


def _digits_swapped(number: float, source: np.random.Generator) -> float:
    """Two neighbouring digits before the point exchanged, so that the number changes."""
    digits = list(f"{abs(number):.0f}".zfill(3))
    places = [i for i in range(len(digits) - 1) if digits[i] != digits[i + 1]] or [0]
    i = int(source.choice(places))
    digits[i], digits[i + 1] = digits[i + 1], digits[i]
    if digits[i] == digits[i + 1]:
        digits[-1] = str((int(digits[-1]) + 5) % 10)
    return float(np.copysign(float("".join(digits)), number))
