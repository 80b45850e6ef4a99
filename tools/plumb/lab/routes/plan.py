"""Layouts of marks, their power before a hole is cut, and the reach."""

from __future__ import annotations

from dataclasses import dataclass
from threading import Lock

from fastapi import APIRouter
from pydantic import BaseModel, Field

from plumb.fit.compare import expected_priors
from plumb.lab.known import planned_priors, possible, stated
from plumb.lab.project import Choices, Layout
from plumb.lab.rounds import (
    TITLES,
    command,
    grid_command,
    next_names,
    opened,
    planned,
    prior_words,
    unit_words,
    unreachable,
)
from plumb.lab.routes.project import TheProject
from plumb.marks.model import tape_sigma
from plumb.plan.preview import Preview, SheetReach, as_read, preview, reach_of
from plumb.settings import MachineSettings
from plumb.text.answers import in_json
from plumb.text.errors import InputError
from plumb.words import Heading
from plumb.words.proposals import advised, chances, could_tell

router = APIRouter(tags=["plan"])
MOST_MARKS = 400
MOST_SEEN = 64  # plans that are kept


class LayoutAnswer(BaseModel):
    """A way to measure, on the sheet of this machine."""

    id: Layout
    title: str
    minutes: float
    places: list[tuple[float, float]]  # [mm] machine frame


class AdviceAnswer(BaseModel):
    """The layout to take, and what it gains."""

    layout: Layout
    sentence: str


class PlanRequest(BaseModel):
    """Marks that are being considered [mm, machine frame]."""

    layout: Layout
    places: list[tuple[float, float]] = Field(default=[], max_length=MOST_MARKS)


class PlannedCause(BaseModel):
    """An effect under a plan: whether it would be found and named, in a sign and in words."""

    noun: str
    said: tuple[str, str]


class PlanAnswer(BaseModel):
    """Power of a plan to show and to name effects."""

    preview: Preview
    causes: list[PlannedCause]
    minutes: float
    sentence: str
    trouble: str  # why the sled cannot take this way; empty if it can
    command: str


@dataclass(frozen=True, kw_only=True)
class ReachAnswer(SheetReach):
    """Where on the sheet the machine is usable."""

    command: str

    @in_json
    def heading(self) -> Heading:
        """How a screen begins that shows it."""
        said = self.conclusion.partition(";")[0]
        return Heading(f"{said.removesuffix('.')}.", self.normal)


@router.get("/layouts")
def layouts(project: TheProject) -> list[LayoutAnswer]:
    """Return the ways to measure on this machine's sheet."""
    settings = opened(project)
    return [_layout(settings, layout) for layout in TITLES]


def _layout(settings: MachineSettings, layout: Layout) -> LayoutAnswer:
    plan = planned(settings, layout, ())
    return LayoutAnswer(
        id=layout,
        title=TITLES[layout],
        minutes=plan.minutes,
        places=[(touch.x, touch.y) for touch in plan.touches],
    )


@router.get("/layouts/advice")
def layout_advice(project: TheProject) -> AdviceAnswer:
    """Return the layout by which most causes could be named, or most would show; of several the
    quickest.
    """
    settings, choices = opened(project), project.choices
    asked = {layout: PlanRequest(layout=layout) for layout in TITLES}
    previews = {layout: DESK.seen(settings, choices, asked[layout]) for layout in TITLES}
    minutes = {layout: planned(settings, layout, ()).minutes for layout in TITLES}
    worth = {layout: (each.named, each.seen, -minutes[layout]) for layout, each in previews.items()}
    best = max(TITLES, key=lambda layout: worth[layout])
    usual = (previews["nine"], TITLES["nine"]) if best != "nine" else None
    said = advised(previews[best], TITLES[best], minutes[best], choices.unit, instead_of=usual)
    return AdviceAnswer(layout=best, sentence=said)


class Desk:
    """Looks at one plan at a time; who waits while a newer plan comes is sent away."""

    def __init__(self) -> None:
        self._lock, self._newest = Lock(), 0
        self._seen: dict[str, Preview] = {}  # the latest, by what they follow from

    def look(self, settings: MachineSettings, choices: Choices, request: PlanRequest) -> Preview:
        """Return what a plan could tell. Raises InputError for a plan that a newer plan has
        overtaken.
        """
        self._newest += 1
        mine = self._newest
        with self._lock:
            if mine != self._newest:
                raise InputError("another plan came meanwhile")
            return self.seen(settings, choices, request)

    def seen(self, settings: MachineSettings, choices: Choices, request: PlanRequest) -> Preview:
        """Return what a plan could tell."""
        priors, sigma = planned_priors(possible(choices, settings)), tape_sigma(choices.fineness)
        said = repr((settings, request, sigma, sorted(priors.items())))
        if said not in self._seen:
            plan = planned(settings, request.layout, request.places)
            marks = as_read(plan.touches)
            latest = [*self._seen.items()][1 - MOST_SEEN :]
            looked = preview(settings, marks, sigma=sigma, priors=priors)
            self._seen = {**dict(latest), said: looked}
        return self._seen[said]


DESK = Desk()


@router.post("/preview")
def preview_plan(request: PlanRequest, project: TheProject) -> PlanAnswer:
    """Return what marks could tell before a hole is cut."""
    settings = opened(project)
    choices = project.choices
    plan = planned(settings, request.layout, request.places)
    form, file = next_names(project)
    seen = DESK.look(settings, choices, request)
    said = could_tell(seen)
    return PlanAnswer(
        preview=seen,
        causes=[PlannedCause(noun=each.noun, said=chances(each)) for each in seen.outlines],
        minutes=plan.minutes,
        sentence=f"{said[0].upper()}{said[1:]}.",
        trouble=unreachable(plan, settings),
        command=grid_command(project, possible(choices, settings), plan, form=form, program=file),
    )


@router.get("/reach")
def reach(project: TheProject) -> ReachAnswer:
    """Return where on the sheet the machine is usable."""
    settings = opened(project)
    choices = possible(project.choices, settings)
    known = {check.name: check.sigma for check in stated(choices).checked}
    survey, expected = reach_of(settings, known)
    words = prior_words(expected_priors(known), expected_priors({}))
    said = command("reach", choices.settings, *words, *unit_words(choices))
    return ReachAnswer(survey=survey, expected=expected, unit=choices.unit, command=said)
