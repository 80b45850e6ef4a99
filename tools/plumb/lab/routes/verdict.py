"""The verdict: a sentence, a card for each suspect, and what may act unseen."""

from typing import Annotated

from fastapi import APIRouter, Depends
from pydantic import BaseModel

from plumb import api
from plumb.cure.decision import Decision, NextStep, decide
from plumb.cure.live_board import BoardView, Chosen, LiveBoard
from plumb.diagnosis.answer import SHOWN, Diagnosis, Together, odds_words
from plumb.diagnosis.diagnosis import diagnose
from plumb.diagnosis.noise import ORIGINS
from plumb.diagnosis.outliers import Doubts
from plumb.diagnosis.sizes import Size
from plumb.diagnosis.unseen import Unseen, share_words, unseen_by
from plumb.fit.compare import ComparedMark, Comparison
from plumb.lab.background import Background, Progress, key_of
from plumb.lab.project import Project
from plumb.lab.residuals import Span, State, as_set, fitted_state, spans_of
from plumb.lab.rounds import board_words, command, inputs_of, known_words, unit_words
from plumb.lab.routes.project import TheProject, of_lab
from plumb.model.catalogue import every_effect
from plumb.model.plain import noun_of, plainly, ranked
from plumb.text.answers import like
from plumb.text.errors import on_page

router = APIRouter(tags=["verdict"])
MOST_CARDS = 6
ALIKE = 0.6  # share of the error that is left where a cause draws nearly the same


class EffectAnswer(BaseModel):
    """An effect of a suspect card."""

    name: str
    noun: str
    summary: str
    sizes: tuple[Size, ...]
    taken_up: str  # how much of it the refitted frame takes up
    remedy: str
    check: str  # how it is measured directly; empty if it cannot be


class Card(BaseModel):
    """A suspect: an effect, or several that act at once."""

    title: str
    account: Together
    effects: list[EffectAnswer]
    odds: str  # in words; empty where there are none
    share: float  # of what the frame leaves unexplained
    looks_like: list[str]


class RuledOut(BaseModel):
    """A cause that the marks, or all real machines, speak against."""

    noun: str
    why: str


class Verdict(BaseModel):
    """Verdict on the marks."""

    title: str
    sentence: str
    reach: str  # a sentence, where the marks do not reach over the sheet
    marks: tuple[ComparedMark, ...]
    states: list[State]  # as set, with the frame fitted, with what is added
    spans: list[Span]
    doubted: list[int]  # marks whose readings are to be looked at again
    doubted_spans: list[int]
    apart: str  # a sentence, where rivals would cut elsewhere by more than the noise
    sigma: float  # [mm] of a reading
    noise: str  # a sentence
    cards: list[Card]
    more_cards: int
    ruled_out: list[RuledOut]
    sureness: list[tuple[str, str]]  # what tells how sure the answer is, each with its size
    unseen: Unseen
    slips: list[str]
    notes: list[str]
    step: NextStep


class VerdictAnswer(BaseModel):
    """A verdict, or how far it is."""

    share: float
    verdict: Verdict | None
    command: str


TheBackground = Annotated[Background, Depends(of_lab("background", Background))]


@router.get("/verdict")
def show_verdict(project: TheProject, background: TheBackground) -> VerdictAnswer:
    """Return the verdict on the readings so far."""
    key = key_of(project)  # before the files are read: what changes meanwhile is asked for again
    inputs = inputs_of(project)

    def work(progress: Progress) -> Verdict:
        progress(0.1)
        diagnosis = diagnose(inputs)
        progress(0.6)
        decision = decide(inputs, diagnosis=diagnosis)
        progress(0.8)
        return verdict_of(inputs, diagnosis, decision)

    answer = background.ask("verdict", key, work)
    return VerdictAnswer(
        share=answer.share,
        verdict=answer.result,
        command=command("diagnose", *board_and_known(project, inputs)),
    )


def board_and_known(project: Project, inputs: api.Inputs) -> list[str]:
    """Return the board, what is known and the unit, as a command takes them."""
    choices = project.choices
    unit = unit_words(choices, inputs.measurements.typed.unit)
    return [*board_words(project), *known_words(choices), *unit]


def verdict_of(inputs: api.Inputs, diagnosis: Diagnosis, decision: Decision) -> Verdict:
    """Return a diagnosis as the page shows it."""
    raw = api.compare(inputs)
    shown = list(diagnosis.explanations)[:MOST_CARDS]
    doubts = Doubts.of(diagnosis.outliers, raw)
    return Verdict(
        title=diagnosis.title,
        sentence=diagnosis.sentence,
        reach=diagnosis.left_open.sentence,
        marks=raw.marks,
        spans=spans_of(inputs.measurements),
        states=_states(raw, decision, doubts),
        doubted=list(doubts.marks),
        doubted_spans=list(doubts.spans),
        apart=decision.apart.sentence if decision.apart else "",
        sigma=diagnosis.noise.sigma,
        noise=diagnosis.noise.said(diagnosis.unit),
        cards=[_card(diagnosis, i, each) for i, each in enumerate(shown)],
        more_cards=max(len(diagnosis.explanations) - MOST_CARDS, 0),
        ruled_out=_ruled_out(diagnosis) if shown and not doubts.marks else [],
        sureness=_sureness(decision),
        unseen=unseen_by(diagnosis, SHOWN),
        slips=[slip.sentence for slip in diagnosis.outliers],
        notes=[*diagnosis.disagreements, *map(on_page, diagnosis.warnings)],
        step=decision.step,
    )


def _ruled_out(diagnosis: Diagnosis) -> list[RuledOut]:
    """Return the effects that are no suspects: those that would draw the same in a size that no
    real machine has, and how much all others leave.
    """
    rest = [each for each in diagnosis.ranking if each.effect not in diagnosis.suspects]
    tempting, others = [], []
    for each in rest:
        absurd = [size for size in each.sizes if not size.possible and size.range_said]
        if absurd and each.rms_after < ALIKE * diagnosis.rms_before:
            said = f"{absurd[0].said}: real machines have {absurd[0].range_said}."
            tempting.append(RuledOut(noun=noun_of(each.effect), why=said))
        else:
            others.append(each.rms_after)
    if not others:
        return tempting
    least = diagnosis.unit.worded(min(others))
    if len(others) == 1:
        return [*tempting, RuledOut(noun="1 other", why=f"By itself it leaves {least}.")]
    said = f"Each by itself leaves {least} or more."
    return [*tempting, RuledOut(noun=f"{len(others)} others", why=said)]


def _sureness(decision: Decision) -> list[tuple[str, str]]:
    """Return how well marks that took no part are predicted, and the noise of a reading."""
    fitted = decision.addition.after_fit if decision.addition else None
    if fitted is None:
        return []
    noise, unit = decision.diagnosis.noise, decision.inputs.unit
    return [
        ("Marks left out are predicted to", unit.worded(fitted.left_out_rms)),
        (f"Noise of a reading ({ORIGINS[noise.source]})", unit.worded(noise.sigma)),
        ("The same, as these marks show it", unit.worded(fitted.corrected_rms / 2**0.5)),
    ]


def _states(raw: Comparison, decision: Decision, doubts: Doubts) -> list[State]:
    """Return what is left of the marks: as set, with the frame, with what is added."""
    addition, noise = decision.addition, decision.diagnosis.noise
    states = [as_set(raw, doubts=doubts)]
    if decision.diagnosis.outliers:
        return states
    live = LiveBoard(decision.inputs, noise=noise)
    fits = [("frame fitted", addition.before_fit if addition else live.fit(Chosen((), {})))]
    named = addition and (addition.effects_added or decision.named)
    if addition and named:
        fits.append((f"+ {plainly(named)}", addition.after_fit))
    view = BoardView(live)
    return [*states, *(fitted_state(title, fitted, view) for title, fitted in fits)]


def _card(diagnosis: Diagnosis, index: int, together: Together) -> Card:
    return Card(
        title=diagnosis.called(together),
        effects=[_effect(diagnosis, name, together) for name in together.effects],
        account=together,
        odds="" if diagnosis.is_finding else odds_words(together.share),
        share=together.explained_share(diagnosis.rms_before),
        looks_like=_looks_like(diagnosis, index),
    )


def _looks_like(diagnosis: Diagnosis, index: int) -> list[str]:
    """Return the explanations that draw nearly the same arrows here, the nearest first."""
    near = [
        (apart, j if i == index else i)
        for (i, j), apart in diagnosis.differences.items()
        if index in (i, j)
    ]
    return [
        f"{plainly(diagnosis.explanations[other].effects)}, "
        f"{diagnosis.unit.worded(apart)} RMS apart"
        for apart, other in ranked(near, lambda each: each[0])[:3]
    ]


def _effect(diagnosis: Diagnosis, name: str, together: Together) -> EffectAnswer:
    words = next(each for each in every_effect() if each["name"] == name)
    ranked = next(each for each in diagnosis.ranking if each.effect == name)
    check = words["check"]
    return like(
        EffectAnswer,
        words,
        sizes=together.sizes[name],
        taken_up=share_words(ranked.hidden_share),
        check=f"{check['title']}, about {check['minutes']:.0f} minutes"
        if check and check["title"]
        else "",
    )
