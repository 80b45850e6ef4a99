"""The files of a round of marks, form and program, numbered; readings are never replaced."""

from __future__ import annotations

import re
from collections.abc import Collection, Container, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path, PurePath

from plumb import api
from plumb.fit.inputs import settings_in
from plumb.fit.problem import PRIORS, Checked
from plumb.grid import PRESETS, Grid, PlainMachine, marks_list, spans_of, touches_of
from plumb.grid.pattern import Touch
from plumb.lab.known import refuse_absurd_known, stated
from plumb.lab.project import Choices, Layout, Project
from plumb.line.progress import Wait, waits_in
from plumb.marks.form import read_form
from plumb.marks.read import Mark, read_marks
from plumb.model.predict import known_effects
from plumb.model.reach import plain_machine, refuse_way, with_soft_chains
from plumb.plan.options import MARK, READING, ROUND
from plumb.settings.cut_with import cut_with_lines, digest_of, with_form
from plumb.settings.machine import MachineSettings
from plumb.text.commands import quoted
from plumb.text.errors import InputError, Source
from plumb.text.files import is_ours, numbered

FORM, PROGRAM = "marks{}.toml", "grid{}.nc"


def on_new_sheet(choices: Choices) -> bool:
    """Return whether the next round is cut on a new sheet; False for the first round."""
    return choices.new_sheet and bool(choices.marks)


def round_files(
    project: Project, choices: Choices, plan: Planned, text: str, *, form: str, program: str
) -> dict[str, bytes]:
    """Return the form of a round and its program, by their names."""
    settings, path = project.path(choices.settings), str(project.path(form))
    filled = plan.form(path, settings=settings, new_sheet=on_new_sheet(choices))
    return {form: filled.encode(), program: with_form(text, form, program).encode()}


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


def cut_commands(
    project: Project, choices: Choices, plan: Planned, *, form: str, program: str
) -> str:
    """Return that command, and below it the command that cuts the marks."""
    made = grid_command(project, choices, plan, form=form, program=program)
    return f"{made}\n{command('send', program)}"


def next_names(project: Project) -> tuple[str, str]:
    """Return the names of the next round's form and program, which end in nothing, or -2, -3 ..."""
    number = next(
        each
        for each in numbered("")
        if not has_readings(project, FORM.format(each)) and not _is_foreign(project, each)
    )
    return FORM.format(number), PROGRAM.format(number)


def _is_foreign(project: Project, number: str) -> bool:
    """Return whether the program of a round would replace one that the lab did not write."""
    name = PROGRAM.format(number)
    return project.read(name) is not None and not is_ours(project.path(name))


def has_readings(project: Project, name: str) -> bool:
    """Return whether a form has any reading, or is no form at all."""
    if project.read(name) is None:
        return False
    try:
        form = read_form(project.path(name), sheet=(0.0, 0.0), known=known_effects())
    except InputError:
        return True  # whatever it is, somebody wrote it
    return bool(form.measurements.measured_marks or form.measurements.distances)


# The marks of the chosen layout, as a grid to cut and as a plan to look at.

BAND = 150.0  # [mm] marks that lie so near in height are cut side by side
Place = tuple[float, float]


TITLES: dict[Layout, str] = {
    "nine": "Nine marks",
    "fifteen": "Fifteen marks",
    "twenty-five": "Twenty-five marks",
    "distances": "Distances between nine marks",
}


@dataclass(frozen=True)
class Planned:
    """The marks of a layout on a machine's sheet."""

    layout: Layout
    grid: Grid
    machine: PlainMachine
    touches: tuple[Touch, ...]

    @property
    def spans(self) -> Sequence[tuple[str, str]]:
        """Names of marks between which a tape is laid."""
        return spans_of(self.grid)

    @property
    def minutes(self) -> float:
        """The time to cut and read them."""
        read = READING * len(self.spans)
        return ROUND + MARK * len(self.touches) + read

    def form(self, path: str, *, settings: Source, new_sheet: bool = False) -> str:
        """Return the form at that path that waits for readings of marks cut with these settings."""
        named = cut_with_lines(settings, path)
        return marks_list(self.grid, self.machine, named, new_sheet=new_sheet)

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


def refuse_unreachable(plan: Planned, settings: MachineSettings) -> None:
    """Raise GridError or InputError if the sled cannot take the way to all marks."""
    soft = with_soft_chains(replace(settings.as_plumb_model()))[0]
    refuse_way(plan.grid, plan.machine, soft)


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


# A proposal that was accepted into the folder: its form, and the program that cuts it.

STEM = "more"  # as plumb next calls them
FORM_NAME = re.compile(rf"{STEM}(-\d+)?\.toml")


@dataclass(frozen=True)
class Taken:
    """Marks that are to be cut because the verdict proposed them."""

    form: str
    program: str
    text: str  # the G-code
    marks: tuple[Mark, ...]  # in the order in which they are cut
    cut_with: MachineSettings | None = None  # that the form names

    @property
    def waits(self) -> tuple[Wait, ...]:
        """The pauses of the program."""
        return tuple(waits_in(self.text.splitlines()))


def program_name(form: str) -> str:
    """Return the file of the program whose marks a form waits for."""
    return f"{PurePath(form).stem}.nc"


def is_read_again(project: Project, form: str) -> bool:
    """Return whether the marks of a form are on the sheet already: it was accepted, nothing cuts
    it.
    """
    return bool(FORM_NAME.fullmatch(form)) and project.read(program_name(form)) is None


def taken_marks(project: Project, choices: Choices) -> Taken | None:
    """Return what was taken and is to be cut; None once it has readings, and where nothing
    is cut.
    """
    form = choices.proposed
    if not FORM_NAME.fullmatch(form) or project.read(form) is None or has_readings(project, form):
        return None
    text = project.read(program_name(form))
    if text is None:
        return None
    sheet = settings_in(project.path(choices.settings)).sheet if choices.settings else (0.0, 0.0)
    measured = read_form(project.path(form), sheet=sheet, known=known_effects()).measurements
    cut_with = measured.rounds[0].cut_with
    return Taken(form, program_name(form), text.decode(), measured.marks, cut_with)


# The `plumb` command that does the same as a screen, with every choice that counts there.


def command(*words: str) -> str:
    """Return a command as a shell reads it."""
    return " ".join(map(quoted, ["plumb", *words]))


def known_words(
    choices: Choices, *, effects: Collection[str] | None = None, held: Collection[str] = ()
) -> list[str]:
    """Return what the owner knows, as far as a fit of these effects takes it; None: any effect."""
    known = stated(choices)
    words = []
    for check in known.checked:
        effect = check.name.rpartition(".")[0]
        if (effects is None or not effect or effect in effects) and check.name not in held:
            words += ["--checked", f"{check.name}={check.value:.12g}+-{check.sigma:.12g}"]
    return [*prior_words(known.priors), *words]


def prior_words(priors: Mapping[str, float], usual: Mapping[str, float] = PRIORS) -> list[str]:
    """Return how far numbers of the frame may be wrong, where it is not as usual."""
    words = []
    for name, sigma in priors.items():
        if usual.get(name) != sigma:
            words += ["--prior", f"{name}={sigma:.12g}"]
    return words


def usual_words(usual: Sequence[Checked], effects: Sequence[str], but: Container[str]) -> list[str]:
    """Return what is usual of the sizes of these effects, as a command takes it."""
    words = []
    for each in usual:
        if each.name.rpartition(".")[0] in effects and each.name not in but:
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
    if not project.choices.settings:
        raise InputError("no settings are open; open the settings of the machine first")
    return settings_in(project.path(project.choices.settings))


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
    settings = project.path(choices.settings)
    return [name for name in among if _has_readings(project.path(name), settings)]


def _has_readings(path: Path, settings: Path) -> bool:
    """Return whether any mark of a form is read; other files have nothing else."""
    if path.suffix != ".toml":
        return True
    sheet = settings_in(settings).sheet
    measurements = read_form(path, sheet=sheet, known=known_effects()).measurements
    return bool(measurements.measured_marks or measurements.distances)
