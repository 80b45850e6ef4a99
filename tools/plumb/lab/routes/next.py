"""Proposals for the next measurement, and taking one into the folder: a form and a program."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial

from fastapi import APIRouter
from pydantic import BaseModel

from plumb import api
from plumb.fit.inputs import settings_in
from plumb.lab.background import Answer, Background, key_of
from plumb.lab.project import ChangedError, Project, digest_of, save_choices
from plumb.lab.rounds import (
    FORM_NAME,
    STEM,
    command,
    has_readings,
    inputs_of,
    kept_settings,
    opened,
    program_name,
)
from plumb.lab.routes.project import ProjectAnswer, TheProject, show
from plumb.lab.routes.verdict import TheBackground, board_and_known
from plumb.plan.proposal import Next, form_of, program_of, propose
from plumb.text.answers import Internal, in_json
from plumb.text.errors import InputError
from plumb.text.files import numbered
from plumb.words.proposals import HEADS, ProposalInWords, headline, in_words, taking_words

router = APIRouter(tags=["next"])
MOST_OTHERS = 7


@dataclass(frozen=True)
class Taking:
    """Files that a proposal writes into the folder; nothing that is there is replaced."""

    choose: int  # its number, as plumb next --choose takes it
    form: str
    program: str  # empty: nothing is cut, a tape reads marks that are there
    files: Internal[Mapping[str, bytes]]
    is_saved: bool  # they are in the folder
    said: str
    act: str  # on the button
    command: str

    @in_json
    def digest(self) -> str:
        """Of what would be written."""
        return digest_of(b"\0".join(self.files.values()))


class Offer(BaseModel):
    """A thing to measure."""

    proposal: ProposalInWords
    taking: Taking | None  # None: it has no marks


class NextAnswer(BaseModel):
    """What to measure next, or how far that is worked out."""

    share: float
    command: str
    headline: str = ""  # empty: it is still worked out
    offers: list[Offer] = []  # the best first
    ordinary: ProposalInWords | None = None  # what as many marks as patience allows would bring
    promises: str = ""  # head of what other ways promise


class Wanted(BaseModel):
    """A proposal by its number, and the digest of what the page showed."""

    choose: int
    digest: str


@router.get("/next")
def show_next(project: TheProject, background: TheBackground) -> NextAnswer:
    """Return what to measure next."""
    inputs = inputs_of(project)
    answer = _proposed(project, background, inputs)
    advice, said = answer.result, command("next", *board_and_known(project, inputs))
    if advice is None:
        return NextAnswer(share=answer.share, command=said)
    return next_answer(advice, said, partial(_taking, project, inputs, advice))


@router.post("/next")
def take_next(wanted: Wanted, project: TheProject, background: TheBackground) -> ProjectAnswer:
    """Take a proposal: write its form, and the program that cuts its marks. Nothing moves."""
    inputs = inputs_of(project)
    advice = _proposed(project, background, inputs).result
    if advice is None:
        raise InputError("what to measure next is still worked out: wait a moment")
    if not 1 <= wanted.choose <= len(advice.proposals):
        raise InputError(f"there is no proposal number {wanted.choose}")
    written = _taking(project, inputs, advice, wanted.choose)
    if written is None:
        raise InputError(f"proposal {wanted.choose} has no marks: do what it says, by hand")
    if written.digest != wanted.digest:
        raise ChangedError(f"proposal {wanted.choose}")
    kept = kept_settings(project, project.choices)
    save_choices(
        project,
        lambda choices: choices.model_copy(update={"proposed": written.form}),
        files={} if written.is_saved else {**written.files, **kept},
        read={name: project.digest(name) if written.is_saved else "" for name in written.files},
    )
    return show(project)


@router.delete("/next")
def put_back(project: TheProject) -> ProjectAnswer:
    """Take the files of a proposal out of the folder again; readings stay."""
    form = project.choices.proposed
    if not FORM_NAME.fullmatch(form):
        raise InputError("no proposal was taken")
    names = [form, program_name(form)]
    known = {name: project.digest(name) for name in names}
    if has_readings(project, form):
        raise InputError(f"{form} has readings, so it stays")
    save_choices(project, lambda now: now.model_copy(update={"proposed": ""}), read=known)
    project.remove(names, read=known)
    return show(project)


def _proposed(project: Project, background: Background, inputs: api.Inputs) -> Answer[Next]:
    """Return what to measure next, or how far that is."""
    return background.decided(
        "next",
        key_of(project),
        inputs,
        lambda decision, progress: propose(decision.diagnosis, inputs, progress=progress),
    )


def next_answer(
    advice: Next, command: str, taking: Callable[[int], Taking | None] = lambda place: None
) -> NextAnswer:
    """Return the proposals; `taking` says what it writes to take one."""
    advice = in_words(advice)
    proposals = enumerate(advice.proposals[: MOST_OTHERS + 1], 1)
    offers = [Offer(proposal=each, taking=taking(place)) for place, each in proposals]
    best = offers[0] if offers else None
    return NextAnswer(
        share=1,
        command=best.taking.command if best and best.taking else command,
        headline=headline(best.proposal if best else None),
        offers=offers,
        ordinary=advice.blind,
        promises=HEADS[best.proposal.question] if best else "",
    )


def _taking(project: Project, inputs: api.Inputs, advice: Next, place: int) -> Taking | None:
    """Return what taking a proposal writes; None for a proposal without marks."""
    option = advice.proposals[place - 1].option
    if not len(option.visits):
        return None
    settings = project.path(project.choices.settings)
    form = form_of(
        advice,
        place,
        str(project.path(f"{STEM}.toml")),  # the text is the same under any name
        settings=settings,
        sheet=settings_in(settings).sheet,
    )
    for stem in numbered(STEM):
        name, cut_by = f"{stem}.toml", f"{stem}.nc"
        program = program_of(advice, place, cut_by, form=name) if option.is_cut else None
        there = project.read(name), project.read(cut_by)
        if there in ((None, None), (form, program)):
            break
    files = {name: form} if program is None else {name: form, cut_by: program}
    cut_by = cut_by if program else ""
    said, act = taking_words(len(option.visits), name, cut_by)
    command = _command(project, inputs, advice, place, name, cut_by)
    return Taking(place, name, cut_by, files, there[0] is not None, said, act, command)


def _command(
    project: Project, inputs: api.Inputs, advice: Next, place: int, form: str, program: str
) -> str:
    """Return the command that writes the same files."""
    choices = project.choices
    output = ["--output", program] if program else []
    # New marks are cut with what is open now, which may be other than what those there were.
    in_force = advice.case and advice.case.settings == opened(project)
    moved_by = [] if in_force else ["--cut-next-with", choices.settings]
    words = [*board_and_known(project, inputs), "--choose", f"{place}", *moved_by]
    return command("next", *words, "--marks", form, *output)
