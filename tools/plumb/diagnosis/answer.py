"""The answer of a diagnosis: what the marks prove, and what they do not."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated

import numpy as np

from plumb.diagnosis.evidence import Effects
from plumb.diagnosis.expected_error import LeftOpen
from plumb.diagnosis.explanation import Explanation, free_columns, span
from plumb.diagnosis.noise import ORIGINS, Noise, left_by_noise, misfit_chance
from plumb.diagnosis.outliers import Outlier
from plumb.diagnosis.posterior import Account, Listed, Posterior
from plumb.diagnosis.priors import LIKELIER
from plumb.diagnosis.readings import CleanReadings
from plumb.diagnosis.refit import explain_account
from plumb.diagnosis.sizes import Room, Size
from plumb.diagnosis.spots import Spot
from plumb.fit.expected import plausible_range
from plumb.fit.inputs import Stated
from plumb.fit.problem import Checked
from plumb.model.catalogue import place_of
from plumb.model.plain import ranked
from plumb.text.answers import Internal, among, in_json, key, meant, part
from plumb.text.values import Unit

# Nearest causes where the machine does something that no effect draws.
#
# There a smooth field explains nearly as much as effects do, so the weight of an account says
# little of which machine to set. What predicts best the readings that a fit did not see says more:
# each effect has to take a good part of that error, or it is left out.


Array = np.ndarray
WORTH = 1 / 6  # of the error at readings not used, which each effect has to take
MOST = 4  # effects that are tried together
HELD = 0.01  # typical sizes: what cannot be negative and is smaller was held at zero
BEAM = 6  # best sets of a size that are tried with another effect
REFITTED = 3  # best sets of a size that are fitted again


def nearest(frame: Explanation, posterior: Posterior) -> Effects:
    """Return the effects that predict best the readings that a fit did not see; none if the frame
    alone does. Sizes that no machine has do not count.
    """
    best: Effects = ()
    least = min(left_out(at, ()) for at in (frame, explain_account(frame, (), ())))
    sets: Sequence[Effects] = [()]
    for _ in range(MOST):
        larger = dict.fromkeys(
            tuple(name for name in posterior.felt if name in {*few, more})
            for few in sets
            for more in posterior.felt
            if more not in few
        )
        sets = ranked(larger, lambda few: left_out(frame, few))[:BEAM]
        fitted = [(left_out_refitted(frame, few), few) for few in sets[:REFITTED]]
        left, first = ranked(fitted, lambda each: each[0])[0]
        if np.isfinite(left) and left <= least * (1 - WORTH) ** (len(first) - len(best)):
            best, least = first, left
    return best


def left_out(at: Explanation, effects: Effects) -> float:
    """Return the RMS [mm] of readings by a fit without each, linear about `at`; infinite for sizes
    that no machine has.

    With H = basis basis^T and the residual r of a reading b, the fit without it leaves
    (1 - H_bb)^-1 r_b.
    """
    board, problem = at.board, at.board.problem
    free = free_columns(board, dict.fromkeys([*at.effects, *effects]))
    drawn = at.slopes[:, free]
    step = np.linalg.lstsq(drawn, at.residual, rcond=1e-10)[0]
    values = problem.start[free] + problem.scale[free] * (at.unknowns[free] + step)
    for column, value in zip(free, values, strict=True):
        if column not in board.frame and not plausible_range(problem.names[column]).holds(value):
            return np.inf
    basis, residual = span(drawn), at.residual - drawn @ step
    marks, off = board.rows.measured.size, []
    for start, size, end in ((0, 2, marks), (marks, 1, board.rows.count)):
        rows = basis[start:end].reshape((end - start) // size, size, basis.shape[1])
        kept = np.eye(size) - rows @ np.swapaxes(rows, 1, 2)
        each = residual[start:end].reshape(-1, size, 1)
        off.append((np.linalg.pinv(kept, rcond=1e-6, hermitian=True) @ each).ravel())
    return board.rows.rms_of(np.concatenate(off) * board.sigma)


def left_out_refitted(frame: Explanation, effects: Effects) -> float:
    """Return the same linear about the fit of these effects; infinite too where none comes to rest,
    or where a size that cannot be negative was held at zero.
    """
    fit = explain_account(frame, effects, effects)
    board, problem = fit.board, fit.board.problem
    columns = board.columns(effects)
    sizes = problem.start[columns] / problem.scale[columns] + fit.unknowns[columns]
    is_held = any(
        size < HELD and plausible_range(problem.names[column]).low == 0
        for column, size in zip(columns, sizes, strict=True)
    )
    return left_out(fit, effects) if fit.settled and not is_held else np.inf


# The answer.

VERDICTS = ("nothing_provable", "one_suspect", "cannot_tell", "not_in_library", "slip")
Verdict = Annotated[str, among(VERDICTS)]

STATES = (
    "read_again",
    "measure_first",
    "good",
    "frame_only",
    "several_causes",
    "unknown_cause",
    "cannot_tell",
    "one_cause",
    "impossible",
)


@dataclass(frozen=True)
class RankedEffect:
    """An effect of the library by itself."""

    effect: str
    gain: float  # drop of chi-square when it is added to the frame and all is refitted
    chance: Annotated[float, meant("That it acts, by all accounts; the order of the ranking.")]
    sizes: Annotated[tuple[Size, ...], key("parameters")]
    rms_after: Annotated[float, key("rms_after_mm")]
    hidden_share: float | None

    @in_json
    def where(self) -> Annotated[str, among(("firmware", "lab"))]:
        """Where the effect is written."""
        return place_of(self.effect)

    @in_json
    def plausible(self) -> bool:
        """Whether a real machine can have these sizes."""
        return all(size.plausible for size in self.sizes)


@dataclass(frozen=True)
class Together:
    """A likely account of the marks: one effect, or several that act at once, or none."""

    effects: tuple[str, ...]
    sizes: Internal[Mapping[str, tuple[Size, ...]]]
    rms_after: Annotated[float, key("rms_after_mm")]
    noise_rms: Annotated[float, key("noise_rms_mm", "What noise alone leaves of that fit.")]
    share: Annotated[float, meant("How likely it is among all accounts.")]

    @in_json
    def parameters(self) -> tuple[Size, ...]:
        """All sizes in the order of the effects."""
        return tuple(size for name in self.effects for size in self.sizes[name])

    @in_json
    def possible(self) -> bool:
        """Whether the intervals of all sizes reach what a real machine may have."""
        return all(size.possible for sizes in self.sizes.values() for size in sizes)


@dataclass(frozen=True)
class Fall:
    """Error that is left once another effect is fitted too."""

    effect: str
    rms: Annotated[float, key("rms_mm")]


@dataclass(frozen=True)
class Diagnosis:
    """Diagnosis of the marks: all that they prove, and all that they leave open."""

    verdict: Verdict
    readings: Internal[CleanReadings]  # with the posterior that all of this is read from
    fits: Internal[tuple[Explanation, ...]]  # of the explanations, in their order
    best: Internal[Explanation]  # with the effects to go on with
    likely: Internal[tuple[str, ...]]  # those of the account behind it, without what was left out
    rms_before: Annotated[float, key("rms_mm", "With the frame fitted.")]
    noise_rms: Annotated[float, key("noise_rms_mm", "What noise alone leaves of that fit.")]
    explanations: tuple[Together, ...]  # likeliest first
    # [mm] RMS between two explanations' marks
    differences: Internal[Mapping[tuple[int, int], float]]
    ranking: tuple[RankedEffect, ...]
    nothing_chance: Annotated[float, meant("That no effect acts, by the same weights.")]
    field_chance: Annotated[float, meant("That it also does what no effect of the library does.")]
    # the likeliest account, with what every machine has and the settings leave out
    to_add: Annotated[tuple[str, ...], meant("Effects to go on with.")]
    usual: Internal[tuple[Checked, ...]]  # what is known of their sizes before the marks
    outliers: Annotated[tuple[Outlier, ...], key("slips")]
    could_hide: tuple[Room, ...]
    left_open: Internal[LeftOpen]  # of the machine's errors all over the sheet
    is_good: Annotated[
        bool, meant("Whether noise alone may feign all that is wrong with the settings.")
    ]
    is_cured: Internal[bool]  # it is good since a fit wrote its settings
    falls: Annotated[
        tuple[Fall, ...], meant("How the error falls, effect by effect, with what to go on with.")
    ]
    warnings: tuple[str, ...]
    disagreements: tuple[str, ...] = ()  # rounds that do not go together

    @property
    def unit(self) -> Unit:
        """Of the lengths in what is said of it."""
        return self.best.board.unit

    @property
    def noise(self) -> Noise:
        """Of a reading."""
        return self.readings.noise

    sigma_mm = part("noise.sigma", float, "Reading error of a coordinate.")
    sigma_from = part("noise.source", Annotated[str, among(list(ORIGINS))])
    sigma_degrees = part("noise.degrees", float | None, "Of freedom; null: it was not estimated.")

    @in_json
    def state(self) -> Annotated[str, among(STATES)]:
        """What the marks come to: the first of these that holds."""
        if self.outliers:
            return "read_again"
        if self.left_open.is_too_much:
            return "measure_first"
        if self.is_good:
            return "good"
        if self.verdict == "nothing_provable":
            return "frame_only"
        if self.verdict == "not_in_library":
            return "several_causes" if self.is_finding else "unknown_cause"
        if self.verdict == "cannot_tell":
            return "cannot_tell"
        return "one_cause" if self.explanations[0].possible else "impossible"

    @property
    def is_finding(self) -> bool:
        """Whether causes are named although the machine does something that no effect draws: they
        take most of the error, or are likely beside a spot of the sheet that does so.
        """
        if self.verdict != "not_in_library" or self.disagreements or not self.likely:
            return False
        is_likely = bool(self.spot) and self.explanations[0].share > LIKELIER
        return is_likely or self.takes_most

    @property
    def rivals(self) -> list[tuple[Explanation, float]]:
        """What may be right instead of what to go on with, named or not, and how likely each is."""
        is_unknown = self.verdict == "not_in_library"
        possible = self.readings.posterior.possible(with_field=is_unknown)
        others = (each for each in possible if each.account.effects != self.likely)
        return [(self.readings.explained(each.account), each.share) for each in others]

    @property
    def takes_most(self) -> bool:
        """Whether the effects to go on with take most of the error."""
        return _takes_most(self.best, self.readings.frame)

    @property
    def spot(self) -> Spot | None:
        """Place of the sheet about which the machine does what no effect draws."""
        return self.readings.posterior.with_fields.spot

    @property
    def pattern_mm(self) -> float:
        """Error with the effects to go on with, beyond noise [mm RMS]."""
        by_noise = left_by_noise(self.best, self.noise)
        return float(np.sqrt(max(self.best.rms**2 - by_noise**2, 0.0)))

    @in_json
    def suspects(self) -> tuple[str, ...]:
        """The effects in the explanations, best first."""
        names = (name for together in self.explanations for name in together.effects)
        return tuple(dict.fromkeys(names))


# The verdict: a reading of the posterior, by a table of odds.
#
# Bounds, in odds.
#
# | if                                               | odds   | because
# | a reading is off                                 | 1 to 2 | it is read again in a minute
# | what no effect draws, or a moved round, acts too | 1 to 4 | an unknown cause costs a wrong cure
# | no effect acts                                   | 1 to 2 | a cause that is named is believed
# | the listed accounts hold all others together     | 1 to 19| as every interval of the lab does
UNKNOWN = 0.2
NOTHING = 1 / 3
MISFIT = 0.03  # chance below which noise never leaves what even the best account leaves
TAKES_MOST = 0.6  # share of the error that is left where causes take most of its square


@dataclass(frozen=True)
class Judgement:
    """The verdict, and the accounts that it names."""

    verdict: str  # one of answer.VERDICTS
    posterior: Posterior  # with all that is named
    listed: tuple[Listed, ...]  # likeliest first
    best: Account  # to go on with


def judge(readings: CleanReadings, stated: Stated | None) -> Judgement:
    """Read the verdict off the posterior."""
    posterior = readings.posterior
    best = posterior.accounts[0]
    if readings.outliers:
        return Judgement("slip", posterior, (), best)
    unknown = posterior.field_chance + sum(posterior.moved_chances.values())
    if unknown > UNKNOWN or misfit_chance(readings.explained(best), stated) < MISFIT:
        if posterior.with_fields.spot:
            first = posterior.likeliest_with_field
        else:
            # Where the sled sticks, no fit may come to rest.
            first = nearest(readings.frame, posterior) or posterior.likeliest_with_field
            posterior = posterior.weighing(first)
        listed = tuple(posterior.listed_nearest_first(first))
        best = listed[0].account
        if first and not posterior.apart and _takes_most(readings.explained(best), readings.frame):
            listed = listed[:1]
        return Judgement("not_in_library", posterior, listed, best)
    listed = tuple(posterior.listed())
    if is_silent(posterior.nothing_chance()):
        return Judgement("nothing_provable", posterior, (), _likelier(posterior, listed[0]))
    verdict = "one_suspect" if len(listed) == 1 else "cannot_tell"
    return Judgement(verdict, posterior, listed, listed[0].account)


def _likelier(posterior: Posterior, first: Listed) -> Account:
    """Return the account to go on with where none is named: the first if it is likelier than all
    others together, for to leave it out would mostly be wrong; else that of nothing.
    """
    if first.share > LIKELIER:
        return first.account
    return next(account for account in posterior.accounts if not account.effects)


def _takes_most(explained: Explanation, frame: Explanation) -> bool:
    return explained.rms < TAKES_MOST * frame.rms


def is_silent(nothing_chance: float) -> bool:
    """Return whether it is too likely that nothing acts for any cause to be named."""
    return nothing_chance > NOTHING
