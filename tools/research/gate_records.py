"""A board of the gates diagnosed: what was hidden, what of it marks can show, what was said.

A record is all that a rate may ask for, so that rates can be counted again without a diagnosis. Of
the diagnosis only its answer is read, whatever engine gives it.
"""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, replace
from typing import Any

import numpy as np
from gate_boards import HiddenBoard, board_of, places
from gate_kinds import KINDS
from plumb.bench.causes import Hidden
from plumb.bench.judged_board import refitted, shape_error, true_value
from plumb.bench.outcome import ALIKE
from plumb.cure.auto import add_auto
from plumb.diagnosis import Diagnosis, Inputs, diagnose
from plumb.fit.problem import PRIORS, Problem
from plumb.model.catalogue import effect_names, parameter_names

Array = np.ndarray
Sizes = list[tuple[str, float, float, float]]  # name, true value, both ends of its interval
LEAST_GAIN, GAIN_PER_PARAMETER = 9.0, 2.0  # of chi-square, from which marks can show an effect
LEAST = 1e-5  # share of a column's length below which its rest is rounding
# What may go wrong in a diagnosis that ends in a traceback.
FAILURES = (ValueError, ArithmeticError, AssertionError, LookupError, np.linalg.LinAlgError)
FAILED = "failed"


@dataclass(frozen=True)
class Truth:
    """What a diagnosis could know."""

    effects: tuple[str, ...]  # that were hidden
    usual: tuple[str, ...]  # what else the machine has and the settings leave out
    gains: Mapping[str, float]  # of chi-square by each effect, beyond the frame and all others
    alike: Mapping[str, tuple[str, ...]]  # effects that draw the same arrows as each alone

    @property
    def provable(self) -> tuple[str, ...]:
        """The hidden effects that the marks can show."""
        return tuple(name for name in self.effects if self.gains[name] >= needed_gain(name))

    @property
    def allowed(self) -> tuple[str, ...]:
        """What may be named: all that is there, and look-alikes of it that the marks show."""
        shown = [name for name in self.usual if self.gains[name] >= needed_gain(name)]
        alike = (other for name in (*self.effects, *shown) for other in self.alike[name])
        return tuple(dict.fromkeys([*self.effects, *self.usual, *alike]))


@dataclass
class Account:
    """An explanation as it was listed."""

    effects: list[str]
    share: float | None
    possible: bool
    sizes: Sizes = field(default_factory=list)


@dataclass
class Record:
    """A board of a kind, and all that was said of it."""

    kind: str
    index: int
    effects: list[str]
    usual: list[str]
    parameters: dict[str, float]  # of both, by full name
    gains: dict[str, float]
    provable: list[str]
    allowed: list[str]
    alike: dict[str, list[str]]
    outside: str
    slipped: list[str]
    slip_mm: float
    verdict: str = FAILED
    accounts: list[Account] = field(default_factory=list)
    outliers: list[str] = field(default_factory=list)
    to_add: list[str] = field(default_factory=list)
    limits: dict[str, bool] = field(default_factory=dict)  # whether the truth is below what hides
    sigma: float = 0.0
    effect_chances: dict[str, float] = field(default_factory=dict)
    field_chance: float | None = None
    nothing_chance: float | None = None
    outlier_chance: float | None = None
    cure: dict[str, float] = field(default_factory=dict)
    seconds: float = 0.0  # of CPU for the diagnosis
    failures: list[str] = field(default_factory=list)

    @staticmethod
    def of(raw: Mapping[str, Any]) -> Record:
        """Return a record as it was saved."""
        accounts = [Account(**each) for each in raw["accounts"]]
        return Record(**{**raw, "accounts": accounts})


def needed_gain(effect: str) -> float:
    """Return from which gain of chi-square on marks can show an effect."""
    return LEAST_GAIN + GAIN_PER_PARAMETER * len(parameter_names(effect))


def record_of(kind: str, index: int, *, seed: int) -> dict[str, Any]:
    """Return board number `index` of a kind, diagnosed, as it is saved."""
    hidden = board_of(KINDS[kind], index, seed=seed)
    truth = truth_of(hidden)
    record = Record(
        kind,
        index,
        effects=list(truth.effects),
        usual=list(truth.usual),
        parameters=hidden.hidden.parameters,
        gains=dict(truth.gains),
        provable=list(truth.provable),
        allowed=list(truth.allowed),
        alike={name: list(names) for name, names in truth.alike.items()},
        outside=hidden.hidden.outside,
        slipped=list(hidden.slipped),
        slip_mm=hidden.slip_mm,
    )
    inputs = Inputs(hidden.kind.settings, hidden.board.measurements)
    start = time.process_time()
    try:
        diagnosis = diagnose(inputs)
    except FAILURES as error:
        record.failures.append(f"diagnose: {error}")
        return asdict(record)
    record.seconds = time.process_time() - start
    _write_answer(record, diagnosis, hidden)
    if hidden.kind.is_cured:
        _write_cure(record, diagnosis, hidden, inputs)
    return asdict(record)


def _write_answer(record: Record, diagnosis: Diagnosis, hidden: HiddenBoard) -> None:
    """Write down what was said."""
    record.verdict = diagnosis.verdict
    record.accounts = [
        Account(
            list(each.effects),
            each.share,
            each.possible,
            [
                (name, true_value(hidden.board, name), size.low, size.high)
                for effect, sizes in each.sizes.items()
                for size in sizes
                for name in (f"{effect}.{size.name}",)
                if size.low is not None and size.high is not None
            ],
        )
        for each in diagnosis.explanations
    ]
    record.outliers = [outlier.name for outlier in diagnosis.outliers]
    record.to_add = list(diagnosis.to_add)
    record.sigma = diagnosis.noise.sigma
    for room in diagnosis.could_hide:
        if room.mm is not None:
            record.limits[room.effect] = all(
                abs(true_value(hidden.board, f"{room.effect}.{limit.name}")) <= limit.largest
                for limit in room.limits
                if limit.largest is not None
            )
    # What an engine says beyond that, where it does.
    record.effect_chances = {
        each.effect: each.chance for each in diagnosis.ranking if hasattr(each, "chance")
    }
    for name in ("field_chance", "nothing_chance", "outlier_chance"):
        setattr(record, name, getattr(diagnosis, name, None))


def _write_cure(record: Record, diagnosis: Diagnosis, hidden: HiddenBoard, inputs: Inputs) -> None:
    """Write down the error of the sled's shape over the sheet [mm]: by the settings, with the
    frame fitted, with what was named, with what is there, and as `plumb add` does it by itself.
    """
    machine, sigma = hidden.board.machine, diagnosis.noise.sigma
    usual = [name for name in record.usual if name != SMALL]
    there = tuple(dict.fromkeys([*usual, *record.effects]))
    fits = {
        names: shape_error(machine, refitted(inputs, names, sigma))
        for names in {(), diagnosis.to_add, there}
    }
    record.cure = {
        "before": shape_error(machine, inputs.settings),
        "frame": fits[()],
        "after": fits[diagnosis.to_add],
        "known": fits[there],
    }
    try:
        addition = add_auto(inputs, diagnosis=diagnosis).addition
    except FAILURES as error:
        record.failures.append(f"add_auto: {error}")
        return
    settings = addition.settings if addition else inputs.settings
    record.cure["auto"] = shape_error(machine, settings)


# What is there, and what marks can show of it.

SMALL = "chain_sag"  # a tenth of it is not worth a fit
FRAME = "frame"


def truth_of(hidden: HiddenBoard) -> Truth:
    """Return what is hidden in a board, and what of it its marks can show without any noise."""
    secret = hidden.hidden
    several = (*secret.usual, *secret.causes)
    if not several:
        return Truth((), (), {}, {})
    slopes = _slopes(hidden)
    gains, alike = {}, {}
    for cause, size in several:
        name, others = cause.effect, [each for each in several if each[0].effect != cause.effect]
        drawn = [slopes[other.effect] for other, _ in others]
        moved = _moved(hidden, secret, _without(secret, name), slopes)
        left = _beyond(moved, np.hstack([slopes[FRAME], *drawn]))
        gains[name] = float(left @ left)
        alone = _moved(hidden, Hidden(((cause, size),)), Hidden(), slopes)
        left = _beyond(alone, slopes[FRAME])
        alike[name] = tuple(
            other
            for other in effect_names()
            if other != name and _cosine(left, slopes[other], slopes[FRAME]) > ALIKE
        )
    usual = tuple(dict.fromkeys(cause.effect for cause, _ in secret.usual))
    return Truth(secret.effects, usual, gains, alike)


def _without(hidden: Hidden, effect: str) -> Hidden:
    """Return what is left to hide without an effect."""
    causes, usual = (
        tuple(each for each in several if each[0].effect != effect)
        for several in (hidden.causes, hidden.usual)
    )
    return replace(hidden, causes=causes, usual=usual)


def _slopes(hidden: HiddenBoard) -> dict[str, Array]:
    """Return the slopes of readings and priors, whitened, by the frame and by each effect."""
    inputs = Inputs(hidden.kind.settings, hidden.board.measurements)
    model, rows = inputs.model_and_observations()
    problem = Problem.of(model, rows, effect_names(), PRIORS, hidden.kind.noise)
    at = problem.at(np.zeros(len(problem.names)))
    if at is None:
        raise ValueError("with these settings the sled cannot hang where the marks were sent")
    columns = {FRAME: at.slopes[:, problem.held]}
    for effect in effect_names():
        names = parameter_names(effect)
        columns[effect] = at.slopes[:, [problem.names.index(name) for name in names]]
    return columns


def _moved(
    hidden: HiddenBoard, there: Hidden, without: Hidden, slopes: Mapping[str, Array]
) -> Array:
    """Return how far the readings are moved by what is not in both, whitened; by the judge."""
    with_it, bare = (
        places(replace(hidden.board.machine, hidden=each), hidden.plan, hidden.kind.settings)
        for each in (there, without)
    )
    order = [*range(len(bare)), *hidden.plan.again]
    moved = np.zeros(len(slopes[FRAME]))
    moved[: 2 * len(order)] = (with_it - bare)[order].ravel() / hidden.kind.noise
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
