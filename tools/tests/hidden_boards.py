"""Boards with a hidden effect: cut by our own settings, but the judge says where the sled went.

The judge's program shares no formula with the laws that the lab fits, so a slip in a law cannot
hide the same slip in the data.
"""

from __future__ import annotations

import subprocess
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from math import atan, cos, sqrt
from pathlib import Path

import numpy as np
from plumb.measurements import Mark, Measurements
from plumb.predict import FOUND, lengths
from synthetic import BELIEVED, grid

ROOT = Path(__file__).resolve().parents[2]
SOURCE = ROOT / "test/hidden/judge_marks.cpp"
EIGEN = ROOT / ".pio/libdeps/native/ArduinoEigen/ArduinoEigen"
PROGRAM = ROOT / ".build/hidden/judge_marks"

WEIGHT, COMPLIANCE = 0.00137293, 5.17e-6  # [N/mm], [1/N] of the chain of every board
SLED = BELIEVED.sled_weight
# What the maker believes: the judge's chain, so that only the hidden effect is missing.
MAKER = replace(
    BELIEVED,
    effects={
        "chain_sag": {"weight_ratio_squared": (WEIGHT / SLED) ** 2 / 24},
        "chain_stretch": {"compliance": COMPLIANCE},
    },
)
SIDES = np.array([(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)])
GAP_SIGMA, POSE_SIGMA, TURN_SIGMA = 3.0, 5.0, 0.002  # [mm, mm, rad] how far the frame is off

Numbers = dict[str, float]


def _both(name: str, value: float) -> Numbers:
    return {f"left.{name}": value, f"right.{name}": value}


def _lean(size: float) -> Numbers:
    lean = atan(sqrt(0.072 * size))
    # The frame's weights are those along the sheet; the judge wants the whole.
    whole = _both("weight", WEIGHT / cos(lean))
    return {"lean": lean, "sled_weight": SLED / cos(lean), **whole}


# The judge's numbers for an effect of so many typical sizes; empty where the judge has no part.
HIDDEN: Mapping[str, Callable[[float], Numbers]] = {
    "motor_level": lambda s: {"height_difference": 4 * s},
    "frame_flex": lambda s: {**_both("inward", 0.007 * s), **_both("downward", 0.02 * s)},
    "sled_swing": lambda s: {"bit_right": 2 * s, "bit_up": 2 * s},
    "chain_plane": lambda s: {"plane_gap": 40 * sqrt(s)},
    "frame_lean": _lean,
    "chain_sag": lambda s: _both("weight", WEIGHT * sqrt(1 + s)),
    "chain_stretch": lambda s: _both("compliance", COMPLIANCE * (1 + s)),
    "chain_pitch": lambda s: {"left.pitch": 0.001 * s, "right.pitch": 0.0003 * s},
    "sprocket_runout": lambda s: {"left.eccentric_x": 0.2 * s, "right.eccentric_y": 0.1 * s},
    "chain_zero": lambda s: {"left.zero": 2 * s, "right.zero": -1 * s},
    "sled_friction": lambda s: {},
    "sheet_skew": lambda s: {},
    "tape_scale": lambda s: {},
}


def build() -> Path:
    """The judge's program, compiled if any of its sources is newer."""
    sources = [SOURCE, *SOURCE.parents[1].glob("reference/*.h")]
    if not PROGRAM.exists() or any(
        one.stat().st_mtime > PROGRAM.stat().st_mtime for one in sources
    ):
        PROGRAM.parent.mkdir(parents=True, exist_ok=True)
        options = ["-std=c++17", "-O1", "-I", str(ROOT / "test"), "-isystem", str(EIGEN)]
        subprocess.run(["g++", *options, str(SOURCE), "-o", str(PROGRAM)], check=True)
    return PROGRAM


@dataclass(frozen=True)
class Plan:
    """Where the sled is sent, how it comes there, and what hangs on it."""

    targets: np.ndarray  # (n, 2) [mm]
    approaches: np.ndarray  # (n, 2) unit vectors, zero if nobody wrote them down
    sled_weights: np.ndarray  # (n,) [N]


def plan(
    columns: int, rows: int, *, approached: bool = True, sled_weight: float = SLED, times: int = 1
) -> Plan:
    """A grid over the sheet, cut or read so many times."""
    once = grid(columns, rows)
    targets = np.tile(once, (times, 1))
    sides = np.tile(SIDES[(np.arange(len(once)) * 7 // 3) % 4], (times, 1))
    return Plan(
        targets, sides if approached else 0 * sides, np.full(len(targets), float(sled_weight))
    )


def joined(*plans: Plan) -> Plan:
    """Several plans as one board."""
    return Plan(*(np.concatenate([getattr(p, f) for p in plans]) for f in vars(plans[0])))


def ask_judge(numbers: Numbers, own: Plan, *, drag: float = 0.0) -> np.ndarray:
    """Places (n, 2) [mm] of the sled of a machine with these numbers, sent by the maker's."""
    chains, found = lengths(MAKER, own.targets)
    assert (found == FOUND).all()
    base = {
        "sprocket_radius": MAKER.sprocket_radius,
        "motor_gap": MAKER.motor_gap,
        "motor_height": MAKER.motor_height,
        "rotation_radius": MAKER.rotation_radius,
        **_both("weight", WEIGHT),
        **_both("compliance", COMPLIANCE),
        "sled_weight": SLED,
    }
    given = {**base, **numbers}
    heavier = given["sled_weight"] / SLED
    lines = [f"{name} {float(value)!r}" for name, value in given.items()]
    for paid, side, weight in zip(chains, own.approaches, own.sled_weights, strict=True):
        push = -drag * side
        lines.append(f"sled_weight {float(weight * heavier)!r}")
        lines.append(" ".join(["place", *(repr(float(v)) for v in (*paid, *push))]))
    answer = subprocess.run(
        [PROGRAM], input="\n".join(lines), capture_output=True, text=True, check=True
    )
    places = np.array([line.split() for line in answer.stdout.splitlines()], dtype=float)
    assert np.isfinite(places).all()
    return places


def places_with(effect: str | None, size: float, own: Plan, frame: Numbers) -> np.ndarray:
    """Where marks are read (n, 2) [mm] with an effect of so many typical sizes."""
    numbers = {**frame, **(HIDDEN[effect](size) if effect else {})}
    where = ask_judge(numbers, own, drag=6 * size if effect == "sled_friction" else 0.0)
    if effect == "sheet_skew":
        where = where + 0.001 * size * np.stack([where[:, 1], 0 * where[:, 1]], axis=1)
    return where * (1 + 0.0003 * size) if effect == "tape_scale" else where


def size_for(effect: str, own: Plan, millimetres: float) -> float:
    """How many typical sizes move the marks by so much RMS, before anything is refitted."""
    clean, size = places_with(None, 0.0, own, {}), 1.0
    for _ in range(3):
        moved = places_with(effect, size, own, {}) - clean
        size *= millimetres / np.sqrt(np.mean(np.sum(moved**2, axis=1)))
    return size


def board(
    effects: Mapping[str, float],
    own: Plan,
    *,
    seed: int,
    noise: float = 0.5,
    tape_sigma: float | None = 0.5,
    bump: float = 0.0,
) -> Measurements:
    """A board as measured, by sizes of effects in typical ones; frame and sheet lie off by chance.

    bump [mm] RMS moves the marks around a place by what no effect of the library does.
    """
    source = np.random.default_rng(seed)
    frame = {
        "motor_gap": MAKER.motor_gap + GAP_SIGMA * source.standard_normal(),
        "motor_height": MAKER.motor_height + POSE_SIGMA * source.standard_normal(),
        "motor_center_x": POSE_SIGMA * source.standard_normal(),
    }
    numbers: Numbers = {}
    for effect, size in effects.items():
        numbers |= HIDDEN[effect](size)
    own_lab = {name: size for name, size in effects.items() if not HIDDEN[name](size)}
    where = ask_judge({**frame, **numbers}, own, drag=6 * own_lab.get("sled_friction", 0.0))
    skew, strain = 0.001 * own_lab.get("sheet_skew", 0), 0.0003 * own_lab.get("tape_scale", 0)
    turn = TURN_SIGMA * source.standard_normal()
    where = where @ np.array([[cos(turn), turn], [-turn, cos(turn)]])
    where = (where + skew * np.stack([where[:, 1], 0 * where[:, 1]], axis=1)) * (1 + strain)
    where = where + bump * _bump(own.targets, source)
    where = where + noise * source.standard_normal(where.shape)
    return Measurements(
        tuple(
            Mark(
                name=f"{target[0]:.0f}/{target[1]:.0f}",
                target=tuple(target),
                measured=tuple(place),
                approach=tuple(side) if any(side) else None,
                sled_weight=weight,
            )
            for target, place, side, weight in zip(
                own.targets.tolist(),
                where.tolist(),
                own.approaches.tolist(),
                own.sled_weights.tolist(),
                strict=True,
            )
        ),
        tape_sigma=tape_sigma,
        source="hidden",
    )


def _bump(targets: np.ndarray, source: np.random.Generator) -> np.ndarray:
    """A bump of 430 mm width somewhere on the sheet, in some direction, of unit RMS."""
    middle = source.uniform([-900, -400], [900, 400])
    shape = np.exp(-np.sum((targets - middle) ** 2, axis=1) / (2 * 430.0**2))
    turn = source.uniform(0, 2 * np.pi)
    moved = shape[:, np.newaxis] * np.array([np.cos(turn), np.sin(turn)])
    return moved / np.sqrt(np.mean(np.sum(moved**2, axis=1)))
