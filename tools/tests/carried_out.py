"""Carrying out what `plumb next` proposes on the judge's machines: marks, weights, checks."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import cos

import numpy as np
from hidden_boards import (
    COMPLIANCE,
    GAP_SIGMA,
    HIDDEN,
    MAKER,
    POSE_SIGMA,
    SLED,
    TURN_SIGMA,
    WEIGHT,
    Plan,
    ask_judge,
    places_with,
)
from plumb.diagnosis import Checked
from plumb.marks.read import Measurements
from plumb.plan.case import Check
from plumb.plan.planned_visits import Visits

# What an owner would find who measured the parameter itself, for this many typical sizes.
TRUE_VALUES = {
    "motor_level.height_difference": lambda s: 4 * s,
    "frame_flex.inward": lambda s: 0.007 * s,
    "frame_flex.downward": lambda s: 0.02 * s,
    "sled_swing.right": lambda s: 2 * s,
    "sled_swing.up": lambda s: 2 * s,
    "chain_plane.gap_squared": lambda s: 1600 * s,
    "frame_lean.tangent_squared": lambda s: 0.072 * s,
    "chain_sag.weight_ratio_squared": lambda s: (WEIGHT / SLED) ** 2 / 24 * (1 + s),
    "chain_stretch.compliance": lambda s: COMPLIANCE * (1 + s),
    "chain_pitch.left": lambda s: 0.001 * s,
    "chain_pitch.right": lambda s: 0.0003 * s,
    "chain_zero.left": lambda s: 2 * s,
    "chain_zero.right": lambda s: -1 * s,
    "sheet_skew.angle": lambda s: 0.001 * s,
    "tape_scale.strain": lambda s: 0.0003 * s,
    "sled_friction.drag": lambda s: 6 * s,
    "sprocket_runout.left_cosine": lambda s: -0.2 * s,
    "sprocket_runout.right_sine": lambda s: -0.1 * s,
}


@dataclass(frozen=True)
class Bench:
    """One machine with a hidden effect on one sheet, and its owner's tape."""

    effect: str | None
    size: float  # in typical sizes
    seed: int
    noise: float = 0.5  # [mm]

    @property
    def frame(self) -> dict[str, float]:
        """How the frame really is [mm]."""
        gap, height, across = np.random.default_rng([self.seed, 1]).standard_normal(3)
        return {
            "motor_gap": MAKER.motor_gap + GAP_SIGMA * gap,
            "motor_height": MAKER.motor_height + POSE_SIGMA * height,
            "motor_center_x": POSE_SIGMA * across,
        }

    def measured(self, *several: Visits) -> Measurements:
        """The marks of all visits, one group after the other; the first read the same whatever
        follows."""
        marks = []
        for number, visits in enumerate(several):
            where = self._read(visits, number)
            marks += visits.marks(where)
        return Measurements(tuple(marks), tape_sigma=self.noise, source="carried out")

    def checked(self, checks: Sequence[Check]) -> list[Checked]:
        """What direct measurements would find."""
        source = np.random.default_rng([self.seed, 2])
        return [
            Checked(
                check.name,
                self._truth(check.name) + check.sigma * source.standard_normal(),
                check.sigma,
            )
            for check in checks
        ]

    def _truth(self, name: str) -> float:
        if "." not in name:
            return self.frame.get(name, getattr(MAKER, name))
        size = self.size if name.startswith(f"{self.effect}.") else 0.0
        return TRUE_VALUES[name](size) if name in TRUE_VALUES else 0.0

    def _read(self, visits: Visits, number: int) -> np.ndarray:
        plan = Plan(visits.targets, visits.approaches, visits.sled_weights)
        where = places_with(self.effect, self.size, plan, self.frame).reshape(-1, 2)
        if visits.swapped.any() and self.effect == "chain_pitch":
            numbers = HIDDEN["chain_pitch"](self.size)
            other = {"left.pitch": numbers["right.pitch"], "right.pitch": numbers["left.pitch"]}
            swapped = ask_judge({**self.frame, **other}, plan)
            where = np.where(visits.swapped[:, np.newaxis], swapped, where)
        turn = TURN_SIGMA * np.random.default_rng([self.seed, 3]).standard_normal()
        where = where @ np.array([[cos(turn), turn], [-turn, cos(turn)]])
        source = np.random.default_rng([self.seed, 4, number])
        return where + self.noise * source.standard_normal(where.shape)
