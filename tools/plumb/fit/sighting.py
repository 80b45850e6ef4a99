"""From where the sled hangs to what is measured: friction, the turned sheet, edges, the tape."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from plumb.fit.observations import ZERO_COLUMNS, Observations, loaded, visited
from plumb.fit.rounds import pose_of, poses_of, zero_of, zeros_of
from plumb.model.lab_effects import EDGES, LAB_EFFECTS, SLED, Array, LabEffect, Seen
from plumb.model.predict import NAMES, compliance, frame_words, library

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
