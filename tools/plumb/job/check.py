"""Everything about a program before it is cut, in one value."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal

import numpy as np
import scipy

from plumb.diagnosis.explanation import measured_board
from plumb.diagnosis.priors import largest_met
from plumb.diagnosis.readings import clean_readings
from plumb.fit.fit import Problem
from plumb.fit.inputs import Inputs
from plumb.job.dry_run import (
    STEP,
    Done,
    Finding,
    Hanging,
    Moves,
    Rows,
    Run,
    Slower,
    Times,
    ends_too_high,
    findings_of,
    hanging_along,
    meant_otherwise,
    slower_moves,
    times_of,
)
from plumb.job.wood import Piece, Tools, spoiled, take
from plumb.model.predict import FOUND, NAMES, Array, lengths, places_with_slopes
from plumb.settings import MachineSettings
from plumb.text.answers import Internal

Fitness = Literal["clean", "doubtful", "wrong"]
SENT, PARTED, TAKEN = 0.45, 0.6, 0.85  # shares of the time after which a long program is so far


@dataclass(frozen=True)
class CheckedJob:
    """A program, run dry."""

    done: Done
    findings: tuple[Finding, ...]
    hanging: Hanging | None  # None where nothing is cut
    slower: tuple[Slower, ...]
    times: Times
    parts: tuple[Part, ...]
    piece: Piece | None  # None where nothing is cut
    has_errors: bool  # whether marks say which errors to expect of each part

    @cached_property
    def over_sheet(self) -> Moves:
        """The moves of the sled, without those of a single chain."""
        return self.done.moves.only(self.done.moves.over_sheet)

    @property
    def state(self) -> Fitness:
        """Whether something spoils a part or stops the machine, or deserves a look."""
        spoiled = any(finding.is_wrong for finding in self.findings)
        if spoiled or (self.hanging and self.hanging.bad):
            return "wrong"
        return "doubtful" if any(finding.is_doubt for finding in self.findings) else "clean"

    @property
    def is_good(self) -> bool:
        """Whether nothing spoils a part or stops the machine."""
        return self.state != "wrong"


def check_job(
    settings: MachineSettings,
    lines: Sequence[str],
    *,
    inputs: Inputs | None = None,
    numbers: Mapping[int, float] | None = None,
    tools: Tools | None = None,
    start: tuple[float, float, float] = (0.0, 0.0, 0.0),
    progress: Callable[[float], None] | None = None,
) -> CheckedJob:
    """Run a program dry; `inputs` are marks that tell which errors to expect, `tools` what cuts if
    it is not what the program says.
    """
    far = progress or (lambda share: None)
    run = Run(settings, start=start, numbers=numbers)
    run.send(lines, progress=lambda share: far(SENT * share))
    done = run.finish()
    over_sheet = done.moves.only(done.moves.over_sheet)
    parts = parts_of(over_sheet)
    tools = tools or Tools.of(lines)
    far(PARTED)
    taken = take(over_sheet, tools)
    far(TAKEN)
    findings = [*findings_of(done), *spoiled(over_sheet, taken, tools, lines)]
    findings += [*ends_too_high(settings, done), *meant_otherwise(done, lines)]
    if inputs:
        believed = Believed.of(inputs)
        parts = tuple(with_errors(believed, settings, part) for part in parts)
    hanging = hanging_along(settings, over_sheet)
    far(1.0)
    return CheckedJob(
        done=done,
        findings=tuple(sorted(findings, key=lambda finding: finding.line)),
        hanging=hanging,
        slower=slower_moves(over_sheet),
        times=times_of(done),
        parts=parts,
        piece=taken.piece,
        has_errors=inputs is not None,
    )


# The error to expect of each part, from measured marks: how much too wide, high or askew.
#
# The machine is taken as the marks leave it: the frame within its priors, and every effect of the
# library at a size that real machines have. So the spread holds what the fit leaves open and what
# could still hide. A part is compared with the program by the straight map that takes one to the
# other; its shift and its turn say where it lies, not how it fits.

SPREAD = 0.3  # of an effect's size, as a share of the largest that was met
NARROW = 20.0  # [mm] below this a part is too small for its errors to be seen
MOST = 400  # places of a part that are asked for, at least, where it has so many
TWO_SIDED = 1.96  # sigmas of 95 %


@dataclass(frozen=True)
class Error:
    """An error of a part, and how far it may be off [mm]."""

    mm: float
    within: float  # 95 %


@dataclass(frozen=True)
class Believed:
    """The machine as the marks leave it: a normal about a linearized problem."""

    problem: Problem
    about: Array  # (u,) unknowns of the linearization
    mean: Array  # (u,) to add to them
    root: Array  # (u, u) root @ root.T is the covariance

    @staticmethod
    def of(inputs: Inputs) -> Believed:
        """Refit the frame, then let every effect act within what real machines have."""
        board = measured_board(inputs)
        frame = clean_readings(board, inputs).frame
        board = frame.board
        held = np.asarray(board.problem.held, dtype=bool)
        kept = np.ones(len(frame.residual), dtype=bool)
        count = board.rows.count
        kept[count : count + int(held.sum())] = False
        effects = np.flatnonzero(~held)
        precision = np.ones(len(held))
        precision[effects] = 1 / (SPREAD * largest_met(board, effects)) ** 2
        slopes = frame.slopes[kept]
        information = slopes.T @ slopes + np.diag(precision)
        pull = slopes.T @ frame.residual[kept] - precision * frame.unknowns
        lower = scipy.linalg.cholesky(information, lower=True)
        mean = scipy.linalg.cho_solve((lower, True), pull)
        root = scipy.linalg.solve_triangular(lower.T, np.eye(len(held)))
        return Believed(board.problem, frame.unknowns, mean, root)

    def seen(self, settings: MachineSettings, places: Array) -> tuple[Array, Array]:
        """Errors (n, 2) [mm] of places that a machine with these settings is sent to, and how they
        change with the unknowns (n, 2, u)."""
        chains, outcome = lengths(settings.as_plumb_model(), places)
        values, _ = self.problem.values(self.about)
        over_top = self.problem.settings.feed == "top"
        where, by_value, reached = places_with_slopes(values, over_top=over_top, chains=chains)
        by_name = np.zeros((*where.shape, len(self.problem.names)))
        for column, name in enumerate(self.problem.names):
            if name in NAMES:
                by_name[:, :, column] = by_value[:, :, NAMES.index(name)]
        by_name *= self.problem.scale
        hangs = (outcome == FOUND) & (reached == FOUND)
        errors = where - places + by_name @ self.mean
        return errors[hangs], by_name[hangs]


def with_errors(believed: Believed, settings: MachineSettings, part: Part) -> Part:
    places, (width, height) = part.places, part.size
    errors, slopes = believed.seen(settings, places)
    if len(errors) < len(places) or max(width, height) < NARROW:
        return part
    # error = shift + matrix @ (place - middle), by least squares: a row for each number of it.
    middle = places - places.mean(axis=0)
    fit = np.linalg.pinv(np.column_stack([np.ones(len(places)), middle]))
    stretch = np.einsum("jn,nk->jk", fit[1:], errors)  # [by place, of error]
    by_unknown = np.einsum("jn,nku->jku", fit[1:], slopes) @ believed.root
    wide, high = width >= NARROW, height >= NARROW
    return replace(
        part,
        width_error=_error(width * stretch[0, 0], width * by_unknown[0, 0]) if wide else None,
        height_error=_error(height * stretch[1, 1], height * by_unknown[1, 1]) if high else None,
        skew=_error(
            height * (stretch[0, 1] + stretch[1, 0]), height * (by_unknown[0, 1] + by_unknown[1, 0])
        )
        if wide and high
        else None,
    )


def _error(mm: float, spread: Array) -> Error:
    return Error(float(mm), TWO_SIDED * float(np.linalg.norm(spread)))


# The parts of a job: what is cut in one neighbourhood.

CELL = 10.0  # [mm] cuts in the same cell or in neighbours belong to one part
ALL_EIGHT = np.ones((3, 3))


@dataclass(frozen=True)
class Part:
    """Cuts that lie together."""

    first_line: int
    last_line: int
    low: tuple[float, float]  # [mm] lower left corner
    high: tuple[float, float]  # [mm] upper right corner
    deepest: float  # [mm] z
    places: Internal[Array]  # (k, 2) [mm] some of its cuts, evenly
    # How it will differ from its program; None without marks, and where it is too narrow
    width_error: Error | None = None  # positive: too wide
    height_error: Error | None = None
    skew: Error | None = None  # how far the top lies too far to the right of the bottom

    @property
    def size(self) -> tuple[float, float]:
        """Width and height [mm], by the middle of the bit."""
        return self.high[0] - self.low[0], self.high[1] - self.low[1]


def parts_of(moves: Moves) -> tuple[Part, ...]:
    """Return the parts of a job, of moves over the sheet, in the order in which they are begun."""
    extents = [(places.min(axis=0), places.max(axis=0)) for places, _, _ in _cuts(moves)]
    if not extents:
        return ()
    low, high = np.min(extents, axis=(0, 1)), np.max(extents, axis=(0, 1))

    def cells(places: Array) -> tuple[Rows, ...]:
        return tuple(np.floor((places - low) / CELL).astype(int).T)

    grid = np.zeros(np.floor((high - low) / CELL).astype(int) + 1, dtype=bool)
    for places, _, _ in _cuts(moves):
        grid[cells(places)] = True
    numbers, count = scipy.ndimage.label(grid, structure=ALL_EIGHT)

    def part_of(places: Array) -> Rows:
        return np.asarray(numbers[cells(places)], dtype=np.intp)

    sizes = np.zeros(count + 1, dtype=int)
    lines = np.tile([np.inf, -np.inf], (count + 1, 1))  # the first and the last of each part
    corners = np.tile([[[np.inf] * 2], [[-np.inf] * 2]], (1, count + 1, 1))
    deepest = np.full(count + 1, np.inf)
    for places, z, line in _cuts(moves):
        part = part_of(places)
        sizes += np.bincount(part, minlength=count + 1)
        np.minimum.at(lines[:, 0], part, line)
        np.maximum.at(lines[:, 1], part, line)
        np.minimum.at(corners[0], part, places)
        np.maximum.at(corners[1], part, places)
        np.minimum.at(deepest, part, z)
    kept = _thinned(moves, part_of, sizes)
    parts = [
        Part(
            first_line=int(lines[each, 0]),
            last_line=int(lines[each, 1]),
            low=_pair(corners[0, each]),
            high=_pair(corners[1, each]),
            deepest=float(deepest[each]),
            places=np.concatenate(kept[each]),
        )
        for each in range(1, count + 1)
    ]
    return tuple(sorted(parts, key=lambda part: (part.first_line, part.last_line)))


def _cuts(moves: Moves) -> Iterator[tuple[Array, Array, Array]]:
    """Yield the places (k, 2), z and line of all cuts, piece by piece."""
    for _, block in moves.blocks():
        samples = block.sampled(STEP)
        cut = block.cut[samples.move]
        if cut.any():
            yield samples.places[cut], samples.z[cut], block["line"][samples.move[cut]]


def _thinned(
    moves: Moves, part_of: Callable[[Array], Rows], sizes: Rows
) -> Mapping[int, Sequence[Array]]:
    """Return some places of each part, every so many, so that MOST stay of many."""
    every, seen = np.maximum(sizes // MOST, 1), np.zeros(len(sizes), dtype=int)
    kept: dict[int, list[Array]] = {each: [] for each in range(len(sizes))}
    for places, _, _ in _cuts(moves):
        part = part_of(places)
        order = np.argsort(part, kind="stable")
        for mine in np.split(order, np.flatnonzero(np.diff(part[order])) + 1):
            each = int(part[mine[0]])
            kept[each].append(places[mine[-seen[each] % every[each] :: every[each]]])
            seen[each] += len(mine)
    return kept


def _pair(place: Array) -> tuple[float, float]:
    return float(place[0]), float(place[1])
