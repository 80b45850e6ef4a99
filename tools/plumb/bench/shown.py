"""Hidden effects that the marks of a board can show, without any noise."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from plumb.bench.boards import read
from plumb.bench.causes import Hidden
from plumb.bench.kinds import HiddenBoard
from plumb.fit.inputs import Inputs
from plumb.fit.problem import PRIORS, Problem
from plumb.model.catalogue import effect_names, parameter_names

Array = np.ndarray
ALIKE = 0.98  # |cosine| after the refit above which two causes draw the same arrows
LEAST_GAIN, GAIN_PER_PARAMETER = 9.0, 2.0  # of chi-square, from which marks can show an effect
LEAST = 1e-5  # share of a column's length below which its rest is rounding
FRAME = "frame"


@dataclass(frozen=True)
class Truth:
    """Knowledge that a diagnosis could have."""

    effects: tuple[str, ...]  # that were hidden
    usual: tuple[str, ...]  # what else the machine has and the settings leave out
    gains: Mapping[str, float]  # of chi-square by each effect, beyond the frame and all others
    alike: Mapping[str, frozenset[str]]  # effects that draw the same arrows as each alone

    def shows(self, effect: str) -> bool:
        """Return whether the marks can show an effect that is there."""
        return self.gains[effect] >= LEAST_GAIN + GAIN_PER_PARAMETER * len(parameter_names(effect))

    @property
    def allowed(self) -> frozenset[str]:
        """Effects that may be named: all that are there, and look-alikes that the marks show."""
        shown = [name for name in self.usual if self.shows(name)]
        alike = (self.alike[name] for name in (*self.effects, *shown))
        return frozenset[str]().union(self.effects, self.usual, *alike)

    def is_held_by(self, named: set[str]) -> bool:
        """Return whether these have all hidden effects that the marks can show, or look-alikes."""
        return all(named & {name, *self.alike[name]} for name in self.effects if self.shows(name))


def truth_of(board: HiddenBoard) -> Truth:
    """Return what is hidden in a board, and what of it its marks can show."""
    hidden = board.hidden
    several = {cause.effect: (cause, size) for cause, size in (*hidden.usual, *hidden.causes)}
    usual = tuple(dict.fromkeys(cause.effect for cause, _ in hidden.usual))
    slopes, gains, alike = _slopes(board), {}, {}
    for name, cause in several.items():
        drawn = [slopes[other] for other in several if other != name]
        moved = _moved(board, hidden, _without(hidden, name), len(slopes[FRAME]))
        left = _beyond(moved, np.hstack([slopes[FRAME], *drawn]))
        gains[name] = float(left @ left)
        alone = _moved(board, Hidden((cause,)), Hidden(), len(slopes[FRAME]))
        left = _beyond(alone, slopes[FRAME])
        alike[name] = frozenset(
            other
            for other in effect_names()
            if other != name and _cosine(left, slopes[other], slopes[FRAME]) > ALIKE
        )
    return Truth(hidden.effects, usual, gains, alike)


def _without(hidden: Hidden, effect: str) -> Hidden:
    """Return what is left to hide without an effect."""
    causes, usual = (
        tuple(each for each in several if each[0].effect != effect)
        for several in (hidden.causes, hidden.usual)
    )
    return replace(hidden, causes=causes, usual=usual)


def _slopes(board: HiddenBoard) -> dict[str, Array]:
    """Return the slopes of readings and priors, whitened, by the frame and by each effect."""
    inputs = Inputs(board.kind.settings, board.board.measurements)
    model, rows = inputs.model_and_observations()
    problem = Problem.of(model, rows, effect_names(), PRIORS, board.kind.noise)
    at = problem.at(np.zeros(len(problem.names)))
    if at is None:
        raise ValueError("with these settings the sled cannot hang where the marks were sent")
    columns = {FRAME: at.slopes[:, problem.held]}
    for effect in effect_names():
        names = parameter_names(effect)
        columns[effect] = at.slopes[:, [problem.names.index(name) for name in names]]
    return columns


def _moved(board: HiddenBoard, there: Hidden, without: Hidden, rows: int) -> Array:
    """Return how far the readings are moved by what is not in both, whitened; by the judge."""
    with_it, bare = (
        read(replace(board.board.machine, hidden=each), board.plan, board.kind.settings)
        for each in (there, without)
    )
    order = [*range(len(bare)), *board.plan.again]
    moved = np.zeros(rows)
    moved[: 2 * len(order)] = (with_it - bare)[order].ravel() / board.kind.noise
    return moved


def _beyond(columns: Array, fitted: Array) -> Array:
    """Return columns without what fitted columns can imitate."""
    basis = _basis(fitted, fitted)
    beyond: Array = columns - basis @ (basis.T @ columns)
    return beyond


def _cosine(left: Array, effect: Array, frame: Array) -> float:
    """Return the cosine of the angle between what a cause leaves and the nearest of an effect."""
    if not np.any(effect):
        return 0.0
    basis = _basis(_beyond(effect, frame), effect)
    return float(np.linalg.norm(basis.T @ left)) / max(float(np.linalg.norm(left)), 1e-9)


def _basis(columns: Array, against: Array) -> Array:
    """Return an orthonormal basis; what is tiny against the columns `against` is rounding."""
    lengths = np.linalg.norm(against, axis=0)
    felt = columns[:, lengths > 0] / lengths[lengths > 0]
    left, sizes, _ = np.linalg.svd(felt, full_matrices=False)
    return np.asarray(left[:, sizes > LEAST])
