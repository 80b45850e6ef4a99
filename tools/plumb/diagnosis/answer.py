"""The answer of a diagnosis: what the marks prove, and what they do not."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import inf
from typing import Annotated

import numpy as np

from plumb.diagnosis.expected_error import LeftOpen
from plumb.diagnosis.explanation import Explanation
from plumb.diagnosis.nearest import nearest
from plumb.diagnosis.noise import ORIGINS, Noise, left_by_noise, misfit_chance
from plumb.diagnosis.outliers import Outlier
from plumb.diagnosis.posterior import Account, Listed, Posterior
from plumb.diagnosis.priors import LIKELIER
from plumb.diagnosis.readings import CleanReadings
from plumb.diagnosis.sizes import Room, Size
from plumb.diagnosis.spots import Spot
from plumb.fit.inputs import Stated
from plumb.fit.problem import Checked
from plumb.model.catalogue import place_of
from plumb.model.plain import plainly
from plumb.text.answers import Internal, among, in_json, key, meant, part
from plumb.text.values import Unit

VERDICTS = ("nothing_provable", "one_suspect", "cannot_tell", "not_in_library", "slip")
Verdict = Annotated[str, among(VERDICTS)]

# What follows from each state of a diagnosis: a sentence, and the command with the same board; none
# where the question is asked again, or where there is none left.
ADD, NEXT = ("add", "--effect", "auto"), ("next",)
STEPS: Mapping[str, tuple[str, tuple[str, ...]]] = {
    "read_again": ("When the file is corrected:", ()),
    "measure_first": ("What to measure next:", NEXT),
    "good": ("Nothing to change: cut your jobs.", ()),
    "frame_only": ("Fit the frame:", ADD),
    "several_causes": ("Add what is known:", ADD),
    "one_cause": ("Add it:", ADD),
    "impossible": ("What to measure next:", NEXT),
    "cannot_tell": ("What to measure next:", NEXT),
    "unknown_cause": ("What to measure next:", NEXT),
}


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

    def explained_share(self, rms_before: float) -> float:
        """Share of the squared error that the frame leaves [mm RMS] and this takes away."""
        return max(0.0, 1 - (self.rms_after / rms_before) ** 2) if rms_before else 0.0


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
    def state(self) -> Annotated[str, among(list(STEPS))]:
        """What the marks come to, and what follows."""
        return _state(self)

    @in_json
    def title(self) -> str:
        """What the marks come to, in a few words."""
        return _title(self)

    @in_json
    def sentence(self) -> str:
        """The verdict for people."""
        return verdict_sentence(self)

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

    def called(self, together: Together) -> str:
        """Return an explanation by the nouns of its effects, for people."""
        is_unknown = self.verdict == "not_in_library" and self.field_chance > LIKELIER
        if is_unknown and not together.effects:
            return "only what no known effect draws"
        return plainly(together.effects)

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


# The last step of a diagnosis: its verdict in at most forty words for people.

TAKES_MOST = 0.6  # share of the error that is left where causes take most of its square
SHOWN = 8  # explanations that a screen names; a Diagnosis holds all
MOST_WORDS = 40
MOST_NAMED = 2  # causes in a sentence


def _takes_most(explained: Explanation, frame: Explanation) -> bool:
    return explained.rms < TAKES_MOST * frame.rms


def verdict_sentence(diagnosis: Diagnosis) -> str:
    """Return the verdict in a sentence or two."""
    return _SENTENCES[diagnosis.verdict](diagnosis)


def _state(diagnosis: Diagnosis) -> str:
    if diagnosis.outliers:
        return "read_again"
    if diagnosis.left_open.is_too_much:
        return "measure_first"
    if diagnosis.is_good:
        return "good"
    if diagnosis.verdict == "nothing_provable":
        return "frame_only"
    if diagnosis.verdict == "not_in_library":
        return "several_causes" if diagnosis.is_finding else "unknown_cause"
    if diagnosis.verdict == "cannot_tell":
        return "cannot_tell"
    return "one_cause" if diagnosis.explanations[0].possible else "impossible"


def _title(diagnosis: Diagnosis) -> str:
    if diagnosis.outliers:
        return "A reading disagrees: look at it first"
    if diagnosis.disagreements:
        return "The rounds do not go together"
    if diagnosis.is_good:
        return "Cured" if diagnosis.is_cured else "As good as these marks can show"
    if diagnosis.verdict == "nothing_provable":
        may_act = diagnosis.nothing_chance <= LIKELIER
        return "Something may act" if may_act else "The frame may be all of it"
    if diagnosis.is_finding:
        return diagnosis.sentence.partition(".")[0]
    if diagnosis.verdict == "not_in_library":
        known = diagnosis.field_chance <= LIKELIER
        odds = odds_words(diagnosis.field_chance)
        return "Something is left over" if known else f"Something unknown acts, odds {odds}"
    if diagnosis.verdict == "one_suspect":
        return f"It is most likely {diagnosis.called(diagnosis.explanations[0])}"
    return "Several things could be it"


def _outlier(diagnosis: Diagnosis) -> str:
    names = list(dict.fromkeys(outlier.called for outlier in diagnosis.outliers))
    shown = names[:MOST_NAMED]
    more = f" and {len(names) - len(shown)} more" if len(names) > len(shown) else ""
    which = "One reading disagrees" if len(diagnosis.outliers) == 1 else "Some readings disagree"
    against = {outlier.against for outlier in diagnosis.outliers}
    what = against.pop() if len(against) == 1 else "every explanation or with their repeats"
    what = "their repeats" if what == "its repeats" and len(diagnosis.outliers) > 1 else what
    return f"{which} with {what}: look at {', '.join(shown)}{more} again before anything else."


def _nothing_provable(diagnosis: Diagnosis) -> str:
    left = _left(diagnosis.rms_before, diagnosis.noise_rms, diagnosis.unit)
    if diagnosis.is_good:
        good = "as good as these marks can show"
        said = (
            f"Cured: the machine is now {good}" if diagnosis.is_cured else f"The machine is {good}"
        )
        return f"{said}. With the frame fitted {left}."
    said = (
        "The marks show no cause: all that is wrong may be the frame's numbers."
        if diagnosis.nothing_chance > LIKELIER
        else "Something may act, but the marks do not show what."
    )
    return f"{said} With the frame fitted {left}."


def _not_in_library(diagnosis: Diagnosis) -> str:
    if diagnosis.is_finding:
        return _finding(diagnosis)
    nearest = diagnosis.explanations[0] if diagnosis.explanations else None
    left = _left(
        nearest.rms_after if nearest else diagnosis.rms_before,
        nearest.noise_rms if nearest else diagnosis.noise_rms,
        diagnosis.unit,
    )
    what = _unknown(diagnosis)
    if nearest is None or not nearest.effects:
        return f"{what}. With the frame fitted {left}."
    return f"{what}. What comes nearest is {_named(nearest.effects)}: with that {left}."


COUNTS = {2: "Two", 3: "Three", 4: "Four"}  # more are written as a number


def _finding(diagnosis: Diagnosis) -> str:
    """Return how the error falls, and what stays that no effect draws."""
    falls, unit = diagnosis.falls, diagnosis.unit
    share = "Most" if diagnosis.takes_most else "Part"
    which = f"{share} of it is {plainly(diagnosis.likely)}"
    if len(falls) > 1:
        which = f"{COUNTS.get(len(falls), len(falls))} things are wrong at once"
    steps = ", ".join(
        unit.bare(each) for each in [diagnosis.rms_before, *(f.rms for f in falls[:-1])]
    )
    said = f"{which}. The error falls from {steps} to {unit.worded(falls[-1].rms)} RMS"
    return f"{said}; a pattern of {unit.worded(diagnosis.pattern_mm)} stays that no effect draws."


def _unknown(diagnosis: Diagnosis) -> str:
    """Return why the library does not explain the marks, without the full stop."""
    if diagnosis.disagreements:
        return "The rounds do not go together"
    if diagnosis.field_chance < UNKNOWN:
        return "Even the likeliest cause leaves more than noise would"
    does = "does" if diagnosis.field_chance > LIKELIER else "may do"
    return (
        f"The machine {does} something that the library does not know: the odds are "
        f"{odds_words(diagnosis.field_chance)}"
    )


def _left(rms: float, by_noise: float, unit: Unit) -> str:
    """Return what a fit leaves, and what it would leave of noise alone."""
    return f"{unit.worded(rms)} RMS is left; noise alone leaves {unit.worded(by_noise)}"


def _one_suspect(diagnosis: Diagnosis) -> str:
    (first,), unit = diagnosis.explanations, diagnosis.unit
    causes = "The cause is" if len(first.effects) == 1 else "The causes are"
    return (
        f"{causes} most likely {_named(first.effects)}: the odds are {odds_words(first.share)}. "
        f"The error falls from {unit.bare(diagnosis.rms_before)} to "
        f"{unit.worded(first.rms_after)} RMS; noise alone leaves {unit.worded(first.noise_rms)}."
    )


def _cannot_tell(diagnosis: Diagnosis) -> str:
    first, second, *others = diagnosis.explanations
    sure = [
        name
        for name in first.effects
        if all(name in each.effects for each in diagnosis.explanations)
    ]
    if sure:
        causes = "One cause is" if len(sure) == 1 else "Two causes are"
        causes = causes if len(sure) <= MOST_NAMED else "The causes are"
        said = f"{causes} most likely {_named(sure)}. In addition: "
    else:
        said = "The marks cannot tell yet. Most likely it is "
    said += f"{_open(first, sure)}, at odds of {odds_words(first.share)}"
    if len({*first.effects, *second.effects} - {*sure}) <= MOST_NAMED:
        said += f", or {_open(second, sure)}, at {odds_words(second.share)}"
    else:
        others = [second, *others]
    are = "is" if len(others) == 1 else "are"
    return f"{said}. {len(others)} more {are} possible." if others else f"{said}."


def _open(together: Together, sure: Sequence[str]) -> str:
    """Return an account but for what is sure."""
    effects = [name for name in together.effects if name not in sure]
    return _named(effects) if effects or not sure else "nothing else"


MOST_ODDS = 100.0  # beyond which they were not checked
FINE_ODDS = 20.0  # beyond which they are said in tens


def odds_words(share: float) -> str:
    """Return how likely something is, as odds against all else."""
    odds = share / (1 - share) if share < 1 else inf
    if odds > MOST_ODDS:
        return f"over {MOST_ODDS:.0f} to 1"
    if odds < 1 / MOST_ODDS:
        return f"under 1 to {MOST_ODDS:.0f}"
    larger = max(odds, 1 / odds)
    if 1.25 <= larger < 1.75:
        sides = "3", "2"
    else:
        sides = f"{round(larger, -1 if larger > FINE_ODDS else 0):.0f}", "1"
    return " to ".join(sides if odds >= 1 else sides[::-1])


def _named(effects: Sequence[str]) -> str:
    """Effects by their nouns; by their number where there are many."""
    return plainly(effects) if len(effects) <= MOST_NAMED else f"{len(effects)} causes at once"


_SENTENCES = {
    "slip": _outlier,
    "nothing_provable": _nothing_provable,
    "not_in_library": _not_in_library,
    "one_suspect": _one_suspect,
    "cannot_tell": _cannot_tell,
}


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


def is_silent(nothing_chance: float) -> bool:
    """Return whether it is too likely that nothing acts for any cause to be named."""
    return nothing_chance > NOTHING
