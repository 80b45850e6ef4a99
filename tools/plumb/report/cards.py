"""The suspect cards: what an effect does, how large it is, what hides it and what settles it."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from plumb.diagnosis.answer import Ranked
from plumb.diagnosis.explanation import Explanation
from plumb.diagnosis.sizes import Size
from plumb.diagnosis.suspect_curves import fingerprint_of
from plumb.diagnosis.unseen import share_words
from plumb.fit.expected import plausible_range
from plumb.model.catalogue import every_effect, place_of
from plumb.model.plain import plain_range, plain_size, plainly, ranked
from plumb.model.predict import frame_words
from plumb.pictures.scale import Panel, Scale, spots_of
from plumb.report.findings import Findings
from plumb.report.maps import FINGERPRINT, arrow_map
from plumb.text.values import worded

if TYPE_CHECKING:
    from plumb.model.python_effect import CheckWords

Array = np.ndarray
MOST_CARDS = 8
NAME = re.compile(r"\b[a-z]+(?:_[a-z]+)+\b")
MARGIN = 0.06  # of a bar's length, left and right of what it shows
ARROWS = (9, 5)  # of a fingerprint, across and down
UNSEEN = 0.005  # [mm] below which a fingerprint shows nothing


@dataclass(frozen=True)
class SizeBar:
    """A size with its interval on the range that was met in workshops; places in percent."""

    said: str
    range_said: str
    low: float | None  # None: these marks say nothing of it
    high: float | None
    at: float
    range_low: float
    range_high: float
    zero: float
    possible: bool  # its interval reaches what a real machine may have


@dataclass(frozen=True)
class Drawn:
    """The fingerprints of an effect, and how large they are on the marks."""

    alone: str  # picture: what it does; empty: nothing to see
    alone_rms: str
    beyond: str  # picture: what is left of that when the frame is refitted
    beyond_rms: str


@dataclass(frozen=True)
class Card:
    """A suspect for people."""

    effect: str
    noun: str
    where: str
    summary: str
    pattern: str
    sizes: tuple[SizeBar, ...]
    taken_up: str  # how much of it the refitted frame takes
    rms_after: str
    look_alikes: str
    remedy: str
    check: str  # how it is measured directly; empty if nobody can
    drawn: Drawn


def cards_of(findings: Findings) -> tuple[Card, ...]:
    """Return a card for each effect of the explanations; of what is added where none stands."""
    names = findings.diagnosis.suspects or findings.used.effects
    return tuple(_card(findings, name) for name in names[:MOST_CARDS])


def _card(findings: Findings, effect: str) -> Card:
    ranked = next(each for each in findings.diagnosis.ranking if each.effect == effect)
    words = next(each for each in every_effect() if each["name"] == effect)
    explanation = _explanation_with(findings, effect)
    return Card(
        effect=effect,
        noun=words["noun"],
        where=place_of(effect),
        summary=words["summary"],
        pattern=words["pattern"],
        sizes=tuple(_size_bar(effect, size) for size in _sizes(findings, ranked)),
        taken_up=share_words(ranked.hidden_share),
        rms_after=worded(ranked.rms_after),
        look_alikes=_look_alikes(findings, effect, words["look_alikes"]),
        remedy=words["remedy"],
        check=_check_words(words["check"]),
        drawn=_drawn(findings, explanation, effect),
    )


def _check_words(check: CheckWords | None) -> str:
    if not check or not check["title"]:
        return ""
    return f"{check['title']}, about {check['minutes']:.0f} minutes"


def _explanation_with(findings: Findings, effect: str) -> Explanation:
    """Return the best explanation that has the effect."""
    known = (*findings.diagnosis.fits, findings.used)
    return next(each for each in known if effect in each.effects)


def _sizes(findings: Findings, ranked: Ranked) -> tuple[Size, ...]:
    """Return the sizes in the best explanation with the effect; alone where none has it."""
    for explanation in findings.diagnosis.explanations:
        if ranked.effect in explanation.sizes:
            return explanation.sizes[ranked.effect]
    return ranked.sizes


def _size_bar(effect: str, size: Size) -> SizeBar:
    name = f"{effect}.{size.name}"
    known = plausible_range(name)
    ends = [
        end
        for end in (known.low, known.high, size.low, size.high, size.value, 0.0)
        if end is not None and np.isfinite(end)
    ]
    least, most = min(ends), max(ends)
    length = (most - least) or 1.0

    def place(value: float) -> float:
        return 100 * (MARGIN + (1 - 2 * MARGIN) * (value - least) / length)

    bounded = np.isfinite(known.low) and np.isfinite(known.high)
    return SizeBar(
        said=plain_size(name, size.value, size.low, size.high),
        range_said=plain_range(name, known.low, known.high) if bounded else "no limit known",
        low=None if size.low is None else place(size.low),
        high=None if size.high is None else place(size.high),
        at=place(size.value),
        range_low=place(known.low if np.isfinite(known.low) else least),
        range_high=place(known.high if np.isfinite(known.high) else most),
        zero=place(0.0),
        possible=size.possible,
    )


def _look_alikes(findings: Findings, effect: str, said: str) -> str:
    """Return the explanations without this effect that draw nearly the same arrows here, with how
    far they are apart; what the catalogue says where there is none.
    """
    explanations = findings.diagnosis.explanations
    near = [
        (apart, other)
        for (i, j), apart in findings.diagnosis.differences.items()
        for mine, other in ((i, j), (j, i))
        if effect in explanations[mine].effects and effect not in explanations[other].effects
    ]
    said = _with_nouns(said)
    if not near:
        return said
    apart, other = ranked(near, lambda each: each[0])[0]
    return (
        f"{plainly(explanations[other].effects)}: on these marks only {worded(apart)} RMS apart. "
        f"In general: {said}"
    )


def _with_nouns(said: str) -> str:
    """Return the sentence with the nouns of effects and of the frame's numbers, for their names."""
    nouns = {words["name"]: words["noun"] for words in (*every_effect(), *frame_words())}
    return NAME.sub(lambda name: nouns.get(name[0], name[0]), said)


def _drawn(findings: Findings, explanation: Explanation, effect: str) -> Drawn:
    """Return both fingerprints of an effect in the size that the explanation gives it."""
    sheet = findings.framed.model.sheet
    print_of = fingerprint_of(explanation, effect, findings.rows)

    def picture(kind: str, field: Array) -> str:
        panel = Panel("", print_of.places, field)
        scale = Scale.of([spots_of(panel)], sheet)
        name, says = f"{effect} {kind}", "arrows over the sheet"
        return arrow_map(panel, scale, FINGERPRINT, name=name, says=says)

    pictures = [
        picture(kind, field) if length > UNSEEN else ""
        for kind, field, length in (
            ("alone", print_of.alone, print_of.alone_rms),
            ("beyond", print_of.beyond, print_of.beyond_rms),
        )
    ]
    return Drawn(pictures[0], worded(print_of.alone_rms), pictures[1], worded(print_of.beyond_rms))
