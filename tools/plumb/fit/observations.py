"""Observations for a fit: chains that were paid out, and where the sled was measured."""

from dataclasses import dataclass, field
from functools import partial

import numpy as np

from plumb.marks.read import Measurements
from plumb.model.catalogue import WEIGHT_POWERS, ZEROING_NAMES
from plumb.model.predict import (
    NAMES,
    believed_lengths,
    lengths,
    places_with_slopes,
    settings_of,
    values_of,
)
from plumb.settings.machine import MachineSettings
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
