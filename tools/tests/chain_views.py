"""Errors of marks seen by the chains, straight from a machine's numbers: the lab is held to it."""

from typing import NamedTuple

import numpy as np
from plumb.fit.compare import chain_errors, hung_places
from plumb.fit.observations import sighted
from plumb.model.predict import settings_of


class ChainView(NamedTuple):
    """The same errors [mm] on the sheet and in chain, (k, 2) each."""

    errors: np.ndarray
    chains: np.ndarray


def chain_view(values, outside, rows, like) -> ChainView:
    """Return the marks of `rows` seen by a machine with `values`; `outside` as in sighted()."""
    model, marked = settings_of(values, like=like), rows.mark_rows
    how = {"over_top": like.feed == "top", "usual_weight": like.sled_weight, "names": ()}
    errors = rows.measured - sighted(values, outside, rows, **how).read.where[marked]
    places, weights = hung_places(model, rows)[marked], rows.sled_weights[marked]
    return ChainView(errors, chain_errors(model, places, errors, weights))
