"""The scenarios of the bench: what is hidden, on which marks, with which noise."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from plumb.bench.boards import BoardCut, cut, plan, size_for
from plumb.bench.causes import CAUSES, IN_THE_FRAME, OUTSIDE, Cause, Hidden, Plan
from plumb.bench.outcome import Outcome, look_alikes, outcome_of
from plumb.catalogue import effect_names, parameter_words
from plumb.diagnose import Diagnosis, diagnose
from plumb.bench.causes import MAKER

GRIDS = {9: (3, 3), 15: (5, 3), 25: (5, 5), 35: (7, 5)}
LARGEST_DRAG = 1.5  # typical sizes of friction beyond which lower corners stick for centimetres
PAIRED_MM = 6.0
BEYOND = 1.5  # times the catalogue's range: more than that no real machine has
SLIP_MM = 5.0

# What is hidden in board number i of a scenario, on this plan.
Hide = Callable[[int, Plan], Hidden]


@dataclass(frozen=True)
class Scenario:
    """Boards of one kind."""

    name: str
    hide: Hide
    marks: int = 25
    noise: float = 0.5  # [mm]
    stated: float | None = 0.5  # [mm] what the file says of it
    repeats: bool = False  # three marks are read three times, which gives 12 degrees of freedom
    spans: bool = False  # distances between all marks instead of places
    slip: str = ""  # "turned": 5 mm somewhere; "digits", "axes"

    @property
    def plan(self) -> Plan:
        """Its marks."""
        return plan(*GRIDS[self.marks], repeats=self.repeats, spans=self.spans)


@dataclass(frozen=True)
class Trial:
    """One board of a scenario, diagnosed."""

    board: BoardCut
    found: Diagnosis
    outcome: Outcome


def run_one(scenario: Scenario, index: int, *, seed: int) -> Trial:
    """Make, diagnose and judge one board."""
    own = scenario.plan
    hidden = scenario.hide(index, own)
    number = 1_000_003 * seed + index
    board = cut(hidden, own, seed=number, noise=scenario.noise, tape_sigma=scenario.stated)
    slipped: tuple[str, ...] = ()
    if scenario.slip:
        board, slipped = slip(board, scenario.slip, np.random.default_rng(number + 17))
    found = diagnose(MAKER, board.measurements)
    alike: frozenset[str] = frozenset()
    if len(hidden.causes) == 1:
        alike = look_alikes(*hidden.causes[0], own, scenario.noise)
    return Trial(board, found, outcome_of(found, board, alike=alike, slipped=slipped))


def nothing(index: int, own: Plan) -> Hidden:
    """Only the frame is off."""
    return Hidden()


def by_effect(causes: tuple[Cause, ...]) -> tuple[tuple[Cause, ...], ...]:
    """The causes of each effect."""
    return tuple(
        tuple(one for one in causes if one.effect == effect)
        for effect in dict.fromkeys(one.effect for one in causes)
    )


def _turns(causes: tuple[Cause, ...], index: int) -> Cause:
    """Effects take turns, and so do the causes of each."""
    effects = by_effect(causes)
    own = effects[index % len(effects)]
    return own[index // len(effects) % len(own)]


def raw(millimetres: float, causes: tuple[Cause, ...]) -> Hide:
    """One cause after the other, as large as moves marks by so much RMS before any refit."""

    def hide(index: int, own: Plan) -> Hidden:
        cause = _turns(causes, index)
        size = size_for(cause, own, millimetres) if not cause.drag else LARGEST_DRAG
        return Hidden(((cause, size),))

    return hide


def typical(low: float, high: float, causes: tuple[Cause, ...]) -> Hide:
    """One cause after the other, of some typical sizes."""

    def hide(index: int, own: Plan) -> Hidden:
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

    def hide(index: int, own: Plan) -> Hidden:
        return Hidden(
            tuple((one, size_for(one, own, millimetres)) for one in both[index % len(both)])
        )

    return hide


def outside(millimetres: float) -> Hide:
    """What the library has no word for."""

    def hide(index: int, own: Plan) -> Hidden:
        return Hidden(outside=list(OUTSIDE)[index % len(OUTSIDE)], outside_mm=millimetres)

    return hide


def possible(cause: Cause, own: Plan, millimetres: float) -> bool:
    """Whether a real machine can move marks by so much RMS with this cause."""
    if cause.drag:
        return False
    words = parameter_words()
    values = cause.sizes(size_for(cause, own, millimetres))
    return all(
        BEYOND * words[f"{cause.effect}.{name}"]["low"]
        <= value
        <= BEYOND * words[f"{cause.effect}.{name}"]["high"]
        for name, value in values.items()
    )


VISIBLE = tuple(one for one in CAUSES if one.effect not in IN_THE_FRAME)
REAL = tuple(one for one in VISIBLE if possible(one, plan(5, 5), 3.0) ) if False else VISIBLE


def slip(
    board: BoardCut, kind: str, source: np.random.Generator
) -> tuple[BoardCut, tuple[str, ...]]:
    """The board with one reading written down wrongly, and the mark's name."""
    marks = list(board.measurements.marks)
    index = int(source.integers(len(marks)))
    x, y = marks[index].measured
    if kind == "axes":
        moved = (y, x)
    elif kind == "digits":
        moved = (_digits_swapped(x, source), y)
    else:
        turn = source.uniform(0, 2 * np.pi)
        moved = (x + SLIP_MM * np.cos(turn), y + SLIP_MM * np.sin(turn))
    marks[index] = replace(marks[index], measured=moved)
    return replace(board, measurements=replace(board.measurements, marks=tuple(marks))), (
        marks[index].name,
    )


def _digits_swapped(number: float, source: np.random.Generator) -> float:
    """Two neighbouring digits before the point exchanged, so that the number changes."""
    digits = list(f"{abs(number):.0f}".zfill(3))
    places = [i for i in range(len(digits) - 1) if digits[i] != digits[i + 1]] or [0]
    i = int(source.choice(places))
    digits[i], digits[i + 1] = digits[i + 1], digits[i]
    if digits[i] == digits[i + 1]:
        digits[-1] = str((int(digits[-1]) + 5) % 10)
    return float(np.copysign(float("".join(digits)), number))
