"""One board of a kind: made, diagnosed, cured, and held against what is hidden in it."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from zlib import crc32

import numpy as np

from plumb.bench.boards import BoardCut, TrueMachine
from plumb.bench.causes import CHAIN, HALF, MAKER
from plumb.bench.hiding import SMALLEST
from plumb.bench.kinds import KINDS, board_of
from plumb.bench.shown import Truth, truth_of
from plumb.cure.decision import decide
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

NAMED = ("one_suspect", "cannot_tell")
WORSE = 0.05  # [mm] by which the error must grow to be called worse


@dataclass(frozen=True)
class JudgedBoard:
    """A board, what was said of it, and what the sled is worth with what was written."""

    kind: str
    index: int
    effects: tuple[str, ...]  # hidden
    verdict: str
    said: tuple[str, ...]  # effects named in the first explanation
    outliers: tuple[str, ...]  # readings set aside
    named: bool  # an effect is named
    exact: bool  # named is all that the marks can show, and nothing that is not there
    holds: bool  # the best explanation has all that the marks can show
    needless: int  # effects named that are not there
    unknown: bool  # it is said that the machine does what the library does not know
    readings: bool  # the readings set aside are those that are wrong
    # RMS [mm] of the shape of the sled's errors all over the sheet:
    before: float  # by the settings as they were
    after: float  # by those that `plumb add --effect auto` leaves
    fitted: float  # by a fit of what is there
    worse: bool
    cpu: float  # [s] of diagnosing and adding


def judge_board(kind: str, index: int, *, marks: int, seed: int, rounds: int = 0) -> JudgedBoard:
    """Return what comes of board number `index` of a kind, after some rounds of `plumb next`."""
    hidden = board_of(KINDS[kind], index, marks=marks, seed=seed)
    settings, truth = hidden.kind.settings, truth_of(hidden)
    source = np.random.default_rng([seed, crc32(kind.encode()), index, OWNER])
    start = time.process_time()
    owner = BoardOwner(source, hidden.kind.noise)
    loop = followed(hidden.board, settings, owner, rounds=rounds)
    diagnosis, inputs = loop.diagnosis, loop.inputs(settings)
    addition = decide(inputs, diagnosis=diagnosis).addition
    cpu = time.process_time() - start
    best = set(diagnosis.explanations[0].effects) if diagnosis.explanations else set[str]()
    said = best if diagnosis.verdict in NAMED or diagnosis.is_finding else set[str]()
    outliers = tuple(outlier.name for outlier in diagnosis.outliers)
    machine = loop.board.machine
    before = shape_error(machine, settings)
    after = shape_error(machine, addition.settings) if addition else before
    return JudgedBoard(
        kind=kind,
        index=index,
        effects=truth.effects,
        verdict=diagnosis.verdict,
        said=tuple(sorted(said)),
        outliers=outliers,
        named=bool(said),
        exact=truth.is_held_by(said) and said <= truth.allowed,
        holds=truth.is_held_by(best),
        needless=len(said - truth.allowed),
        unknown=diagnosis.verdict == "not_in_library",
        readings=set(outliers) == set(hidden.slipped),
        before=before,
        after=after,
        fitted=shape_error(machine, _with_what_is_there(inputs, diagnosis, truth)),
        worse=after > before + WORSE,
        cpu=cpu,
    )


def _with_what_is_there(inputs: Inputs, diagnosis: Diagnosis, truth: Truth) -> MachineSettings:
    """Return the settings with the frame and all that is there fitted, as `plumb add` does it."""
    usual = (name for name in truth.usual if name != SMALLEST)
    there = tuple(dict.fromkeys([*usual, *truth.effects]))
    model, rows = inputs.model_and_observations()
    sigma, checked = diagnosis.noise.sigma, inputs.checked
    return fit(model, rows, effects=there, sigma=sigma, checked=checked).settings


# The owner of a board of the bench: measures more of the same machine, as it is proposed.

OWNER = 29  # of seeds


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


# What settings are worth at the sled: the shape of its errors over the whole sheet.

COLUMNS, ROWS = 15, 9  # places of the sheet at which the sled is asked for
MARGIN = 50.0  # [mm] of the sheet's edge that is left out


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
