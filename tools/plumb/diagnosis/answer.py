"""The answer of a diagnosis: what the marks prove, and what they do not."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated

from pydantic import computed_field

from plumb.diagnosis.expected_error import LeftOpen
from plumb.diagnosis.noise import ORIGINS, Noise
from plumb.diagnosis.outliers import Outlier
from plumb.diagnosis.sizes import Room, Size
from plumb.model.catalogue import place_of
from plumb.model.plain import nouns_of, plainly
from plumb.text.answers import Internal, among, key, meant, part
from plumb.text.values import bare, worded

VERDICTS = ("nothing_provable", "one_suspect", "cannot_tell", "not_in_library", "slip")
Verdict = Annotated[str, among(VERDICTS)]


@dataclass(frozen=True)
class Ranked:
    """An effect of the library by itself."""

    effect: str
    gain: float  # drop of chi-square when it is added to the frame and all is refitted
    # the order of the ranking
    negative_log_p: Annotated[float, key("surprise", "-log of the chance of that gain from noise.")]
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
    """An explanation that stood its test: one effect, or several that act at once."""

    effects: tuple[str, ...]
    sizes: Internal[Mapping[str, tuple[Size, ...]]]
    rms_after: Annotated[float, key("rms_after_mm")]
    share: Annotated[float | None, meant("Of all accounts; null: they were not weighed.")] = None

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
    noise: Internal[Noise]
    threshold: Internal[float]  # of detection: the -log p that noise hardly ever exceeds
    rms_before: Annotated[float, key("rms_mm", "With the frame fitted.")]
    explanations: tuple[Together, ...]  # best first
    # [mm] RMS between two explanations' marks
    differences: Internal[Mapping[tuple[int, int], float]]
    ranking: tuple[Ranked, ...]
    library_fits: Internal[bool]  # whether all effects of the library at once could draw the marks
    chance: Annotated[float, meant("That as many effects explain what none of them made.")]
    # the first explanation, or the best at hand
    to_add: Annotated[tuple[str, ...], meant("Effects to go on with.")]
    outliers: Annotated[tuple[Outlier, ...], key("slips")]
    could_hide: tuple[Room, ...]
    left_open: Internal[LeftOpen]  # of the machine's errors all over the sheet
    warnings: tuple[str, ...]
    disagreements: tuple[str, ...] = ()  # rounds, or halves of the sheet, that do not go together

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

SHOWN = 8  # explanations that a sentence names; a Diagnosis holds all
MOST_WORDS = 40  # of a sentence, not counting the names that a command line adds to nouns
Nouns = Callable[[tuple[str, ...]], str]


def verdict_sentence(diagnosis: Diagnosis) -> str:
    """Return the verdict in a sentence or two, which name as many explanations as there is room
    for.
    """
    say = _SENTENCES[diagnosis.verdict]
    rooms = (n for n in range(SHOWN, 0, -1) if _count(say(diagnosis, plainly, n)) <= MOST_WORDS)
    return say(diagnosis, nouns_of, next(rooms, 0))


def _count(said: str) -> int:
    return len(said.split())


def _outlier(diagnosis: Diagnosis, _nouns: Nouns, shown: int) -> str:
    names = list(dict.fromkeys(outlier.name for outlier in diagnosis.outliers))
    more = f" and {len(names) - shown} more" if len(names) > shown else ""
    which = "One reading disagrees" if len(diagnosis.outliers) == 1 else "Some readings disagree"
    against = {outlier.against for outlier in diagnosis.outliers}
    what = against.pop() if len(against) == 1 else "every explanation or with their repeats"
    what = "their repeats" if what == "its repeats" and len(diagnosis.outliers) > 1 else what
    where = ", ".join(names[: max(shown, 1)])
    return f"{which} with {what}: look at {where}{more} again before anything else."


def _nothing_provable(diagnosis: Diagnosis, _nouns: Nouns, _shown: int) -> str:
    return f"Nothing is provable: {_error_left(diagnosis)}, and noise alone could look like that."


def _not_in_library(diagnosis: Diagnosis, nouns: Nouns, shown: int) -> str:
    left = _error_left(diagnosis)
    if not diagnosis.explanations:
        more = " (unless more than three act at once)" if diagnosis.library_fits else ""
        return (
            f"No effect of the library explains these marks, alone or up to three together{more}: "
            f"{left}, more than noise."
        )
    least = min(len(explanation.effects) for explanation in diagnosis.explanations)
    suspects = _suspects(diagnosis, nouns, shown)
    kind = "one effect explains" if least == 1 else f"{least} effects explain"
    return (
        f"No effect is proved: {left}. {suspects[0].upper()}{suspects[1:]} could be it, but here "
        f"{kind} {100 * diagnosis.chance:.0f} % of all smooth errors. More marks tell."
    )


def _one_suspect(diagnosis: Diagnosis, nouns: Nouns, shown: int) -> str:
    if not _any_possible(diagnosis):
        return _impossible(diagnosis, nouns, shown)
    first = diagnosis.explanations[0]
    single = len(first.effects) == 1
    who = "One suspect" if single else "Several effects at once"
    before, after = diagnosis.rms_before, first.rms_after
    named = _suspects(diagnosis, nouns, shown)
    return f"{who}: {named}. The error falls from {bare(before)} to {worded(after)} RMS."


def _cannot_tell(diagnosis: Diagnosis, nouns: Nouns, shown: int) -> str:
    if not _any_possible(diagnosis):
        return _impossible(diagnosis, nouns, shown)
    if diagnosis.explanations[0].share is not None:
        return _most_likely(diagnosis, nouns, shown)
    return (
        f"Something is missing ({_error_left(diagnosis)}), but the marks cannot tell which: "
        f"{_suspects(diagnosis, nouns, shown)}."
    )


def _most_likely(diagnosis: Diagnosis, nouns: Nouns, shown: int) -> str:
    """Return the likeliest account with its odds against all others, and the next if there
    is room.
    """
    first, *others = diagnosis.explanations
    said = f"{_named(first.effects, nouns, shown)} (odds {odds_words(first.share)})"
    if shown > 1 and others:
        second = others.pop(0)
        said += f"; next, {nouns(second.effects)} ({odds_words(second.share)})"
    more = f", and {len(others)} more" if others else ""
    missing = "is" if all(each.effects for each in diagnosis.explanations) else "may be"
    return f"Something {missing} missing: {_error_left(diagnosis)}. Most likely: {said}{more}."


def odds_words(share: float | None) -> str:
    """Return how likely something is, as odds against all else."""
    if share is None:
        return "not weighed"
    odds = share / max(1 - share, 1e-3)
    return f"{odds:.0f} to 1" if odds >= 1 else f"1 to {1 / max(odds, 1e-3):.0f}"


def _impossible(diagnosis: Diagnosis, nouns: Nouns, shown: int) -> str:
    return (
        f"Something is missing ({_error_left(diagnosis)}), but only sizes that no real machine has "
        f"would explain it: {_suspects(diagnosis, nouns, shown)}. Look for another cause first."
    )


def _any_possible(diagnosis: Diagnosis) -> bool:
    return any(explanation.possible for explanation in diagnosis.explanations)


def _error_left(diagnosis: Diagnosis) -> str:
    return f"the fitted frame leaves {worded(diagnosis.rms_before)} RMS"


def _suspects(diagnosis: Diagnosis, nouns: Nouns, shown: int) -> str:
    """Return the best explanations, and how many more there are."""
    best = diagnosis.explanations[: max(shown, 1)]
    names = [_named(explanation.effects, nouns, shown) for explanation in best]
    more = len(diagnosis.explanations) - len(best)
    *others, last = [*names, f"{more} more"] if more else names
    return f"{'; '.join(others)}; or {last}" if others else last


def _named(effects: Sequence[str], nouns: Nouns, shown: int) -> str:
    """Effects by their nouns; by their number where there is no room."""
    return nouns(tuple(effects)) if shown else f"{len(effects)} effects at once"


_SENTENCES = {
    "slip": _outlier,
    "nothing_provable": _nothing_provable,
    "not_in_library": _not_in_library,
    "one_suspect": _one_suspect,
    "cannot_tell": _cannot_tell,
}
