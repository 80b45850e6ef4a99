"""One board of a scenario: made, diagnosed, and judged."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from zlib import crc32

import numpy as np

from plumb.bench.boards import BoardCut, TrueMachine, cut
from plumb.bench.causes import CHAIN, HALF, MAKER
from plumb.bench.hiding import slip
from plumb.bench.outcome import Outcome, look_alikes, outcome_of
from plumb.bench.scenarios import Scenario
from plumb.diagnosis import Checked, Diagnosis, diagnose
from plumb.fit.compare import best_pose
from plumb.fit.fit import fit
from plumb.fit.inputs import Inputs
from plumb.fit.observations import rms
from plumb.model.predict import FOUND, lengths
from plumb.plan import Proposal, propose
from plumb.plan.case import Check
from plumb.plan.planned_visits import Visits
from plumb.settings.machine import MachineSettings

MOST_ALIKE = 3  # causes of a board whose look-alikes are asked for
LARGE_SLIP = 10.0  # [mm]
SEEDS = 1_000_003  # boards of one seed before those of the next


@dataclass(frozen=True)
class JudgedBoard:
    """What came of a board."""

    outcome: Outcome
    cure: Cure | None  # where the sled was measured too
    readings: int = 0  # of marks that were proposed, beyond those of the board
    checks: int = 0  # numbers that were measured directly


def judge_board(scenario: Scenario, index: int, *, seed: int) -> JudgedBoard:
    """Board number `index` of a scenario."""
    plan = scenario.plan
    hidden = scenario.hide(index, plan)
    # Each scenario draws by itself, or one odd board would show in all of them.
    number = SEEDS * seed + crc32(scenario.name.encode()) + index
    board = cut(
        hidden,
        plan,
        seed=number,
        noise=scenario.noise,
        tape_sigma=scenario.stated,
        settings=scenario.settings,
    )
    slipped: tuple[str, ...] = ()
    kind = scenario.slips[index % len(scenario.slips)] if scenario.slips else None
    if kind:
        board, slipped = slip(board, kind, np.random.default_rng(number + 17))
    owner = BoardOwner(np.random.default_rng(number + 29), scenario.noise)
    loop = followed(board, scenario.settings, owner, rounds=scenario.rounds)
    board, diagnosis = loop.board, loop.diagnosis
    alike = frozenset[str]().union(
        *(look_alikes(*cause, plan, scenario.noise) for cause in hidden.causes[:MOST_ALIKE])
    )
    cure = None
    if scenario.cured:
        inputs, sigma = loop.inputs(scenario.settings), diagnosis.noise.sigma
        cure = cure_of(board.machine, inputs, diagnosis.to_add, sigma=sigma)
    small = kind is not None and kind.millimetres < LARGE_SLIP
    outcome = outcome_of(diagnosis, board, alike=alike, slipped=slipped, small_slip=small)
    return JudgedBoard(outcome, cure, loop.readings, len(loop.checked))


# The owner of a board of the bench: measures more of the same machine, as it is proposed.

Array = np.ndarray


@dataclass(frozen=True)
class BoardOwner:
    """Somebody with a machine of the bench, its sheet and a tape."""

    source: np.random.Generator
    noise: float  # [mm] of a coordinate

    def with_marks(self, board: BoardCut, visits: Visits) -> BoardCut:
        """Return the board with the marks of these visits as well, on the same sheet.

        Raises ValueError where the sled cannot hang.
        """
        where = np.zeros((len(visits), 2))
        for swapped in (False, True):
            mine = visits.swapped == swapped
            where[mine] = replace(board.machine, swapped=swapped).read(
                visits.chains[mine],
                approaches=visits.approaches[mine],
                weights=visits.sled_weights[mine],
            )
        if not np.isfinite(where).all():
            raise ValueError("the sled cannot hang where it is sent")
        where = where + self.noise * self.source.standard_normal(where.shape)
        marks = tuple(visits.marks(where))
        measurements = board.measurements
        return replace(
            board, measurements=replace(measurements, marks=(*measurements.marks, *marks))
        )

    def checked(self, board: BoardCut, checks: Sequence[Check]) -> list[Checked]:
        """Return what direct measurements find, each with its error."""
        return [
            Checked(
                check.name,
                true_value(board, check.name) + check.sigma * float(self.source.standard_normal()),
                check.sigma,
            )
            for check in checks
        ]


def true_value(board: BoardCut, name: str) -> float:
    """Return what a perfect measurement of a number of the frame or of an effect would find."""
    if "." in name:
        return float(board.machine.hidden.parameters.get(name, CHAIN.get(name, 0.0)))
    return float(getattr(board.machine, name, getattr(MAKER, name, 0.0)))


# What a diagnosis is worth at the sled: the shape error over the whole sheet before and after.

COLUMNS, ROWS = 15, 9  # places of the sheet at which the sled is asked for
MARGIN = 50.0  # [mm] of the sheet's edge that is left out


@dataclass(frozen=True)
class Cure:
    """RMS shape errors [mm] of the judge's sled over the whole sheet."""

    before: float  # by the maker's settings
    frame: float  # by a fit of the frame alone
    after: float  # by a fit with what was named
    known: float  # by a fit with what was hidden


def sheet() -> np.ndarray:
    """Return places (n, 2) [mm] all over the sheet."""
    across = np.linspace(-HALF[0] + MARGIN, HALF[0] - MARGIN, COLUMNS)
    up = np.linspace(-HALF[1] + MARGIN, HALF[1] - MARGIN, ROWS)
    return np.array([(x, y) for y in up for x in across])


def shape_error(machine: TrueMachine, settings: MachineSettings) -> float:
    """RMS [mm] of how far the judge's sled, sent by these settings to places all over the sheet,
    is from them once the sheet is laid at its best. Nothing rubs: no setting knows of friction."""
    wanted = sheet()
    chains, outcome = lengths(settings, wanted)
    if not (outcome == FOUND).all():
        return float("inf")
    pose = best_pose(wanted, machine.sleds(chains))
    return rms(pose.errors) if pose else 0.0


def refitted(inputs: Inputs, effects: Sequence[str], sigma: float) -> MachineSettings:
    """Return the settings with the frame and these effects fitted, as `plumb add` does it."""
    model, rows = inputs.model_and_observations()
    return fit(model, rows, effects=effects, sigma=sigma, checked=inputs.checked).settings


def cure_of(machine: TrueMachine, inputs: Inputs, effects: Sequence[str], *, sigma: float) -> Cure:
    """Return what naming these effects is worth on a board; sigma [mm] as the diagnosis took it."""
    truth = machine.hidden.effects
    fits = {
        named: shape_error(machine, refitted(inputs, named, sigma))
        for named in {(), tuple(effects), truth}
    }
    before = shape_error(machine, inputs.settings)
    return Cure(before, fits[()], fits[tuple(effects)], fits[truth])


# The loop: what `plumb next` proposes is measured on the same board, round after round.


@dataclass(frozen=True)
class Followed:
    """A board with all that was measured of it, and what the lab then says."""

    board: BoardCut
    diagnosis: Diagnosis
    checked: tuple[Checked, ...] = ()
    done: tuple[str, ...] = ()  # titles of the proposals that were carried out
    readings: int = 0  # of marks, beyond those of the first board

    def inputs(self, settings: MachineSettings) -> Inputs:
        """Return what the lab knows of a machine with these settings."""
        return Inputs(settings, self.board.measurements, checked=self.checked)


def followed(
    board: BoardCut, settings: MachineSettings, owner: BoardOwner, *, rounds: int
) -> Followed:
    """Return the board after some rounds, in each of which the best proposal is carried out."""
    loop = Followed(board, diagnose(Inputs(settings, board.measurements)))
    for _ in range(rounds):
        for proposal in propose(loop.diagnosis, loop.inputs(settings)).proposals:
            more = _carried_out(loop, proposal, owner)
            if more:
                loop = replace(more, diagnosis=diagnose(more.inputs(settings)))
                break
    return loop


def _carried_out(loop: Followed, proposal: Proposal, owner: BoardOwner) -> Followed | None:
    """Return the board with a proposal measured, not yet diagnosed; None for what was done before,
    and for what this owner's sled cannot reach.
    """
    option = proposal.option
    if option.title in loop.done or not (len(option.visits) or option.checks):
        return None
    try:
        board = owner.with_marks(loop.board, option.visits)
    except ValueError:
        return None
    return replace(
        loop,
        board=board,
        checked=(*loop.checked, *owner.checked(board, option.checks)),
        done=(*loop.done, option.title),
        readings=loop.readings + len(option.visits),
    )
