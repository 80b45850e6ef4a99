"""Boards with something hidden: cut by the maker's settings, the sled hung by the judge."""

from dataclasses import dataclass, replace
from itertools import combinations
from math import cos
from typing import Any

import numpy as np

from plumb.bench import judge
from plumb.bench.causes import MAKER, SLED, Cause, Field, Hidden, Plan
from plumb.marks.read import Distance, Mark, Measurements
from plumb.model.predict import FOUND, judged, lengths
from plumb.settings.machine import MachineSettings

Array = np.ndarray
SIDES = np.array([(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)])
GAP_SIGMA, POSE_SIGMA, TURN_SIGMA = 3.0, 5.0, 0.002  # [mm, mm, rad] how far the frame is off
# The judge's numbers of each chain.
WIDTH, HEIGHT = 2200.0, 1000.0  # [mm] that a plan covers of the sheet


def plan(
    columns: int,
    rows: int,
    *,
    approached: bool = True,
    sled_weight: float = SLED,
    times: int = 1,
    repeats: bool = False,
    spans: bool = False,
) -> Plan:
    """Return a grid over the sheet, cut `times`; with `repeats` three marks are read three
    times.
    """
    across = np.linspace(-WIDTH / 2, WIDTH / 2, columns)
    up = np.linspace(HEIGHT / 2, -HEIGHT / 2, rows)
    once = np.array([(x, y) for y in up for x in across])
    targets = np.tile(once, (times, 1))
    sides = np.tile(SIDES[(np.arange(len(once)) * 7 // 3) % 4], (times, 1))
    chosen = (0, len(once) // 2, len(once) - 2) * 2 if repeats else ()
    return Plan(
        targets,
        sides if approached else 0 * sides,
        np.full(len(targets), float(sled_weight)),
        again=chosen,
        spans=spans,
        name=f"{columns}x{rows}",
    )


def joined(*plans: Plan) -> Plan:
    """Several plans as one board."""
    return Plan(
        targets=np.concatenate([plan.targets for plan in plans]),
        approaches=np.concatenate([plan.approaches for plan in plans]),
        sled_weights=np.concatenate([plan.sled_weights for plan in plans]),
    )


@dataclass(frozen=True)
class TrueMachine:
    """The true machine: the maker's with its frame off, and what is hidden."""

    hidden: Hidden
    motor_gap: float = MAKER.motor_gap
    motor_height: float = MAKER.motor_height
    motor_center_x: float = 0.0
    turn: float = 0.0  # [rad] of the sheet
    field: Field | None = None  # what else it does, which no effect of the library draws

    def read(self, chains: Array, *, approaches: Array, weights: Array) -> Array:
        """Return where marks would be read (n, 2) [mm] without noise; NaN where the sled cannot
        hang.
        """
        return self.hidden.read(self.on_sheet(chains, approaches=approaches, weights=weights))

    def on_sheet(self, chains: Array, *, approaches: Array, weights: Array) -> Array:
        """Return the same by a tape that is right, from edges that are square."""
        where = self.sleds(chains, approaches=approaches, weights=weights)
        where = where - self.hidden.backlash * approaches
        turned: Array = where @ np.array(
            [[cos(self.turn), self.turn], [-self.turn, cos(self.turn)]]
        )
        return turned

    def sleds(
        self, chains: Array, *, approaches: Array | None = None, weights: Array | None = None
    ) -> Array:
        """Return where the sled comes to rest (n, 2) [mm]; without approaches nothing rubs."""
        numbers = {
            **judged(MAKER),
            "motor_gap": self.motor_gap,
            "motor_height": self.motor_height,
            "motor_center_x": self.motor_center_x,
            **self.hidden.numbers,
        }
        heavier = numbers["sled_weight"] / SLED
        still = np.zeros_like(chains)
        where = judge.places(
            numbers,
            chains,
            pushes=still if approaches is None else -self.hidden.drag * approaches,
            weights=heavier * (np.full(len(chains), SLED) if weights is None else weights),
        )
        return where + self.field(where) if self.field else where


@dataclass(frozen=True)
class BoardCut:
    """A board, and the machine that cut it."""

    machine: TrueMachine
    measurements: Measurements


def cut(
    hidden: Hidden,
    plan: Plan,
    *,
    seed: int | np.random.Generator,
    noise: float = 0.5,
    tape_sigma: float | None = 0.5,
    settings: MachineSettings = MAKER,
) -> BoardCut:
    """Return a board as measured; frame and sheet lie off by chance. noise, tape_sigma [mm].

    The settings are those in force; the machine's chain is the maker's, whatever they say.
    """
    source = np.random.default_rng(seed)
    machine = TrueMachine(
        hidden,
        motor_gap=MAKER.motor_gap + GAP_SIGMA * source.standard_normal(),
        motor_height=MAKER.motor_height + POSE_SIGMA * source.standard_normal(),
        motor_center_x=POSE_SIGMA * source.standard_normal(),
        turn=TURN_SIGMA * source.standard_normal(),
    )
    machine = replace(machine, field=hidden.field(plan.targets, source))
    where = read(machine, plan, settings)
    return BoardCut(machine, measured(where, plan, source, noise, tape_sigma))


def read(machine: TrueMachine, plan: Plan, settings: MachineSettings = MAKER) -> Array:
    """Return where marks would be read (n, 2) [mm] without noise; ValueError if the sled cannot
    hang there.
    """
    where = machine.read(
        chains_for(plan, settings), approaches=plan.approaches, weights=plan.sled_weights
    )
    if not np.isfinite(where).all():
        raise ValueError("the judge's sled cannot hang at some mark")
    return where


def measured(
    where: Array, plan: Plan, source: np.random.Generator, noise: float, tape_sigma: float | None
) -> Measurements:
    """Return what is written down of places (n, 2) [mm]."""
    marks = [
        Mark(
            name=f"{target[0]:.0f}/{target[1]:.0f}",
            target=tuple(target),
            measured=None if plan.spans else tuple(place),
            approach=tuple(side) if any(side) else None,
            sled_weight=weight,
        )
        for target, place, side, weight in zip(
            plan.targets.tolist(),
            (where + noise * source.standard_normal(where.shape)).tolist(),
            plan.approaches.tolist(),
            plan.sled_weights.tolist(),
            strict=True,
        )
    ]
    spans: tuple[Distance, ...] = ()
    if plan.spans:
        ends = list(combinations(range(len(marks)), 2))
        ends += ends[:: len(ends) // 6][:6] * 2 if plan.again else []
        spans = tuple(
            Distance(
                (marks[i].name, marks[j].name),
                float(np.linalg.norm(where[i] - where[j]) + noise * source.standard_normal()),
            )
            for i, j in ends
        )
    else:
        marks += [
            replace(
                marks[i], measured=tuple((where[i] + noise * source.standard_normal(2)).tolist())
            )
            for i in plan.again
        ]
    return Measurements(tuple(marks), spans, tape_sigma=tape_sigma, source="hidden")


def chains_for(plan: Plan, settings: MachineSettings = MAKER) -> Array:
    """Return what a machine of these settings pays out (n, 2) [mm]."""
    chains, outcome = lengths(settings, plan.targets)
    if not (outcome == FOUND).all():
        raise ValueError("a plan reaches beyond the machine")
    return chains


def raw_field(cause: Cause, size: float, plan: Plan) -> Array:
    """Return how far marks (n, 2) [mm] move by a cause of some typical sizes, nothing refitted."""
    there = read(TrueMachine(Hidden(((cause, size),))), plan)
    moved: Array = there - read(TrueMachine(Hidden()), plan)
    return moved


_SIZES: dict[tuple[Any, ...], float] = {}


def size_for(cause: Cause, plan: Plan, millimetres: float) -> float:
    """Return how many typical sizes move the marks by so much RMS, before anything is refitted."""
    key = (
        cause.effect,
        cause.label,
        plan.targets.tobytes(),
        plan.approaches.tobytes(),
        millimetres,
    )
    if key not in _SIZES:
        size = 1.0
        for _ in range(3):
            moved = raw_field(cause, size, plan)
            size *= millimetres / np.sqrt(np.mean(np.sum(moved**2, axis=1)))
        _SIZES[key] = float(size)
    return _SIZES[key]
