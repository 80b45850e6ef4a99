"""The verdict: a sentence, a card for each suspect, and what may act unseen."""

from typing import Annotated

from fastapi import APIRouter, Depends
from pydantic import BaseModel

from plumb import api
from plumb.cure.add import BoardView, Chosen, LiveBoard
from plumb.cure.decision import Decision
from plumb.diagnosis.readings import Doubts
from plumb.fit.compare import Comparison
from plumb.lab.background import Background, key_of
from plumb.lab.project import Project
from plumb.lab.residuals import Readings, State, as_set, fitted_state, readings_of
from plumb.lab.rounds import board_words, command, inputs_of, known_words, unit_words
from plumb.lab.routes.project import TheProject, of_lab
from plumb.model.plain import plainly
from plumb.text.errors import on_page
from plumb.words import Link, Part
from plumb.words import decision as of_decision
from plumb.words import verdict as words

router = APIRouter(tags=["verdict"])


class Verdict(Readings):
    """Verdict on the marks."""

    title: str
    sentence: str
    warned: list[str]  # what is wrong with the readings
    states: list[State]  # as set, with the frame fitted, with what is added
    apart: str  # a sentence, where rivals would cut elsewhere by more than the noise
    cards: list[words.Suspect]
    more: str  # a sentence on the suspects without a card
    ruled_out: list[tuple[str, str]]  # each with its reason
    sureness: list[tuple[str, str]]  # what tells how sure the answer is, each with its size
    unseen: list[Part]
    why: list[str]
    step: Link


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
    answer = background.decided(
        "verdict", key, inputs, lambda decision, progress: verdict_of(inputs, decision)
    )
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


def verdict_of(inputs: api.Inputs, decision: Decision) -> Verdict:
    """Return the verdict as the page shows it."""
    diagnosis, raw = decision.diagnosis, api.compare(inputs)
    doubts, noise = Doubts.of(diagnosis.outliers, raw), diagnosis.noise
    reach = diagnosis.left_open.sentence
    slips = [slip.sentence for slip in diagnosis.outliers]
    return Verdict(
        **readings_of(inputs.measurements, raw, noise.sigma, doubts),
        title=words.title(diagnosis),
        sentence=words.sentence(diagnosis),
        warned=[*slips, *([f"{reach}."] if reach else [])],
        states=_states(raw, decision, doubts),
        apart=decision.apart.sentence if decision.apart else "",
        cards=words.suspects(diagnosis),
        more=words.less_likely(diagnosis),
        ruled_out=words.ruled_out(diagnosis),
        sureness=of_decision.sureness(decision),
        unseen=words.unseen(diagnosis),
        why=[
            words.noise_sentence(noise.sigma, noise.source, diagnosis.unit),
            *diagnosis.disagreements,
            *map(on_page, diagnosis.warnings),
        ],
        step=of_decision.step(decision),
    )


def _states(raw: Comparison, decision: Decision, doubts: Doubts) -> list[State]:
    """Return what is left of the marks: as set, with the frame, with what is added."""
    addition, noise = decision.addition, decision.diagnosis.noise
    states = [as_set(raw, doubts=doubts)]
    if decision.diagnosis.outliers:
        return states
    live = LiveBoard(decision.inputs, noise=noise)
    fits = [("frame fitted", addition.before.fit if addition else live.fit(Chosen((), {})))]
    named = addition and (addition.effects_added or decision.diagnosis.likely)
    if addition and named:
        fits.append((f"+ {plainly(named)}", addition.after_fit))
    view = BoardView(live)
    return [*states, *(fitted_state(title, fitted, view) for title, fitted in fits)]
