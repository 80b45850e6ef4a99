"""What the diagnosis of a board was worth, as the bench, which knows the truth, sees it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated, Any

import numpy as np

from plumb.bench.boards import BoardCut, cut
from plumb.bench.causes import MAKER, Cause, Hidden, Plan
from plumb.diagnosis import Diagnosis
from plumb.diagnosis.explanation import Board, Explanation, explain, span
from plumb.fit.observations import Observations, observe
from plumb.model.catalogue import effect_names, parameter_words
from plumb.text.answers import Number, key

Array = np.ndarray
ALIKE = 0.98  # |cosine| after the refit above which two causes draw the same arrows
NAMED = ("one_suspect", "cannot_tell")


@dataclass(frozen=True)
class Outcome:
    """One board's truth and what was said of it."""

    cause: str  # what was hidden, in words
    verdict: str
    suspects: tuple[str, ...]
    named: bool  # whether effects were named
    right_first: bool  # the first effects named, or first of the ranking, draw the truth's arrows
    exactly_first: bool  # they are the truth itself
    inside: bool  # the truth is among what was named, or could hide where nothing was proved
    covered: bool  # an explanation has all of the truth but what could hide, and nothing else
    invented: bool  # all explanations share an effect that is not there, nor draws its arrows
    both: bool  # all hidden effects are among the suspects
    slip_named: bool  # the slipped readings, and only they, were named
    false_slip: bool  # a reading was named that is right
    small_slip: bool  # the slip, if there is any, is small
    intervals: tuple[int, int]  # parameters of the truth inside their intervals, and in all
    limits: tuple[int, int]  # effects whose truth lies below what could hide, and in all


def outcome_of(
    diagnosis: Diagnosis,
    board: BoardCut,
    *,
    alike: frozenset[str],
    slipped: tuple[str, ...] = (),
    small_slip: bool = False,
) -> Outcome:
    """Judge a diagnosis; alike are effects that draw the same arrows as the hidden effect."""
    hidden = board.machine.hidden
    truth = set(hidden.effects)
    named = diagnosis.verdict in NAMED
    first = _first(diagnosis)
    limits = _limits(diagnosis, hidden)
    own_limits = [good for effect, good in limits if effect in truth]
    held = any(set(explanation.effects) == truth for explanation in diagnosis.explanations)
    return Outcome(
        cause=_words(hidden),
        verdict=diagnosis.verdict,
        suspects=diagnosis.suspects,
        named=named,
        right_first=set(first) == truth or (len(truth) == 1 and set(first) <= truth | alike),
        exactly_first=set(first) == truth,
        inside=held or (diagnosis.verdict == "nothing_provable" and all(own_limits)),
        covered=_is_covered(diagnosis, hidden, truth | alike),
        invented=named and bool(_in_all(diagnosis) - truth - alike - _background(hidden)),
        both=bool(truth) and truth <= set(diagnosis.suspects),
        slip_named=diagnosis.verdict == "slip"
        and {slip.name for slip in diagnosis.outliers} == set(slipped),
        false_slip=bool({slip.name for slip in diagnosis.outliers} - set(slipped)),
        small_slip=small_slip,
        intervals=_intervals(diagnosis, hidden),
        limits=(sum(good for _, good in limits), len(limits)),
    )


def _in_all(diagnosis: Diagnosis) -> set[str]:
    """Return the effects of which the lab is sure: those in every explanation."""
    return set.intersection(*(set(explanation.effects) for explanation in diagnosis.explanations))


def _background(hidden: Hidden) -> set[str]:
    """Return what is there on every machine."""
    return {cause.effect for cause, _ in hidden.usual}


def _is_covered(diagnosis: Diagnosis, hidden: Hidden, allowed: set[str]) -> bool:
    """Return whether an explanation of nothing else leaves only what could hide."""
    allowed = allowed | _background(hidden)
    small = {effect for effect, good in _limits(diagnosis, hidden) if good}
    explanations = [set(explanation.effects) for explanation in diagnosis.explanations]
    if diagnosis.verdict == "nothing_provable":
        explanations.append(set())
    return any(
        effects <= allowed and set(hidden.effects) - effects <= small for effects in explanations
    )


def _first(diagnosis: Diagnosis) -> tuple[str, ...]:
    if diagnosis.explanations:
        return diagnosis.explanations[0].effects
    return (diagnosis.ranking[0].effect,)


def _words(hidden: Hidden) -> str:
    words = [f"{cause.effect}, {cause.label}" for cause, _ in hidden.causes]
    return " and ".join(words + [hidden.outside] * bool(hidden.outside)) or "nothing"


def _truths(hidden: Hidden) -> dict[str, float]:
    """Return the true value of each parameter of the library by its full name."""
    diagnosis = {
        name: MAKER.effects.get(name.partition(".")[0], {}).get(name.partition(".")[2], 0.0)
        for name in parameter_words()
    }
    for cause, size in (*hidden.usual, *hidden.causes):
        for name, value in cause.sizes(size).items():
            diagnosis[f"{cause.effect}.{name}"] = value
    return diagnosis


def _intervals(diagnosis: Diagnosis, hidden: Hidden) -> tuple[int, int]:
    """Return how many intervals hold, and how many there are, of the explanation that is
    the truth.
    """
    truths, good, count = _truths(hidden), 0, 0
    for explanation in diagnosis.explanations:
        if set(explanation.effects) != set(hidden.effects):
            continue
        for effect, sizes in explanation.sizes.items():
            for size in sizes:
                if size.low is not None and size.high is not None:
                    good += size.low <= truths[f"{effect}.{size.name}"] <= size.high
                    count += 1
    return good, count


def _limits(diagnosis: Diagnosis, hidden: Hidden) -> list[tuple[str, bool]]:
    """Return each effect that the marks feel, and whether its true size is below what could
    hide.
    """
    truths, judged = _truths(hidden), []
    if hidden.outside or diagnosis.verdict in ("slip", "not_in_library"):
        return []
    for room in diagnosis.could_hide:
        below = [
            abs(truths[f"{room.effect}.{limit.name}"]) <= limit.largest * (1 + 1e-9)
            for limit in room.limits
            if limit.largest is not None
        ]
        if room.mm is not None:
            judged.append((room.effect, all(below)))
    return judged


_ALIKE: dict[tuple[Any, ...], frozenset[str]] = {}


def look_alikes(cause: Cause, size: float, plan: Plan, noise: float) -> frozenset[str]:
    """Effects that draw the same arrows as this cause on these marks, with the frame refitted."""
    key = (cause.effect, cause.label, plan.targets.tobytes(), plan.spans, round(size, 3), noise)
    if key not in _ALIKE:
        _ALIKE[key] = _look_alikes(cause, size, plan, noise)
    return _ALIKE[key]


def _look_alikes(cause: Cause, size: float, plan: Plan, noise: float) -> frozenset[str]:
    there, clean = (
        observe(MAKER, cut(hidden, plan, seed=0, noise=0.0).measurements)
        for hidden in (Hidden(((cause, size),)), Hidden())
    )
    frame = explain(Board.of(MAKER, clean, sigma=noise))
    moved = np.zeros(len(frame.residual))
    moved[: clean.count] = (_numbers(there) - _numbers(clean)) / noise
    left = moved - frame.basis @ (frame.basis.T @ moved)
    return frozenset(
        name
        for name in effect_names()
        if name != cause.effect and _cosine(frame, name, left) > ALIKE
    )


def _numbers(rows: Observations) -> Array:
    return np.concatenate([rows.measured.ravel(), rows.distances])


def _cosine(frame: Explanation, effect: str, left: Array) -> float:
    """Return the cosine of the angle between what a cause leaves beyond the frame and the nearest
    of an effect.
    """
    raw = frame.slopes[:, frame.board.columns([effect])]
    if not np.any(raw):
        return 0.0
    basis = span(frame.beyond_fit([effect]), against=raw)
    return float(np.linalg.norm(basis.T @ left)) / max(float(np.linalg.norm(left)), 1e-9)


# Rates over many boards, with how far they may be off, next to the lines to be reached.

SURE = 1.96  # standard deviations by which a rate must miss its line to be called missed
JUDGED = ("reached", "missed", "open")


@dataclass(frozen=True)
class Rate:
    """A mean over boards."""

    name: Annotated[str, key("rate")]
    value: Number
    error: Number  # standard deviation of it, as another draw of boards would show
    count: int


@dataclass(frozen=True)
class Line:
    """What a rate should reach."""

    name: str  # of the rate
    least: float | None = None
    most: float | None = None

    def judge(self, rate: Rate) -> str:
        """`reached`, `missed`, or `open` where this many boards cannot tell."""
        low = -np.inf if self.least is None else self.least
        high = np.inf if self.most is None else self.most
        if low <= rate.value <= high:
            return "reached"
        apart = low - rate.value if rate.value < low else rate.value - high
        return "missed" if apart > SURE * rate.error else "open"

    @property
    def words(self) -> str:
        """The line for people."""
        if self.least is not None and self.most is not None:
            return f"{self.least:g} .. {self.most:g}"
        return f">= {self.least:g}" if self.least is not None else f"<= {self.most:g}"


Counted = Callable[[Outcome], "tuple[float, float]"]  # of a board: how much, of how much


def _share(of: Callable[[Outcome], bool]) -> Counted:
    return lambda outcome: (float(of(outcome)), 1.0)


def _among(of: Callable[[Outcome], bool], good: Callable[[Outcome], bool]) -> Counted:
    return lambda outcome: (float(of(outcome) and good(outcome)), float(of(outcome)))


def _has_small_slip(outcome: Outcome) -> bool:
    return outcome.small_slip


def _has_large_slip(outcome: Outcome) -> bool:
    return not outcome.small_slip


MEASURES: Mapping[str, Counted] = {
    "false naming": _share(lambda outcome: outcome.verdict in NAMED),
    "silent": _share(lambda outcome: outcome.verdict == "nothing_provable"),
    "named": _share(lambda outcome: outcome.verdict in NAMED),
    "right class first": _share(lambda outcome: outcome.right_first),
    "suspects": lambda outcome: (float(len(outcome.suspects)), float(bool(outcome.suspects))),
    "truth inside": _share(lambda outcome: outcome.inside),
    "truth covered": _share(lambda outcome: outcome.covered),
    "not in library": _share(lambda outcome: outcome.verdict == "not_in_library"),
    "invented": _share(lambda outcome: outcome.invented),
    "both": _share(lambda outcome: outcome.both),
    "flagged": _share(lambda outcome: outcome.verdict in ("not_in_library", "slip")),
    "slip named": _share(lambda outcome: outcome.slip_named),
    "large slip named": _among(_has_large_slip, lambda outcome: outcome.slip_named),
    "small slip named": _among(_has_small_slip, lambda outcome: outcome.slip_named),
    "false slip": _share(lambda outcome: outcome.false_slip),
    "effect named first": _share(lambda outcome: outcome.verdict in NAMED),
    "interval holds": lambda outcome: (float(outcome.intervals[0]), float(outcome.intervals[1])),
    "limit holds": lambda outcome: (float(outcome.limits[0]), float(outcome.limits[1])),
}


def rate_of(name: str, outcomes: Sequence[Outcome]) -> Rate:
    """Return one rate over boards; a share that was 0 or 1 throughout is given the error of one
    board.
    """
    counted = np.array([MEASURES[name](outcome) for outcome in outcomes], dtype=float).reshape(
        -1, 2
    )
    of = counted[:, 1].sum()
    if not of:
        return Rate(name, float("nan"), float("nan"), 0)
    value = counted[:, 0].sum() / of
    # Of a ratio of sums, since boards differ in how much they count.
    apart = counted[:, 0] - value * counted[:, 1]
    error = float(np.sqrt(np.sum(apart**2))) / of
    return Rate(name, float(value), max(error, 1 / of if name != "suspects" else 0.0), int(of))
