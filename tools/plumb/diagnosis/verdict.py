"""The verdict: a reading of the posterior, by a table of odds."""

from __future__ import annotations

from dataclasses import dataclass

from plumb.diagnosis.clean import CleanReadings
from plumb.diagnosis.noise import misfit_chance
from plumb.diagnosis.posterior import Account, Listed, explain_account
from plumb.fit.inputs import Stated

# Bounds, in odds.
#
# | if                                               | odds   | because
# | a reading is off                                 | 1 to 2 | it is read again in a minute
# | what no effect draws, or a moved round, acts too | 1 to 4 | an unknown cause costs a wrong cure
# | no effect acts                                   | 1 to 3 | a cause that is named is believed
# | the listed accounts hold all others together     | 1 to 19| as every interval of the lab does
UNKNOWN = 0.2
NOTHING = 0.25
MISFIT = 0.03  # chance below which noise never leaves what even the best account leaves


@dataclass(frozen=True)
class Judgement:
    """The verdict, and the accounts that it names."""

    verdict: str  # one of answer.VERDICTS
    listed: tuple[Listed, ...]  # likeliest first
    best: Account  # to go on with


def judge(readings: CleanReadings, stated: Stated | None) -> Judgement:
    """Read the verdict off the posterior."""
    posterior = readings.posterior
    best = posterior.accounts[0]
    if readings.outliers:
        return Judgement("slip", (), best)
    unknown = posterior.field_chance + sum(posterior.moved_chances.values())
    if unknown > UNKNOWN or _misfits(readings, best, stated):
        nearest = tuple(posterior.listed_with_field())
        return Judgement("not_in_library", nearest, nearest[0].account)
    listed = tuple(posterior.listed())
    if is_silent(posterior.nothing_chance):
        nothing = next(account for account in posterior.accounts if not account.effects)
        return Judgement("nothing_provable", (), nothing)
    verdict = "one_suspect" if len(listed) == 1 else "cannot_tell"
    return Judgement(verdict, listed, listed[0].account)


def is_silent(nothing_chance: float) -> bool:
    """Return whether it is too likely that nothing acts for any cause to be named."""
    return nothing_chance > NOTHING


def _misfits(readings: CleanReadings, best: Account, stated: Stated | None) -> bool:
    """Return whether even the likeliest account leaves more than noise ever does."""
    fitted = explain_account(readings.frame, best.effects, best.acting)
    return misfit_chance(fitted, stated) < MISFIT
