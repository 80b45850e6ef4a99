"""Practice: a virtual machine with something hidden, in the project's folder."""

from __future__ import annotations

import secrets
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Annotated

from fastapi import APIRouter, Depends, Request
from pydantic import BaseModel, Field

from plumb.fit.inputs import settings_in
from plumb.lab.choices import Bench, Number, read_choices, save_choices
from plumb.lab.practice_desk import PracticeDesk
from plumb.lab.project import Project
from plumb.lab.routes.bench import NEW_MACHINE
from plumb.lab.routes.project import TheProject
from plumb.marks.read import Mark, Measurements
from plumb.model.predict import values_of
from plumb.plan.options import READING
from plumb.plan.separation import FRAME_CHECKS, effect_checks
from plumb.settings.machine import MachineSettings
from plumb.text.errors import InputError
from plumb.vm import practice, practice_folder
from plumb.vm.budget import cutting
from plumb.vm.practice import HINT_MINUTES, SECOND_GRID, Practice, Score, hints_of
from plumb.vm.practice_file import NAME, game_in, score_in, score_text
from plumb.vm.practice_folder import MARKS, SETTINGS, Step
from plumb.vm.secret import LEVELS

router = APIRouter(tags=["practice"])
SEEDS = 1_000_000
GRIDS = ((3, 3), (5, 3), (5, 5))
MOST_PLACES = 45

Place = tuple[float, float]


class Level(BaseModel):
    """How hard a game is."""

    number: int
    words: str


class Cost(BaseModel):
    """What something costs."""

    name: str  # of a grid, like 5x5, or of what is measured directly
    words: str
    marks: int
    minutes: float
    allowed: bool


class FinalScore(BaseModel):
    """How the game ended [mm RMS over the sheet, without noise]."""

    hidden: str
    sentence: str
    named: list[str]
    false: list[str]
    missed: list[str]
    before: float
    frame: float
    after: float
    best: float  # by somebody who knows the truth and has the same marks
    second_sheet: float  # as the tape reads it
    marks: int
    minutes: float
    hints: int


class Game(BaseModel):
    """A game so far."""

    level: int
    words: str
    marks_left: int
    minutes_left: float
    marks: int  # of the budget
    minutes: float
    names: list[str]  # of the marks on the sheet
    hints: list[str]  # that were given
    hint_minutes: float
    more_hints: bool
    cuts: list[Cost]
    place_cost: Cost  # of the first mark of a round, and of each more
    place_minutes: float
    read_minutes: float
    checks: list[Cost]
    machines: list[str]  # files whose numbers can be sent
    score: FinalScore | None


class Work(BaseModel):
    """What is being done."""

    words: str
    done: int
    of: int


class PracticeAnswer(BaseModel):
    """What the screen needs."""

    levels: list[Level]
    taken: str  # why no game can begin in this folder; empty if it can
    game: Game | None
    doing: Work | None
    trouble: str  # why the last work failed


class Beginning(BaseModel):
    """A game to be started."""

    level: int = Field(ge=1, le=len(LEVELS))
    seed: int | None = Field(default=None, ge=0, lt=SEEDS)


class Cutting(BaseModel):
    """Marks to be cut: a grid, or places [mm, machine frame]."""

    grid: str = ""
    places: list[Place] = Field(default=[], max_length=MOST_PLACES)


class Names(BaseModel):
    """Marks to be read again."""

    names: list[str] = Field(min_length=1, max_length=MOST_PLACES)


class Measuring(BaseModel):
    """What to measure directly."""

    name: str


class Sending(BaseModel):
    """Whose numbers are sent at the end: a file of the folder."""

    machine: str


def _desk(request: Request) -> PracticeDesk:
    desk = request.app.state.practice_desk
    assert isinstance(desk, PracticeDesk)
    return desk


Desk = Annotated[PracticeDesk, Depends(_desk)]


@router.get("/practice")
def show_practice(project: TheProject, desk: Desk) -> PracticeAnswer:
    """The game of this folder, and what can be done."""
    doing = desk.doing
    playing = project.read(NAME) is not None
    return PracticeAnswer(
        levels=[Level(number=number, words=level.words) for number, level in LEVELS.items()],
        taken="" if playing else _taken(project),
        game=_game(project) if playing else None,
        doing=Work(words=doing.words, done=doing.done, of=doing.of) if doing else None,
        trouble=desk.trouble,
    )


@router.post("/practice/start")
def start(beginning: Beginning, project: TheProject, desk: Desk) -> PracticeAnswer:
    """Begin a game; an earlier game of this folder ends."""
    earlier = project.digest(NAME)
    if taken := "" if earlier else _taken(project):
        raise InputError(taken)
    if desk.doing:
        raise InputError(f"{desk.doing.words} first: wait until that is done")
    seed = secrets.randbelow(SEEDS) if beginning.seed is None else beginning.seed
    step = practice_folder.begun(Practice(beginning.level, seed))
    fresh = {"settings": SETTINGS, "marks": [], "known": {}, "bench": Bench(), "accepted": []}
    _save(project, step, earlier, fresh)
    # Only now: a game that somebody else moved on meanwhile keeps its marks.
    for name in (MARKS, NEW_MACHINE):
        project.path(name).unlink(missing_ok=True)
    return show_practice(project, desk)


@router.post("/practice/cut")
def cut(wanted: Cutting, project: TheProject, desk: Desk) -> PracticeAnswer:
    """Begin to cut marks on the machine; the tape reads them."""
    game, earlier = _playing(project), project.digest(NAME)
    believed = game.believed
    plan = _plan(wanted, game)
    visits = practice.visits_of(plan, believed)
    game.after(cutting(visits.sled_weights.tolist(), believed.sled_weight))

    def work(done: Callable[[int], None]) -> None:
        step = practice_folder.cut(project.folder, game, believed, plan, done)
        _save(project, step, earlier, {"marks": [MARKS]})

    desk.start("The machine cuts marks", len(plan.marks), work)
    return show_practice(project, desk)


@router.post("/practice/read")
def read_again(names: Names, project: TheProject, desk: Desk) -> PracticeAnswer:
    """Read marks of the sheet once more."""
    game, earlier = _playing(project), project.digest(NAME)
    believed = game.believed
    step = practice_folder.read_again(project.folder, game, believed, names.names)
    _save(project, step, earlier, {})
    return show_practice(project, desk)


@router.post("/practice/check")
def check(measuring: Measuring, project: TheProject, desk: Desk) -> PracticeAnswer:
    """Measure a number directly; it becomes what the owner knows."""
    game, earlier = _playing(project), project.digest(NAME)
    after, checked, _ = practice.check(game, measuring.name)
    choices, _ = read_choices(project)
    known = {each.name: Number(value=each.value, sigma=each.sigma) for each in checked}
    step = Step(after, {NAME: practice_folder.game_bytes(after)})
    _save(project, step, earlier, {"known": {**choices.known, **known}})
    return show_practice(project, desk)


@router.post("/practice/hint")
def hint(project: TheProject, desk: Desk) -> PracticeAnswer:
    """Give the next hint."""
    game, earlier = _playing(project), project.digest(NAME)
    after, _ = practice.hint(game)
    _save(project, Step(after, {NAME: practice_folder.game_bytes(after)}), earlier, {})
    return show_practice(project, desk)


@router.post("/practice/solve")
def solve(sending: Sending, project: TheProject, desk: Desk) -> PracticeAnswer:
    """Begin to cut a second sheet with a machine's numbers; then the secret is out."""
    game, earlier = _playing(project), project.digest(NAME)
    if not game.sheet:
        raise InputError("cut marks first: without marks there is nothing to solve")
    machine, believed = settings_in(project.path(sending.machine)), game.believed

    def work(done: Callable[[int], None]) -> None:
        score = practice_folder.solve(project.folder, game, believed, machine, done)
        _save(project, Step(game, {NAME: score_text(game, score).encode()}), earlier, {})

    count = SECOND_GRID.columns * SECOND_GRID.rows
    desk.start("The machine cuts a second sheet", count, work)
    return show_practice(project, desk)


def _taken(project: Project) -> str:
    """Why a game would harm what is in the folder; empty if it would not."""
    choices, _ = read_choices(project)
    there = [name for name in (SETTINGS, MARKS) if project.read(name) is not None]
    if not choices.settings and not there:
        return ""
    return (
        "This folder holds a machine of yours, and a game would write over its files. Open the "
        "lab on an empty folder: plumb lab game"
    )


def _playing(project: Project) -> Practice:
    """The game, if it goes on."""
    game = game_in(str(project.folder))
    if score_in(str(project.folder)):
        raise InputError("this game is solved: begin another")
    return game


def _plan(wanted: Cutting, game: Practice) -> Measurements:
    """The marks that are wanted; new names for places."""
    if wanted.places:
        taken = len(game.sheet)
        side = float(SECOND_GRID.approach[0]), float(SECOND_GRID.approach[1])
        marks = (
            Mark(f"p{taken + i}", place, place, approach=side)
            for i, place in enumerate(wanted.places, start=1)
        )
        return Measurements(tuple(marks))
    for columns, rows in GRIDS:
        if wanted.grid == f"{columns}x{rows}":
            return practice_folder.grid_marks(columns, rows, game.believed)
    raise InputError(f"{wanted.grid!r} is no grid of this game")


def _save(project: Project, step: Step, earlier: str, chosen: dict[str, object]) -> None:
    """Write a step and the choices that go with it, if nobody else moved the game meanwhile."""
    read = {NAME: earlier}
    if not chosen:
        return project.save(step.files, read=read)
    save_choices(project, lambda now: now.model_copy(update=chosen), files=step.files, read=read)


def _game(project: Project) -> Game:
    folder = str(project.folder)
    game, score = game_in(folder), score_in(folder)
    budget, believed = game.budget, game.believed
    return Game(
        level=game.level,
        words=LEVELS[game.level].words,
        marks_left=game.left.marks,
        minutes_left=game.left.minutes,
        marks=budget.marks,
        minutes=budget.minutes,
        names=list(game.sheet),
        hints=list(hints_of(game)[: game.hints]),
        hint_minutes=HINT_MINUTES,
        more_hints=game.hints < len(hints_of(game)) and game.left.minutes >= HINT_MINUTES,
        cuts=[_cost_of(f"{x}x{y}", f"{x} × {y} marks", x * y, game) for x, y in GRIDS],
        place_cost=_cost_of("", "a mark", 1, game),
        place_minutes=cutting([0.0, 0.0], 0.0).minutes - cutting([0.0], 0.0).minutes,
        read_minutes=READING,
        checks=_checks(game),
        machines=_machines(project, believed),
        score=_final(score) if score else None,
    )


def _cost_of(name: str, words: str, marks: int, game: Practice) -> Cost:
    spent = cutting([0.0] * marks, 0.0)
    return Cost(
        name=name,
        words=words,
        marks=marks,
        minutes=spent.minutes,
        allowed=game.budget.allows(game.spent + spent),
    )


def _checks(game: Practice) -> list[Cost]:
    """What can be measured directly, quickest first."""
    known = {**FRAME_CHECKS, **effect_checks()}
    costs = [
        Cost(
            name=name,
            words=check.direct.title,
            marks=0,
            minutes=check.direct.minutes,
            allowed=game.left.minutes >= check.direct.minutes,
        )
        for name, check in known.items()
    ]
    return sorted(costs, key=lambda cost: cost.minutes)


def _machines(project: Project, believed: MachineSettings) -> list[str]:
    """Files of machines that are not what the owner believed; the newest first."""
    paths = [project.path(name) for name in project.names() if name.endswith(".toml")]
    machines = []
    for path in sorted(paths, key=_age):
        try:
            machine = settings_in(path)
        except InputError:
            continue
        if values_of(machine).tolist() != values_of(believed).tolist():
            machines.append(path.name)
    return machines


def _age(path: Path) -> float:
    """Less for a newer file; a file that is just taken away is old."""
    with suppress(FileNotFoundError):
        return -path.stat().st_mtime
    return 0.0


def _final(score: Score) -> FinalScore:
    return FinalScore(
        hidden=score.hidden,
        sentence=score.sentence,
        named=list(score.named),
        false=list(score.false),
        missed=list(score.missed),
        before=score.sled.before,
        frame=score.sled.frame,
        after=score.sled.after,
        best=score.sled.known,
        second_sheet=score.cut,
        marks=score.spent.marks,
        minutes=score.spent.minutes,
        hints=score.hints,
    )
