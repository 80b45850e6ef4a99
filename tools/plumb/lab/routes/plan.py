"""Layouts of marks, their power before a hole is cut, and the reach."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import lru_cache
from threading import Lock

import numpy as np
from fastapi import APIRouter
from pydantic import BaseModel, Field

from plumb.fit.expected import Expected, expected_anywhere, expected_priors, expected_sentence
from plumb.lab.known import measured_to, planned_priors, possible
from plumb.lab.project import Choices, Layout
from plumb.lab.rounds import (
    TITLES,
    Place,
    command,
    grid_command,
    next_names,
    opened,
    planned,
    prior_words,
    refuse_unreachable,
    unit_words,
)
from plumb.lab.routes.project import TheProject
from plumb.marks.model import tape_sigma
from plumb.model.plain import noun_of
from plumb.model.predict import REACH_WORDS
from plumb.model.reach import Give, Pull, Survey, conclusion_of, percent, survey_sheet
from plumb.plan.preview import Preview, as_read, preview
from plumb.settings.machine import MachineSettings
from plumb.text.answers import like
from plumb.text.errors import InputError
from plumb.text.values import shown_in, worded

router = APIRouter(tags=["plan"])
MOST_MARKS = 400
COLUMNS, ROWS = 61, 31  # of the map of reach


class LayoutAnswer(BaseModel):
    """A way to measure, on the sheet of this machine."""

    id: Layout
    title: str
    marks: int
    distances: int
    minutes: float
    places: list[tuple[float, float]]  # [mm] machine frame
    spans: list[tuple[int, int]]  # distances between marks, by their place in the list


class AdviceAnswer(BaseModel):
    """The layout to take, and what it gains."""

    layout: Layout
    sentence: str


class PlanRequest(BaseModel):
    """Marks that are being considered [mm, machine frame]."""

    layout: Layout
    places: list[tuple[float, float]] = Field(default=[], max_length=MOST_MARKS)


class PlannedEffect(BaseModel):
    """An effect under a plan."""

    name: str
    noun: str
    is_seen: bool  # proved in most cases, if it has its usual size
    is_distinct: bool  # in most cases it is taken for no other effect
    alike: list[str]  # nouns of effects it would be taken for


class PlanAnswer(BaseModel):
    """Power of a plan to show and to name effects."""

    marks: int
    distances: int
    minutes: float
    sigma: float  # [mm] of a reading
    effects: list[PlannedEffect]
    seen: int  # effects that would show in their usual size
    named: int  # effects that could be named in their usual size
    trouble: str  # why the sled cannot take this way; empty if it can
    command: str


class ReachAnswer(BaseModel):
    """Where on the sheet the machine is usable."""

    columns: int
    rows: int
    verdicts: list[int]  # row by row from the top left: index into words
    words: list[str]
    shares: dict[str, str]
    conclusion: str
    extremes: list[ExtremeAnswer]
    assumed: list[str]
    expected: Expected | None  # None: no sled hangs on this sheet
    normal: str  # the same as a sentence
    command: str


class ExtremeAnswer(BaseModel):
    """The tightest, slackest or softest place."""

    title: str
    place: tuple[float, float]
    value: float
    unit: str
    side: str


@router.get("/layouts")
def layouts(project: TheProject) -> list[LayoutAnswer]:
    """Return the ways to measure on this machine's sheet."""
    settings = opened(project)
    return [_layout(settings, layout) for layout in TITLES]


def _layout(settings: MachineSettings, layout: Layout) -> LayoutAnswer:
    plan = planned(settings, layout, ())
    order = [touch.name for touch in plan.touches]
    return LayoutAnswer(
        id=layout,
        title=TITLES[layout],
        marks=len(plan.touches),
        distances=len(plan.spans),
        minutes=plan.minutes,
        places=[(touch.x, touch.y) for touch in plan.touches],
        spans=[(order.index(first), order.index(second)) for first, second in plan.spans],
    )


@router.get("/layouts/advice")
def layout_advice(project: TheProject) -> AdviceAnswer:
    """Return the layout by which most causes could be named, or most would show; of several the
    quickest.
    """
    settings, choices = opened(project), project.choices
    previews = {layout: _looked(settings, choices, PlanRequest(layout=layout)) for layout in TITLES}
    minutes = {layout: planned(settings, layout, ()).minutes for layout in TITLES}
    worth = {layout: (each.named, each.seen, -minutes[layout]) for layout, each in previews.items()}
    best = max(TITLES, key=lambda layout: worth[layout])
    with shown_in(choices.units):
        return AdviceAnswer(layout=best, sentence=_advice(previews, best, minutes[best]))


def _advice(previews: Mapping[Layout, Preview], best: Layout, minutes: float) -> str:
    first, taken = next(iter(TITLES)), previews[best]
    if not taken.seen:
        return (
            f"With a tape that reads to {worded(taken.sigma)} no plan here would show a cause of "
            "its usual size. Any of them shows causes that move marks further."
        )
    said = (
        f"{TITLES[best]}, about {minutes:.0f} minutes: of {len(taken.effects)} causes in their "
        f"usual size {taken.seen} would show and {taken.named} could be named"
    )
    few = previews[first]
    instead = f", instead of {few.seen} and {few.named} with {TITLES[first].lower()}"
    return f"{said}{instead if best != first else ''}."


class Desk:
    """Looks at one plan at a time; who waits while a newer plan comes is sent away."""

    def __init__(self) -> None:
        self._lock, self._newest = Lock(), 0

    def look(self, settings: MachineSettings, choices: Choices, request: PlanRequest) -> Preview:
        """Return what a plan could tell. Raises InputError for a plan that a newer plan has
        overtaken.
        """
        self._newest += 1
        mine = self._newest
        with self._lock:
            if mine != self._newest:
                raise InputError("another plan came meanwhile")
            return _looked(settings, choices, request)


def _looked(settings: MachineSettings, choices: Choices, request: PlanRequest) -> Preview:
    priors = tuple(sorted(planned_priors(possible(choices, settings)).items()))
    places, sigma = tuple(request.places), tape_sigma(choices.fineness)
    return _look(_Same(settings), request.layout, places, sigma, priors)


class _Same:
    """Settings as the key of a cache: what they say counts."""

    def __init__(self, settings: MachineSettings) -> None:
        self.settings, self._text = settings, repr(settings)

    def __hash__(self) -> int:
        return hash(self._text)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Same) and self._text == other._text


@lru_cache(maxsize=64)
def _look(
    same: _Same,
    layout: Layout,
    places: tuple[Place, ...],
    sigma: float,
    priors: tuple[tuple[str, float], ...],
) -> Preview:
    plan = planned(same.settings, layout, places)
    marks = as_read(plan.touches, plan.spans)
    return preview(same.settings, marks, sigma=sigma, priors=dict(priors))


DESK = Desk()


@router.post("/preview")
def preview_plan(request: PlanRequest, project: TheProject) -> PlanAnswer:
    """Return what marks could tell before a hole is cut."""
    settings = opened(project)
    choices = project.choices
    plan = planned(settings, request.layout, request.places)
    outlook = DESK.look(settings, choices, request)
    form, file = next_names(project)
    made = grid_command(project, possible(choices, settings), plan, form=form, program=file)
    return like(
        PlanAnswer,
        outlook,
        marks=len(plan.touches),
        distances=len(plan.spans),
        minutes=plan.minutes,
        effects=_effects(outlook),
        trouble=_trouble(settings, request),
        command=made,
    )


@router.get("/reach")
def reach(project: TheProject) -> ReachAnswer:
    """Return where on the sheet the machine is usable."""
    choices = project.choices
    settings = opened(project)
    survey = survey_sheet(settings)
    choices = possible(choices, settings)
    known = expected_priors(measured_to(choices))
    expected = expected_anywhere(settings, known)
    with shown_in(choices.units):
        said = expected_sentence(expected)
    rows, columns = len(survey.y), len(survey.x)
    verdicts = survey.reached.verdict.reshape(rows, columns)
    down = np.linspace(0, rows - 1, ROWS).round().astype(int)
    across = np.linspace(0, columns - 1, COLUMNS).round().astype(int)
    return ReachAnswer(
        columns=COLUMNS,
        rows=ROWS,
        verdicts=verdicts[np.ix_(down, across)].ravel().tolist(),
        words=list(REACH_WORDS),
        shares={word: percent(share) for word, share in survey.shares.items()},
        conclusion=conclusion_of(survey),
        extremes=list(_extremes(survey)),
        assumed=list(survey.assumed),
        expected=expected,
        normal=said,
        command=command(
            "reach",
            choices.settings,
            *prior_words(known, expected_priors({})),
            *unit_words(choices),
        ),
    )


def _trouble(settings: MachineSettings, request: PlanRequest) -> str:
    try:
        refuse_unreachable(planned(settings, request.layout, request.places), settings)
    except (ValueError, InputError) as error:
        return str(error)
    return ""


def _effects(outlook: Preview) -> list[PlannedEffect]:
    return [
        like(
            PlannedEffect,
            outline,
            name=outline.effect,
            noun=noun_of(outline.effect),
            alike=[noun_of(name) for name in outline.alike],
        )
        for outline in outlook.outlines
    ]


def _extremes(survey: Survey) -> Iterable[ExtremeAnswer]:
    each: list[tuple[str, Pull | Give | None, str]] = [
        ("tightest chain", survey.tightest, "N"),
        ("slackest chain", survey.slackest, "N"),
        ("softest place", survey.softest, "mm/N"),
    ]
    for title, extreme, unit in each:
        if extreme:
            yield like(ExtremeAnswer, extreme, title=title, unit=unit)
