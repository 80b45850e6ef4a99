"""Rounds of marks: form and program, numbered, where the marks are, and who proposed them. Readings
are never replaced."""

from __future__ import annotations

import re
from collections.abc import Container, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import PurePath
from typing import Literal

import numpy as np

from plumb import api
from plumb.fit.fit import PRIORS, Checked
from plumb.fit.inputs import Inputs, settings_in
from plumb.grid import PRESETS, Grid, PlainMachine, Touch, marks_list, program, touches_of
from plumb.lab.known import refuse_absurd_known, stated
from plumb.lab.project import FILE, Choices, Layout, Project, read_choices
from plumb.marks.form import Form, read_form
from plumb.marks.read import Mark, read_marks
from plumb.model.predict import known_effects
from plumb.model.reach import plain_machine, refuse_way, with_soft_chains
from plumb.plan import planned_visits
from plumb.plan.planned_visits import proof_places
from plumb.plan.proposal import MARK, ROUND
from plumb.settings import MachineSettings, cut_with_lines, digest_of, with_form
from plumb.text.answers import Internal
from plumb.text.commands import quoted
from plumb.text.errors import InputError, on_page
from plumb.text.files import is_ours, numbered

ENDING = ".toml"  # of a form
MARKS, PROOFS = ("marks", "grid"), ("proof", "proof")  # beginnings of the names of form and program


def is_proof(name: str) -> bool:
    """Return whether a form is of proof marks, which take part only on request."""
    return name.startswith(("proof", "check"))  # as they were called before


def on_new_sheet(choices: Choices) -> bool:
    """Return whether the next round is cut on a new sheet; False for the first round."""
    return choices.new_sheet and bool(choices.marks)


def kept_settings(project: Project, choices: Choices) -> dict[str, bytes]:
    """Return the open settings as a file that stays, by the digest that a form names."""
    name = choices.settings
    content = project.read(name)
    if content is None:
        return {}
    digest = digest_of(project.path(name))[:16]
    return {f".settings-{digest}{PurePath(name).suffix.lower()}": content}


def grid_command(
    project: Project, choices: Choices, plan: Planned, *, form: str, program: str
) -> str:
    """Return the command that writes a form and its program as the lab does."""
    sheet = ["--new-sheet"] * on_new_sheet(choices)
    force = ["--force"] * (project.read(form) is not None)  # the lab replaces it too
    files = ["--marks", form, "--output", program]
    return command("grid", "--settings", choices.settings, *plan.words(), *sheet, *files, *force)


def next_names(project: Project, names: tuple[str, str] = MARKS) -> tuple[str, str]:
    """Return the names of the next round's form and program, which end in nothing, or -2, -3 ..."""
    form, program = names
    number = next(
        each
        for each in numbered("")
        if not has_readings(project, f"{form}{each}{ENDING}")
        # A program that the lab did not write stays.
        and (project.read(cut := f"{program}{each}.nc") is None or is_ours(project.path(cut)))
    )
    return f"{form}{number}{ENDING}", f"{program}{number}.nc"


def form_of(project: Project, choices: Choices, name: str) -> Form:
    """Return a form of the folder. Raises InputError."""
    settings = settings_of(project, choices)
    sheet = settings.sheet if settings else (0.0, 0.0)
    return read_form(project.path(name), sheet=sheet, known=known_effects())


def has_readings(project: Project, name: str) -> bool:
    """Return whether a form has any reading, or is no form at all."""
    if project.read(name) is None:
        return False
    try:
        return _is_read(form_of(project, project.choices, name))
    except InputError:
        return True  # whatever it is, somebody wrote it


def _is_read(form: Form) -> bool:
    return bool(form.measurements.measured_marks or form.measurements.distances)


# The marks of the chosen layout, as a grid to cut and as a plan to look at.

BAND = 150.0  # [mm] marks that lie so near in height are cut side by side
Place = tuple[float, float]


TITLES: dict[Layout, str] = {
    "nine": "Nine marks",
    "fifteen": "Fifteen marks",
    "twenty-five": "Twenty-five marks",
}


@dataclass(frozen=True)
class Planned:
    """The marks of a layout on a machine's sheet."""

    layout: Layout
    grid: Grid
    machine: PlainMachine
    touches: tuple[Touch, ...]

    @property
    def minutes(self) -> float:
        """The time to cut and read them."""
        return ROUND + MARK * len(self.touches)

    def words(self) -> list[str]:
        """Return what `plumb grid` is given for these marks."""
        if self.layout in PRESETS:
            return ["--preset", self.layout]
        places = " ".join(f"{x:.12g},{y:.12g}" for x, y in self.grid.places)
        return [f"--places={places}"]


def planned(settings: MachineSettings, layout: Layout, places: Sequence[Place]) -> Planned:
    """Return the marks of a layout; `places` [mm] are those of the layout "own". Raises
    GridError.
    """
    machine = plain_machine(settings)
    usual = PRESETS.get(layout)
    grid = usual or Grid(repeats=False, places=tuple(in_turn(places)))
    touches = tuple(sorted(touches_of(grid, machine), key=lambda touch: int(touch.name)))
    return Planned(layout, grid, machine, touches)


def unreachable(plan: Planned, settings: MachineSettings) -> str:
    """Return why the sled cannot take the way to all marks; empty if it can."""
    soft = with_soft_chains(replace(settings.as_plumb_model()))[0]
    try:
        refuse_way(plan.grid, plan.machine, soft)
    except (ValueError, InputError) as error:
        return on_page(error)
    return ""


def in_turn(places: Sequence[Place]) -> list[Place]:
    """Return places in an order that makes the way short: in bands from the top, there and back."""
    rows: list[list[Place]] = []
    for place in sorted(places, key=lambda place: -place[1]):
        if rows and rows[-1][0][1] - place[1] < BAND:
            rows[-1].append(place)
        else:
            rows.append([place])
    return [
        place
        for index, row in enumerate(rows)
        for place in sorted(row, key=lambda place: place[0] * (-1 if index % 2 else 1))
    ]


# A round: marks that are to be cut, whoever proposed them.

# Who says where they are: the owner, the verdict, or nobody: they are as far away as can be.
Origin = Literal["chosen", "proposed", "proof"]


@dataclass(frozen=True, kw_only=True)
class RoundToCut:
    """Marks of a form, and the program that cuts them."""

    origin: Origin
    form: str
    program: str
    text: str  # the G-code; empty where it cannot be made
    marks: tuple[Mark, ...]  # in the order in which they are cut
    command: str
    trouble: str = ""  # why the sled cannot take this way; empty if it can
    new_sheet: bool = False
    # That the form names; None: those that are open.
    cut_with: Internal[MachineSettings | None] = None
    # Written before it is cut, with the digests of what they replace; empty: it is in the folder.
    files: Internal[Mapping[str, bytes]] = field(default_factory=dict)
    read: Internal[Mapping[str, str]] = field(default_factory=dict)

    def is_in(self, project: Project) -> bool:
        """Return whether its files are in the folder as they would be written now."""
        return all(project.read(name) == content for name, content in self.files.items())

    def save(self, project: Project) -> None:
        """Write its files. Raises ChangedError, and InputError if the sled cannot take its way."""
        if self.trouble:
            raise InputError(self.trouble)
        if self.files:
            project.save({**self.files, **kept_settings(project, project.choices)}, read=self.read)


def chosen_round(project: Project) -> RoundToCut:
    """Return the marks of the chosen layout, or those that somebody took from the verdict."""
    choices, digest = read_choices(project)
    settings = opened(project)
    if is_taken(project, choices.proposed):
        taken = saved_round(project, choices.proposed, "proposed")
        try:
            planned_visits.refuse_way(settings, taken.marks)
        except InputError as error:
            return replace(taken, trouble=on_page(error))
        return taken
    plan = planned(settings, choices.layout, choices.planned)
    names, read = next_names(project), {FILE: digest}
    return new_round(project, choices, plan, names, origin="chosen", read=read)


def new_round(
    project: Project,
    choices: Choices,
    plan: Planned,
    names: tuple[str, str],
    *,
    origin: Origin,
    read: Mapping[str, str] | None = None,
) -> RoundToCut:
    """Return a round of planned marks, for files of these names."""
    form, file = names
    settings, path = project.path(choices.settings), str(project.path(form))
    new_sheet = on_new_sheet(choices)
    digests = {name: project.digest(name) for name in names}
    trouble = unreachable(plan, opened(project))
    text = "" if trouble else program(plan.grid, plan.machine)
    named = cut_with_lines(settings, path)
    filled = marks_list(plan.grid, plan.machine, named, new_sheet=new_sheet)
    made = grid_command(project, choices, plan, form=form, program=file)
    return RoundToCut(
        origin=origin,
        form=form,
        program=file,
        text=text,
        marks=tuple(
            Mark(touch.name, (touch.x, touch.y)) for touch in touches_of(plan.grid, plan.machine)
        ),
        command=f"{made}\n{command('send', file)}",
        trouble=trouble,
        new_sheet=new_sheet,
        files={form: filled.encode(), file: with_form(text, form, file).encode()},
        read={**(read or {}), **digests},
    )


def saved_round(project: Project, form: str, origin: Origin) -> RoundToCut:
    """Return a round that is in the folder."""
    measurements = form_of(project, project.choices, form).measurements
    file = program_name(form)
    return RoundToCut(
        origin=origin,
        form=form,
        program=file,
        text=(project.read(file) or b"").decode(errors="replace"),
        marks=measurements.marks,
        command=command("send", file),
        cut_with=measurements.rounds[0].cut_with,
    )


# A proposal that was accepted into the folder: its form, and the program that cuts it.

STEM = "more"  # as plumb next calls them
FORM_NAME = re.compile(rf"{STEM}(-\d+)?\.toml")


def program_name(form: str) -> str:
    """Return the file of the program whose marks a form waits for."""
    return f"{PurePath(form).stem}.nc"


def is_read_again(project: Project, form: str) -> bool:
    """Return whether the marks of a form are on the sheet already: it was accepted, nothing cuts
    it.
    """
    return bool(FORM_NAME.fullmatch(form)) and project.read(program_name(form)) is None


def is_taken(project: Project, form: str) -> bool:
    """Return whether a form was accepted, is cut by a program, and has no readings yet."""
    there = FORM_NAME.fullmatch(form) and None not in map(project.read, [form, program_name(form)])
    return bool(there) and not has_readings(project, form)


# The `plumb` command that does the same as a screen, with every choice that counts there.


def command(*words: str) -> str:
    """Return a command as a shell reads it."""
    return " ".join(map(quoted, ["plumb", *words]))


def known_words(
    choices: Choices, *, effects: Container[str] | None = None, held: Container[str] = ()
) -> list[str]:
    """Return what the owner knows, as far as a fit of these effects takes it; None: any effect."""
    known = stated(choices)
    return [*prior_words(known.priors), *checked_words(known.checked, effects, held)]


def prior_words(priors: Mapping[str, float], usual: Mapping[str, float] = PRIORS) -> list[str]:
    """Return how far numbers of the frame may be wrong, where it is not as usual."""
    words = []
    for name, sigma in priors.items():
        if usual.get(name) != sigma:
            words += ["--prior", f"{name}={sigma:.12g}"]
    return words


def checked_words(
    checks: Iterable[Checked], effects: Container[str] | None, but: Container[str]
) -> list[str]:
    """Return what is known of numbers, as far as a fit of these effects takes it; None: any."""
    words = []
    for each in checks:
        effect = each.name.rpartition(".")[0]
        if (effects is None or not effect or effect in effects) and each.name not in but:
            words += ["--checked", f"{each.name}={each.value:.12g}+-{each.sigma:.12g}"]
    return words


def unit_words(choices: Choices, typed: str = "mm") -> list[str]:
    """Return the chosen unit, unless the command shows it by itself: the unit in which it was
    typed.
    """
    return ["--units", choices.units] if choices.units != typed else []


# Settings and readings of a folder, as a fit takes them and as a command names them.


def opened(project: Project) -> MachineSettings:
    """Return the opened settings. Raises InputError if none are open."""
    settings = settings_of(project, project.choices)
    if settings is None:
        raise InputError("no settings are open; open the settings of the machine first")
    return settings


def settings_of(project: Project, choices: Choices) -> MachineSettings | None:
    """Return the opened settings; None if none are open. Raises InputError."""
    return settings_in(project.path(choices.settings)) if choices.settings else None


def inputs_of(project: Project, *, among: Sequence[str] | None = None) -> api.Inputs:
    """Return the opened settings with all readings, or with those in files of these names.

    Raises InputError if something is missing, or cannot have been measured.
    """
    choices, settings = project.choices, opened(project)
    names = read_names(project, choices.marks if among is None else among, choices)
    if not names:
        raise InputError("there are no readings yet; type in what you measured first")
    inputs = api.read(*map(project.path, [choices.settings, *names]))
    refuse_absurd_known(settings, choices)
    known = stated(choices)
    return replace(inputs, priors=known.priors, checked=known.checked, unit=choices.unit)


def changed_since_fit(project: Project, choices: Choices, settings: MachineSettings) -> str:
    """Return the name of a form that the opened settings were fitted to, and that has other
    readings by now; empty if there is none.
    """
    for board in settings.fitted.boards if settings.fitted else ():
        if board.marks not in choices.marks or not board.marks.endswith(".toml"):
            continue
        try:
            now = read_marks(project.path(board.marks), sheet=settings.sheet, known=known_effects())
        except InputError:
            continue  # who asks for the readings hears of it
        if now.rounds[0].digest != board.digest:
            return board.marks
    return ""


def board_words(project: Project) -> list[str]:
    """Return the opened settings and the files that have readings, as a command names them."""
    choices = project.choices
    return [choices.settings, *read_names(project, choices.marks, choices)]


def read_names(project: Project, among: Sequence[str], choices: Choices) -> list[str]:
    """Return those of these files of marks that have readings."""
    return [
        name
        for name in among
        if not name.endswith(ENDING) or _is_read(form_of(project, choices, name))
    ]


# Proof marks: two that took no part in the fit, on the sheet of the marks before them.


FORM = re.compile(r"(proof|check)(?:-(\d+))?\.toml")  # check: as they were called before


def proof_round(project: Project, *, anew: bool = False) -> RoundToCut:
    """Return the newest round of proof marks; another where there is none, or `anew`: it takes the
    place of one without readings.
    """
    forms = proof_forms(project)
    if forms and not anew:
        return saved_round(project, forms[-1], "proof")
    choices, inputs = project.choices, inputs_of_promise(project)
    names = next_names(project, PROOFS)
    before = [form_of(project, choices, form) for form in forms if form not in names]
    cut = [mark.target for form in before for mark in form.measurements.marks]
    # Far from the marks that were fitted, and from proof marks that were cut before.
    known = [*map(tuple, inputs.measurements.targets), *cut]
    places = proof_places(inputs.settings, np.array(known))
    if not len(places):
        raise InputError("no place is left that the sled reaches and that was not fitted")
    plan = planned(inputs.settings, "own", [(float(x), float(y)) for x, y in places])
    same_sheet = choices.model_copy(update={"new_sheet": False})
    return new_round(project, same_sheet, plan, names, origin="proof")


def proof_forms(project: Project) -> list[str]:
    """Return the forms of proof marks in the folder, in the order in which they were made."""
    found = [match for name in project.names() if (match := FORM.fullmatch(name))]
    return [match[0] for match in sorted(found, key=lambda match: (match[1], int(match[2] or 1)))]


def inputs_of_promise(project: Project) -> Inputs:
    """Return the readings that the promise goes by. Raises InputError."""
    return inputs_of(project, among=_promising(project))


def _promising(project: Project) -> list[str]:
    """Return the files of these readings: proof marks take no part, nor does a sheet that was laid
    after the correction, for proof marks are on the sheet before it.
    """
    choices = project.choices
    names = [name for name in choices.marks if not is_proof(name)]
    settings = settings_of(project, choices)
    fitted = settings and settings.fitted
    seen = [board.marks for board in fitted.boards] if fitted else names
    later = (
        place
        for place, name in enumerate(names)
        if name not in seen and form_of(project, choices, name).measurements.rounds[0].new_sheet
    )
    return names[: next(later, len(names))]
