"""What a diagnosis of one board was worth, as the bench, which knows the truth, sees it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from plumb.bench.boards import BoardCut, cut
from plumb.bench.causes import MAKER, Cause, Hidden, Plan
from plumb.board.observations import Observations, observe
from plumb.diagnose import Diagnosis
from plumb.diagnose.explanation import Board, Explanation, explain, span
from plumb.model.catalogue import effect_names, parameter_words

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
    both: bool  # all hidden effects are among the suspects
    slip_named: bool  # the slipped readings, and only they, were named
    intervals: tuple[int, int]  # parameters of the truth inside their intervals, and in all
    limits: tuple[int, int]  # effects whose truth lies below what could hide, and in all


def outcome_of(
    found: Diagnosis, board: BoardCut, *, alike: frozenset[str], slipped: tuple[str, ...] = ()
) -> Outcome:
    """Judge one diagnosis; alike are effects that draw the same arrows as the one hidden."""
    hidden = board.machine.hidden
    truth = set(hidden.effects)
    named = found.verdict in NAMED
    first = _first(found)
    limits = _limits(found, hidden)
    own_limits = [good for effect, good in limits if effect in truth]
    held = any(set(one.effects) == truth for one in found.explanations)
    return Outcome(
        cause=_words(hidden),
        verdict=found.verdict,
        suspects=found.suspects,
        named=named,
        right_first=set(first) == truth or (len(truth) == 1 and set(first) <= truth | alike),
        exactly_first=set(first) == truth,
        inside=held or (found.verdict == "nothing_provable" and all(own_limits)),
        both=bool(truth) and truth <= set(found.suspects),
        slip_named=found.verdict == "slip" and {one.name for one in found.slips} == set(slipped),
        intervals=_intervals(found, hidden),
        limits=(sum(good for _, good in limits), len(limits)),
    )


def _first(found: Diagnosis) -> tuple[str, ...]:
    if found.explanations:
        return found.explanations[0].effects
    return (found.ranking[0].effect,)


def _words(hidden: Hidden) -> str:
    words = [f"{cause.effect}, {cause.label}" for cause, _ in hidden.causes]
    return " and ".join(words + [hidden.outside] * bool(hidden.outside)) or "nothing"


def _truths(hidden: Hidden) -> dict[str, float]:
    """The true value of each parameter of the library by its full name."""
    found = {
        name: MAKER.effects.get(name.partition(".")[0], {}).get(name.partition(".")[2], 0.0)
        for name in parameter_words()
    }
    for cause, size in hidden.causes:
        for name, value in cause.sizes(size).items():
            found[f"{cause.effect}.{name}"] = value
    return found


def _intervals(found: Diagnosis, hidden: Hidden) -> tuple[int, int]:
    """Of the explanation that is the truth, wherever it stands in the list."""
    truths, good, count = _truths(hidden), 0, 0
    for one in found.explanations:
        if set(one.effects) != set(hidden.effects):
            continue
        for effect, sizes in one.sizes.items():
            for size in sizes:
                if size.low is not None:
                    good += size.low <= truths[f"{effect}.{size.name}"] <= size.high
                    count += 1
    return good, count


def _limits(found: Diagnosis, hidden: Hidden) -> list[tuple[str, bool]]:
    """For each effect that the marks feel: whether its true size is below what could hide."""
    truths, judged = _truths(hidden), []
    if hidden.outside or found.verdict in ("slip", "not_in_library"):
        return []
    for room in found.could_hide:
        if room.mm is None:
            continue
        good = all(
            abs(truths[f"{room.effect}.{name}"]) <= largest * (1 + 1e-9)
            for name, largest, _ in room.limits
        )
        judged.append((room.effect, good))
    return judged


_ALIKE: dict[tuple, frozenset[str]] = {}


def look_alikes(cause: Cause, size: float, own: Plan, noise: float) -> frozenset[str]:
    """Effects that draw the same arrows as this cause on these marks, with the frame refitted."""
    key = (cause.effect, cause.label, own.targets.tobytes(), own.spans, round(size, 3), noise)
    if key not in _ALIKE:
        _ALIKE[key] = _look_alikes(cause, size, own, noise)
    return _ALIKE[key]


def _look_alikes(cause: Cause, size: float, own: Plan, noise: float) -> frozenset[str]:
    there, clean = (
        observe(MAKER, cut(hidden, own, seed=0, noise=0.0).measurements)
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
    """Of the angle between what a cause leaves beside the frame and the nearest of an effect."""
    raw = frame.slopes[:, frame.board.columns([effect])]
    if not np.any(raw):
        return 0.0
    basis = span(frame.beyond_fit([effect]), against=raw)
    return float(np.linalg.norm(basis.T @ left) / max(np.linalg.norm(left), 1e-9))
