"""The bench for effects: add and take away, fit or hold, and see what is left of the errors."""

from collections.abc import Collection
from contextlib import suppress
from dataclasses import replace
from typing import Annotated

import numpy as np
from fastapi import APIRouter, Depends, Query, Request
from pydantic import BaseModel, Field, FiniteFloat

from plumb.cure.add import Chosen, FitStep, Quality, add, add_to
from plumb.cure.decision import record_of, toml_of
from plumb.fit.compare import Covariate, plausible_range
from plumb.fit.fit import Fit
from plumb.lab.background import LiveBoards, WarmBoard
from plumb.lab.project import Choices
from plumb.lab.residuals import (
    NO_ENDS,
    Ends,
    Pair,
    Readings,
    State,
    among_all,
    as_set,
    ends,
    fitted_state,
    pairs,
    readings_of,
)
from plumb.lab.rounds import board_words, checked_words, command, inputs_of, known_words, unit_words
from plumb.lab.routes.project import ProjectAnswer, TheProject, of_lab, show
from plumb.model.catalogue import every_effect, parameter_words
from plumb.model.plain import plain_size, plainly
from plumb.model.predict import Array
from plumb.text.answers import like
from plumb.text.errors import InputError, on_page
from plumb.text.values import Unit
from plumb.words import Heading
from plumb.words.decision import what_is_added
from plumb.words.verdict import noise_sentence, same_for_all

router = APIRouter(tags=["bench"])
NEW_MACHINE = "new.toml"
MOST_EFFECTS = 32
# What errors may depend on, in the order of the plots: most effects are a curve against the first.
TITLES = {
    "tension": "chain tension",
    "length": "chain length",
    "x": "x on the sheet",
    "y": "y on the sheet",
    "angle": "chain angle",
    "wrap": "chain on sprocket",
    "phase": "sprocket turn",
    "order": "order of cutting",
    "approach": "last move",
}
SAME = 1e-3  # of what differs less between marks errors do not depend


class BenchParameter(BaseModel):
    """A number of an effect, and the sizes that real machines have."""

    name: str  # in full, `effect.parameter`
    label: str
    low: float
    high: float
    now: float  # in the settings; 0: absent


class BenchEffect(BaseModel):
    """An effect that can be added."""

    name: str
    noun: str
    where: str  # "firmware" or "lab"
    in_settings: bool
    parameters: list[BenchParameter]


class BenchCovariate(BaseModel):
    """A covariate of the chains' errors, left and right for each mark."""

    name: str
    title: str
    unit: str
    values: list[Ends]
    same: str  # that it is the same for all marks, in words; empty: errors may depend on it


class BenchAnswer(Readings):
    """First answer to the bench."""

    heading: Heading
    board: str  # another for other marks or settings
    as_set: State
    effects: list[BenchEffect]
    covariates: list[BenchCovariate]
    new_machine: str  # name of the file that the bench writes


class BenchChoice(BaseModel):
    """Effects to add, in their order, and sizes that are held by hand."""

    effects: list[str] = Field(max_length=MOST_EFFECTS)
    held: dict[str, FiniteFloat] = {}

    @property
    def chosen(self) -> Chosen:
        """The choice as the fit knows it."""
        return Chosen(tuple(dict.fromkeys(self.effects)), self.held)


class BenchSize(BaseModel):
    """A parameter of an effect that was added."""

    value: float
    said: str  # in words, with its interval if it was fitted
    possible: bool  # whether its interval, or what holds it, reaches what a real machine may have


class BenchFit(State):
    """The marks with the chosen effects, all else refitted."""

    left_out_rms: float  # [mm]
    sizes: dict[str, BenchSize]
    intervals: str  # for which noise they hold
    command: str


class BenchStairs(BaseModel):
    """The fall of the error, effect by effect, and the verdict on it."""

    before: Quality  # with the frame fitted
    by_effect: tuple[FitStep, ...]
    warnings: list[str]


class BenchDrawn(BaseModel):
    """Shifts that effects add to the frame's fit [mm]."""

    noun: str
    moved: list[Pair | None]
    chains: list[Ends]


class BenchSave(BenchChoice):
    """A choice to be written, and the digest of the file that it replaces."""

    read: str


def _warm(request: Request, project: TheProject) -> WarmBoard:
    return of_lab("live_boards", LiveBoards)(request).of(project, inputs_of, board_words)


Warm = Annotated[WarmBoard, Depends(_warm)]


@router.get("/bench")
def open_bench(project: TheProject, warm: Warm) -> BenchAnswer:
    """Return the marks, the effects, and what errors may depend on."""
    doubts = warm.doubts
    return BenchAnswer(
        **readings_of(warm.inputs.measurements, warm.raw, warm.live.noise.sigma, doubts),
        heading=what_is_added(warm.inputs.unit, any_marks=bool(warm.raw.marks)),
        board=warm.key,
        as_set=as_set(warm.raw, doubts=doubts),
        effects=_effects(warm),
        covariates=covariates_of(warm),
        new_machine=NEW_MACHINE,
    )


@router.post("/bench/fit")
def refit(choice: BenchChoice, project: TheProject, warm: Warm) -> BenchFit:
    """Refit everything with these effects. Nothing is written."""
    chosen = choice.chosen
    warm.live.refuse(chosen)
    fitted = warm.live.fit(chosen)
    sizes = _sizes(fitted, chosen, warm.inputs.unit)
    intervals = noise_sentence(fitted.sigma, warm.live.noise.source, warm.inputs.unit)
    title = f"+ {plainly(chosen.effects)}" if chosen.effects else "frame fitted"
    return BenchFit(
        **dict(fitted_state(title, fitted, warm.view, warm.doubts)),
        left_out_rms=fitted.left_out_rms,
        sizes=sizes,
        intervals=intervals,
        command=_command(
            project.choices,
            chosen,
            warm,
            can_be=fitted.settled and all(size.possible for size in sizes.values()),
        ),
    )


@router.post("/bench/gains")
def gain(choice: BenchChoice, warm: Warm) -> dict[str, float]:
    """Return what each effect more would leave of the errors [mm]. Nothing is written."""
    chosen, left = choice.chosen, {}
    for effect in every_effect():
        name = effect["name"]
        more = replace(chosen, effects=(*chosen.effects, name))
        with suppress(InputError):  # the marks are too few for it
            if name not in chosen.effects:
                warm.live.refuse(more)
                left[name] = warm.live.fit(more).rms
    return left


@router.post("/bench/stairs")
def climb(choice: BenchChoice, warm: Warm) -> BenchStairs:
    """Return how the error falls with each effect more. Nothing is written."""
    chosen = choice.chosen
    warm.live.refuse(chosen)
    result = add_to(warm.live, warm.raw, chosen)
    return BenchStairs(
        before=result.before,
        by_effect=result.by_effect,
        warnings=[*(slip.sentence for slip in warm.slips), *map(on_page, result.warnings)],
    )


@router.get("/bench/drawn")
def draw(
    effects: Annotated[list[str], Query(min_length=1, max_length=MOST_EFFECTS)], warm: Warm
) -> BenchDrawn:
    """Return what effects would draw into what the frame leaves."""
    warm.live.refuse(Chosen(tuple(effects)))
    drawn, doubted = warm.view.drawn(*effects), warm.doubts.marks
    moved: list[Pair | None] = [*pairs(drawn.moved)]
    return BenchDrawn(
        noun=plainly(effects),
        moved=among_all(moved, doubted, None),
        chains=among_all(ends(drawn.chains), doubted, NO_ENDS),
    )


@router.post("/bench/machine")
def save(change: BenchSave, project: TheProject, warm: Warm) -> ProjectAnswer:
    """Write the machine with these effects, as `plumb add -o` does."""
    inputs, chosen = warm.live.inputs, change.chosen
    if warm.slips:
        names = ", ".join(dict.fromkeys(slip.called for slip in warm.slips))
        raise InputError(f"look at {names} again under Readings first, or clear the reading there")
    result = add(inputs, effects=chosen.effects, held=chosen.held, noise=warm.live.noise)
    source = inputs.measurements.source
    content = toml_of(result, source=source, record=record_of(result, warm.inputs))
    project.save({NEW_MACHINE: content}, read={NEW_MACHINE: change.read})
    return show(project)


def _effects(warm: WarmBoard) -> list[BenchEffect]:
    settings = warm.live.model
    return [
        like(
            BenchEffect,
            effect,
            in_settings=any(settings.effects.get(effect["name"], {}).values()),
            parameters=[
                _parameter(f"{effect['name']}.{each['name']}", warm)
                for each in effect["parameters"]
            ],
        )
        for effect in every_effect()
    ]


def _parameter(name: str, warm: WarmBoard) -> BenchParameter:
    words, known = parameter_words()[name], plausible_range(name)
    plain = words["plain"]
    label = " ".join(plain["more"].replace("#", "").split()) if plain else words["summary"]
    effect, _, parameter = name.rpartition(".")
    return BenchParameter(
        name=name,
        label=label,
        low=min(known.low, 0.0),
        high=max(known.high, 0.0),
        now=warm.live.model.effect(effect, parameter),
    )


def covariates_of(warm: WarmBoard) -> list[BenchCovariate]:
    """Return what errors of the chains may depend on, for all marks."""
    by_name = {each.name: each for each in warm.view.covariates}
    return [_covariate(by_name[name], warm.doubts.marks) for name in TITLES]


def _covariate(covariate: Covariate, doubted: Collection[int]) -> BenchCovariate:
    is_angle = covariate.unit == "rad"
    values = np.degrees(covariate.values) if is_angle else covariate.values
    unit = "°" if is_angle else covariate.unit
    return like(
        BenchCovariate,
        covariate,
        title=TITLES[covariate.name],
        unit=unit,
        values=among_all(ends(values), doubted, NO_ENDS),
        same=_same(TITLES[covariate.name], values[np.isfinite(values)], unit),
    )


def _same(title: str, known: Array, unit: str) -> str:
    """Return that something is the same for all marks; empty: errors may depend on it."""
    if known.size and np.ptp(known) >= SAME:
        return ""
    return same_for_all(title, known[0] if known.size else None, unit)


def _sizes(fitted: Fit, chosen: Chosen, unit: Unit) -> dict[str, BenchSize]:
    sizes = {}
    for name in chosen.parameters:
        estimate = next((each for each in fitted.estimates if each.name == name), None)
        value = estimate.value if estimate else chosen.held[name]
        interval = (estimate.low, estimate.high) if estimate and estimate.felt else ()
        sizes[name] = BenchSize(
            value=value,
            said=plain_size(name, value, *interval, unit=unit),
            possible=bool(plausible_range(name).is_near(*(interval or (value, value)))),
        )
    return sizes


def _command(choices: Choices, chosen: Chosen, warm: WarmBoard, *, can_be: bool) -> str:
    """Return the same in a terminal, which writes sizes that cannot be only by force. No file is
    read: a slider asks for it many times a second.
    """
    held = [word for item in chosen.held.items() for word in ("--hold", "{}={:.12g}".format(*item))]
    known = known_words(choices, effects=chosen.effects, held=chosen.held)
    usual = warm.live.inputs.checked[len(warm.inputs.checked) :]
    known += checked_words(usual, chosen.effects, {*chosen.held, *choices.known})
    names = [slip.name for slip in warm.slips if len(slip.read) == 2]
    known += [word for name in dict.fromkeys(names) for word in ("--without", name)]
    return command(
        *("add", *warm.words, *known),
        *unit_words(choices, warm.live.inputs.measurements.typed.unit),
        *("--effect", *(chosen.effects or ["none"]), *held, "-o", NEW_MACHINE),
        *([] if can_be else ["--force"]),
    )
