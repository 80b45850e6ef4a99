"""What numbers of the published programs say of our effects, and back, by the effects' headers."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from plumb import _core

Effects = dict[str, dict[str, float]]

# The $-numbers by which published settings describe chains, and what we call them.
TUNED = {37: "chain_sag_correction", 40: "left_tolerance", 41: "right_tolerance"}
ELASTICITY = 45  # of the catenary release [1/N]

# By effect and parameter: the published number and by how much it is larger than ours.
_SAID: dict[tuple[str, str], tuple[int, float]] = {
    (effect["name"], parameter["name"]): parameter["published"]
    for effect in _core.effects()
    for parameter in effect["parameters"]
    if parameter["published"]
}


def effects_said_by(numbers: Mapping[int, float]) -> Effects:
    """The parameters that published numbers set, even if they are zero."""
    effects: Effects = {}
    for (effect, parameter), (number, factor) in _SAID.items():
        if number in numbers:
            effects.setdefault(effect, {})[parameter] = numbers[number] / factor
    return effects


def usual_effects(frame: Mapping[str, float]) -> Effects:
    """What every machine with this frame has: the sizes to expect."""
    values = np.array([frame.get(name, 0.0) for name in _core.settings()], dtype=float)
    effects: Effects = {}
    for name, size in _core.usual(values, True).items():
        effect, _, parameter = name.partition(".")
        effects.setdefault(effect, {})[parameter] = size
    return effects


def present(effects: Mapping[str, Mapping[str, float]]) -> Effects:
    """Those effects of which some parameter is not zero."""
    return {name: dict(sizes) for name, sizes in effects.items() if any(sizes.values())}


def tuned_numbers(effects: Mapping[str, Mapping[str, float]]) -> dict[str, float]:
    """The published settings, by our name for each, that say what these effects are."""
    return {
        TUNED[number]: factor * effects.get(effect, {}).get(parameter, 0.0)
        for (effect, parameter), (number, factor) in _SAID.items()
        if number in TUNED
    }


def is_tuned(effect: str, parameter: str) -> bool:
    """Whether a setting of every published firmware says this parameter."""
    return _SAID.get((effect, parameter), (0, 0.0))[0] in TUNED
