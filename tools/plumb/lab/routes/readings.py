"""Readings of the tape: each is saved into a marks.toml as it is typed."""

from collections.abc import Mapping
from pathlib import Path

from fastapi import APIRouter, UploadFile
from pydantic import BaseModel

from plumb.lab.project import Choices, Edges, Project, save_choices, with_marks
from plumb.lab.rounds import (
    ENDING,
    command,
    form_of,
    is_proof,
    is_read_again,
    known_words,
    opened,
    unit_words,
)
from plumb.lab.routes.project import TheProject, laid_down
from plumb.marks.form import (
    Form,
    marks_toml,
    read_form,
    with_distances,
    with_readings,
    with_tape_sigma,
)
from plumb.marks.model import Distance, Measurements, tape_sigma
from plumb.marks.read import from_edges, in_machine, read_marks
from plumb.model.predict import known_effects
from plumb.text.errors import InputError
from plumb.words import Heading
from plumb.words import round as words

router = APIRouter(tags=["readings"])


class AskedMark(BaseModel):
    """A mark whose place is measured. mm."""

    index: int
    name: str
    target: tuple[float, float]  # machine frame
    read: tuple[float, float] | None  # from the chosen edges; None: yet to come
    place: tuple[float, float] | None  # the same in the machine frame


class FormFile(BaseModel):
    """A file of marks in the folder."""

    name: str
    read: int  # readings that it has
    asked: int  # readings and marks that wait


class ReadingsAnswer(BaseModel):
    """A form with its readings."""

    heading: Heading
    counted: str  # how much is read, in a sentence
    files: list[FormFile]
    file: str  # the form below; empty if there is none
    digest: str
    edges: Edges  # from which the readings count
    sheet: tuple[float, float]
    marks: list[AskedMark]
    distances: tuple[Distance, ...]
    tape_sigma: float | None  # [mm] as stated in the file
    again: int  # marks that wait and are on the sheet already: they are only to be read again
    command: str


class TypedReading(BaseModel):
    """A reading as it was typed [mm from the chosen edges]; None takes it out."""

    index: int
    read: tuple[float, float] | None


class FormChange(BaseModel):
    """A change of a form, and the digest of the form that the page knows."""

    file: str
    digest: str


class TypedReadings(FormChange):
    """Readings for a form.

    `edges`: from which they count, whatever is chosen by now.
    """

    edges: Edges
    readings: list[TypedReading]


class TypedDistances(FormChange):
    """All distances of a form."""

    distances: list[Distance]


class Fineness(FormChange):
    """The finest division of the tape [mm]; None: nothing is stated."""

    finest: float | None


@router.get("/readings")
def show_readings(project: TheProject, file: str = "") -> ReadingsAnswer:
    """Return a form of the folder: the named, else the newest that is used."""
    choices = project.choices
    # Before the form is read: who saves it meanwhile is not taken for known.
    digests = {each: project.digest(each) for each in project.names()}
    forms = _forms(project, choices)
    name = file or next(iter(_by_use(forms, choices)), "")
    digest = digests.get(name, "")
    form = forms.get(name) if name else None
    if is_proof(file) and project.read(file) is not None:
        form = form_of(project, choices, file)
    if name and not form:
        raise InputError(f"{name}: there is no such form of marks in the folder")
    sheet = _sheet_of(project, form)
    measurements = form.measurements if form else Measurements(())
    return ReadingsAnswer(
        heading=words.TO_READ,
        counted=words.how_much_is_read(len(measurements.measured_marks), len(measurements.marks)),
        files=[_form_file(name, forms[name]) for name in _by_use(forms, choices)],
        file=name,
        digest=digest,
        edges=choices.edges,
        sheet=sheet,
        marks=_marks(measurements, sheet, choices.edges),
        distances=measurements.distances,
        tape_sigma=measurements.tape_sigma,
        again=_waiting(form) if form and is_read_again(project, name) else 0,
        command=_command(choices, name, measurements)
        if name
        else command("grid", "--marks", "..."),
    )


@router.put("/readings")
def save_readings(typed: TypedReadings, project: TheProject) -> ReadingsAnswer:
    """Put readings into a form, or take them out."""
    choices = project.choices
    form = form_of(project, choices, typed.file)
    sheet = _sheet_of(project, form)
    places = {
        each.index: each.read and in_machine(each.read, sheet=sheet, corner=typed.edges)
        for each in typed.readings
    }
    return _saved(project, typed.file, typed.digest, with_readings(form, places))


@router.put("/distances")
def save_distances(typed: TypedDistances, project: TheProject) -> ReadingsAnswer:
    """Replace the distances of a form."""
    form = form_of(project, project.choices, typed.file)
    for name in (name for each in typed.distances for name in each.between):
        if len({mark.target for mark in form.measurements.marks if mark.name == name}) > 1:
            raise InputError(f"mark {name} is at two places: measure from another mark")
    distances = [(each.between, each.length) for each in typed.distances]
    return _saved(project, typed.file, typed.digest, with_distances(form, distances))


@router.put("/fineness")
def save_fineness(stated: Fineness, project: TheProject) -> ReadingsAnswer:
    """State how fine the tape is."""
    form = form_of(project, project.choices, stated.file)
    finest = stated.finest
    chosen = {} if finest is None else {"fineness": finest}
    text = with_tape_sigma(form, None if finest is None else tape_sigma(finest))
    save_choices(
        project,
        lambda now: now.model_copy(update=chosen),
        files={stated.file: text.encode()},
        read={stated.file: stated.digest},
    )
    return show_readings(project, stated.file)


@router.post("/marks")
def open_marks(file: UploadFile, project: TheProject) -> ReadingsAnswer:
    """Take a file of marks into the project; another form than marks.toml becomes such."""
    sheet = opened(project).sheet
    content = file.file.read()
    ending = Path(file.filename or "").suffix.lower()
    with laid_down(project, file, ending if ending in (".csv", ".ini") else ENDING) as copy:
        content = _as_toml(copy, content, sheet)
    name = project.free_name("marks", ENDING)
    save_choices(project, lambda now: with_marks(now, name), files={name: content}, read={name: ""})
    return show_readings(project, name)


def _command(choices: Choices, name: str, measurements: Measurements) -> str:
    """Return the arrows of a form, and the readings that disagree."""
    unit = unit_words(choices, measurements.typed.unit)
    arrows = command("compare", choices.settings, name, *unit)
    doubts = command("diagnose", choices.settings, name, *known_words(choices), *unit)
    return f"{arrows}\n{doubts}"


def _as_toml(path: Path, content: bytes, sheet: tuple[float, float]) -> bytes:
    """Return a file of marks as a marks.toml; InputError if it is none."""
    if path.suffix == ENDING:
        try:
            read_form(path, sheet=sheet, known=known_effects())
            return content
        except InputError:
            read_marks(path, sheet=sheet, known=known_effects())
    measurements = read_marks(path, sheet=sheet, known=known_effects())
    return marks_toml(measurements).encode()


def _saved(project: Project, name: str, digest: str, text: str) -> ReadingsAnswer:
    """Save a form; from its first reading on the verdict goes by it."""
    files, read = {name: text.encode()}, {name: digest}
    if name in project.choices.marks or is_proof(name):
        project.save(files, read=read)
    else:
        save_choices(project, lambda now: with_marks(now, name), files=files, read=read)
    return show_readings(project, name)


def _forms(project: Project, choices: Choices) -> dict[str, Form]:
    """Return every form in the folder by its name."""
    forms = {}
    for name in project.names():
        if not name.endswith(ENDING) or name == choices.settings:
            continue
        if is_proof(name) and name not in choices.marks:
            continue
        try:
            forms[name] = form_of(project, choices, name)
        except InputError:
            if name in choices.marks:
                raise
    return forms


def _by_use(forms: Mapping[str, Form], choices: Choices) -> list[str]:
    """Return names of forms: what waits for readings first, then what is used, the newest first.

    Of those that wait, the marks that somebody took from the verdict come first.
    """
    used = [name for name in reversed(choices.marks) if name in forms]
    order = [*used, *(name for name in forms if name not in used)]
    waiting = [name for name in order if _waiting(forms[name])]
    waiting.sort(key=lambda name: name != choices.proposed)
    return [*waiting, *(name for name in order if name not in waiting)]


def _waiting(form: Form) -> int:
    """Return how many marks of a form wait for a reading."""
    return sum(mark.measured is None for mark in form.measurements.marks)


def _form_file(name: str, form: Form) -> FormFile:
    measurements = form.measurements
    lengths = len(measurements.distances)
    return FormFile(
        name=name,
        read=len(measurements.measured_marks) + lengths,
        asked=len(measurements.marks) + lengths,
    )


def _sheet_of(project: Project, form: Form | None) -> tuple[float, float]:
    """Return the sheet on which the marks were cut [mm]."""
    in_force = form and form.measurements.rounds[0].cut_with
    return in_force.sheet if in_force else opened(project).sheet


def _marks(measurements: Measurements, sheet: tuple[float, float], corner: str) -> list[AskedMark]:
    return [
        AskedMark(
            index=index,
            name=mark.name,
            target=mark.target,
            read=mark.measured and _shown(mark.measured, sheet, corner),
            place=mark.measured,
        )
        for index, mark in enumerate(measurements.marks)
    ]


def _shown(
    place: tuple[float, float], sheet: tuple[float, float], corner: str
) -> tuple[float, float]:
    """Return a place from the edges, without the noise of a computer's arithmetic."""
    x, y = from_edges(place, sheet=sheet, corner=corner)
    return round(x, 6) + 0.0, round(y, 6) + 0.0
