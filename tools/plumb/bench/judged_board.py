"""One board: made, diagnosed, cured, and compared with what is hidden in it."""

import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from plumb.bench.causes import HALF
from plumb.bench.hiding import SMALLEST
from plumb.bench.kinds import Kind, board_of
from plumb.bench.shown import Truth, truth_of
from plumb.cure.decision import decide
from plumb.diagnosis import Diagnosis, diagnose
from plumb.fit.compare import best_pose
from plumb.fit.fit import fit
from plumb.fit.inputs import Inputs
from plumb.fit.observations import rms
from plumb.model.predict import FOUND, Array, lengths
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
    promised: float | None  # that the sled errs then [mm]; None: nothing is promised
    cpu: float  # [s] of diagnosing and adding


def judge_board(kind: Kind, index: int, *, marks: int, seed: int) -> JudgedBoard:
    """Return the result of board number `index` of one kind."""
    hidden = board_of(kind, index, marks=marks, seed=seed)
    settings, truth = hidden.kind.settings, truth_of(hidden)
    inputs = Inputs(settings, hidden.board.measurements)
    start = time.process_time()
    diagnosis = diagnose(inputs)
    decision = decide(inputs, diagnosis=diagnosis)
    cpu = time.process_time() - start
    best = set(diagnosis.explanations[0].effects) if diagnosis.explanations else set[str]()
    said = best if diagnosis.verdict in NAMED or diagnosis.is_finding else set[str]()
    outliers = tuple(outlier.name for outlier in diagnosis.outliers)
    sleds = hidden.board.machine.sleds
    before = shape_error(settings, sleds)
    addition = decision.addition
    after = shape_error(addition.settings, sleds) if addition else before
    return JudgedBoard(
        kind=kind.name,
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
        fitted=shape_error(_with_what_is_there(inputs, diagnosis, truth), sleds),
        worse=after > before + WORSE,
        promised=decision.expected_mm,
        cpu=cpu,
    )


def _with_what_is_there(inputs: Inputs, diagnosis: Diagnosis, truth: Truth) -> MachineSettings:
    """Return the settings with the frame and all that is there fitted, as `plumb add` does it."""
    usual = (name for name in truth.usual if name != SMALLEST)
    there = tuple(dict.fromkeys([*usual, *truth.effects]))
    model, rows = inputs.model_and_observations()
    return fit(model, rows, effects=there, sigma=diagnosis.noise.sigma).settings


# What settings are worth at the sled: the shape of its errors over the whole sheet.

COLUMNS, ROWS = 15, 9  # places of the sheet at which the sled is asked for
MARGIN = 50.0  # [mm] of the sheet's edge that is left out


def sheet() -> np.ndarray:
    """Return places (n, 2) [mm] all over the sheet."""
    across = np.linspace(-HALF[0] + MARGIN, HALF[0] - MARGIN, COLUMNS)
    up = np.linspace(-HALF[1] + MARGIN, HALF[1] - MARGIN, ROWS)
    return np.array([(x, y) for y in up for x in across])


def shape_error(settings: MachineSettings, landed: Callable[[Array], Array]) -> float:
    """RMS [mm] of how far the judge's sled, sent by these settings to places all over the sheet,
    is from them once the sheet is laid at its best; `landed` says where it is by its chains.
    Nothing rubs: no setting knows of friction."""
    chains, outcome = lengths(settings, sheet())
    return shape_of(landed(chains)) if (outcome == FOUND).all() else float("inf")


def shape_of(places: Array) -> float:
    """RMS [mm] of how far places (n, 2) [mm] are from those of `sheet`, laid at its best."""
    pose = best_pose(sheet(), places)
    return rms(pose.errors) if pose else 0.0
