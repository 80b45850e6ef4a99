"""A game for people: a machine with a secret, a sheet on it, and a budget of marks and minutes.

The state is kept between commands. It holds the level and the seed, from which the secret follows,
but not the secret. Each visit to the machine begins as the first did: chains laid over the
sprockets. The sheet stays on it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cache

import numpy as np

from plumb.diagnosis import Checked
from plumb.fit.compare import compare
from plumb.fit.inputs import Inputs
from plumb.grid.options import Grid
from plumb.marks.read import Measurements
from plumb.model.catalogue import empirical_effects
from plumb.model.plain import plainly
from plumb.plan.case import Check
from plumb.plan.planned_visits import Visits, joined, sent
from plumb.plan.separation import FRAME_CHECKS, NumberCheck, effect_checks
from plumb.settings.machine import MachineSettings
from plumb.text.errors import InputError
from plumb.text.values import refuse_unknown
from plumb.vm.budget import Budget, Spent, cutting, reading
from plumb.vm.floor import SledError, sled_errors
from plumb.vm.garage import random_garage
from plumb.vm.hiding import described
from plumb.vm.loop import lay_next_sheet, read, shape
from plumb.vm.owner import VirtualOwner
from plumb.vm.secret import LEVELS, Secret, of_level

HINT_MINUTES = 10.0
SECOND_GRID = Grid(columns=5, rows=5, repeats=0)
SHORT = "practice"  # how messages call it


@dataclass(frozen=True)
class Practice:
    """A game so far."""

    level: int
    seed: int
    spent: Spent = field(default_factory=Spent)
    visits: int = 0  # to the machine
    hints: int = 0
    sheet: dict[str, list[tuple[float, float]]] = field(default_factory=dict)  # marks on it [mm]

    @property
    def budget(self) -> Budget:
        """What may be spent."""
        return Budget()

    @property
    def secret(self) -> Secret:
        """What is hidden."""
        return of_level(self.level, self.seed)

    @property
    def believed(self) -> MachineSettings:
        """What the owner of the machine believes of it."""
        return _believed(self.level, self.seed)

    def owner(self) -> VirtualOwner:
        """Somebody who goes to the machine once more; a slip happens on the first sheet."""
        garage = random_garage(self.secret.hidden, self.seed)
        slip = 0.0 if self.sheet else self.secret.slip
        return VirtualOwner(garage, slip=slip, visit=self.visits)

    def after(self, more: Spent) -> Practice:
        """The game after something was done; InputError if the budget does not allow it."""
        spent = self.spent + more
        if not self.budget.allows(spent):
            left = self.left
            raise InputError(
                f"that takes {more.marks} marks and {more.minutes:.0f} minutes, and {left.marks} "
                f"marks and {left.minutes:.0f} minutes are left: measure less, or solve it"
            )
        return replace(self, spent=spent, visits=self.visits + 1)

    @property
    def left(self) -> Spent:
        """What is left of the budget."""
        budget = self.budget
        return Spent(budget.marks - self.spent.marks, budget.minutes - self.spent.minutes)


@cache
def _believed(level: int, seed: int) -> MachineSettings:
    return random_garage(of_level(level, seed).hidden, seed).settings


def cut(
    game: Practice,
    settings: MachineSettings,
    visits: Visits,
    done: Callable[[int], None] | None = None,
) -> tuple[Practice, str]:
    """Cut marks and read them: the game, and the form, filled; `done` counts the marks."""
    after = game.after(cutting(visits.sled_weights.tolist(), settings.sled_weight))
    owner = game.owner()
    owner.switch_on()
    form = owner.carry_out(visits, done)
    sheet = {name: list(places) for name, places in game.sheet.items()}
    for name, places in owner.tape.places.items():
        sheet[name] = [*sheet.get(name, []), *places]
    return replace(after, sheet=sheet), form


def visits_of(marks: Measurements, settings: MachineSettings) -> Visits:
    """The visits that a form asks for; InputError for what this machine cannot do."""
    each = []
    for mark in marks.marks:
        if mark.chains_swapped:
            raise InputError(f"{SHORT}: mark {mark.name} wants the chains swapped; choose others")
        side = np.array(mark.approach or (0.0, 0.0))
        length = float(np.hypot(*side))
        try:
            visit = sent(
                settings,
                np.array([mark.target]),
                controller="plumb",
                sled_weight=mark.sled_weight or settings.sled_weight,
                names=[mark.name],
                approaches=np.array([side / length if length else side]),
            )
        except ValueError as error:
            raise InputError(f"{SHORT}: mark {mark.name}: {error}") from None
        each.append(visit)
    return joined(*each)


def read_again(
    game: Practice, names: Sequence[str]
) -> tuple[Practice, list[tuple[str, float, float]]]:
    """New readings of marks that are on the sheet: the name and the place [mm from its middle]."""
    try:
        refuse_unknown(names, list(game.sheet))
    except ValueError as error:
        raise InputError(f"{SHORT}: no mark on the sheet has that name: {error}") from None
    tape = game.owner().tape
    tape.find(game.sheet)
    readings = [(name, *place) for name in names for place in tape.read_again(name)]
    return game.after(reading(len(readings))), readings


def check(game: Practice, name: str) -> tuple[Practice, list[Checked], NumberCheck]:
    """Measure a number of the frame, or what makes an effect, directly."""
    checks = {**FRAME_CHECKS, **effect_checks()}
    try:
        refuse_unknown([name], list(checks))
    except ValueError as error:
        raise InputError(f"{SHORT}: {error}") from None
    known, in_frame = checks[name], name in FRAME_CHECKS
    each = [
        Check(part if in_frame else f"{name}.{part}", sigma) for part, sigma in known.sigmas.items()
    ]
    return game.after(Spent(0, known.direct.minutes)), game.owner().check(each), known


@dataclass(frozen=True)
class Score:
    """How a game ended."""

    hidden: str
    named: tuple[str, ...]  # effects that were hidden and claimed
    false: tuple[str, ...]  # claims of what was not there
    missed: tuple[str, ...]  # effects that were hidden and not claimed
    cut: float  # [mm] RMS of the second sheet as a tape reads it, laid at its best
    sled: SledError  # all over the sheet, without noise
    spent: Spent
    hints: int

    @property
    def sentence(self) -> str:
        """What was found, missed, and claimed though it is not there."""
        parts = []
        if self.named:
            parts.append(f"You found {plainly(self.named)}.")
        if self.missed:
            parts.append(f"You missed {plainly(self.missed)}.")
        if self.false:
            parts.append(f"You added {plainly(self.false)}, which is not there.")
        return " ".join(parts) or "You added no effect."


def solve(
    game: Practice,
    inputs: Inputs,
    machine: MachineSettings,
    done: Callable[[int], None] | None = None,
) -> Score:
    """Send a machine's numbers, cut a second sheet, and look at the truth; `done` counts marks."""
    owner = game.owner()
    garage, hidden = owner.garage, game.secret.hidden
    claims = claims_of(inputs.settings, machine)
    owner.switch_on()
    raised = machine.fitted.sheet_rise(machine.sheet_width) if machine.fitted else 0.0
    lay_next_sheet(owner, machine, raised=raised)
    lines = len(owner.grid_program(SECOND_GRID)[0])
    marks = SECOND_GRID.columns * SECOND_GRID.rows
    answered = (lambda line: done(line * marks // lines)) if done else None
    second = shape(compare(machine, read(owner, owner.cut_grid(SECOND_GRID, answered=answered))))
    return Score(
        described(hidden),
        tuple(name for name in claims if name in hidden.effects),
        tuple(name for name in claims if name not in hidden.effects),
        tuple(name for name in hidden.effects if name not in claims),
        second,
        sled_errors(inputs, garage, machine),
        game.spent,
        game.hints,
    )


def claims_of(believed: MachineSettings, machine: MachineSettings) -> tuple[str, ...]:
    """The effects whose numbers are not what they were, patches aside."""
    patches = {effect["name"] for effect in empirical_effects()}
    named = [
        name
        for name in (*believed.effects, *machine.effects)
        if machine.effects.get(name) != believed.effects.get(name) and name not in patches
    ]
    return tuple(dict.fromkeys(named))


def hint(game: Practice) -> tuple[Practice, str]:
    """The next hint, each clearer than the last; it costs minutes."""
    hints = hints_of(game)
    if game.hints >= len(hints):
        raise InputError(f"{SHORT}: all {len(hints)} hints are given; solve it")
    after = replace(game.after(Spent(0, HINT_MINUTES)), hints=game.hints + 1)
    return after, hints[game.hints]


def hints_of(game: Practice) -> tuple[str, ...]:
    """All hints, whether given or not."""
    hidden, level = game.secret.hidden, LEVELS[game.level]
    return (
        f"It is {level.words}.",
        _where(game),
        f"It is {described(hidden)}." if hidden.causes or hidden.outside else "Nothing is hidden.",
    )


def _where(game: Practice) -> str:
    """Three effects among which the hidden are."""
    hidden = game.secret.hidden
    if not hidden.effects:
        return "No effect of the library makes it: where do the errors lie, and how wide?"
    source = np.random.default_rng([game.seed, game.level, 23])
    others = [name for name in effect_checks() if name not in hidden.effects]
    shown = [*hidden.effects, *source.choice(others, 3 - len(hidden.effects), replace=False)]
    return f"Among these: {', '.join(sorted(shown))}."
