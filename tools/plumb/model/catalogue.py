"""Every effect that can be fitted: those of the firmware, then those of the lab, which are here.

To add an effect of the lab, write it here and give it a line in LAB_EFFECTS.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from plumb import _core
from plumb.model.predict import (
    NAMES,
    CheckWords,
    EffectWords,
    ParameterWords,
    PlainWords,
    RuleReading,
    frame_words,
    library,
)
from plumb.text.values import in_both_units

# Lab effects: they act on what is measured and never on what is sent to the machine.
#
# To add an effect, write it here and give it a line in LAB_EFFECTS.


Array = NDArray[np.float64]
SLED = "sled"  # the sled comes to rest elsewhere, before the turn of the sheet
EDGES = "edges"  # what is read from the sheet's edges; distances between marks are as before
TAPE = "tape"  # everything that is read from a tape, distances too


@dataclass(frozen=True)
class Seen:
    """Places before an effect acts, and what else it may read."""

    places: Array  # (n, 2) [mm]
    approaches: Array  # (n, 2) unit vectors of the last move; zero where it is not known
    compliance: Array  # (n, 2, 2) [mm/N] of the hanging sled; zero for effects not on the sled


@dataclass(frozen=True)
class PlaceShift:
    """Shifts of places by an effect, and its slopes with everything else held."""

    moved: Array  # (n, 2) [mm] to be added to the places
    by_size: Array  # (n, 2) [mm per unit]
    by_place: Array  # (n, 2, 2) of `moved` by the places themselves


@dataclass(frozen=True, kw_only=True)
class LabEffect:
    """One physical cause that lies in what is measured and never in what the machine is sent.

    It has a single number. Two laws hold: with the number zero no bit of any place changes, and
    the number has a slope at zero.
    """

    words: EffectWords
    needs: str  # what measurements must hold to feel it
    acts_on: str  # SLED, EDGES or TAPE
    change: Callable[[float, Seen], PlaceShift]  # of the number and what is seen
    hidden_as: str  # what the bench does to a board by the number: drag, skew or strain
    reading: Callable[[float, float], RuleReading] | None = None  # by hand, on a sheet [mm]

    @property
    def name(self) -> str:
        """The effect's name."""
        return self.words["name"]

    @property
    def parameter(self) -> str:
        """Its number as a fit names it: `effect.parameter`."""
        return f"{self.name}.{self.words['parameters'][0]['name']}"


def _words(
    name: str,
    number: tuple[str, str, float, float, float, str],  # name, unit, low, high, typical, summary
    *,
    noun: str,
    summary: str,
    pattern: str,
    look_alikes: str,
    remedy: str,
    plain: tuple[str, str, str, float],  # more, less, unit, times
    example: tuple[str, float],  # its label, and how far it moves a mark at most [mm]
    sigma: float = 0.0,
    check: CheckWords | None = None,
) -> EffectWords:
    """Return an effect in the form of the firmware's library; no setting holds its number."""
    parameter, unit, low, high, typical, what = number
    more, less, shown_unit, times = plain
    words = PlainWords(more=more, less=less, unit=shown_unit, times=times, shown="as is")
    parameters = ParameterWords(
        name=parameter,
        setting=None,
        unit=unit,
        low=low,
        high=high,
        typical=typical,
        summary=what,
        sigma=sigma,
        plain=words,
        reading=None,
        published=None,
    )
    label, most = example
    return {
        "name": name,
        "noun": noun,
        "where": "lab",
        "summary": summary,
        "pattern": pattern,
        "look_alikes": look_alikes,
        "remedy": remedy,
        "empirical": False,
        "per_zeroing": False,
        "in_frame": False,
        "weight_power": 0,
        "check": check,
        "examples": [{"label": label, "sizes": {parameter: typical}, "most": most}],
        "parameters": [parameters],
    }


# Sled friction: the sled rubs on the sheet and stops short of where its chains let it hang.


def _friction(size: float, seen: Seen) -> PlaceShift:
    """Displacement = -compliance * drag * unit approach.

    Friction pulls against the last motion; a side force changes both tensions, so sag and stretch,
    so the place (see plumb.model.compliance). Marks whose approach is not known do not move. How
    the compliance itself changes from place to place is left to who worked it out.
    """
    per_newton = -np.einsum("nij,nj->ni", seen.compliance, seen.approaches)
    return PlaceShift(
        moved=size * per_newton, by_size=per_newton, by_place=np.zeros((len(per_newton), 2, 2))
    )


SLED_FRICTION = LabEffect(
    words=_words(
        "sled_friction",
        ("drag", "N", 0.0, 40.0, 6.0, "force of friction against the last motion"),
        noun="a sled that rubs",
        summary="the sled rubs on the sheet and stops short of where it would hang freely",
        pattern="marks lag behind their approach: millimetres in the lower corners, little "
        "elsewhere",
        look_alikes="chain_sag, frame_lean, noise if the approaches differ",
        remedy="approach every mark from the same side, keep marks out of the lowest corners, wax "
        "the sled; touch some marks from both sides to see how much it is",
        plain=("sled held back by #", "", "N", 1.0),
        example=("drag", 20.0),
    ),
    needs="marks with an approach",
    acts_on=SLED,
    hidden_as="drag",
    change=_friction,
)


# Sheet skew: places are read from edges of the sheet that are not square to each other.


def _skew(size: float, seen: Seen) -> PlaceShift:
    """Return the reading x grows by angle * y: a positive angle reads too far right at the top.

    That is a left edge whose top leans out to the left. Distances between marks do not feel it.
    """
    by_size = np.zeros_like(seen.places)
    by_size[:, 0] = seen.places[:, 1]
    by_place = np.zeros((len(by_size), 2, 2))
    by_place[:, 0, 1] = size
    return PlaceShift(size * by_size, by_size, by_place)


def _by_diagonals(width: float, height: float) -> RuleReading:
    """Return how the diagonals differ: their squares by about twice a diagonal times that."""
    return RuleReading(
        "how much longer the diagonal from the top left corner is",
        1.0,
        math.hypot(width, height) / (2 * width * height),
    )


SHEET_SKEW = LabEffect(
    words=_words(
        "sheet_skew",
        ("angle", "rad", -0.01, 0.01, 0.001, "by which the reading x grows for each mm up"),
        noun="sheet edges that are not square",
        summary="the edges from which marks are measured are not square to each other",
        pattern="the top row lies to one side of the bottom row; each row by itself is right",
        look_alikes="sled_swing, sheet_rotation in part",
        remedy="measure both diagonals of the sheet, or distances between marks instead of to "
        "edges",
        plain=("sheet edges # out of square for each metre", "", "mm", 1000.0),
        example=("skew", 4.0),
        sigma=0.0005,
        check={
            "title": "both diagonals of the sheet",
            "steps": in_both_units("Measure both diagonals of the sheet to {1 mm|0.039 inch}."),
            "value": "(top left to bottom right squared - bottom left to top right squared) / "
            "(4 width height)",
            "minutes": 5.0,
        },
    ),
    needs="marks measured from the sheet's edges, not distances alone",
    acts_on=EDGES,
    hidden_as="skew",
    change=_skew,
    reading=_by_diagonals,
)


# Tape scale: the tape's millimetres are not millimetres, so everything measured is too long.


def _scale(size: float, seen: Seen) -> PlaceShift:
    """Measured = true * (1 + strain), about the middle of the sheet: positive reads too long.

    (A tape that reads too long is itself too short. Where its hook sits only shifts all marks.)
    """
    by_place = np.broadcast_to(size * np.eye(2), (len(seen.places), 2, 2))
    return PlaceShift(size * seen.places, seen.places, by_place)


TAPE_SCALE = LabEffect(
    words=_words(
        "tape_scale",
        ("strain", "1", -0.003, 0.003, 0.0003, "share by which readings are too long"),
        noun="a tape that reads wrong",
        summary="the tape reads too long (positive) or too short, by the same share everywhere",
        pattern="all marks lie farther from the middle, in x and y alike, by the same share",
        look_alikes="chain_pitch of both chains, sled_swing, frame_flex",
        remedy="hold the tape against a length that you trust, like a steel rule or another tape",
        plain=("tape reads # too long", "tape reads # too short", "%", 100.0),
        example=("long", 4.0),
        sigma=0.0001,
        check={
            "title": "the tape against a certified length",
            "steps": in_both_units(
                "Hold the tape against a steel rule or a certified length of {1 m|39 3/8 inches}, "
                "or a second tape over {2 m|78 3/4 inches}, and read the difference to "
                "{0.1 mm per metre|0.001 inch per foot}."
            ),
            "value": "mm that the tape reads too much over a metre, / 1000",
            "minutes": 4.0,
        },
    ),
    needs="measured places or distances",
    acts_on=TAPE,
    hidden_as="strain",
    change=_scale,
    reading=lambda width, height: RuleReading(
        in_both_units("how much too much the tape reads over {a metre|39 3/8 inches}"),
        0.1,
        1 / 1000,
        digits=2,
    ),
)


# From the sled over the sheet to the tape: where the sled stops, what the edges say of it, and
# what the tape reads.
LAB_EFFECTS: tuple[LabEffect, ...] = (SLED_FRICTION, SHEET_SKEW, TAPE_SCALE)


# Every effect that can be fitted: those of the firmware, then those of the lab.


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
