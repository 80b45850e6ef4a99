"""The expected error of a job with the fitted settings: what the marks leave open, place by place.

Two things are counted: how well the marks and the priors settle the numbers of the explanation
that is used, and how far its rivals would lead elsewhere, each by its share. What no explanation
has is not counted, nor where the sheet lies: that is no error among the holes of a job.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from plumb.diagnosis.explanation import Explanation
from plumb.fit.compare import best_pose, chain_errors, hung_places, places_over
from plumb.fit.observations import Observations, Sighting, sighted, visited
from plumb.model.plain import ranked
from plumb.model.predict import FOUND, NAMES, Array, lengths, settings_of
from plumb.settings import MachineSettings
from plumb.text.answers import Internal, in_json
from plumb.text.values import Unit

# Errors that an explanation draws, mark by mark.
#
# An explanation refits the frame, so it changes what the frame alone leaves. That change is what
# the marks can show of it.


@dataclass(frozen=True)
class Drawn:
    """Chain that an explanation adds to the frame's fit."""

    moved: Array  # (k, 2) [mm] of the marks on the sheet
    chains: Array  # (k, 2) [mm] at the marks, left and right


def drawn_by(frame: Explanation, explanation: Explanation, rows: Observations) -> Drawn:
    """Return what an explanation adds to the frame's fit at the marks of `rows`."""
    model = model_by(frame)
    moved = _moved(frame, explanation, rows)
    chains = chain_errors(model, hung_places(model, rows), moved, rows.sled_weights)
    return Drawn(moved[rows.mark_rows], chains[rows.mark_rows])


def _moved(frame: Explanation, explanation: Explanation, rows: Observations) -> Array:
    """Return the same on the sheet (r, 2) [mm]."""
    return np.asarray(seen_by(explanation, rows).read.where - seen_by(frame, rows).read.where)


def model_by(explanation: Explanation) -> MachineSettings:
    """Return the machine as an explanation has it."""
    problem = explanation.board.problem
    values, _ = problem.values(explanation.unknowns)
    return settings_of(values, like=problem.settings)


def seen_by(explanation: Explanation, rows: Observations) -> Sighting:
    """Return what an explanation says is measured on each visit."""
    problem = explanation.board.problem
    values, outside = problem.values(explanation.unknowns)
    return sighted(
        values,
        outside,
        rows,
        over_top=problem.settings.feed == "top",
        usual_weight=problem.settings.sled_weight,
        names=(),
    )


# The error that a job may expect.


def expected_error(used: Explanation, rivals: Sequence[tuple[Explanation, float]] = ()) -> float:
    """Return the error [mm RMS] to expect over the sheet, laid at its best, of a machine set as
    `used` says; rivals with their shares of what is likely, the rest being the share of `used`.
    """
    problem, free = used.board.problem, used.free
    # The sheet's rotation, the tape and the like do not move the sled.
    machine = [i for i, column in enumerate(free) if problem.names[column] in NAMES]
    moved = _among_each_other(used, [int(free[i]) for i in machine])
    inside = used.covariance[np.ix_(machine, machine)]
    square = float(np.einsum("rij,jk,rik->", moved, inside, moved)) / len(moved)
    for (_, share), apart in zip(rivals, _apart(used, [each for each, _ in rivals]), strict=True):
        square += share * float(np.nanmean(apart)) if np.isfinite(apart).any() else 0.0
    return float(np.sqrt(square))


def _apart(used: Explanation, rivals: Sequence[Explanation]) -> Iterator[Array]:
    """Yield for each rival how far it would cut from there, squared (n,) [mm^2], the sheet laid at
    its best; nan where one of them does not reach.
    """
    places = places_over(model_by(used).sheet)
    chains, outcome = lengths(model_by(used), places)
    where, _, hanging = hung(used, chains)
    for rival in rivals:
        elsewhere, _, reached = hung(rival, chains)
        good = (outcome == FOUND) & (hanging == FOUND) & (reached == FOUND)
        pose = best_pose(where[good], elsewhere[good])
        apart = np.full(len(places), np.nan)
        if pose:
            apart[good] = np.sum(pose.errors**2, axis=1)
        yield apart


def hung(explanation: Explanation, chains: Array) -> tuple[Array, Array, Array]:
    """Return where the sled hangs (n, 2) [mm] with these chains, slopes by NAMES (n, 2, v), and
    FOUND.
    """
    problem = explanation.board.problem
    values, _ = problem.values(explanation.unknowns)
    usual = problem.settings.sled_weight
    return visited(
        values, _visits(chains, usual), over_top=problem.settings.feed == "top", usual_weight=usual
    )


def _visits(chains: Array, weight: float) -> Observations:
    """Visits (n,) with these chains and the usual sled, of which nothing is read."""
    count = len(chains)
    first = np.zeros(count, dtype=int)
    return Observations(
        chains=chains,
        sled_weights=np.full(count, weight),
        approaches=np.zeros((count, 2)),
        rounds=first,
        zero_groups=first,
        sheet_groups=first,
    )


# How far rivals would cut elsewhere, and where.

SIDE_WORDS = {
    (0, 0): "the upper left corner",
    (0, 1): "the middle of the upper edge",
    (0, 2): "the upper right corner",
    (1, 0): "the left edge",
    (1, 1): "the middle",
    (1, 2): "the right edge",
    (2, 0): "the lower left corner",
    (2, 1): "the middle of the lower edge",
    (2, 2): "the lower right corner",
}
BOTH_WORDS = {0: "the upper corners", 1: "the left and right edges", 2: "the lower corners"}
ALIKE = 0.7  # share of the larger of two sides from which on both are named


@dataclass(frozen=True)
class RivalError:
    """Where the settings of rivals differ most, the sheet laid at its best for each."""

    mm: float  # RMS over that part of the sheet
    where: str  # for people
    unit: Internal[Unit]

    @in_json
    def sentence(self) -> str:
        """By how much and where, for people."""
        apart = self.unit.worded(self.mm, 1)
        return f"On the sheet the likely causes differ by {apart} in {self.where}."


def rival_error(explanations: Sequence[Explanation], noise: float) -> RivalError | None:
    """Return where the likeliest explanation and its rivals would cut farthest apart; None if that
    is less than the noise [mm] everywhere.
    """
    used, *rivals = explanations
    apart = np.stack([*_apart(used, rivals)])
    squares = np.where(np.isfinite(apart), apart, 0.0).max(axis=0)
    places = places_over(model_by(used).sheet)
    width, height = model_by(used).sheet
    column = np.clip(np.floor(places[:, 0] / width * 3 + 1.5), 0, 2)
    row = np.clip(np.floor(1.5 - places[:, 1] / height * 3), 0, 2)
    rms = {
        (r, c): float(np.sqrt(np.mean(squares[(row == r) & (column == c)]))) for r, c in SIDE_WORDS
    }
    worst = ranked(rms, lambda cell: -rms[cell])[0]
    if rms[worst] <= noise:
        return None
    mirrored = rms[worst[0], 2 - worst[1]]
    both = worst[1] != 1 and mirrored > ALIKE * rms[worst]
    return RivalError(
        rms[worst], BOTH_WORDS[worst[0]] if both else SIDE_WORDS[worst], used.board.unit
    )


# How much of a machine's errors the marks leave open, all over its sheet.
#
# Before anything is measured, each number of the frame is wrong by its stated error, and each
# effect that the library knows may be there in its typical size, all independent of each other.
# Marks close a part of that, provable or not: a row of marks closes little, however well its few
# errors are fitted. Where the sheet lies is left out, for that is no error among the holes of a
# job.

MOST_OPEN = 0.3  # share: marks on both edges of the sheet leave less, a row of marks leaves more


@dataclass(frozen=True)
class LeftOpen:
    """Errors to expect, RMS over the sheet when it is laid at its best [mm]."""

    before: float  # anything was measured
    now: float
    unit: Unit

    @property
    def is_too_much(self) -> bool:
        """Whether settings by these marks would be a guess over most of the sheet."""
        return self.now > MOST_OPEN * self.before

    @property
    def sentence(self) -> str:
        """A sentence that the marks do not cover the sheet; empty where they do."""
        if not self.is_too_much:
            return ""
        return (
            "These marks do not reach over the sheet: of the "
            f"{self.unit.worded(self.before, 1)} by which holes may be off among each other before "
            "anything is measured, they leave "
            f"{self.unit.worded(self.now, 1)} open. What a fit promises holds near the marks only; "
            "measure marks all over the sheet"
        )


def left_open(explanation: Explanation) -> LeftOpen:
    """Return what the marks of an explanation leave open, by its slopes."""
    board = explanation.board
    machine = [i for i, name in enumerate(board.problem.names) if name in NAMES]
    moved = _among_each_other(explanation, machine)
    measured, known = np.split(explanation.slopes, [board.rows.count])
    typical = np.ones(len(board.problem.names))
    typical[board.frame] = 0.0  # its priors are among what is known
    before = known.T @ known + np.diag(typical)

    def error(precision: Array) -> float:
        covariance = np.linalg.inv(precision)[np.ix_(machine, machine)]
        variance = np.einsum("rij,jk,rik->", moved, covariance, moved)
        return float(np.sqrt(variance / len(moved)))

    return LeftOpen(error(before), error(before + measured.T @ measured), board.unit)


def _among_each_other(explanation: Explanation, columns: list[int]) -> Array:
    """Return how places (n, 2, u) [mm] move by these unknowns, the sheet shifted and turned
    back.
    """
    problem = explanation.board.problem
    targets = places_over(model_by(explanation).sheet)
    chains, outcome = lengths(model_by(explanation), targets)
    where, slopes, hanging = hung(explanation, chains)
    good = (outcome == FOUND) & (hanging == FOUND)
    where, slopes = where[good], slopes[good]
    by_name = slopes[:, :, [NAMES.index(problem.names[i]) for i in columns]]
    moved = (by_name * problem.scale[columns]).reshape(-1, len(columns))
    turned = np.stack([-where[:, 1], where[:, 0]], axis=1).reshape(-1, 1)
    shifted = np.tile(np.eye(2), (len(where), 1))
    pose, _ = np.linalg.qr(np.hstack([shifted, turned]))
    apart: Array = (moved - pose @ (pose.T @ moved)).reshape(len(where), 2, len(columns))
    return apart
