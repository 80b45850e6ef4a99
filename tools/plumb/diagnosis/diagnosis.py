"""The diagnosis: from readings to what the marks prove, what they do not, and how large each effect
could be.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Annotated

import numpy as np
import scipy

from plumb.diagnosis.evidence import (
    ORIGINS,
    Effects,
    Noise,
    explain_account,
    left_by_noise,
    misfit_chance,
)
from plumb.diagnosis.expected_error import LeftOpen, left_open
from plumb.diagnosis.explanation import (
    Explanation,
    beyond,
    covariance_of,
    explain,
    free_columns,
    measured_board,
    span,
)
from plumb.diagnosis.posterior import Account, Listed, Posterior, Spot
from plumb.diagnosis.priors import LIKELIER
from plumb.diagnosis.readings import CleanReadings, Outlier, clean_readings, shifts
from plumb.fit.compare import plausible_range, range_said
from plumb.fit.fit import Checked
from plumb.fit.inputs import Inputs, Stated
from plumb.model.catalogue import effect_names, parameter_words, place_of
from plumb.model.plain import plain_size, ranked
from plumb.model.predict import NAMES
from plumb.text.answers import Internal, among, in_json, key, meant, part
from plumb.text.values import Unit

# Sizes of effects: fitted with intervals, hidden in the frame, and how large they could be.


Array = np.ndarray


@dataclass(frozen=True)
class Size:
    """A parameter of an effect, fitted, with its 95 % interval."""

    effect: str
    name: str  # without the effect's
    value: float
    low: float | None  # None: these marks say nothing of it
    high: float | None
    unit: str
    plausible: bool  # whether a real machine can have the value
    possible: bool  # whether its interval reaches what a real machine may have
    shown: Internal[Unit]  # in which its lengths are said

    @in_json
    def said(self) -> str:
        """The same in words."""
        name = f"{self.effect}.{self.name}"
        return plain_size(name, self.value, self.low, self.high, unit=self.shown)

    @in_json
    def limits(self) -> tuple[float | None, float | None]:
        """The least and the largest that real machines have; null: no limit is known."""
        return plausible_range(f"{self.effect}.{self.name}").limits

    @in_json
    def range_said(self) -> str:
        """The same in words; empty: no limit is known."""
        return range_said(f"{self.effect}.{self.name}", self.shown)


@dataclass(frozen=True)
class SizeLimit:
    """The largest size that a parameter may still have."""

    name: str  # without the effect's
    largest: Annotated[float | None, meant("Null: these marks say nothing of it.")]
    unit: str


@dataclass(frozen=True)
class Room:
    """The largest size that an effect without proof may still have."""

    effect: str
    limits: Annotated[tuple[SizeLimit, ...], key("parameters")]
    mm: float | None  # RMS of what it would do to the marks before the frame is refitted


def sizes_of(explanation: Explanation, effect: str, noise: Noise) -> tuple[Size, ...]:
    """Return the fitted parameters of an effect of an explanation."""
    problem, words = explanation.board.problem, parameter_words()
    free = explanation.free
    sizes = []
    for column in explanation.board.columns([effect]):
        name, scale = problem.names[column], problem.scale[column]
        value = float(problem.start[column] + scale * explanation.unknowns[column])
        variance = explanation.covariance[free == column, free == column].item()
        half = noise.quantile * float(np.sqrt(variance)) * scale
        felt = bool(np.any(explanation.slopes[:, column]))
        plausible = plausible_range(name)
        # What cannot be negative has no negative part of an interval, unless it was fitted there.
        least = 0.0 if min(plausible.low, value) >= 0 else -np.inf
        sizes.append(
            Size(
                effect=effect,
                name=name.partition(".")[2],
                value=value,
                low=max(float(value - half), least) if felt else None,
                high=float(value + half) if felt else None,
                unit=words[name]["unit"],
                plausible=plausible.holds(value),
                possible=bool(plausible.is_near(value - half, value + half)),
                shown=explanation.board.unit,
            )
        )
    return tuple(sizes)


def hidden_share(frame: Explanation, effect: str) -> float | None:
    """Share of an effect's variance that the refitted frame swallows; None if nothing feels it.

    Parameters count in their typical sizes.
    """
    columns = frame.slopes[:, frame.board.columns([effect])]
    whole = float(np.sum(columns**2))
    return 1 - float(np.sum(frame.beyond_fit([effect]) ** 2)) / whole if whole else None


def room_for(effect: str, explanations: Sequence[Explanation], noise: Noise) -> Room:
    """Return the largest size that any of these explanations leaves to an effect (95 % upper
    limit), or what a real machine can have if that is less.

    Where the effect is part of the explanation its fitted size counts, else what could be added.
    """
    rooms = [_room(effect, explanation, noise) for explanation in explanations]
    limits = tuple(
        replace(limit, largest=_largest_of(room.limits[i].largest for room in rooms))
        for i, limit in enumerate(rooms[0].limits)
    )
    return Room(effect, limits, _largest_of(room.mm for room in rooms))


def _largest_of(sizes: Iterable[float | None]) -> float | None:
    """Return the largest; None if an explanation says nothing of it."""
    known = list(sizes)
    return None if None in known else max(size for size in known if size is not None)


def _room(effect: str, explanation: Explanation, noise: Noise) -> Room:
    board, words = explanation.board, parameter_words()
    columns = board.columns([effect])
    names = [board.problem.names[i] for i in columns]
    raw = explanation.slopes[:, columns]
    if not np.any(raw):
        nothing = tuple(
            SizeLimit(name.partition(".")[2], None, words[name]["unit"]) for name in names
        )
        return Room(effect, nothing, None)
    without = [i for i in explanation.free if i not in columns]
    fits = effect in explanation.effects
    basis = span(explanation.slopes[:, without]) if fits else explanation.basis
    added = beyond(basis, raw)
    covariance = covariance_of(added)
    start = explanation.unknowns[columns]
    middle = start + np.linalg.lstsq(added, explanation.residual, rcond=1e-10)[0]
    total = board.problem.start[columns] / board.problem.scale[columns] + middle
    reach = noise.upper_quantile * np.sqrt(np.diag(covariance))
    limits = []
    for i, name in enumerate(names):
        # What cannot be negative can only be as large as its upper end.
        plausible = plausible_range(name)
        ends = [total[i] + reach[i]]
        if plausible.low < 0:
            ends.append(-(total[i] - reach[i]))
        met = max(abs(plausible.low), abs(plausible.high))
        largest = min(max(0.0, *ends) * board.problem.scale[columns[i]], met)
        limits.append(SizeLimit(name.partition(".")[2], float(largest), words[name]["unit"]))
    if len(columns) == 1:
        whole = np.abs(raw) * limits[0].largest / board.problem.scale[columns[0]]
        return Room(effect, tuple(limits), board.rows.rms_of(board.sigma * whole[:, 0]))
    # Where little is measured the ellipsoid is boundless, but what is possible is not.
    sizes = np.array([limit.largest for limit in limits]) / board.problem.scale[columns]
    at_limits = sum(board.rows.rms_of(board.sigma * column) for column in (raw * sizes).T)
    return Room(
        effect, tuple(limits), min(_largest(explanation, raw, total, covariance), at_limits)
    )


def _largest(explanation: Explanation, raw: Array, total: Array, covariance: Array) -> float:
    """RMS over the readings of the largest effect of several parameters [mm]."""
    # |E v| over the ellipsoid of v is at most |E middle| + its radius times the longest axis.
    board = explanation.board
    values, directions = np.linalg.eigh(covariance)
    axes = raw @ (directions * np.sqrt(np.maximum(values, 0.0)))
    radius = float(np.sqrt(scipy.special.chdtri(raw.shape[1], 0.10)))
    middle = board.rows.rms_of(board.sigma * raw @ total)
    # Turned so that the first is the longest.
    left, sizes, _ = np.linalg.svd(axes, full_matrices=False)
    return middle + radius * max(board.rows.rms_of(board.sigma * axis) for axis in (left * sizes).T)


# The answer of a diagnosis: what the marks prove, and what they do not.


# Nearest causes where the machine does something that no effect draws.
#
# There a smooth field explains nearly as much as effects do, so the weight of an account says
# little of which machine to set. What predicts best the readings that a fit did not see says more:
# each effect has to take a good part of that error, or it is left out.


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


# The diagnosis: observe, weigh all accounts, set outliers aside, and read the answers off.


# A test whether the marks can fault the settings, or noise alone could explain the errors.


FEIGNED = 0.005  # chance below which noise is no longer believed to do it


def is_good(frame: Explanation, fits: Iterable[Explanation] = ()) -> bool:
    """Return whether noise alone may lower chi-square as much as the fitted frame does, and each
    of some fits, against the settings as they are. Where the sheet lies is no setting.

    If the settings are right, a fit of k numbers lowers chi-square by that of k degrees of freedom
    at most: what is known of them before the marks only makes it less.
    """
    problem = frame.board.problem
    at = problem.at(np.zeros(len(frame.unknowns)))
    if at is None:
        return False
    pose = [i for i in frame.board.frame if problem.names[i] not in NAMES]
    count = frame.board.rows.count
    left, slopes = at.residual[:count], at.slopes[:count, pose]
    left = left - slopes @ np.linalg.lstsq(slopes, left, rcond=1e-10)[0]
    as_set = float(left @ left)
    return all(
        scipy.special.chdtrc(len(fit.free) - len(pose), max(as_set - _left(fit), 0.0)) > FEIGNED
        for fit in (frame, *fits)
    )


def _left(fit: Explanation) -> float:
    return float(np.sum(fit.residual[: fit.board.rows.count] ** 2))


# From readings to a verdict.


def diagnose(inputs: Inputs) -> Diagnosis:
    """Find what the model of these settings misses in the marks, and in numbers checked directly.

    Raises InputError for too few marks, and marks that cannot be reached.
    """
    readings = clean_readings(measured_board(inputs), inputs)
    judgement = judge(readings, inputs.stated)
    best = readings.explained(judgement.best)
    frame, noise = readings.frame, readings.noise
    # Where a field acts, all chances are on that condition; else that nothing else is wrong.
    is_unknown = judgement.verdict == "not_in_library"
    explanations = tuple(readings.explained(each.account) for each in judgement.listed)
    doubts = doubts_of(readings, judgement.verdict, best)
    names = [part.name for part in inputs.measurements.rounds]
    open_now = left_open(frame)
    is_nothing = judgement.verdict == "nothing_provable"
    good = is_nothing and is_good(frame, [best])
    return Diagnosis(
        verdict=judgement.verdict,
        readings=readings,
        fits=explanations,
        best=best,
        likely=judgement.best.effects,
        rms_before=frame.rms,
        noise_rms=left_by_noise(frame, noise),
        explanations=tuple(
            _together(each, explanation, noise)
            for each, explanation in zip(judgement.listed, explanations, strict=True)
        ),
        differences=_differences(explanations),
        ranking=_ranking(readings, judgement.posterior.effect_chances(with_field=is_unknown)),
        nothing_chance=judgement.posterior.nothing_chance(with_field=is_unknown),
        field_chance=readings.posterior.field_chance,
        to_add=() if readings.outliers else best.effects,
        usual=best.board.usual_checks,
        outliers=readings.outliers,
        could_hide=tuple(room_for(name, explanations or (best,), noise) for name in effect_names()),
        left_open=open_now,
        is_good=good,
        is_cured=good and inputs.settings.fitted is not None,
        falls=_falls(frame, best, judgement.best.effects),
        warnings=tuple(filter(None, [open_now.sentence, *doubts])),
        disagreements=tuple(_round_warnings(readings, names)),
    )


def _falls(frame: Explanation, best: Explanation, effects: Sequence[str]) -> tuple[Fall, ...]:
    """Return how the error falls, that effect first which takes most."""
    falls: list[Fall] = []
    so_far: tuple[str, ...] = ()
    while len(so_far) + 1 < len(effects):
        several = [(*so_far, name) for name in effects if name not in so_far]
        fits = [explain(best.board, each, start=frame) for each in several]
        fitted = ranked(fits, lambda each: each.rms)[0]
        so_far = fitted.effects
        falls.append(Fall(so_far[-1], fitted.rms))
    last = [name for name in effects if name not in so_far]
    return (*falls, *(Fall(name, best.rms) for name in last))


def _together(listed: Listed, explanation: Explanation, noise: Noise) -> Together:
    effects = listed.account.effects
    return Together(
        effects=effects,
        sizes={name: sizes_of(explanation, name, noise) for name in effects},
        rms_after=explanation.rms,
        noise_rms=left_by_noise(explanation, noise),
        share=listed.share,
    )


def _differences(explanations: Sequence[Explanation]) -> dict[tuple[int, int], float]:
    """RMS between what two explanations leave of the readings [mm]."""
    return {
        (j, i): explanations[i].board.rows.rms_of(explanations[i].numbers - explanations[j].numbers)
        for i in range(len(explanations))
        for j in range(i)
    }


def _ranking(readings: CleanReadings, chances: Mapping[str, float]) -> tuple[RankedEffect, ...]:
    """Return every effect of the library by itself, the likeliest first; sizes by the slopes at the
    frame's fit.
    """
    frame, noise = readings.frame, readings.noise
    effects = []
    for name in effect_names():
        single = frame.with_effects((name,))
        effects.append(
            RankedEffect(
                effect=name,
                gain=max(frame.cost - single.cost, 0.0),
                chance=chances.get(name, 0.0),
                sizes=sizes_of(single, name, noise),
                rms_after=single.rms,
                hidden_share=hidden_share(frame, name),
            )
        )
    by_gain = ranked(effects, lambda effect: -effect.gain)
    return tuple(ranked(by_gain, lambda effect: -effect.chance))


# What does not go together, in sentences.


def doubts_of(readings: CleanReadings, verdict: str, best: Explanation) -> tuple[str, ...]:
    """Return all doubts about a verdict."""
    return (
        *readings.noise.notes,
        *(_place_warnings(readings, best) if verdict == "not_in_library" else []),
        *_unsettled_warnings((readings.frame, best)),
        *_sign_warnings(readings),
    )


def _place_warnings(readings: CleanReadings, nearest: Explanation) -> list[str]:
    """Return where to look first if nothing in the library explains the marks."""
    board = nearest.board
    of_marks = [shift for shift in shifts(nearest) if shift.reading.is_mark]
    if not of_marks:
        return []
    worst = ranked(of_marks, lambda shift: -shift.drop)[0]
    name = board.rows.names[worst.reading.index]
    far = board.unit.worded(float(np.hypot(*worst.offset)), 1)
    if board.rows.names.count(name) > 1:
        return [f"mark {name} stays {far} off when it is read again: it is the machine there"]
    if spot := readings.posterior.with_fields.spot:
        x, y = (board.unit.worded(float(along), 0) for along in spot.middle)
        return [
            f"what no effect draws acts about x {x}, y {y}: look there for a sheet that gives or "
            "lies uneven, and for a cable or hose that pulls"
        ]
    return [
        f"the marks are farthest off at {name}, by {far}: read it again; if it stays, it is the "
        "machine there"
    ]


def _unsettled_warnings(explanations: Sequence[Explanation]) -> list[str]:
    unsettled = [fitted for fitted in explanations if not fitted.settled]
    names = ", ".join(" + ".join(fitted.effects) or "frame" for fitted in unsettled)
    return [f"the fit did not come to rest: {names}"] if unsettled else []


def _sign_warnings(readings: CleanReadings) -> list[str]:
    """Return whether the other sign of y would explain the marks better than anything does."""
    if readings.posterior.turned_chance < LIKELIER:
        return []
    return [
        "with all y errors the other way round these marks would be explained better: check that "
        "measured and target count y in the same direction"
    ]


_WAYS_OUT = {
    "new_sheet": "new_sheet = true in {name} would explain it; if it is not so, use one at a time",
    "chains_rezeroed": "chains_rezeroed = true in {name} would explain it; if it is not so, use "
    "one at a time",
    "": "use one file at a time and compare what they say",
}


def _round_warnings(readings: CleanReadings, names: Sequence[str]) -> list[str]:
    """Return a sentence for each round that likely does not go with the others."""
    posterior = readings.posterior
    causes: dict[int, tuple[float, str]] = {}
    for move, chance in posterior.moved_chances.items():
        causes[move.number] = max(causes.get(move.number, (0.0, "")), (chance, move.cause))
    return [
        f"{names[number]} does not go with the other rounds: do not pool them; "
        + _WAYS_OUT[causes[number][1]].format(name=names[number])
        for number in posterior.apart
    ]
