"""Knowledge before the next measurement: the accounts that are likely, and the next machine."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from plumb.diagnosis.answer import Diagnosis
from plumb.diagnosis.explanation import Board, Explanation
from plumb.diagnosis.noise import Noise
from plumb.diagnosis.posterior import Posterior
from plumb.fit.inputs import Inputs
from plumb.model.catalogue import effect_names
from plumb.model.predict import FOUND
from plumb.plan.planned_visits import Visits
from plumb.settings.machine import MachineSettings

Array = np.ndarray


@dataclass(frozen=True)
class Hypothesis:
    """One account of the marks so far."""

    effects: tuple[str, ...]
    at: Explanation  # whose slopes it goes by
    weight: float  # how likely it is among all


@dataclass(frozen=True)
class Case:
    """A diagnosed board, and the machine that will cut the next marks."""

    settings: MachineSettings  # in force when the next marks are cut
    controller: str
    verdict: str
    posterior: Posterior
    frame: Explanation  # whitened by the noise
    best: Explanation
    hypotheses: tuple[Hypothesis, ...]  # likeliest first
    spans: tuple[str, ...] = ()  # the names of both ends of each distance

    @property
    def board(self) -> Board:
        """The marks so far."""
        return self.frame.board

    @property
    def noise(self) -> Noise:
        """Of a reading."""
        return self.posterior.noise

    @property
    def usual_weight(self) -> float:
        """The sled's [N] when nothing extra hangs on it."""
        return float(np.median(self.board.rows.sled_weights))

    @property
    def effects(self) -> tuple[str, ...]:
        """The effects of all hypotheses, likeliest first."""
        return tuple(
            dict.fromkeys(name for hypothesis in self.hypotheses for name in hypothesis.effects)
        )


def case_of(diagnosis: Diagnosis, inputs: Inputs) -> Case:
    """Return the case of a diagnosis, with the inputs it was made of."""
    # New marks belong to the first round: its settings, its zeros and its sheet.
    measurements = inputs.measurements
    in_force = measurements.rounds[0].cut_with or inputs.cut_with or inputs.settings
    both = zip(diagnosis.explanations, diagnosis.fits, strict=True)
    likely = tuple(
        Hypothesis(together.effects, fitted, together.share)
        for together, fitted in both
        if together.effects
    )
    return Case(
        settings=in_force,
        controller=inputs.controller or measurements.controller or in_force.controller,
        verdict=diagnosis.verdict,
        posterior=diagnosis.readings.posterior,
        frame=diagnosis.readings.frame,
        best=diagnosis.best,
        hypotheses=likely or hidden_hypotheses(diagnosis.readings.frame),
        spans=tuple(" - ".join(distance.between) for distance in measurements.distances),
    )


def hidden_hypotheses(frame: Explanation) -> tuple[Hypothesis, ...]:
    """Return where nothing is proved: each effect there in its typical size, all as likely."""
    names = effect_names()
    return tuple(Hypothesis((name,), frame, 1 / len(names)) for name in names)


# What a planned measurement would add: rows of slopes below those of the marks so far.


@dataclass(frozen=True)
class PlannedCheck:
    """A number of the machine that would be measured directly."""

    name: str  # of a parameter or of the frame
    sigma: float  # [its unit]


@dataclass(frozen=True)
class Ahead:
    """All rows there would be, whitened: those so far, planned marks, planned checks."""

    slopes: Array  # (rows, u)
    so_far: int  # rows there are already
    marks: Array  # (rows,) True for what is read of marks and distances, false for priors, checks
    where: Array  # (planned marks * 2,) [sigmas] predicted; NaN where the sled could not hang


class PlannedMeasurement:
    """A planned measurement; what it adds by an explanation is worked out once."""

    def __init__(self, visits: Visits, checks: Sequence[PlannedCheck] = ()) -> None:
        self.visits, self.checks = visits, tuple(checks)
        self._known: dict[int, tuple[Explanation, Ahead]] = {}

    def ahead(self, at: Explanation) -> Ahead:
        """Return the rows after the measurement, by the slopes of an explanation."""
        if id(at) not in self._known:
            self._known[id(at)] = at, self._ahead(at)
        return self._known[id(at)][1]

    def _ahead(self, at: Explanation) -> Ahead:
        where, marks = seen_on(at, self.visits)
        problem = at.board.problem
        checked = np.zeros((len(self.checks), len(problem.names)))
        for row, check in zip(checked, self.checks, strict=True):
            column = problem.names.index(check.name)
            row[column] = problem.scale[column] / check.sigma
        read = np.arange(len(at.slopes)) < at.board.rows.count
        return Ahead(
            slopes=np.vstack([at.slopes, marks.reshape(-1, at.slopes.shape[1]), checked]),
            so_far=len(at.slopes),
            marks=np.r_[read, np.full(marks[:, :, 0].size, True), np.full(len(checked), False)],
            where=where,
        )


def seen_on(at: Explanation, visits: Visits) -> tuple[Array, Array]:
    """Return where visits would be read (n * 2,), and the slopes of that (n, 2, u), both whitened;
    of a visit where the explanation's sled could not hang NaN, and zero: nothing is expected of it.
    """
    problem = replace(at.board.problem, observations=visits.rows())
    width = len(problem.names)
    if not len(visits):
        return np.zeros(0), np.zeros((0, 2, width))
    sighting, _ = problem.predict(at.unknowns)
    slopes = (problem.data_slopes(sighting) / problem.sigma).reshape(-1, 2, width)
    hangs = sighting.outcome == FOUND
    where = np.where(hangs[:, np.newaxis], sighting.read.where / problem.sigma, np.nan)
    return where.ravel(), np.where(hangs[:, np.newaxis, np.newaxis], slopes, 0.0)
