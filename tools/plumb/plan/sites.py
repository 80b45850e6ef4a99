"""Places on the sheet that are worth a mark, as far as the machine reaches them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from plumb.board.visits import loaded
from plumb.model.predict import USABLE, reach, settings_of, values_of
from plumb.model.reach import with_soft_chains
from plumb.settings.machine import MachineSettings

Array = np.ndarray
COLUMNS, ROWS = 7, 5  # of the grid of new places
MARGIN = (
    0.05,
    0.09,
)  # of the sheet's width and height: closer to the edge the sled would tip over the edge
NEAR = 60.0  # [mm] nearer than this a new mark counts as the old mark


def grid(
    sheet: tuple[float, float],
    columns: int = COLUMNS,
    rows: int = ROWS,
    *,
    margin: tuple[float, float] = MARGIN,
) -> Array:
    """Places (n, 2) [mm] spread over the sheet, from the top left, in whole 10 mm."""
    reach_x, reach_y = ((0.5 - share) * side for share, side in zip(margin, sheet, strict=True))
    across = np.linspace(-reach_x, reach_x, columns) if columns > 1 else np.zeros(1)
    up = np.linspace(reach_y, -reach_y, rows) if rows > 1 else np.zeros(1)
    return np.round(np.array([(x, y) for y in up for x in across]), -1)


def new_places(sheet: tuple[float, float], known: Array) -> Array:
    """Places of the grid that are not near one of the known targets (n, 2) [mm]."""
    places = grid(sheet)
    if not len(known):
        return places
    gaps = np.linalg.norm(places[:, np.newaxis] - known[np.newaxis], axis=2).min(axis=1)
    far: Array = places[gaps > NEAR]
    return far


def usable(settings: MachineSettings, places: Array, sled_weight: float) -> Array:
    """Whether a sled of that weight [N] may be sent to each place (n,): neither too tight nor too
    slack nor too soft by our model."""
    machine = with_soft_chains(settings.as_plumb_model())[0]
    loaded_values, _ = loaded(values_of(machine), sled_weight, machine.sled_weight)
    heavy = settings_of(loaded_values, like=replace(machine, sled_weight=sled_weight))
    is_usable: Array = reach(heavy, places).verdict == USABLE
    return is_usable
