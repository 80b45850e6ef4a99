"""Every effect that can be fitted: those of the firmware, of the lab, then sketches."""

from __future__ import annotations

from typing import Any

from plumb.model.lab_effects import LAB_EFFECTS
from plumb.model.predict import library
from plumb.model.sketches import SKETCHES

NO_FIRMWARE = "no firmware can cure this"


def every_effect() -> list[dict[str, Any]]:
    """The words of every effect that may be a cause; `where` is "firmware", "lab" or "sketch"."""
    firmware = [{**words, "where": "firmware"} for words in library() if not words["empirical"]]
    lab = [effect.words for effect in LAB_EFFECTS]
    return firmware + lab + [sketch.words for sketch in SKETCHES]


def empirical_effects() -> list[dict[str, Any]]:
    """The words of what the firmware can apply that is a mere fit and never a suspect."""
    return [{**words, "where": "firmware"} for words in library() if words["empirical"]]


def effect_names() -> tuple[str, ...]:
    """The names of all effects."""
    return tuple(words["name"] for words in every_effect())


def is_lab(effect: str) -> bool:
    """Whether the effect acts on what is measured only."""
    return any(known.name == effect for known in LAB_EFFECTS)


def is_sketch(effect: str) -> bool:
    """Whether the effect is on trial in Python, so that no firmware has it."""
    return any(known.name == effect for known in SKETCHES)


def place_of(effect: str) -> str:
    """Where the effect is written: "firmware", "lab" or "sketch"."""
    if is_sketch(effect):
        return "sketch"
    return "lab" if is_lab(effect) else "firmware"


def label(effect: str) -> str:
    """The effect's name, marked where no firmware has it."""
    if is_sketch(effect):
        return f"{effect} (sketch, not in the firmware)"
    return f"{effect} (lab)" if is_lab(effect) else effect


def parameter_words() -> dict[str, dict[str, Any]]:
    """The words of each parameter by its full name, `effect.parameter`."""
    return {
        f"{effect['name']}.{parameter['name']}": parameter
        for effect in (*every_effect(), *empirical_effects())
        for parameter in effect["parameters"]
    }


def parameter_names(effect: str) -> tuple[str, ...]:
    """The full names of an effect's parameters."""
    return tuple(name for name in parameter_words() if name.startswith(f"{effect}."))
