"""What the machine believed: chain lengths by the formulas of the published controllers.

Not the truth, and not the kinematics of lib: only what was paid out when a mark was made.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from plumb.settings.machine import HOLEY_CHAIN_WEIGHT, MachineSettings

Array = NDArray[np.float64]
# The published sources write the number so; for a chain under the sprocket it is 0.03 um of chain.
PUBLISHED_PI = 3.14159


class StraightStrands(NamedTuple):
    """Both chains at n points; each array is (n, 2), left and right."""

    angle: Array  # [rad] of the straight line below the horizontal
    wrapped: Array  # [mm] on the sprocket, from 12 o'clock
    straight: Array  # [mm] from the tangent point to the bit
    across: Array  # [mm] horizontal part of the straight line
    drop: Array  # [mm] vertical part of the straight line


def chain_lengths(
    settings: MachineSettings, points: ArrayLike, *, controller: str | None = None
) -> Array:
    """Chain paid out from 12 o'clock, (n, 2) [mm] left and right, for targets (n, 2) [mm].

    Targets off the sheet are moved to its edge first, as the controllers do.
    """
    formulas: dict[str, Callable[[MachineSettings, StraightStrands], Array]] = {
        "stock": _stock,
        "holey": _holey,
    }
    whose = controller or settings.controller
    if whose not in formulas:
        raise ValueError(f"controller '{whose}' has no published formula; there are stock, holey")
    targets = np.asarray(points, dtype=float)
    if targets.ndim != 2 or targets.shape[1] != 2:
        raise ValueError(f"points must have the shape (n, 2), not {targets.shape}")
    _refuse_points(targets, ~np.isfinite(targets).all(axis=1), "is not a pair of finite numbers")
    with np.errstate(all="ignore"):
        strands = _strands(settings, clamped(settings, targets))
        lengths = formulas[whose](settings, strands)
    # Two chains hold a sled only where they pull upwards together.
    hangs = (np.sin(strands.angle.sum(axis=1)) > 0) & np.isfinite(lengths).all(axis=1)
    _refuse_points(targets, ~hangs, "is where the sled cannot hang on these two chains")
    return lengths


def clamped(settings: MachineSettings, points: Array) -> Array:
    """The points (n, 2) [mm], those off the sheet moved to its edge."""
    edge = np.array(settings.sheet) / 2
    return np.clip(points, -edge, edge)


def _refuse_points(points: Array, bad: NDArray[np.bool_], why: str) -> None:
    if bad.any():
        x, y = points[bad][0]
        raise ValueError(f"point ({x:g}, {y:g}) {why}")


def _strands(settings: MachineSettings, points: Array) -> StraightStrands:
    """The straight chains from their tangent points to the bit.

    angle = asin(below / distance) + asin(radius / distance) over the top, minus below it.
    """
    radius = settings.sprocket_radius
    motor_x = np.array([-settings.motor_gap / 2, settings.motor_gap / 2])
    below = (settings.motor_height - points[:, 1])[:, np.newaxis]
    distance = np.hypot(points[:, :1] - motor_x, below)
    lift = np.arcsin(radius / distance)
    over = settings.feed == "top"
    angle = np.arcsin(below / distance) + (lift if over else -lift)
    side = 1.0 if over else -1.0
    # From the tangent point, which lies inwards and above the axis, or outwards and below it.
    inwards = np.array([1.0, -1.0]) * (points[:, :1] - motor_x)
    return StraightStrands(
        angle=angle,
        wrapped=radius * (angle if over else PUBLISHED_PI - angle),
        straight=np.sqrt(distance**2 - radius**2),
        across=inwards - side * radius * np.sin(angle),
        drop=below + side * radius * np.cos(angle),
    )


def _stock(settings: MachineSettings, strands: StraightStrands) -> Array:
    """The published triangular formula: sag as a share of the straight part, then tolerance.

    sag share = correction * 1e-12 * cos(a)^2 * straight^2 * (tan(other) cos(a) + sin(a))^2
    """
    other = strands.angle[:, ::-1]
    cosine: Array = np.cos(strands.angle)
    pull = np.tan(other) * cosine + np.sin(strands.angle)
    sag = settings.published.chain_sag_correction * 1e-12
    hanging: Array = strands.straight * (1 + sag * (cosine * strands.straight * pull) ** 2)
    return strands.wrapped + hanging / _longer(settings) - settings.rotation_radius


def _holey(settings: MachineSettings, strands: StraightStrands) -> Array:
    """The catenary release: a catenary under the static tension, then tolerance and stretch.

    hanging^2 = (2 a sinh(across / (2 a)))^2 + drop^2 with a = horizontal tension / chain weight
    """
    catenary = settings.published.catenary
    if catenary is None:
        return _stock(settings, strands)
    sled_weight, elasticity = catenary
    weight: Array = sled_weight + HOLEY_CHAIN_WEIGHT / 2 * strands.straight.sum(
        axis=1, keepdims=True
    )
    cosine, sine = strands.across / strands.straight, strands.drop / strands.straight
    other = slice(None, None, -1)
    # Horizontal pulls are equal, vertical pulls carry the weight.
    tension = weight * cosine[:, other] / (sine * cosine[:, other] + cosine * sine[:, other])
    bend: Array = tension * cosine / HOLEY_CHAIN_WEIGHT
    hanging: Array = np.hypot(2 * bend * np.sinh(strands.across / (2 * bend)), strands.drop)
    stretched: Array = 1 + tension * elasticity
    return strands.wrapped + hanging / _longer(settings) / stretched - settings.rotation_radius


def _longer(settings: MachineSettings) -> Array:
    """Length of a nominal millimetre of either chain, (2,) [mm]."""
    published = settings.published
    percent: Array = np.array([published.left_tolerance, published.right_tolerance], dtype=float)
    return 1 + percent / 100
