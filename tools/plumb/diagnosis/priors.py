"""Priors of the posterior: machines and readings before any mark is read.

Each number stands here with its source. To change what the lab believes, change it here.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from plumb.diagnosis.explanation import Board, Explanation
from plumb.fit.compare import plausible_range
from plumb.fit.fit import USUAL_SIGMA, Checked
from plumb.fit.inputs import Stated
from plumb.model.catalogue import EVERY_MACHINE

Array = np.ndarray

LIKELIER = 0.5  # chance from which on something is likelier than not

# How likely each thing is on a machine in question. No machines were counted, so
# these are guesses; docs/diagnosis.md says which answers hang on them, and by how much.
ACTS = 0.1  # an effect
UNUSUAL = 0.05  # that what every machine has is far from usual
ALL = 0.01  # that every effect of the library acts at once
TOGETHER = 3  # effects at once in an account; the marks of one sheet hardly carry more
FIELD = 0.15  # that the machine also does what no effect of the library does: half of it all over
# the sheet, half about a single place
OUTLIER = 0.1  # that some reading is off
MOVED = 0.05  # that a later round was not cut by the same machine on the same sheet
TURNED = 0.01  # that all y errors have the wrong sign

# [mm] Readings that are off: a misread tick, a wrong hook, exchanged digits. All as likely.
OUTLIER_SPREADS = (4.0, 20.0, 200.0)
# [mm] and halves of what the marks span: what a smooth field of no effect does. All as likely.
FIELD_SPREADS = (1.0, 2.0, 4.0)
FIELD_WIDTHS = (0.35, 0.7, 1.4)
SPOT_WIDTHS = (0.25, 0.45)  # of a field that acts about a single place
ROUND_SPREAD = 6.0  # [mm] of a sheet laid elsewhere, and of a chain hung by a link less

# The noise of a reading: the logarithm of its standard deviation is Student's t about what is
# stated. A careful owner's tape reads to about 0.5 mm.
NOISE_DEGREES = 4.0
STATED_SPREAD = 0.22  # how well people know it
UNSTATED_SPREAD = 0.5  # of tapes in general, about USUAL_SIGMA


@dataclass(frozen=True)
class Usual:
    """Usual sizes of a parameter on every machine, as shares of its typical size."""

    mean: float  # of machines whose settings do not know it
    spread: float  # from machine to machine, where the settings do not know it
    known: float  # the same about the value that the settings have


# Stretch: makers and owners state 4.1e-6 to 8.1e-6 1/N for this chain; WebControl takes 5.17e-6.
# Sag goes with the square of the chain's weight, which differs by a tenth from maker to maker.
USUAL: Mapping[str, Usual] = {
    "chain_stretch.compliance": Usual(mean=1.0, spread=0.6, known=0.3),
    "chain_sag.weight_ratio_squared": Usual(mean=1.0, spread=0.2, known=0.12),
}
# Pitch: ANSI allows this chain to be up to 0.26 % too long. Half of all chains are taken to be a
# little off, each chain by itself.
PITCH = "chain_pitch"
PITCH_CHANCE, PITCH_SPREAD = 0.5, 0.0005
# Where pitch is far from usual, both chains are off by about as much, for they come from one reel:
# the only machine whose two numbers are published has 0.35 and 0.36 %.
PITCH_CORRELATION = 0.9
ZERO = 1e-4  # of a typical size: how near zero what cannot be negative is held


@dataclass(frozen=True)
class SizePriors:
    """Normal priors of the parameters of some effects, in typical sizes off the settings' values.

    A parameter that cannot be negative is at least its `least`. What every machine has counts in
    each account, about `mean` with `usual`; an effect that acts adds one of two spreads. All are
    independent; the pitches of both chains are not, and stand as `turned` has them.
    """

    mean: Array  # (p,)
    usual: Array  # (p,) standard deviation on every machine; 0: only where the effect acts
    typical: Array  # (p,) spread of the sizes that are met most
    largest: Array  # (p,) spread of the sizes that were met at all
    least: Array  # (p,) off the settings' value; -inf: it has either sign
    pitch: Array  # (p,) usual standard deviation that half of all machines have


def size_priors(board: Board, columns: Array) -> SizePriors:
    """Return the priors of these columns of a board's unknowns."""
    problem = board.problem
    names = [problem.names[column] for column in columns]
    scale, start = problem.scale[columns], problem.start[columns] / problem.scale[columns]
    met = [plausible_range(name) for name in names]
    usual = [USUAL.get(name) for name in names]
    is_set = start != 0
    alike, drift = np.ones(len(names)), np.zeros(len(names))
    pair = _pitches(board, columns)
    if pair:
        alike[pair] = np.sqrt([1 + PITCH_CORRELATION, 1 - PITCH_CORRELATION])
        # Settings that have the pitch of a chain know that of the other too.
        drift[pair] = 0.0 if is_set[pair].any() else PITCH_SPREAD / scale[pair]
    return SizePriors(
        mean=np.array([each.mean if each else 0.0 for each in usual]) * ~is_set,
        usual=np.array(
            [
                (each.known if known else each.spread) if each else 0.0
                for each, known in zip(usual, is_set, strict=True)
            ]
        ),
        typical=alike,
        largest=largest_met(board, columns) * alike,
        least=np.where([each.low >= 0 for each in met], -start, -np.inf),
        pitch=drift,
    )


def largest_met(board: Board, columns: Array) -> Array:
    """Return the largest sizes (p,) that real machines have of these columns, in typical sizes."""
    met = [plausible_range(board.problem.names[column]) for column in columns]
    sizes = np.array([max(abs(each.low), abs(each.high)) for each in met])
    largest: Array = sizes / board.problem.scale[columns]
    return largest


def turned(board: Board, columns: Array, slopes: Array) -> Array:
    """Return the slopes (n, p) of these columns, with those of the pitches of both chains along
    their sum and their difference, each over the root of two: these are independent.
    """
    pair = _pitches(board, columns)
    if pair:
        slopes = slopes.copy()
        slopes[:, pair] = slopes[:, pair] @ (np.array([[1.0, 1.0], [1.0, -1.0]]) / np.sqrt(2))
    return slopes


def _pitches(board: Board, columns: Array) -> list[int]:
    """Return the places of both pitches among some columns; none where that effect is not."""
    names = [board.problem.names[column] for column in columns]
    return [place for place, name in enumerate(names) if name.startswith(f"{PITCH}.")]


def usual_checks(board: Board, effects: Iterable[str]) -> tuple[Checked, ...]:
    """Return what is usual of the parameters of some effects, as if it had been measured."""
    problem, checks = board.problem, []
    for column in board.columns(effects):
        name, scale, start = problem.names[column], problem.scale[column], problem.start[column]
        known = USUAL.get(name)
        if known:
            share = known.known if start else known.spread
            checks.append(Checked(name, float(start or known.mean * scale), float(share * scale)))
        elif name.startswith(f"{PITCH}."):
            checks.append(Checked(name, float(start), PITCH_SPREAD))
    return tuple(checks)


def zero_checks(fitted: Explanation) -> tuple[Checked, ...]:
    """Return the sizes of an explanation that are below zero and cannot be, as zero."""
    problem = fitted.board.problem
    checks = []
    for column in fitted.board.columns(fitted.effects):
        name, scale = problem.names[column], float(problem.scale[column])
        value = problem.start[column] + scale * fitted.unknowns[column]
        if plausible_range(name).low >= 0 and value < 0:
            checks.append(Checked(name, 0.0, ZERO * scale))
    return tuple(checks)


def chance_of(effect: str) -> float:
    """Return how likely an effect acts, or is unusual on this machine, before the marks."""
    return UNUSUAL if effect in EVERY_MACHINE or effect == PITCH else ACTS


def noise_prior(stated: Stated | None) -> tuple[float, float]:
    """Return the middle [mm] of the noise, and the spread of its logarithm; 0: it is known."""
    if stated is None:
        return USUAL_SIGMA, UNSTATED_SPREAD
    return stated.sigma, 0.0 if stated.is_final else STATED_SPREAD
