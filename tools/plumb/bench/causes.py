"""What can be hidden in a board: each effect of the library in the judge's own numbers, and things
that the library has no word for.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from math import atan, cos, sqrt

import numpy as np

from plumb.settings.machine import MachineSettings

Array = np.ndarray
Numbers = dict[str, float]

WEIGHT, COMPLIANCE = 0.00137293, 5.17e-6  # [N/mm], [1/N] of the chain of every board
_BARE = MachineSettings(
    motor_gap=2978.4,
    motor_height=1072.6,
    rotation_radius=139.1,
    sheet_width=2438.4,
    sheet_height=1219.2,
    feed="top",
)
SLED = _BARE.sled_weight  # [N]
HALF = np.array([1219.2, 609.6])  # [mm] of the sheet
_SAG = (WEIGHT / SLED) ** 2 / 24
# What the maker believes: the judge's chain, so that only what is hidden is missing.
MAKER = replace(
    _BARE,
    effects={
        "chain_sag": {"weight_ratio_squared": _SAG},
        "chain_stretch": {"compliance": COMPLIANCE},
    },
)


@dataclass(frozen=True)
class Cause:
    """One effect in one direction of its parameters, by how many typical sizes of it there are."""

    effect: str
    label: str
    numbers: Callable[[float], Numbers] = lambda size: {}  # the judge's
    sizes: Callable[[float], Numbers] = lambda size: {}  # the library's, by parameter
    drag: float = 0.0  # [N] of friction
    skew: float = 0.0  # [rad] of the sheet's edges
    strain: float = 0.0  # of the tape


def _both(name: str, value: float) -> Numbers:
    return {f"left.{name}": value, f"right.{name}": value}


def _lean(size: float) -> Numbers:
    lean = atan(sqrt(0.072 * size))
    # The frame's weights are those along the sheet; the judge wants the whole.
    whole = _both("weight", WEIGHT / cos(lean))
    return {"lean": lean, "sled_weight": SLED / cos(lean), **whole}


def _flex(inward: float, downward: float, label: str) -> Cause:
    return Cause(
        "frame_flex",
        label,
        lambda s: {**_both("inward", inward * s), **_both("downward", downward * s)},
        lambda s: {"inward": inward * s, "downward": downward * s},
    )


def _swing(right: float, up: float, label: str) -> Cause:
    return Cause(
        "sled_swing",
        label,
        lambda s: {"bit_right": right * s, "bit_up": up * s},
        lambda s: {"right": right * s, "up": up * s},
    )


def _sides(effect: str, name: str, left: float, right: float, label: str) -> Cause:
    return Cause(
        effect,
        label,
        lambda s: {f"left.{name}": left * s, f"right.{name}": right * s},
        lambda s: {"left": left * s, "right": right * s},
    )


def _runout(left: float, right: float, label: str) -> Cause:
    return Cause(
        "sprocket_runout",
        label,
        lambda s: {"left.eccentric_x": left * s, "right.eccentric_y": right * s},
    )


CAUSES: tuple[Cause, ...] = (
    Cause(
        "motor_level",
        "right motor higher",
        lambda s: {"height_difference": 4 * s},
        lambda s: {"height_difference": 4 * s},
    ),
    _flex(0.007, 0.02, "inward and downward"),
    _flex(0.007, 0.0, "inward"),
    _flex(0.0, 0.02, "downward"),
    _swing(2, 2, "right and up"),
    _swing(2, 0, "right"),
    _swing(0, 2, "up"),
    Cause(
        "chain_plane",
        "sprockets off the sheet",
        lambda s: {"plane_gap": 40 * sqrt(s)},
        lambda s: {"gap_squared": 1600 * s},
    ),
    Cause("frame_lean", "leaning", _lean, lambda s: {"tangent_squared": 0.072 * s}),
    Cause(
        "chain_sag",
        "heavier chain",
        lambda s: _both("weight", WEIGHT * sqrt(1 + s)),
        lambda s: {"weight_ratio_squared": _SAG * (1 + s)},
    ),
    Cause(
        "chain_stretch",
        "softer chain",
        lambda s: _both("compliance", COMPLIANCE * (1 + s)),
        lambda s: {"compliance": COMPLIANCE * (1 + s)},
    ),
    _sides("chain_pitch", "pitch", 0.001, 0.001, "both alike"),
    _sides("chain_pitch", "pitch", 0.001, 0.0003, "left more"),
    _sides("chain_pitch", "pitch", 0.0, 0.001, "right"),
    _runout(0.1, 0.1, "both"),
    _runout(0.1, 0.0, "left"),
    _sides("chain_zero", "zero", 2, -1, "one each way"),
    _sides("chain_zero", "zero", 2, 2, "both alike"),
    Cause("sled_friction", "drag", sizes=lambda s: {"drag": 6 * s}, drag=6.0),
    Cause("sheet_skew", "skew", sizes=lambda s: {"angle": 0.001 * s}, skew=0.001),
    Cause("tape_scale", "long", sizes=lambda s: {"strain": 0.0003 * s}, strain=0.0003),
)
# A tilt of both motors is a turned sheet, and zeros of the chains are a frame elsewhere.
IN_THE_FRAME = ("motor_level", "chain_zero")


def causes_of(effect: str) -> tuple[Cause, ...]:
    """All causes of one effect, the usual one first."""
    return tuple(one for one in CAUSES if one.effect == effect)


@dataclass(frozen=True)
class Hidden:
    """What is wrong with a machine and its board, besides the frame that lies off by chance."""

    causes: tuple[tuple[Cause, float], ...] = ()  # with sizes in typical ones
    outside: str = ""  # of OUTSIDE: what no effect of the library does
    outside_mm: float = 0.0  # RMS of it [mm]

    @property
    def effects(self) -> tuple[str, ...]:
        """The hidden effects of the library."""
        return tuple(cause.effect for cause, _ in self.causes)

    @property
    def numbers(self) -> Numbers:
        """The judge's numbers."""
        found: Numbers = {}
        for cause, size in self.causes:
            found |= cause.numbers(size)
        return found

    @property
    def drag(self) -> float:
        """Friction of the sled [N]."""
        return sum(cause.drag * size for cause, size in self.causes)

    def read(self, places: Array) -> Array:
        """Places (n, 2) [mm] as edges that are not square and a wrong tape give them."""
        for cause, size in self.causes:
            skewed = cause.skew * size * places[:, 1]
            places = (places + np.stack([skewed, 0 * skewed], axis=1)) * (1 + cause.strain * size)
        return places


def _bump(targets: Array, source: np.random.Generator) -> Array:
    """A bump as wide as 0.35 half sheets each way, somewhere on the sheet, in some direction."""
    middle = source.uniform(-0.8, 0.8, 2)
    shape = np.exp(-np.sum((targets / HALF - middle) ** 2, axis=1) / (2 * 0.35**2))
    turn = source.uniform(0, 2 * np.pi)
    return shape[:, np.newaxis] * np.array([np.cos(turn), np.sin(turn)])


def _cubic(targets: Array, source: np.random.Generator) -> Array:
    """A polynomial of second and third degree in x and y, with coefficients of equal size.

    Shifts, turns, scales and skews are left out: the frame and the library have those.
    """
    x, y = (targets / HALF).T
    terms = [x**i * y**j for i in range(4) for j in range(4) if 2 <= i + j <= 3]
    return np.stack(terms, axis=1) @ source.standard_normal((len(terms), 2))


def _tipping(targets: Array, source: np.random.Generator) -> Array:
    """A sled that hangs over one edge of the sheet, where nothing holds it, and tips.

    Its bit then leans outward or inward, and up or down, by how far the sled of 230 mm stands out.
    """
    side = int(source.integers(4))
    axis, sign = side % 2, 1 - 2 * (side // 2)
    out = np.maximum(sign * targets[:, axis] + 230.0 - HALF[axis], 0.0)
    turn = source.uniform(0, 2 * np.pi)
    return out[:, np.newaxis] * np.array([np.cos(turn), np.sin(turn)])


OUTSIDE: Mapping[str, Callable[[Array, np.random.Generator], Array]] = {
    "bump": _bump,
    "cubic": _cubic,
    "tipping sled": _tipping,
}


@dataclass(frozen=True)
class Plan:
    """Where the sled is sent, how it comes there, what hangs on it, and what is read."""

    targets: Array  # (n, 2) [mm]
    approaches: Array  # (n, 2) unit vectors, zero if nobody wrote them down
    sled_weights: Array  # (n,) [N]
    again: tuple[int, ...] = ()  # marks that are read once more, each time
    spans: bool = False  # whether distances between marks are read instead of places
    name: str = field(default="", compare=False)
