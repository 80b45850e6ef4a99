"""Contents of docs/effects.md and its pictures: how each effect shows on the default machine."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from plumb.cli.drawing import Panel, draw
from plumb.fit.compare import best_pose
from plumb.fit.observations import observe, rms, sighted
from plumb.hidden import BARE
from plumb.marks.read import Mark, Measurements
from plumb.model.catalogue import (
    EVERY_MACHINE,
    NO_FIRMWARE,
    empirical_effects,
    every_effect,
    is_felt_by_approach,
    is_lab,
    parameter_words,
)
from plumb.model.predict import FOUND, values_of, with_parameters
from plumb.settings import MachineSettings
from template import filled

PAGE = "docs/effects.md"
PICTURES = "docs/pictures/effects"
DRAWN_COLUMNS, DRAWN_ROWS = 9, 5
Array = np.ndarray
EDGE = (1150.0, 550.0)  # [mm] how far from the middle marks are made
COLUMNS, ROWS = 13, 7  # of the marks by which sizes and cosines are worked out
FRAME_STEPS = {"motor_gap": 3.0, "motor_height": 10.0, "rotation_radius": 1.0}  # [mm]
RIGHT, UP = (1.0, 0.0), (0.0, 1.0)  # approaches
# With the sag and the stretch that every machine has.
DEFAULT_MACHINE = with_parameters(
    BARE,
    {
        name: words["typical"]
        for name, words in parameter_words().items()
        if name.partition(".")[0] in EVERY_MACHINE
    },
)
SHAPELESS = 0.02  # [share of the raw error] below which there is no shape to speak of


@dataclass(frozen=True)
class Field:
    """Where marks land against where they were sent."""

    sent: Array  # (n, 2) [mm]
    raw: Array  # (n, 2) [mm] landed or read - sent
    shape: Array  # (n, 2) [mm] after the best shift and rotation

    @property
    def has_shape(self) -> bool:
        """Whether more than shift and rotation is to be seen."""
        return rms(self.shape) > SHAPELESS * rms(self.raw)


@dataclass(frozen=True)
class Showing:
    """A way in which an effect shows: some of its parameters at their typical size."""

    label: str
    parameters: Mapping[str, float]  # by full name, or numbers of the frame [mm] off
    approach: tuple[float, float] = RIGHT

    @cached_property
    def field(self) -> Field:
        """Shifts of a grid of marks over the sheet."""
        return self.field_on(COLUMNS, ROWS)

    def field_on(self, columns: int, rows: int) -> Field:
        """Return the same for a grid of so many marks."""
        across, up = np.linspace(-EDGE[0], EDGE[0], columns), np.linspace(EDGE[1], -EDGE[1], rows)
        sent = np.array([(x, y) for y in up for x in across])
        true, believed, outside = _machines(self)
        marks = [Mark(f"{x}/{y}", (x, y), approach=self.approach) for x, y in sent.tolist()]
        sighting = sighted(
            values_of(true),
            outside,
            observe(believed, Measurements(tuple(marks))),
            over_top=True,
            usual_weight=true.sled_weight,
            names=(),
        )
        if (sighting.outcome != FOUND).any():
            raise ValueError(f"{self.label}: the default machine cannot reach every mark")
        landed = sighting.read.where
        pose = best_pose(sent, landed)
        assert pose, "a grid of marks has a shape"
        return Field(sent, landed - sent, pose.errors)

    @property
    def label_with_size(self) -> str:
        """The label with the sizes of its parameters, like `left = 2 mm`."""
        words = parameter_words()
        sizes = dict.fromkeys(
            f"{value:g} {words[name]['unit']}".removesuffix(" 1")
            for name, value in self.parameters.items()
        )
        name, comma, way = self.label.partition(", ")
        return f"{name} = {' and '.join(sizes)}{comma}{way}"


Showings = Mapping[str, Sequence[Showing]]


def _machines(case: Showing) -> tuple[MachineSettings, MachineSettings, dict[str, float]]:
    """Return the true machine, the machine by the settings, and what lies outside of both."""
    true = believed = DEFAULT_MACHINE
    outside = {}
    for name, value in case.parameters.items():
        effect = name.rpartition(".")[0]
        if not effect:
            true = replace(true, **{name: getattr(true, name) + value})
        elif is_lab(effect):
            outside[name] = value
        elif effect in EVERY_MACHINE:
            others = {name: sizes for name, sizes in believed.effects.items() if name != effect}
            believed = replace(believed, effects=others)
        else:
            true = with_parameters(true, {name: value})
    return true, believed, outside


def every_showing() -> dict[str, list[Showing]]:
    """Return how each effect shows, and each of the frame's numbers that marks feel."""
    effects = {effect["name"]: showings_of(effect) for effect in every_effect()}
    return effects | {name: [Showing(name, {name: step})] for name, step in FRAME_STEPS.items()}


def showings_of(effect: Mapping[str, Any]) -> list[Showing]:
    """Return how an effect shows: each parameter, both sides alike, both approaches."""
    typical = {f"{effect['name']}.{each['name']}": each["typical"] for each in effect["parameters"]}
    cases = [Showing(name.rpartition(".")[2], {name: value}) for name, value in typical.items()]
    if [case.label for case in cases] == ["left", "right"]:
        cases.append(Showing("both alike", typical))
    if is_felt_by_approach(effect["name"]):
        ways = (("approached moving right", RIGHT), ("approached moving up", UP))
        cases = [Showing(f"{case.label}, {way}", typical, to) for case in cases for way, to in ways]
    return cases


def look_alikes(name: str, showings: Showings, *, most: int = 3) -> list[tuple[str, float]]:
    """Return the other causes whose shape comes nearest to any shape of this effect, nearest
    first, each with the cosine between the shapes; negative: the same with the other sign.
    """
    shapes = {
        other: [case.field.shape for case in cases if case.field.has_shape]
        for other, cases in showings.items()
    }
    nearest = [
        (other, max((cosine(mine, each) for mine in shapes[name] for each in theirs), key=abs))
        for other, theirs in shapes.items()
        if other != name and theirs and shapes[name]
    ]
    # Rounded first, so that the order does not hang on the last bits.
    return sorted(nearest, key=lambda alike: (-round(abs(alike[1]), 2), alike[0]))[:most]


def cosine(first: Array, second: Array) -> float:
    """Return the cosine of the angle between two fields (n, 2), each taken as a long vector."""
    return float(np.sum(first * second) / (np.linalg.norm(first) * np.linalg.norm(second)))


def worst(errors: Array) -> float:
    """Length [mm] of the longest error of (n, 2)."""
    return float(np.hypot(errors[:, 0], errors[:, 1]).max())


def pages() -> dict[str, str]:
    """Return the page by its name below the project's root."""
    effects, showings = every_effect(), every_showing()
    text = filled(
        "effects.md",
        effects=effects,
        patches=empirical_effects(),
        showings=showings,
        no_firmware=NO_FIRMWARE,
        columns=COLUMNS,
        rows=ROWS,
        frame_steps=FRAME_STEPS,
        alike=lambda name: alike(name, showings),
        largest=lambda several: f"{max(map(worst, several)):.1f}",
    )
    return {PAGE: text}


def pictures() -> dict[str, bytes]:
    """Return the picture of each effect by its name below the project's root."""
    showings = every_showing()
    return {
        f"{PICTURES}/{effect['name']}.png": draw(
            [_panel(case) for case in showings[effect["name"]]], sheet=BARE.sheet
        )
        for effect in every_effect()
    }


def _panel(case: Showing) -> Panel:
    """Return the shape that an effect draws; all that marks do, where they only shift and turn."""
    drawn, whole = case.field_on(DRAWN_COLUMNS, DRAWN_ROWS), case.field
    if not whole.has_shape:
        said = f"{case.label_with_size}: no shape, {_sizes(whole.raw)}"
        return Panel(said, drawn.sent, drawn.raw)
    said = f"{case.label_with_size}: {_sizes(whole.shape)}; {rms(whole.raw):.2f} as it is"
    return Panel(said, drawn.sent, drawn.shape)


def alike(name: str, showings: Showings) -> str:
    """Return the computed look-alikes in words."""
    nearest = look_alikes(name, showings)
    if nearest:
        return ", ".join(f"`{other}` {cosine + 0.0:.2f}" for other, cosine in nearest)
    shapeless = [
        f"`{other}`"
        for other, cases in showings.items()
        if other != name and not any(case.field.has_shape for case in cases)
    ]
    others = " and ".join([*shapeless, "`sheet_rotation`"])
    return f"it has no shape, so everything that shifts and turns the sheet: {others}"


def _sizes(errors: Array) -> str:
    return f"{rms(errors):.2f} mm RMS, worst {worst(errors):.2f}"
