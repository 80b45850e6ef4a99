"""The correction: each number before and after, accepted one by one, written, and taken back."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from fastapi import APIRouter
from pydantic import BaseModel

from plumb.cure.add import Addition, BoardView, LiveBoard, Note, Parameter, refuse_other_origin
from plumb.cure.decision import (
    Correction,
    Decision,
    correct,
    decide,
    has_setting,
    record_of,
    toml_of,
)
from plumb.diary.file import FIT, fit_entry, keep
from plumb.firmware.settings import CLIENT_FILES, ClientFiles, client_files
from plumb.fit.compare import range_said
from plumb.fit.fit import Checked
from plumb.fit.inputs import Inputs
from plumb.lab.background import key_of
from plumb.lab.machine_line import TheLine, refuse_unanswered
from plumb.lab.project import FILE, Choices, Project, choices_text
from plumb.lab.residuals import Readings, State, as_set, fitted_state, readings_of
from plumb.lab.rounds import board_words, checked_words, command, inputs_of, known_words, unit_words
from plumb.lab.routes.project import ProjectAnswer, TheProject, show
from plumb.lab.routes.verdict import TheBackground
from plumb.model.plain import PlainChange, plain_change
from plumb.text.errors import InputError, on_page
from plumb.words import Heading, Link
from plumb.words import decision as words
from plumb.words.verdict import range_met

router = APIRouter(tags=["correction"])
CLIENT_OF = {Path(file).suffix: client for client, file in CLIENT_FILES.items()}
NO_CLIENT = "none"
KEPT = re.compile(r"(.+)-before-(\d{4}-\d{2}-\d{2}-\d{6})\.nc")  # numbers of a machine
WRITTEN = (".toml", ".nc", *(f"-{file}" for file in CLIENT_FILES.values()))  # by a correction


@dataclass(frozen=True, kw_only=True)
class ChangedNumber(PlainChange):
    """A number of the machine before and after, in words."""

    name: str
    possible: bool  # whether its interval reaches what a real machine may have
    met: str  # which sizes real machines have; empty: no limit is known
    is_accepted: bool


class CorrectionParts(Readings):
    """Numbers that could be changed, and those that are accepted."""

    heading: Heading
    reasons: list[str]  # why these effects, in sentences
    add: list[str]  # what plumb add is given for what is accepted
    instead: Link | None = None  # where to go on where no number is to be changed
    numbers: tuple[ChangedNumber, ...] = ()
    # Those that would change, or are accepted, as they become with what is accepted.
    asked: tuple[ChangedNumber, ...] = ()
    # On what is accepted: what speaks against it, what to do by hand, and what else is to be known.
    stops: tuple[str, ...] = ()
    by_hand: tuple[str, ...] = ()
    doubts: tuple[str, ...] = ()
    intervals: str = ""  # for which noise they hold
    settings: str = ""  # name of the file that these numbers would change
    as_set: State | None = None  # the marks as that file stands
    accepted: State | None = None  # with what is accepted; None: nothing is
    whole: State | None = None  # with all of it


class CorrectionAnswer(BaseModel):
    """The correction, or how far it is."""

    share: float
    heading: Heading
    is_written: bool  # the open file was fitted to just these marks
    correction: CorrectionParts | None
    file: str  # that would be written
    last_sent: str  # whose numbers from before it the folder keeps; empty if there is none
    command: str


class Write(BaseModel):
    """The digests of the settings and the choices that the page knows."""

    settings: str
    choices: str


class Written(BaseModel):
    """Written files, and the steps to take with them."""

    file: str
    files: list[str]
    steps: list[str]
    failure: str  # why the diary says nothing of it; empty if it does


@router.get("/correction")
def show_correction(project: TheProject, background: TheBackground) -> CorrectionAnswer:
    """Return what the marks would change."""
    choices = project.choices
    key, inputs = key_of(project), inputs_of(project)
    refuse_other_origin(inputs)
    answer = background.decided(
        "correction",
        key,
        inputs,
        lambda decision, progress: correction_of(inputs, decision, choices),
        more="\n".join(sorted(choices.accepted)),
    )
    file = project.free_name("machine", *WRITTEN)
    unit = unit_words(choices, inputs.measurements.typed.unit)
    add = answer.result.add if answer.result else _auto_words(choices)
    client = ["--client", *_client_words(choices)]
    is_written = _is_written(inputs)
    fitted = answer.result.heading if answer.result else words.FITTED
    return CorrectionAnswer(
        share=answer.share,
        heading=words.what_is_written(choices.settings) if is_written else fitted,
        is_written=is_written,
        correction=answer.result,
        file=file,
        last_sent=_last_sent(project),
        command=command("add", *board_words(project), *unit, *add, *client, "-o", file),
    )


def _last_sent(project: Project) -> str:
    """Return the file that was sent last, if the folder keeps what the machine held before it."""
    kept = [match for name in project.names() if (match := KEPT.fullmatch(name))]
    last = max(kept, key=lambda match: match[2], default=None)
    file = f"{last[1]}.toml" if last else ""
    return file if file in project.names() else ""


def correction_of(inputs: Inputs, decision: Decision, choices: Choices) -> CorrectionParts:
    """Return what the marks would change, and what is accepted of it."""
    reasons = list(map(on_page, words.said(decision)))
    # What was written stays in view: it goes to the machine, or is taken back.
    if decision.addition is None and not (decision.state == "good" and _is_written(inputs)):
        return CorrectionParts(
            heading=words.what_changes(decision, choices.settings, count=0),
            reasons=reasons,
            instead=words.step(decision),
            add=_auto_words(choices),
        )
    made, noise = correct(decision, choices.accepted), decision.diagnosis.noise
    whole, some = made.whole, made.accepted
    fitted = some.parameters if some else ()
    again = {each.name: _number(each, choices) for each in fitted if has_setting(each.name)}
    numbers = [_number(number, choices) for number in made.numbers]
    now = [again.get(number.name, number) for number in numbers]
    asked = [each for each in now if each.before != each.after or each.is_accepted]
    notes = (some or whole).notes
    left = partial(fitted_state, view=BoardView(LiveBoard(decision.inputs, noise=noise)))
    return CorrectionParts(
        **readings_of(decision.inputs.measurements, whole.raw, noise.sigma),
        heading=words.what_changes(decision, choices.settings, count=len(asked)),
        reasons=reasons,
        numbers=tuple(numbers),
        asked=tuple(asked),
        stops=_noted(notes, "stop"),
        by_hand=_noted(notes, "by_hand"),
        doubts=_noted(notes, "doubt", "hint"),
        intervals=words.intervals(some or whole),
        settings=choices.settings,
        as_set=as_set(whole.raw, title=f"as {choices.settings} says"),
        accepted=left("with what you accepted", some.after_fit) if some else None,
        whole=left("with all of it", whole.after_fit),
        add=_add_words(made, decision.diagnosis.usual, choices),
    )


def _is_written(inputs: Inputs) -> bool:
    """Return whether the open settings were fitted to just these marks."""
    record = inputs.settings.fitted
    return bool(record and record.is_of(each.digest for each in inputs.measurements.rounds))


def _noted(notes: Sequence[Note], *weights: str) -> tuple[str, ...]:
    """Return the notes of these weights, in sentences."""
    said = [on_page(note.text) for note in notes if note.weight in weights]
    return tuple(f"{each[0].upper()}{each[1:]}." for each in said)


@router.post("/correction")
def write(known: Write, project: TheProject, line: TheLine) -> Written:
    """Write the machine with the accepted numbers, and what belongs to its client; open it."""
    choices = project.choices
    inputs = inputs_of(project)
    refuse_other_origin(inputs)
    refuse_unanswered(project, line)
    decision = decide(inputs)
    if decision.addition is None:
        raise InputError(words.reason(decision))
    made = correct(decision, choices.accepted).accepted
    if made is None:
        raise InputError("no number is accepted, so there is nothing to write")
    name = project.free_name("machine", *WRITTEN)
    text = toml_of(made, source=" ".join(choices.marks), record=record_of(made, inputs))
    client = _client_files(project, choices, made, name)
    chosen = choices.model_copy(
        update={
            "settings": name,
            "settings_before": [*choices.settings_before, choices.settings],
            "accepted": [],
        }
    )
    more = {Path(path).name: content for path, content in client.files.items()}
    project.save(
        {**more, name: text, FILE: choices_text(chosen)},
        read={
            FILE: known.choices,
            choices.settings: known.settings,
            **dict.fromkeys(more, ""),
            name: "",
        },
    )
    entry = fit_entry(made, inputs, machine=name, settings=text.decode())
    return Written(
        file=name,
        files=[name, *more],
        steps=[*client.steps, *(f"{key}: {value}" for (_, key), value in client.typed.items())],
        failure=keep(str(project.path(name)), FIT, entry),
    )


@router.post("/correction/undo")
def undo(known: Write, project: TheProject) -> ProjectAnswer:
    """Open the settings again that were open before the latest correction; no file is lost."""
    choices = project.choices
    if not choices.settings_before:
        raise InputError("no correction was written, so there is nothing to take back")
    *earlier, name = choices.settings_before
    chosen = choices.model_copy(update={"settings": name, "settings_before": earlier})
    project.save({FILE: choices_text(chosen)}, read={FILE: known.choices})
    return show(project)


def _add_words(made: Correction, usual: Sequence[Checked], choices: Choices) -> list[str]:
    """Return what plumb add is given to change the accepted numbers alone; all of them if
    none is.
    """
    if not (made.effects or made.fixed):
        return _auto_words(choices)
    gone = {*made.held, *made.fixed}
    words = known_words(choices, effects=made.effects, held=gone)
    words += checked_words(usual, made.effects, {*gone, *choices.known})
    for name in made.fixed:
        words += ["--prior", f"{name}=0"]
    words += ["--effect", *(made.effects or ["none"])]
    for name, size in made.held.items():
        words += ["--hold", f"{name}={size:.12g}"]
    return words


def _auto_words(choices: Choices) -> list[str]:
    return [*known_words(choices), "--effect", "auto"]


def _number(number: Parameter, choices: Choices) -> ChangedNumber:
    change = plain_change(
        number.name, number.before, number.value, number.low, number.high, choices.unit
    )
    return ChangedNumber(
        name=number.name,
        **vars(change),
        possible=number.possible,
        met=range_met(range_said(number.name, choices.unit), possible=number.possible),
        is_accepted=number.name in choices.accepted,
    )


def _client_files(project: Project, choices: Choices, made: Addition, name: str) -> ClientFiles:
    """Return the lines for the machine, and the client's file if its settings came from a
    client.
    """
    original = _original(choices)
    return client_files(
        made.settings,
        client=CLIENT_OF[Path(original).suffix] if original else NO_CLIENT,
        firmware="plumb",
        original=project.path(original) if original else None,
        lines=str(project.path(f"{Path(name).stem}.nc")),
    )


def _original(choices: Choices) -> str | None:
    """Return the client's file that was opened last."""
    opened = [choices.settings, *reversed(choices.settings_before)]
    return next((each for each in opened if Path(each).suffix in CLIENT_OF), None)


def _client_words(choices: Choices) -> list[str]:
    """Return the client, and its file if that is not the settings' file."""
    original = _original(choices)
    if original is None:
        return [NO_CLIENT]
    more = [] if original == choices.settings else ["--original", original]
    return [CLIENT_OF[Path(original).suffix], *more]
