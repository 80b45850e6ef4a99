"""How likely each account of the marks is: effects, a reading that is off, or a field of no effect.

An account is a set of effects, with nothing else, with one reading off, with a smooth field that no
mechanics made, or with rounds that do not go together. What is known before the marks enters as
spreads: of the frame by its priors, of each effect by the sizes that real machines have, of a slip
by what people misread. The marks then say how likely each account is, over all sizes at once. So an
account that can draw anything is worth little, and no limit has to be set for a search.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from plumb.diagnosis.explanation import Explanation
from plumb.diagnosis.linear_board import LinearBoard, Metric
from plumb.diagnosis.moved_rounds import rounds_columns
from plumb.diagnosis.noise import Noise
from plumb.diagnosis.smooth import field_columns
from plumb.model.catalogue import EVERY_MACHINE
from plumb.model.ranks import ranked

Array = np.ndarray
TOGETHER = 3  # effects at once in an account; all at once are an account too
FEWER = 150  # measured numbers beyond which only pairs are weighed, for time
EFFECT = 0.1  # how likely an effect is before the marks
EVERYWHERE = 0.9  # the same of what every machine has and the settings do not know of
ALL = 0.01  # how likely it is that every effect acts at once
SLIP = 0.05  # that some reading is off
UNKNOWN = 0.05  # that the machine does what no effect of the library does
SLIP_MM = (4.0, 20.0, 200.0)  # [mm] spreads of a slip, all as likely
WIDTHS = (0.35, 0.7, 1.4)  # of the details of a field, in halves of what the marks span
LEFT_OUT = 1e-3  # share of the noise's variance that a field is described to
FIELD_MM = (1.0, 2.0, 4.0)  # [mm] spreads of a field, all as likely


@dataclass(frozen=True)
class Weighed:
    """The accounts of a board, and the logarithms of their weights."""

    effects: tuple[tuple[str, ...], ...]  # of each account
    clean: Array  # (accounts,) with nothing else
    field: float  # with a field of no effect or a moved round, all sets of effects together
    slips: Array  # (readings,) with this reading off, all sets of effects together

    @property
    def best(self) -> tuple[str, ...]:
        """The effects of the likeliest account of a few effects."""
        few = [i for i, names in enumerate(self.effects) if len(names) <= TOGETHER]
        return self.effects[ranked(few, lambda i: -float(self.clean[i]))[0]]

    @property
    def field_chance(self) -> float:
        """How likely a field of no effect is, if no reading is off."""
        return float(np.exp(self.field - np.logaddexp.reduce([*self.clean, self.field])))

    def slip_chances(self, allowed: Array) -> Array:
        """How likely each reading is off (readings,), if only those allowed may be."""
        weights = np.where(allowed, self.slips, -np.inf)
        whole = np.logaddexp.reduce([*self.clean, self.field, *weights])
        chances: Array = np.exp(weights - whole)
        return chances


def weigh(
    frame: Explanation, felt: Sequence[str], noise: Noise, *, with_slips: bool = True
) -> Weighed:
    """Weigh all accounts of what a frame's fit leaves."""
    board = LinearBoard.of(frame, felt, noise)
    sets, before = accounts(frame, felt)
    parts, plain = board.parts(sets), Metric.of(board)
    clean = before + plain.evidences(parts)[:, 0]
    slips = (
        plain.slip_evidences(parts, before, SLIP_MM) + np.log(SLIP) if with_slips else np.zeros(0)
    )
    least = LEFT_OUT * board.sigma**2 / max(FIELD_MM) ** 2
    fields = [
        before + metric.evidences(parts)[:, 0]
        for columns in field_columns(frame, WIDTHS, least)
        for metric in Metric.with_other(board, columns, FIELD_MM)
    ]
    field = np.logaddexp.reduce(np.ravel(fields)) - np.log(len(fields))
    between = rounds_columns(frame)
    if between is not None:
        (metric,) = Metric.with_other(board, between, (1.0,))
        moved = before + metric.evidences(parts)[:, 0]
        field = np.logaddexp(field, np.logaddexp.reduce(moved))
    return Weighed(sets, clean, float(field + np.log(UNKNOWN)), slips)


def accounts(frame: Explanation, felt: Sequence[str]) -> tuple[tuple[tuple[str, ...], ...], Array]:
    """Sets of effects, and the logarithms of their weights before the marks; last all at once."""
    most = TOGETHER if frame.board.rows.count <= FEWER else 2
    sets = [names for size in range(most + 1) for names in combinations(felt, size)]
    chances = {name: EFFECT for name in felt} | dict.fromkeys(left_out(frame), EVERYWHERE)
    odds = {name: float(np.log(chance / (1 - chance))) for name, chance in chances.items()}
    before = [sum(odds[name] for name in names) for names in sets]
    return (*sets, tuple(felt)), np.array([*before, np.log(ALL)])


def left_out(frame: Explanation) -> tuple[str, ...]:
    """What every machine has, and what the settings do not know of."""
    board = frame.board
    return tuple(
        name for name in EVERY_MACHINE if not np.any(board.problem.start[board.columns([name])])
    )
