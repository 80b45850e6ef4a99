"""Errors on the sheet seen by the chains: how much more of each chain the measured place needs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from plumb.board.observations import Observations
from plumb.board.sighting import sighted
from plumb.board.visits import chains_to
from plumb.model.predict import FOUND, Array, settings_of, values_of
from plumb.settings.machine import MachineSettings


@dataclass(frozen=True)
class ChainView:
    """The errors of marks as errors of the left and the right chain, by a model of the machine."""

    model: MachineSettings
    names: tuple[str, ...]  # (k,) of the marks
    places: Array  # (k, 2) [mm] where the sled hangs for each mark, on the machine
    errors: Array  # (k, 2) [mm] measured - predicted, x and y on the sheet
    chains: Array  # (k, 2) [mm] the same, left and right chain; nan where no chain reaches


def chain_view(
    values: Array, outside: Mapping[str, float], rows: Observations, like: MachineSettings
) -> ChainView:
    """The marks of `rows` seen by a machine with `values`; `outside` as in sighting.py."""
    model = settings_of(values, like=like)
    predicted = sighted(
        values,
        outside,
        rows,
        over_top=like.feed == "top",
        usual_weight=like.sled_weight,
        names=(),
    ).read.where[rows.mark_rows]
    places = hung_places(model, rows)[rows.mark_rows]
    errors = rows.measured - predicted
    weights = rows.sled_weights[rows.mark_rows]
    return ChainView(
        model, rows.names, places, errors, chain_errors(model, places, errors, weights)
    )


def hung_places(model: MachineSettings, rows: Observations) -> Array:
    """Where the sled hangs on each visit (r, 2) [mm], whatever the sheet and the tape do."""
    hung = sighted(
        values_of(model),
        {},
        rows,
        over_top=model.feed == "top",
        usual_weight=model.sled_weight,
        names=(),
    )
    return hung.read.where


def chain_errors(model: MachineSettings, places: Array, errors: Array, weights: Array) -> Array:
    """How much more of each chain (n, 2) [mm] a sled needs at places + errors than at the places.

    nan where no chain reaches.
    """
    there, reached = chains_to(model, places + errors, weights)
    here, hanging = chains_to(model, places, weights)
    good = (reached == FOUND) & (hanging == FOUND)
    more: Array = np.where(good[:, np.newaxis], there - here, np.nan)
    return more
