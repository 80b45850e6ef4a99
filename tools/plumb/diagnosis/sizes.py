"""Sizes of effects: fitted with intervals, hidden in the frame, and how large they could be."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Annotated

import numpy as np
import scipy

from plumb.diagnosis.explanation import Explanation, beyond, covariance_of, span
from plumb.diagnosis.noise import Noise
from plumb.fit.expected import plausible_range, range_said
from plumb.model.catalogue import parameter_words
from plumb.model.plain import plain_size
from plumb.text.answers import Internal, in_json, key, meant
from plumb.text.values import Unit

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
