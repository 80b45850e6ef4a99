"""Boards cut by settings that do not know what is hidden, and measured as an owner would."""

from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np
from plumb.hidden import BARE, CHAIN, MAKER, Array, Hidden, Plan, TrueMachine, read
from plumb.marks.read import Distance, Mark, Measurements
from plumb.model.predict import with_parameters
from plumb.settings import MachineSettings

# As published settings are: they correct the chain's sag and know nothing of its stretch.
PUBLISHED = with_parameters(
    BARE, {name: size for name, size in CHAIN.items() if name.startswith("chain_sag.")}
)
GAP_SIGMA, POSE_SIGMA, TURN_SIGMA = 3.0, 5.0, 0.002  # [mm, mm, rad] how far the frame is off


def joined(*plans: Plan) -> Plan:
    """Several plans as one board."""
    return Plan(
        targets=np.concatenate([plan.targets for plan in plans]),
        approaches=np.concatenate([plan.approaches for plan in plans]),
        sled_weights=np.concatenate([plan.sled_weights for plan in plans]),
    )


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
