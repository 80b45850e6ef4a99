"""The answer of a diagnosis: what the marks prove, and what they do not."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated

from pydantic import computed_field

from plumb.diagnosis.clean import CleanReadings
from plumb.diagnosis.expected_error import LeftOpen
from plumb.diagnosis.explanation import Explanation
from plumb.diagnosis.noise import ORIGINS, Noise
from plumb.diagnosis.outliers import Outlier
from plumb.diagnosis.sizes import Room, Size
from plumb.fit.problem import Checked
from plumb.model.catalogue import place_of
from plumb.model.plain import plainly
from plumb.text.answers import Internal, among, key, meant, part
from plumb.text.values import bare, worded

VERDICTS = ("nothing_provable", "one_suspect", "cannot_tell", "not_in_library", "slip")
Verdict = Annotated[str, among(VERDICTS)]


@dataclass(frozen=True)
class Ranked:
    """An effect of the library by itself."""

    effect: str
    gain: float  # drop of chi-square when it is added to the frame and all is refitted
    chance: Annotated[float, meant("That it acts, by all accounts; the order of the ranking.")]
    sizes: Annotated[tuple[Size, ...], key("parameters")]
    rms_after: Annotated[float, key("rms_after_mm")]
    hidden_share: float | None

    @computed_field
    @property
    def where(self) -> Annotated[str, among(("firmware", "lab", "sketch"))]:
        """Where the effect is written."""
        return place_of(self.effect)

    @computed_field
    @property
    def plausible(self) -> bool:
        """Whether a real machine can have these sizes."""
        return all(size.plausible for size in self.sizes)


@dataclass(frozen=True)
class EffectSize(Size):
    """The same with the name of its effect."""

    effect: str


@dataclass(frozen=True)
class Together:
    """A likely account of the marks: one effect, or several that act at once, or none."""

    effects: tuple[str, ...]
    sizes: Internal[Mapping[str, tuple[Size, ...]]]
    rms_after: Annotated[float, key("rms_after_mm")]
    share: Annotated[float, meant("How likely it is among all accounts.")]

    @computed_field
    @property
    def parameters(self) -> tuple[EffectSize, ...]:
        """All sizes in the order of the effects."""
        return tuple(
            EffectSize(**vars(size), effect=name)
            for name in self.effects
            for size in self.sizes[name]
        )

    @property
    def possible(self) -> bool:
        """Whether the intervals of all sizes reach what a real machine may have."""
        return all(size.possible for sizes in self.sizes.values() for size in sizes)

    def explained_share(self, rms_before: float) -> float:
        """Share of the squared error that the frame leaves [mm RMS] and this takes away."""
        return max(0.0, 1 - (self.rms_after / rms_before) ** 2) if rms_before else 0.0


@dataclass(frozen=True)
class Diagnosis:
    """What the marks prove, and what they do not."""

    verdict: Verdict
    readings: Internal[CleanReadings]  # with the posterior that all of this is read from
    fits: Internal[tuple[Explanation, ...]]  # of the explanations, in their order
    best: Internal[Explanation]  # with the effects to go on with
    rms_before: Annotated[float, key("rms_mm", "With the frame fitted.")]
    noise_rms: Annotated[float, key("noise_rms_mm", "What noise alone would leave of that fit.")]
    explanations: tuple[Together, ...]  # likeliest first
    # [mm] RMS between two explanations' marks
    differences: Internal[Mapping[tuple[int, int], float]]
    ranking: tuple[Ranked, ...]
    nothing_chance: Annotated[float, meant("That no effect acts, if nothing else is wrong.")]
    field_chance: Annotated[float, meant("That it also does what no effect of the library does.")]
    # the likeliest account, with what every machine has and the settings leave out
    to_add: Annotated[tuple[str, ...], meant("Effects to go on with.")]
    usual: Internal[tuple[Checked, ...]]  # what is known of their sizes before the marks
    outliers: Annotated[tuple[Outlier, ...], key("slips")]
    could_hide: tuple[Room, ...]
    left_open: Internal[LeftOpen]  # of the machine's errors all over the sheet
    warnings: tuple[str, ...]
    disagreements: tuple[str, ...] = ()  # rounds that do not go together

    @property
    def noise(self) -> Noise:
        """Of a reading."""
        return self.readings.noise

    sigma_mm = part("noise.sigma", float, "Reading error of a coordinate.")
    sigma_from = part("noise.source", Annotated[str, among(list(ORIGINS))])
    sigma_degrees = part("noise.degrees", float | None, "Of freedom; null: it was not estimated.")

    @computed_field
    @property
    def sentence(self) -> str:
        """The verdict for people."""
        return verdict_sentence(self)

    @computed_field
    @property
    def suspects(self) -> tuple[str, ...]:
        """The effects in the explanations, best first."""
        names = (name for together in self.explanations for name in together.effects)
        return tuple(dict.fromkeys(names))


# The last step of a diagnosis: its verdict in at most forty words for people.

SHOWN = 8  # explanations that a screen names; a Diagnosis holds all
MOST_WORDS = 40
MOST_NAMED = 2  # causes in a sentence


def verdict_sentence(diagnosis: Diagnosis) -> str:
    """Return the verdict in a sentence or two."""
    return _SENTENCES[diagnosis.verdict](diagnosis)


def _outlier(diagnosis: Diagnosis) -> str:
    names = list(dict.fromkeys(outlier.name for outlier in diagnosis.outliers))
    shown = names[:MOST_NAMED]
    more = f" and {len(names) - len(shown)} more" if len(names) > len(shown) else ""
    which = "One reading disagrees" if len(diagnosis.outliers) == 1 else "Some readings disagree"
    against = {outlier.against for outlier in diagnosis.outliers}
    what = against.pop() if len(against) == 1 else "every explanation or with their repeats"
    what = "their repeats" if what == "its repeats" and len(diagnosis.outliers) > 1 else what
    return f"{which} with {what}: look at {', '.join(shown)}{more} again before anything else."


def _nothing_provable(diagnosis: Diagnosis) -> str:
    return (
        f"The marks show no cause: with the frame fitted they are {worded(diagnosis.rms_before)} "
        f"off (RMS), and reading noise alone leaves about {worded(diagnosis.noise_rms)}."
    )


def _not_in_library(diagnosis: Diagnosis) -> str:
    nearest = diagnosis.explanations[0] if diagnosis.explanations else None
    left = nearest.rms_after if nearest else diagnosis.rms_before
    said = (
        "The machine does something that no effect of the library draws: "
        f"{worded(left)} RMS stay, where noise leaves {worded(diagnosis.noise_rms)}."
    )
    if nearest is None or not nearest.effects:
        return said
    falls = f"brings {bare(diagnosis.rms_before)} to {worded(nearest.rms_after)}"
    return f"{said} What comes nearest, {_named(nearest.effects)}, {falls}."


def _one_suspect(diagnosis: Diagnosis) -> str:
    (first,) = diagnosis.explanations
    return (
        f"The cause is most likely {_named(first.effects)}, {odds_words(first.share)}. "
        f"With it the error falls from {bare(diagnosis.rms_before)} to {worded(first.rms_after)} "
        "RMS."
    )


def _cannot_tell(diagnosis: Diagnosis) -> str:
    first, second, *others = diagnosis.explanations
    said = (
        f"The cause may be {_named(first.effects)}, {odds_words(first.share)}, or "
        f"{_named(second.effects)}, {odds_words(second.share)}."
    )
    more = f" {len(others)} more are less likely." if others else ""
    return f"{said}{more} The marks cannot tell yet."


def odds_words(share: float) -> str:
    """Return how likely something is, as odds against all else."""
    odds = share / max(1 - share, 1e-3)
    return f"{odds:.0f} to 1" if odds >= 1 else f"1 to {1 / max(odds, 1e-3):.0f}"


def _named(effects: Sequence[str]) -> str:
    """Effects by their nouns; by their number where there are many."""
    return plainly(effects) if len(effects) <= MOST_NAMED else f"{len(effects)} effects at once"


_SENTENCES = {
    "slip": _outlier,
    "nothing_provable": _nothing_provable,
    "not_in_library": _not_in_library,
    "one_suspect": _one_suspect,
    "cannot_tell": _cannot_tell,
}
