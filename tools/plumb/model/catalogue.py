"""Every effect that can be fitted: those of the firmware, then those of the lab."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from plumb import _core
from plumb.model.lab_effects import LAB_EFFECTS, SLED
from plumb.model.predict import NAMES, frame_words, library

if TYPE_CHECKING:
    from plumb.model.effect_words import EffectWords, ParameterWords

NO_FIRMWARE = "no firmware can cure this"


def _on_every_machine() -> tuple[str, ...]:
    """Return the effects that no real machine is without."""
    frame = [parameter["usual"] for parameter in frame_words()]
    values = np.array(frame + [0.0] * (len(NAMES) - len(frame)))
    return tuple(dict.fromkeys(name.partition(".")[0] for name in _core.usual(values, True)))


EVERY_MACHINE = _on_every_machine()


# Left, right: new each time the chains are zeroed.
ZEROING_NAMES = tuple(
    f"{effect['name']}.{parameter['name']}"
    for effect in library()
    if effect["per_zeroing"]
    for parameter in effect["parameters"]
)
# Parameters that go with a power of the sled's weight.
WEIGHT_POWERS = {
    f"{effect['name']}.{parameter['name']}": effect["weight_power"]
    for effect in library()
    if effect["weight_power"]
    for parameter in effect["parameters"]
}


def every_effect() -> list[EffectWords]:
    """Return the words of every effect that may be a cause; `where` is "firmware" or "lab"."""
    firmware = [words for words in library() if not words["empirical"]]
    return firmware + [effect.words for effect in LAB_EFFECTS]


def empirical_effects() -> list[EffectWords]:
    """Return the words of what the firmware can apply that is a mere fit and never a suspect."""
    return [words for words in library() if words["empirical"]]


def effect_names() -> tuple[str, ...]:
    """Return the names of all effects."""
    return tuple(words["name"] for words in every_effect())


def is_lab(effect: str) -> bool:
    """Return whether the effect acts on what is measured only."""
    return any(known.name == effect for known in LAB_EFFECTS)


def is_felt_by_approach(effect: str) -> bool:
    """Return whether marks from opposite sides tell the effect: it moves the sled that comes to
    rest.
    """
    return any(known.name == effect and known.acts_on == SLED for known in LAB_EFFECTS)


def place_of(effect: str) -> str:
    """Return where the effect is written: "firmware" or "lab"."""
    return "lab" if is_lab(effect) else "firmware"


def label(effect: str) -> str:
    """Return the effect's name, marked where no firmware has it."""
    return f"{effect} (lab)" if is_lab(effect) else effect


def parameter_words() -> dict[str, ParameterWords]:
    """Return the words of each parameter by its full name, `effect.parameter`."""
    return {
        f"{effect['name']}.{parameter['name']}": parameter
        for effect in (*every_effect(), *empirical_effects())
        for parameter in effect["parameters"]
    }


def parameter_names(effect: str) -> tuple[str, ...]:
    """Return the full names of an effect's parameters."""
    return tuple(name for name in parameter_words() if name.startswith(f"{effect}."))
