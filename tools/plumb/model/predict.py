"""The lab's only door to the compiled kinematics: settings in, chain lengths and places out."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from plumb import _core
from plumb.model.controllers import chain_lengths
from plumb.settings.machine import MachineSettings, frame_of

if TYPE_CHECKING:
    from plumb._core import EffectWords, FrameWords

Array = NDArray[np.float64]
Codes = NDArray[np.uint8]  # FOUND ... of each place or length, or USABLE ...
NAMES: tuple[str, ...] = tuple(_core.settings())  # of the values array, in its order
FOUND, OUT_OF_REACH, TOO_MANY_TRIES = 0, 1, 2  # what the kinematics says of a place or length
FOUND_WORDS = ("yes", "out of reach", "too many tries")
USABLE, TOO_TIGHT, TOO_SLACK, TOO_VERTICAL, CANNOT_HANG = range(5)  # what it says of a place's use
REACH_WORDS = ("usable", "too tight", "too slack", "too vertical", "cannot hang")
REACH_LIMITS: Mapping[str, float] = _core.reach_limits()  # the usual limits, by name [N, mm, mm/N]


@dataclass(frozen=True)
class Reached:
    """What n places are good for; a place where nothing hangs has zeros."""

    verdict: Codes  # (n,) USABLE ...
    tension: Array  # (n, 2) [N] of left and right chain at their sprockets
    compliance: Array  # (n, 2, 2) [mm/N] of the sled by a force along the sheet, symmetric

    @property
    def give(self) -> Array:
        """Compliance (n,) [mm/N] in the direction in which the sled gives most."""
        return np.asarray(np.linalg.eigvalsh(self.compliance)[:, -1], dtype=float)


def library() -> list[EffectWords]:
    """Every effect of the firmware, in the order applied: words, parameters and units."""
    return _core.effects()


def frame_words() -> list[FrameWords]:
    """The frame's numbers: name, unit, usual, low, high, summary."""
    return _core.frame()


def known_effects() -> dict[str, list[str]]:
    """The names of each effect's parameters."""
    return {
        effect["name"]: [parameter["name"] for parameter in effect["parameters"]]
        for effect in library()
    }


def parameter_names(effect: str) -> tuple[str, ...]:
    """The entries of NAMES that belong to an effect."""
    return tuple(name for name in NAMES if name.startswith(f"{effect}."))


def values_of(settings: MachineSettings) -> Array:
    """Our model of a machine as the values array (len(NAMES),) [mm, N, rad]."""
    return np.array([_value(settings, name) for name in NAMES], dtype=float)


def settings_of(values: Array, *, like: MachineSettings) -> MachineSettings:
    """The machine with these values; effects that are all zero are left out."""
    by_name = dict(zip(NAMES, (float(value) for value in values), strict=True))
    effects: dict[str, Mapping[str, float]] = {}
    for effect, parameters in known_effects().items():
        sizes = {name: by_name[f"{effect}.{name}"] for name in parameters}
        if any(sizes.values()):
            effects[effect] = sizes
    return replace(like, effects=effects, **frame_of(by_name))


def with_parameters(settings: MachineSettings, parameters: Mapping[str, float]) -> MachineSettings:
    """The machine with some parameters set, by full name `effect.parameter`."""
    effects = {name: dict(sizes) for name, sizes in settings.effects.items()}
    for name, value in parameters.items():
        effect, _, parameter = name.rpartition(".")
        effects.setdefault(effect, {})[parameter] = value
    return replace(settings, effects=effects)


def judged(settings: MachineSettings) -> dict[str, float]:
    """Our model of a machine in the numbers of the judge (tools/judge/reference/numbers.h)."""
    return _core.judged(values_of(settings), settings.feed == "top")


def usual_parameters(settings: MachineSettings) -> dict[str, float]:
    """What every machine with this frame has, by full name: the size to expect."""
    return _core.usual(values_of(settings), settings.feed == "top")


def lengths(
    settings: MachineSettings, points: Array, *, float32: bool = False
) -> tuple[Array, Codes]:
    """Chain paid out (n, 2) [mm] for places (n, 2) [mm] by our model, and FOUND (n,)."""
    return _core.lengths(
        values_of(settings), settings.feed == "top", _pairs(points), float32=float32
    )


def places(settings: MachineSettings, chains: Array) -> tuple[Array, Codes]:
    """Places (n, 2) [mm] for chains paid out (n, 2) [mm] by our model, and FOUND (n,)."""
    return _core.places(values_of(settings), settings.feed == "top", _pairs(chains))


def reach(settings: MachineSettings, points: Array, **limits: float) -> Reached:
    """Whether places (n, 2) [mm] are usable, by our model; limits as in REACH_LIMITS."""
    reached = _core.reach(values_of(settings), settings.feed == "top", _pairs(points), **limits)
    return Reached(**reached)


def places_with_slopes(
    values: Array, *, over_top: bool, chains: Array
) -> tuple[Array, Array, Codes]:
    """Places (n, 2), their slopes by every value (n, 2, len(NAMES)), and FOUND (n,).

    The chains are given, so place and values balance in lengths(place, values) = chains; hence
    d place = -(d lengths / d place)^-1 (d lengths / d values): the slopes are exact.
    """
    where, outcome = _core.places(values, over_top, _pairs(chains))
    by_value, by_place, _ = _core.slopes(values, over_top, where)
    slopes = np.zeros_like(by_value)
    good = outcome == FOUND
    slopes[good] = -np.linalg.solve(by_place[good], by_value[good])
    return where, slopes, outcome


def believed_lengths(
    settings: MachineSettings, targets: Array, *, controller: str | None = None
) -> Array:
    """Chain (n, 2) [mm] that the machine paid out for targets (n, 2) [mm], right or wrong.

    Raises ValueError naming a target that the controller cannot reach.
    """
    whose = controller or settings.controller
    if whose != "plumb":
        return chain_lengths(settings, targets, controller=whose)
    chains, outcome = lengths(settings.as_plumb_model(), targets)
    for i in np.flatnonzero(outcome != FOUND)[:1]:
        raise ValueError(f"target ({targets[i, 0]:g}, {targets[i, 1]:g}) is out of reach")
    return chains


def _value(settings: MachineSettings, name: str) -> float:
    effect, _, parameter = name.rpartition(".")
    return settings.effect(effect, parameter) if effect else getattr(settings, name)


def _pairs(points: Array) -> Array:
    return np.ascontiguousarray(points, dtype=float).reshape(-1, 2)
