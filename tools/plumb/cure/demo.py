"""The error of one real machine, step by step: which effects are kept, and what is doubtful."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

from plumb.cure.add import Addition, Quality, add
from plumb.fit.inputs import Inputs
from plumb.marks.read import Measurements, read_marks
from plumb.model.predict import known_effects
from plumb.settings.files import read_settings

EXAMPLE = Path(__file__).resolve().parents[1] / "examples" / "mibproj"
SETTINGS = EXAMPLE / "groundcontrol.ini"
MARKS = EXAMPLE / "Calibration Measurements.ini"
ORDER = ("chain_pitch", "chain_sag", "chain_stretch")
GOAL = 0.9  # [mm] RMS below which the error has fallen far enough


@dataclass(frozen=True)
class DemoStep:
    """One effect more, and whether it is kept."""

    name: str
    quality: Quality
    kept: bool


@dataclass(frozen=True)
class Demonstration:
    """What the demo shows."""

    steps: tuple[DemoStep, ...]  # frame only, then one effect more each
    chosen: Addition
    flipped: Addition  # the same effects, the y errors with the other sign
    inputs: Inputs

    @property
    def reached(self) -> bool:
        """Whether the error fell below the goal."""
        return self.chosen.after.fit_rms < GOAL


def demonstrate(measurements: Measurements | None = None) -> Demonstration:
    """Add one effect after the other; an effect stays if marks left out are predicted better."""
    settings = read_settings(SETTINGS, known=known_effects())
    marks = measurements or read_marks(MARKS, sheet=settings.sheet)
    chosen = add(Inputs(settings, marks), effects=())
    steps = [DemoStep("frame only", chosen.before, kept=True)]
    names: tuple[str, ...] = ()
    for effect in ORDER:
        tried = add(Inputs(settings, marks), effects=(*names, effect))
        kept = is_better(tried.after, chosen.after)
        steps.append(DemoStep(f"+ {effect}", tried.after, kept))
        if kept:
            chosen, names = tried, (*names, effect)
    other_sign = add(Inputs(settings, with_y_errors_flipped(marks)), effects=names)
    return Demonstration(tuple(steps), chosen, other_sign, Inputs(settings, marks))


def is_better(tried: Quality, known: Quality) -> bool:
    """Whether an effect is worth its price: both honest errors fall."""
    return tried.priced_rms < known.priced_rms and tried.left_out_rms < known.left_out_rms


def with_y_errors_flipped(measurements: Measurements) -> Measurements:
    """The same marks, each as far below its target as it was above it."""
    flipped = []
    for mark in measurements.marks:
        x, y = mark.measured or mark.target
        measured = (x, 2 * mark.target[1] - y) if mark.measured else None
        flipped.append(replace(mark, measured=measured))
    return replace(measurements, marks=tuple(flipped))
