"""What a plan of marks is good for before any hole is drilled: where it reaches, and which effects
it tells apart.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Annotated

import numpy as np
import scipy

from plumb.diagnosis.diagnosis import NOTHING
from plumb.diagnosis.explanation import FEWEST_NUMBERS, Board, Explanation
from plumb.diagnosis.priors import chance_of, largest_met
from plumb.fit.compare import Expected, expected_anywhere, expected_priors, expected_sentence
from plumb.fit.fit import PRIORS
from plumb.fit.observations import different_numbers, model_and_observations
from plumb.grid import APPROACH, Touch
from plumb.marks.read import Mark, Measurements
from plumb.model.catalogue import effect_names
from plumb.model.plain import noun_of, ranked
from plumb.model.predict import REACH_WORDS
from plumb.model.reach import Extreme, Survey, conclusion_of, percent, survey_sheet
from plumb.plan.proposal import apart
from plumb.settings import MachineSettings
from plumb.text.answers import Internal, in_json, key, part
from plumb.text.errors import InputError
from plumb.text.values import MM, Unit

# The part of a sheet that a machine can use, and how far off is normal there: one answer.


SIGNS = ".TSV#"  # by verdict
MEANING = (
    "usable",
    "too tight: a chain pulls more than its gearbox should",
    "too slack: a chain pulls less than its gears need to lie on one side",
    "too vertical: only a slack chain holds the sled, which gives sideways",
    "no sled hangs there, or its ring touches a sprocket",
)
MAP_STEP = 4  # every fourth place of the survey


@dataclass(frozen=True)
class Share:
    """A share of the sheet, and what is to be said of it."""

    sign: str  # on the map
    share: str
    meaning: str


@dataclass(frozen=True, kw_only=True)
class SheetReach:
    """The usable part of the sheet, and what limits the rest."""

    survey: Internal[Survey]
    expected: Expected | None  # None: no sled hangs on this sheet
    unit: Internal[Unit] = MM  # of the lengths in what is said of it

    extremes = part("survey.extremes", tuple[Extreme, ...])
    assumed = part("survey.assumed", tuple[str, ...], "What the settings do not say.")

    @in_json
    def conclusion(self) -> str:
        """The usable part in a sentence."""
        return conclusion_of(self.survey)

    @in_json
    def normal(self) -> str:
        """The expected error in sentences; empty if no mark can be made."""
        return expected_sentence(self.expected, self.unit)

    @in_json
    def shares(self) -> dict[str, float]:
        """The share of the sheet of each verdict."""
        return {word.replace(" ", "_"): share for word, share in self.survey.shares.items()}

    @in_json
    def legend(self) -> list[Share]:
        """The verdicts that the map has."""
        each = zip(SIGNS, map(self.survey.shares.get, REACH_WORDS), MEANING, strict=True)
        return [Share(sign, percent(share), meaning) for sign, share, meaning in each if share]

    @in_json
    def map(self) -> list[str]:
        """The sheet in characters, from the top down; edges included."""
        rows = self.survey.reached.verdict.reshape(len(self.survey.y), len(self.survey.x))
        return ["".join(SIGNS[each] for each in row) for row in rows[::MAP_STEP, ::MAP_STEP]]


def reach_of(
    settings: MachineSettings, known: Mapping[str, float]
) -> tuple[Survey, Expected | None]:
    """Return what a SheetReach is made of; `known`: how far stated numbers may be off."""
    return survey_sheet(settings), expected_anywhere(settings, expected_priors(known))


# Power of a plan before any hole is drilled: effect against effect, in sigmas.
#
# Each effect is there in its typical size. A cell is the length of what the row's effect draws and
# neither the refitted frame nor the column's effect can imitate, over the reading error. With
# several parameters it is the root of their squares, so no sign or mixture of them is preferred.


Array = np.ndarray
POWER = 0.8  # chance with which the smallest size that counts as proved is proved
UNSEEN = 0.01  # sigmas below which no size is worth asking for
APART = 3.0  # sigmas from which two effects are distinguished in most cases


@dataclass(frozen=True)
class Outline:
    """One effect by itself under a plan."""

    effect: str
    seen: Annotated[float, key("snr")]  # [sigmas] of its typical size beyond the frame
    smallest: float | None  # times typical, proved with POWER
    alike: tuple[str, ...]  # effects it would be taken for
    is_distinct: bool  # in most cases it is taken for no other effect

    @in_json
    def noun(self) -> str:
        """The effect in a maker's words."""
        return noun_of(self.effect)

    @in_json
    def is_seen(self) -> bool:
        """Whether it shows in its typical size, with POWER."""
        return self.smallest is not None and self.smallest <= 1


@dataclass(frozen=True)
class Preview:
    """Power of a plan to show and to name effects."""

    sigma: Annotated[float, key("sigma_mm")]
    marks: int
    outlines: tuple[Outline, ...]

    @in_json
    def seen(self) -> int:
        """Effects that would show in their usual size."""
        return sum(each.is_seen for each in self.outlines)

    @in_json
    def named(self) -> int:
        """Effects that could be named in their usual size: they show and have no look-alike."""
        return sum(each.is_seen and each.is_distinct for each in self.outlines)


def preview(
    settings: MachineSettings,
    plan: Measurements,
    *,
    sigma: float,
    priors: Mapping[str, float] = PRIORS,
) -> Preview:
    """Return what marks at the targets of a plan could tell; sigma [mm] of one coordinate."""
    frame = _as_planned(settings, plan, sigma, priors)
    matrix = _matrix(frame)
    return Preview(
        sigma=sigma,
        marks=len(frame.board.rows.measured),
        outlines=tuple(_outline(frame, i, matrix) for i in range(len(matrix))),
    )


def as_read(touches: Sequence[Touch]) -> Measurements:
    """Return a plan as if all were read just where it was sent."""
    places = ((touch.name, (touch.x, touch.y)) for touch in touches)
    marks = tuple(Mark(name, place, place, approach=APPROACH) for name, place in places)
    return Measurements(marks, source="the plan")


def _as_planned(
    settings: MachineSettings, plan: Measurements, sigma: float, priors: Mapping[str, float]
) -> Explanation:
    """Return the frame's explanation of readings that are just what the model says."""
    model, rows = model_and_observations(settings, plan)
    if different_numbers(plan, rows) < FEWEST_NUMBERS:
        raise InputError(f"{plan.source}: too few marks for a diagnosis; plan at least three")
    board = Board.of(model, rows, sigma=sigma, priors=priors)
    sighting, _ = board.problem.predict(np.zeros(len(board.problem.names)))
    return board.with_rows(replace(rows, measured=sighting.read.where[rows.mark_rows])).fitted


def _matrix(frame: Explanation) -> Array:
    """Sigmas of each effect (row) beyond the frame and each other effect (column)."""
    board, names, slopes = frame.board, effect_names(), frame.slopes
    sigmas = np.zeros((len(names), len(names)))
    for i, effect in enumerate(names):
        drawn = np.eye(slopes.shape[1])[:, board.columns([effect])]
        for j, other in enumerate(names):
            fitted_too = board.columns([other]) if i != j else np.zeros(0, dtype=int)
            sigmas[i, j] = apart(slopes, drawn, np.concatenate([board.frame, fitted_too]))
    return np.sqrt(sigmas)


def _outline(frame: Explanation, i: int, matrix: Array) -> Outline:
    names, seen = effect_names(), float(matrix[i, i])
    alike = [
        (matrix[i, j], other)
        for j, other in enumerate(names)
        if j != i and matrix[i, j] < min(APART, 0.7 * seen)
    ]
    return Outline(
        effect=names[i],
        seen=seen,
        smallest=_needed(frame.board, names[i], seen) / seen if seen > UNSEEN else None,
        alike=tuple(other for _, other in ranked(alike, lambda each: each[0])),
        is_distinct=bool((matrix[i] >= APART).all()),
    )


def _needed(board: Board, effect: str, seen: float) -> float:
    """Sigmas that an effect must draw to be named in POWER of all cases; `seen` are those that it
    draws in its typical size.

    It is named once "nothing" is less likely than NOTHING. For one direction that is seen with
    d sigmas for each spread of its prior, the logarithm of its odds is that of the prior and
    z^2 / 2 * d^2 / (1 + d^2) - log(1 + d^2) / 2 (Laplace).
    """
    columns = board.columns([effect])
    largest = float(np.mean(largest_met(board, columns)))
    log_odds = np.log((1 - NOTHING) / NOTHING) - np.log(chance_of(effect) / (1 - chance_of(effect)))
    each = []
    for spread in (1.0, largest):
        squared = (spread * seen) ** 2
        price = len(columns) * np.log1p(squared) / 2
        each.append(2 * (log_odds + np.log(2) + price) * (1 + squared) / squared)
    threshold = min(each)
    return float(np.sqrt(scipy.special.chndtrinc(threshold, len(columns), 1 - POWER)))
