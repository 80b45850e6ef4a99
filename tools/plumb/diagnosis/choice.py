"""What to write: the machine that is expected to leave the least error on the sheet.

Candidates are the machines by the likeliest accounts, by the frame alone, and by the effects that
predict best the marks that a fit did not see; and the settings as they are. Each account is a
truth that may hold, as likely as the posterior says, with a smooth field that nobody draws and
without: so what a candidate leaves is expected over all of them, whichever it was fitted to. Only
errors among the holes of a job count: where the sheet lies does not.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
import scipy

from plumb.diagnosis.expected_error import moved_on_sheet
from plumb.diagnosis.explanation import (
    Explanation,
    free_columns,
    gaussian_process_columns,
    span,
)
from plumb.diagnosis.linear import LEFT_OUT, Other
from plumb.diagnosis.posterior import Account, Listed, Posterior
from plumb.diagnosis.priors import TOGETHER, largest_met
from plumb.diagnosis.readings import CleanReadings
from plumb.fit.expected import plausible_range
from plumb.model.plain import ranked
from plumb.model.predict import NAMES

Array = np.ndarray
FEIGNED = 0.005  # chance below which noise alone never improves on settings that are right
SAME = 0.03  # share by which expected errors hardly differ: then the likelier is taken
UNWEIGHED = -1e9  # log weight of what the posterior did not weigh
WORTH = 0.85  # of the expected error of what is named: what is not named has to leave less
COUNTED = 0.01  # chance of a truth from which on it is counted
NOTHING = Account((), (), -np.inf, -np.inf)


@dataclass(frozen=True)
class Candidate:
    """A machine that may be written, and the error over the sheet [mm RMS] it is to leave."""

    account: Account
    expected: float


@dataclass(frozen=True)
class Choice:
    """Candidates, the best first, and the settings as they are."""

    candidates: tuple[Candidate, ...]
    as_set: float  # [mm RMS] that is expected over the sheet if nothing is changed
    is_good: bool  # whether noise alone may feign all that is wrong with the settings

    @property
    def best(self) -> Candidate:
        """What is expected to leave the least; of those that hardly differ in this the likeliest,
        and of those that are as likely the simplest.
        """
        return self.candidates[0]

    @property
    def is_better(self) -> bool:
        """Whether the settings are worth changing."""
        return not self.is_good and self.best.expected < self.as_set


def choose(
    readings: CleanReadings, listed: Sequence[Listed], *, unknown: bool, silent: bool
) -> Choice:
    """Weigh all candidates; `unknown`: also those that predict best what a fit did not see;
    `silent`: no cause is named.
    """
    posterior = readings.posterior
    accounts = {each.account.effects: each.account for each in listed}
    found = [predicting(readings, posterior.felt)] if unknown else []
    for effects in [(), *(one for several in found for one in several)]:
        accounts.setdefault(effects, _account_of(posterior, effects))
    fits = [readings.explained(account) for account in accounts.values()]
    possible = [
        (account, fit)
        for account, fit in zip(accounts.values(), fits, strict=True)
        if is_possible(fit) or not account.effects
    ]
    truths = [
        truth
        for each in listed
        for truth in _truths(readings, each, posterior.smooth)
        if truth.chance > COUNTED
    ]
    known = {each.account.effects for each in listed}
    weighed = ranked(
        [Candidate(account, _expected(truths, fit)) for account, fit in possible],
        # What the posterior does not name has to be worth it.
        lambda each: each.expected / (1 if each.account.effects in known else WORTH),
    )
    alike = [each for each in weighed if each.expected <= (1 + SAME) * weighed[0].expected]
    simplest = ranked(alike, lambda each: float(len(each.account.effects)))
    likeliest = ranked(simplest, lambda each: -max(each.account.weight, UNWEIGHED))
    best = [*likeliest, *weighed[len(alike) :]]
    return Choice(
        candidates=tuple(best),
        as_set=_expected(truths, None),
        is_good=silent and is_feigned(readings, [fit for _, fit in possible]),
    )


def _account_of(posterior: Posterior, effects: tuple[str, ...]) -> Account:
    known = (each for each in posterior.accounts if each.effects == effects)
    return next(known, Account(effects, effects, -np.inf, -np.inf))


def is_possible(fit: Explanation) -> bool:
    """Return whether a real machine may have all sizes of an explanation."""
    problem = fit.board.problem
    columns = fit.board.columns(fit.effects)
    values = problem.start[columns] + problem.scale[columns] * fit.unknowns[columns]
    spread = problem.scale[columns] * np.sqrt(np.diag(fit.covariance)[len(fit.board.frame) :])
    return fit.settled and all(
        plausible_range(problem.names[column]).is_near(value - each, value + each)
        for column, value, each in zip(columns, values, spread, strict=True)
    )


# What a machine leaves if an account is true.


@dataclass(frozen=True)
class Truth:
    """A machine that may be the real one: where its sled is off all over the sheet."""

    chance: float
    moved: Array  # (n, u) [mm] by unknowns of the machine, less the sheet's best place
    columns: Array  # (u,) of these unknowns
    off: Array  # (n,) [mm] of the sled, with the settings as they are
    variance: float  # [mm^2] of a place, as far as the marks leave it open

    def left_by(self, fit: Explanation | None) -> float:
        """Return the mean squared error [mm^2] of a machine, by the settings as they are or as
        they are fitted.
        """
        left = self.off if fit is None else self.off - self.moved @ fit.unknowns[self.columns]
        return float(2 * np.mean(left**2)) + self.variance


def _expected(truths: Sequence[Truth], fit: Explanation | None) -> float:
    """Return the RMS error [mm] of a machine, expected over all truths."""
    whole = sum(truth.chance for truth in truths)
    return float(np.sqrt(sum(each.chance * each.left_by(fit) for each in truths) / whole))


def _truths(readings: CleanReadings, listed: Listed, smooth: Other | None) -> list[Truth]:
    """Return the machine of an account, and the same with a field."""
    account, fit = listed.account, readings.explained(listed.account)
    with_field = listed.share * float(np.exp(account.field - account.weight))
    both = ((listed.share - with_field, None), (with_field, smooth))
    return [_truth(fit, chance, other) for chance, other in both if chance > COUNTED]


def _truth(fit: Explanation, chance: float, smooth: Other | None) -> Truth:
    """Return the machine of an account by its slopes, what is smooth besides as it is likeliest."""
    board, problem = fit.board, fit.board.problem
    columns = np.array([i for i, name in enumerate(problem.names) if name in NAMES])
    where, moved, apart = moved_on_sheet(fit, columns)
    free = fit.free
    rows, known = fit.slopes[:, free], np.zeros(len(free))
    of_effects = np.isin(free, board.columns(fit.effects))
    known[of_effects] = 1 / largest_met(board, free[of_effects])
    known[~np.isfinite(known)] = 0.0
    fields = np.zeros((board.rows.count + 2 * len(where), 0))
    if smooth is not None:
        least = LEFT_OUT * board.sigma**2 / smooth.spread**2
        fields = gaussian_process_columns(fit, smooth.width, least, where) * smooth.spread
    measured, elsewhere = np.split(fields, [board.rows.count])
    beyond = np.zeros((len(rows) - len(measured), fields.shape[1]))
    drawn = np.hstack([rows, np.vstack([measured / board.sigma, beyond])])
    ridge = np.r_[known, np.ones(fields.shape[1])]
    total = problem.start[free] / problem.scale[free] + fit.unknowns[free]
    pull = drawn.T @ fit.residual - np.r_[known**2 * total, np.zeros(fields.shape[1])]
    inverse = np.linalg.pinv(drawn.T @ drawn + np.diag(ridge**2), rcond=1e-12, hermitian=True)
    step = inverse @ pull
    unknowns = fit.unknowns.copy()
    unknowns[free] += step[: len(free)]
    on_sheet = np.zeros((len(moved), len(free)))
    shared = np.isin(free, columns)
    on_sheet[:, shared] = moved[:, np.searchsorted(columns, free[shared])]
    whole = np.hstack([on_sheet, apart(elsewhere)])
    return Truth(
        chance=chance,
        moved=moved,
        columns=columns,
        off=moved @ unknowns[columns] + whole[:, len(free) :] @ step[len(free) :],
        variance=float(2 * np.einsum("ij,jk,ik->", whole, inverse, whole) / len(whole)),
    )


# Whether noise alone may feign what is wrong with the settings.


def is_feigned(readings: CleanReadings, fits: Iterable[Explanation]) -> bool:
    """Return whether settings that are right would be improved as much by noise alone, whatever
    turn the sheet has.
    """
    frame = readings.frame
    posed = [i for i in frame.board.frame if frame.board.problem.names[i] not in NAMES]
    as_set = _as_set(frame, np.array(posed, dtype=int))
    return all(
        scipy.special.chdtrc(len(fit.free) - len(posed), max(as_set - _left(fit), 0.0)) > FEIGNED
        for fit in fits
    )


def _left(fit: Explanation) -> float:
    return float(np.sum(fit.residual[: fit.board.rows.count] ** 2))


def _as_set(frame: Explanation, posed: Array) -> float:
    """Return what the settings leave of the measured numbers, in squares of the noise."""
    count = frame.board.rows.count
    at = frame.board.problem.at(np.zeros(len(frame.unknowns)))
    if at is None:
        return np.inf
    left, slopes = at.residual[:count], at.slopes[:count, posed]
    step = np.linalg.lstsq(slopes, left, rcond=1e-10)[0]
    return float(np.sum((left - slopes @ step) ** 2))


# The effects that predict best the marks that a fit did not see.

BEAM = 5  # best sets of one size that are tried with another effect


def predicting(readings: CleanReadings, felt: Sequence[str]) -> list[tuple[str, ...]]:
    """Return of one effect, of two and of three those that predict best each reading that is left
    out of the fit, by slopes at the frame's fit; sizes that no machine has do not count.
    """
    at = readings.explained(NOTHING)
    best: list[tuple[str, ...]] = []
    sets: list[tuple[str, ...]] = [()]
    for _ in range(TOGETHER):
        larger = {
            tuple(name for name in felt if name in {*few, more}): None
            for few in sets
            for more in felt
            if more not in few
        }
        scored = [(left_out(at, few), few) for few in larger]
        sets = [few for _, few in ranked(scored, lambda each: each[0])[:BEAM]]
        best += sets[:2]
    return best


def left_out(at: Explanation, effects: Sequence[str]) -> float:
    """Return the RMS [mm] of readings by a fit without each, infinite for impossible sizes.

    With H = basis basis^T and the residual r of a reading b, the fit without it leaves
    (1 - H_bb)^-1 r_b.
    """
    board, problem = at.board, at.board.problem
    added = [name for name in effects if name not in at.effects]
    free = free_columns(board, (*at.effects, *added))
    drawn = at.slopes[:, free]
    step = np.linalg.lstsq(drawn, at.residual, rcond=1e-10)[0]
    for column, size in zip(free, at.unknowns[free] + step, strict=True):
        value = problem.start[column] + problem.scale[column] * size
        if column not in board.frame and not plausible_range(problem.names[column]).holds(value):
            return np.inf
    basis = span(drawn)
    residual = at.residual - drawn @ step
    marks = board.rows.measured.size
    off = []
    for start, size, end in ((0, 2, marks), (marks, 1, board.rows.count)):
        rows = basis[start:end].reshape((end - start) // size, size, basis.shape[1])
        kept = np.eye(size) - rows @ np.swapaxes(rows, 1, 2)
        each = residual[start:end].reshape(-1, size, 1)
        off.append((np.linalg.pinv(kept, rcond=1e-6, hermitian=True) @ each).ravel())
    return board.rows.rms_of(np.concatenate(off) * board.sigma)
