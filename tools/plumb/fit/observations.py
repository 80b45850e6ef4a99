"""Observations for a fit: chains that were paid out, and where the sled was measured."""

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache, partial
from typing import NamedTuple

import numpy as np

from plumb import _core
from plumb.marks.read import Measurements
from plumb.model.catalogue import (
    EDGES,
    LAB_EFFECTS,
    SLED,
    WEIGHT_POWERS,
    ZEROING_NAMES,
    LabEffect,
    Seen,
)
from plumb.model.predict import (
    NAMES,
    believed_lengths,
    compliance,
    frame_words,
    lengths,
    library,
    places_with_slopes,
    settings_of,
    values_of,
)
from plumb.settings import MachineSettings
from plumb.text.errors import InputError

Array = np.ndarray


# Where nothing was read.
NO_PLACES, NO_LENGTHS = partial(np.zeros, (0, 2)), partial(np.zeros, 0)
NO_ROWS, NO_PAIRS = partial(np.zeros, 0, dtype=int), partial(np.zeros, (0, 2), dtype=int)


@dataclass(frozen=True, kw_only=True)
class Observations:
    """Rows of chains paid out, and what was measured of the places they led to.

    A row is one visit of the sled. Marks are rows whose place was measured; distances join the
    places of two rows.
    """

    chains: Array  # (r, 2) [mm] paid out, by what the machine believed
    sled_weights: Array  # (r,) [N]
    mark_rows: Array = field(default_factory=NO_ROWS)  # (k,) the row of each measured mark
    measured: Array = field(default_factory=NO_PLACES)  # (k, 2) [mm]
    targets: Array = field(default_factory=NO_PLACES)  # (k, 2) [mm]
    names: tuple[str, ...] = ()  # (k,) of the marks
    distance_rows: Array = field(default_factory=NO_PAIRS)  # (m, 2) the rows at both ends
    distances: Array = field(default_factory=NO_LENGTHS)  # (m,) [mm]
    # (m,) int: the file of each; its rows may be visits of an earlier file
    distance_rounds: Array = field(default_factory=NO_ROWS)
    approaches: Array  # (r, 2) unit vectors of the last move of each visit; zero if not known
    rounds: Array  # (r,) int: the file of each visit
    zero_groups: Array  # (r,) int: visits with equal numbers have the chains' zeros in common
    sheet_groups: Array  # (r,) int: visits with equal numbers lie on one sheet

    @property
    def count(self) -> int:
        """The number of measured numbers."""
        return 2 * len(self.measured) + len(self.distances)

    def rms_of(self, numbers: Array) -> float:
        """Root mean square of errors of the measured numbers (n or more,) [mm]: over the marks, as
        vectors, or over the distances where no mark was measured.
        """
        counted = numbers[: self.measured.size or self.count]
        return float(np.sqrt(counted @ counted / max(len(self.measured) or len(counted), 1)))

    def rms_of_noise(self, leverages: Array) -> float:
        """Return what a fit leaves of noise of 1 mm, counted alike; its leverages (n or more,)."""
        return self.rms_of(np.sqrt(np.maximum(1 - leverages, 0.0)))


def observe(
    settings: MachineSettings,
    measurements: Measurements,
    *,
    controller: str | None = None,
    sled_weight: float | None = None,
) -> Observations:
    """Return the observations of a board cut with these settings; raises InputError for a bad
    target.

    sled_weight [N] is that of marks whose file does not say it: by default what the settings say.
    """
    marks = measurements.marks
    targets = np.array([mark.target for mark in marks], dtype=float).reshape(-1, 2)
    chains = _paid_out(settings, measurements, targets, controller)
    for i, mark in enumerate(marks):
        if mark.chains is not None:
            chains[i] = mark.chains
    rows = [i for i, mark in enumerate(marks) if mark.measured is not None]
    first: dict[str, int] = {}
    for i, mark in enumerate(marks):
        first.setdefault(mark.name, i)
    ends = [[first[name] for name in distance.between] for distance in measurements.distances]
    usual = measurements.sled_weight or sled_weight or settings.sled_weight
    return Observations(
        chains=chains,
        sled_weights=np.array([mark.sled_weight or usual for mark in marks], dtype=float),
        mark_rows=np.array(rows, dtype=int),
        measured=measurements.measured,
        targets=targets[rows],
        names=tuple(marks[i].name for i in rows),
        distance_rows=np.array(ends, dtype=int).reshape(-1, 2),
        distances=measurements.distance_lengths,
        distance_rounds=np.array([each.round for each in measurements.distances], dtype=int),
        approaches=_directions([mark.approach or (0.0, 0.0) for mark in marks]),
        rounds=_rounds(measurements),
        zero_groups=_of_rounds(measurements, "zero_group"),
        sheet_groups=_of_rounds(measurements, "sheet_group"),
    )


def different_numbers(measurements: Measurements, rows: Observations) -> int:
    """Return how many numbers tell of different places: repeats tell of the noise alone."""
    spans = {frozenset(distance.between) for distance in measurements.distances}
    return 2 * len(set(rows.names)) + len(spans)


def _paid_out(
    settings: MachineSettings, measurements: Measurements, targets: Array, controller: str | None
) -> Array:
    """Chain (r, 2) [mm] paid out for each target by the settings in force in its round."""
    chains = np.zeros_like(targets)
    number = _rounds(measurements)
    for i, file_round in enumerate(measurements.rounds):
        in_force = file_round.cut_with or settings
        whose = controller or measurements.controller or in_force.controller
        mine = number == i
        try:
            chains[mine] = believed_lengths(in_force, targets[mine], controller=whose)
        except ValueError as error:
            raise InputError(
                f"{measurements.source}: {error}; check the target, or the settings it was cut with"
            ) from None
    return chains


def _rounds(measurements: Measurements) -> Array:
    """Return the round of each visit (r,)."""
    return np.array([mark.round for mark in measurements.marks], dtype=int)


def _of_rounds(measurements: Measurements, name: str) -> Array:
    """Return a number of each visit's round (r,)."""
    by_round = np.array(
        [getattr(file_round, name) for file_round in measurements.rounds], dtype=int
    )
    of_visits: Array = by_round[_rounds(measurements)]
    return of_visits


def _directions(moves: list[tuple[float, float]]) -> Array:
    """Return unit vectors (r, 2) of moves of any length; zero stays zero."""
    rows = np.array(moves, dtype=float).reshape(-1, 2)
    lengths = np.hypot(rows[:, 0], rows[:, 1])[:, np.newaxis]
    return rows / np.where(lengths > 0, lengths, 1.0)


def model_and_observations(
    settings: MachineSettings,
    measurements: Measurements,
    *,
    cut_with: MachineSettings | None = None,
    controller: str | None = None,
) -> tuple[MachineSettings, Observations]:
    """Our model of `settings`, and the observations of marks cut with `cut_with` (default: them).

    Published settings mean what the controller made of them; ours mean what they say.
    """
    in_force = cut_with or settings
    whose = controller or measurements.controller or in_force.controller
    published = settings.controller != "plumb" and whose != "plumb"
    model = settings.as_plumb_model(controller=whose if published else None)
    # Each round was moved by the formula of its settings, unless stated otherwise.
    rows = observe(in_force, measurements, controller=controller, sled_weight=model.sled_weight)
    return model, rows


# Where the sled went on each visit: our model under the sled's weight on that visit.

# Left and right: what each zeroing of the chains sets again.
ZERO_COLUMNS = tuple(NAMES.index(name) for name in ZEROING_NAMES)


def loaded(values: Array, weight: float, usual: float) -> tuple[Array, Array]:
    """Return the values for a sled of another weight [N], and each value's slope by the usual
    weight's.

    Some parameters are ratios to the sled's weight, so they follow a power of it.
    """
    loaded_values, factors = values.copy(), np.ones(len(values))
    if weight == usual:
        return loaded_values, factors
    loaded_values[NAMES.index("sled_weight")] = weight
    factors[NAMES.index("sled_weight")] = 0.0
    for name, power in WEIGHT_POWERS.items():
        column = NAMES.index(name)
        factors[column] = (weight / usual) ** power
        loaded_values[column] *= factors[column]
    return loaded_values, factors


def visited(
    values: Array,
    rows: Observations,
    *,
    over_top: bool,
    usual_weight: float,
    zeros: Array | None = None,
) -> tuple[Array, Array, Array]:
    """Return places (r, 2) [mm] of all visits, their slopes by the values (r, 2, v), and FOUND
    (r,).

    zeros (groups, 2) [mm] is what each zero group adds to ZEROING_NAMES, left and right.
    """
    where = np.zeros((len(rows.chains), 2))
    slopes = np.zeros((len(rows.chains), 2, len(NAMES)))
    outcome = np.zeros(len(rows.chains), dtype=int)
    for weight, group in {*zip(rows.sled_weights, rows.zero_groups, strict=True)}:
        mine = (rows.sled_weights == weight) & (rows.zero_groups == group)
        loaded_values, factors = loaded(values, weight, usual_weight)
        if zeros is not None:
            loaded_values[list(ZERO_COLUMNS)] += zeros[group]
        where[mine], of_mine, outcome[mine] = places_with_slopes(
            loaded_values, over_top=over_top, chains=rows.chains[mine]
        )
        slopes[mine] = of_mine * factors
    return where, slopes, outcome


def chains_to(model: MachineSettings, points: Array, weights: Array) -> tuple[Array, Array]:
    """Chain (n, 2) [mm] to places (n, 2) [mm] for sleds of these weights (n,) [N], and FOUND."""
    chains, outcome = np.zeros((len(points), 2)), np.zeros(len(points), dtype=int)
    for weight in np.unique(weights):
        mine = weights == weight
        loaded_values, _ = loaded(values_of(model), weight, model.sled_weight)
        chains[mine], outcome[mine] = lengths(settings_of(loaded_values, like=model), points[mine])
    return chains, outcome


def rms(errors: Array) -> float:
    """Root mean square length of errors (n, 2), or of numbers (n,) [mm]."""
    if len(errors) == 0:
        return float("nan")
    return float(np.sqrt(np.mean(np.sum(np.atleast_2d(errors.T).T ** 2, axis=1))))


# From where the sled hangs to what is measured: friction, the turned sheet, edges, the tape.


SHEET_ROTATION = "sheet_rotation"  # [rad] the sheet as measured, turned against the machine
LAB_NAMES = tuple(effect.parameter for effect in LAB_EFFECTS)  # no setting holds them
# A step for differences of the compliance, of each value's usual size: small against how it bends.
_STEP = 1e-3


@dataclass(frozen=True)
class Places:
    """Places with their slopes by the names that were asked for."""

    where: Array  # (r, 2) [mm]
    slopes: Array  # (r, 2, names) [mm per unit]


@dataclass(frozen=True)
class Sighting:
    """Predicted readings of every visit."""

    read: Places  # from the sheet's edges
    taped: Places  # places whose distances are those that a tape gives
    outcome: Array  # (r,) FOUND where the sled can hang

    def taped_spans(self, ends: Array) -> Array:
        """Return what a tape reads (m,) [mm] between the visits in each row of `ends` (m, 2)."""
        where = self.taped.where[ends]
        spans: Array = np.linalg.norm(where[:, 1] - where[:, 0], axis=1)
        return spans


def sighted(
    values: Array,
    outside: Mapping[str, float],
    rows: Observations,
    *,
    over_top: bool,
    usual_weight: float,
    names: Sequence[str],
) -> Sighting:
    """Return what is measured of a machine with `values` on a board with `outside`: SHEET_ROTATION
    and numbers of lab effects, zero if not named. Slopes are by `names` of any kind.
    """
    view = _View(values, outside, rows, over_top, usual_weight, tuple(names))
    zeros = zeros_of(outside, rows)
    where, by_value, outcome = visited(
        values, rows, zeros=zeros, over_top=over_top, usual_weight=usual_weight
    )
    slopes = np.zeros((*where.shape, len(names)))
    for i, name in enumerate(names):
        if name in NAMES:
            slopes[:, :, i] = by_value[:, :, NAMES.index(name)]
        elif (unknown := zero_of(name)) is not None:
            mine = rows.zero_groups == unknown.group
            slopes[mine, :, i] = by_value[mine][:, :, ZERO_COLUMNS[unknown.axis]]
    places = Places(where, slopes)
    for effect in LAB_EFFECTS:
        if effect.acts_on == SLED:
            places = view.on_sled(effect, places)
    read = taped = view.turned(places)
    for effect in LAB_EFFECTS:
        if effect.acts_on != SLED:
            read = view.on_sheet(effect, read)
            taped = taped if effect.acts_on == EDGES else view.on_sheet(effect, taped)
    return Sighting(read, taped, outcome)


@dataclass(frozen=True)
class _View:
    """A machine and a board, and the names whose slopes are asked for."""

    values: Array
    outside: Mapping[str, float]
    rows: Observations
    over_top: bool
    usual_weight: float
    names: tuple[str, ...]

    def turned(self, places: Places) -> Places:
        """Return the places turned with the sheet, and moved where a later sheet lies elsewhere."""
        moved = poses_of(self.outside, self.rows)[self.rows.sheet_groups]
        rotation = self.outside.get(SHEET_ROTATION, 0.0) + moved[:, 2]
        cosine, sine = np.cos(rotation), np.sin(rotation)
        turn = np.array([[cosine, -sine], [sine, cosine]])
        where = np.einsum("ijn,nj->ni", turn, places.where)
        slopes = np.einsum("ijn,njk->nik", turn, places.slopes)
        across = np.stack([-where[:, 1], where[:, 0]], axis=1)
        for i, name in enumerate(self.names):
            if name == SHEET_ROTATION:
                slopes[:, :, i] += across
            elif (unknown := pose_of(name)) is not None:
                mine = self.rows.sheet_groups == unknown.group
                by_axis = across[mine] if unknown.axis == 2 else np.eye(2)[unknown.axis]
                slopes[mine, :, i] += by_axis
        return Places(where + moved[:, :2], slopes)

    def on_sheet(self, effect: LabEffect, places: Places) -> Places:
        """Read by way of an effect of edges or tape."""
        if not self.asks_for(effect):
            return places
        stiff = np.zeros((len(places.where), 2, 2))
        change = effect.change(self.size(effect), Seen(places.where, self.rows.approaches, stiff))
        slopes = places.slopes + np.einsum("nij,njk->nik", change.by_place, places.slopes)
        return Places(places.where + change.moved, self.with_size(effect, change.by_size, slopes))

    def on_sled(self, effect: LabEffect, places: Places) -> Places:
        """Return the sled at rest elsewhere."""
        if not self.asks_for(effect) or not self.rows.approaches.any():
            return places
        size = self.size(effect)
        change = effect.change(size, self.seen(self.values, places.where))
        slopes = places.slopes.copy()
        if size:
            for i, name in enumerate(self.names):
                slopes[:, :, i] += self.by_difference(effect, name, places, i)
        return Places(places.where + change.moved, self.with_size(effect, change.by_size, slopes))

    def by_difference(self, effect: LabEffect, name: str, places: Places, i: int) -> Array:
        """Slope (r, 2) of the effect's move by a name: machine and place change together.

        The core gives first slopes only, and the compliance is made of them already. Its central
        differences are right to about a millionth.
        """
        if name not in NAMES:
            return np.zeros_like(places.where)
        step, size = _STEP * _SIZES[name], self.size(effect)
        ends = []
        for signed in (step, -step):
            values = self.values.copy()
            values[NAMES.index(name)] += signed
            seen = self.seen(values, places.where + signed * places.slopes[:, :, i])
            ends.append(effect.change(size, seen).moved)
        return (ends[0] - ends[1]) / (2 * step)

    def seen(self, values: Array, where: Array) -> Seen:
        """Return places with the compliance of the sled of each visit."""
        giving = np.zeros((len(where), 2, 2))
        for weight in np.unique(self.rows.sled_weights):
            mine = self.rows.sled_weights == weight
            loaded_values, _ = loaded(values, weight, self.usual_weight)
            giving[mine] = compliance(loaded_values, over_top=self.over_top, points=where[mine])
        return Seen(where, self.rows.approaches, giving)

    def size(self, effect: LabEffect) -> float:
        """Return the effect's number."""
        return self.outside.get(effect.parameter, 0.0)

    def asks_for(self, effect: LabEffect) -> bool:
        """Return whether the effect is there, or its slopes are wanted."""
        return effect.parameter in self.names or self.size(effect) != 0.0

    def with_size(self, effect: LabEffect, by_size: Array, slopes: Array) -> Array:
        """Return the slopes with those by the effect's number added."""
        if effect.parameter in self.names:
            slopes[:, :, self.names.index(effect.parameter)] += by_size
        return slopes


def _sizes() -> dict[str, float]:
    """Return the usual size of every value of the core."""
    sizes = {frame["name"]: abs(frame["usual"]) or 10.0 for frame in frame_words()}
    return sizes | {
        f"{effect['name']}.{parameter['name']}": abs(parameter["typical"])
        for effect in library()
        for parameter in effect["parameters"]
    }


_SIZES = _sizes()


# Differences between rounds of marks: chains zeroed again, another sheet.
#
# Each such round adds unknowns to those of the frame: how far the zeros of both chains moved, or
# how the sheet lies against the first.


ZERO_AXES = ("left", "right")
POSE_AXES = ("x", "y", "rotation")
# Standard deviations: a link or a tooth more or less is 6.35 mm; a sheet lies like the first.
ZERO_SIGMA = 10.0  # [mm]
POSE_SIGMAS = (20.0, 20.0, 0.02)  # [mm, mm, rad]
_ZERO = re.compile(r"zero(\d+)\.(left|right)")
_POSE = re.compile(r"sheet(\d+)\.(x|y|rotation)")


class RoundUnknown(NamedTuple):
    """An unknown of a later round."""

    group: int  # which zero group or sheet group
    axis: int  # index into ZERO_AXES or POSE_AXES


def round_priors(rows: Observations) -> dict[str, float]:
    """Return standard deviations [mm, rad] of all unknowns that later rounds have, by name."""
    priors: dict[str, float] = {}
    for group in range(1, _groups(rows.zero_groups)):
        priors |= {f"zero{group + 1}.{axis}": ZERO_SIGMA for axis in ZERO_AXES}
    # Distances between marks of one sheet do not feel where it lies.
    placed = set(rows.sheet_groups[rows.mark_rows].tolist())
    for group in range(1, _groups(rows.sheet_groups)):
        if group in placed:
            names = (f"sheet{group + 1}.{axis}" for axis in POSE_AXES)
            priors |= dict(zip(names, POSE_SIGMAS, strict=True))
    return priors


def unit_of(name: str) -> str | None:
    """Return the unit of an unknown of a round; None if it is none."""
    unknown = zero_of(name) or pose_of(name)
    if unknown is None:
        return None
    return "rad" if name.endswith(".rotation") else "mm"


def notes_on(names: Iterable[str]) -> list[str]:
    """Return a sentence for each group of round unknowns among these names."""
    groups = sorted({name.partition(".")[0] for name in names if unit_of(name)})
    meaning = {
        "zero": "how much more chain is out at 12 o'clock since the chains were zeroed again",
        "sheet": "how the new sheet lies against the first",
    }
    return [
        f"{group}: {meaning[group.rstrip('0123456789')]}; no setting holds it" for group in groups
    ]


@cache
def zero_of(name: str) -> RoundUnknown | None:
    """Return the chain zero that a name stands for."""
    return _parsed(_ZERO, ZERO_AXES, name)


@cache
def pose_of(name: str) -> RoundUnknown | None:
    """Return the part of a sheet's pose that a name stands for."""
    return _parsed(_POSE, POSE_AXES, name)


def zeros_of(outside: Mapping[str, float], rows: Observations) -> Array:
    """Return what each zero group adds to left and right chain zero, (groups, 2) [mm]."""
    return _filled(outside, _groups(rows.zero_groups), 2, zero_of)


def poses_of(outside: Mapping[str, float], rows: Observations) -> Array:
    """Return how each sheet lies against the first, (groups, 3): x, y [mm], rotation [rad]."""
    return _filled(outside, _groups(rows.sheet_groups), 3, pose_of)


def _groups(numbers: Array) -> int:
    return int(numbers.max(initial=0)) + 1


def last_turn_of(names: Iterable[str]) -> str:
    """Return the number that says how the last sheet is turned against the first; empty if none
    does.
    """
    turns = {
        unknown.group: name
        for name in names
        if (unknown := pose_of(name)) and POSE_AXES[unknown.axis] == "rotation"
    }
    return turns[max(turns)] if turns else ""


def _parsed(pattern: re.Pattern[str], axes: tuple[str, ...], name: str) -> RoundUnknown | None:
    match = pattern.fullmatch(name)
    return RoundUnknown(int(match[1]) - 1, axes.index(match[2])) if match else None


def _filled(
    outside: Mapping[str, float],
    groups: int,
    axes: int,
    parse: Callable[[str], RoundUnknown | None],
) -> Array:
    values_of_groups = np.zeros((groups, axes))
    for name, value in outside.items():
        unknown = parse(name)
        if unknown is not None:
            values_of_groups[unknown] = value
    return values_of_groups


@dataclass(frozen=True)
class Strands:
    """Both strands of each visit; columns are left and right."""

    span: Array  # (n, 2) [mm] free chain between sprocket and ring
    across: Array  # (n, 2) [1] cosine of the strand's angle below the horizontal
    down: Array  # (n, 2) [1] its sine
    tension: Array  # (n, 2) [N]
    length: Array  # (n, 2) [mm] chain beyond the sprocket by all effects of the machine


def strands_at(
    values: Array, rows: Observations, where: Array, *, over_top: bool, usual_weight: float
) -> Strands:
    """Return both strands of a sled at `where` (r, 2) [mm], as heavy as on each visit."""
    count = len(where)
    shown = {name: np.zeros((count, 2)) for name in ("free", "cosine", "sine", "pull", "length")}
    for weight in np.unique(rows.sled_weights):
        mine = rows.sled_weights == weight
        loaded_values, _ = loaded(values, weight, usual_weight)
        points = np.ascontiguousarray(where[mine])
        for name, column in _core.strands(loaded_values, over_top, points).items():
            if name in shown:
                shown[name][mine] = column
        shown["pull"][mine] *= loaded_values[NAMES.index("sled_weight")]
    free, cosine, sine, tension, length = shown.values()
    return Strands(free, cosine, sine, tension, length)
