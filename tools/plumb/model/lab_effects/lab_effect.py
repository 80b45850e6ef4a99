"""What a lab effect is: how it changes what is measured."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from plumb.model.python_effect import PythonEffect, PythonParameter

Array = NDArray[np.float64]
SLED = "sled"  # the sled comes to rest elsewhere, before the turn of the sheet
EDGES = "edges"  # what is read from the sheet's edges; distances between marks are as before
TAPE = "tape"  # everything that is read from a tape, distances too


@dataclass(frozen=True)
class Seen:
    """Places before an effect acts, and what else it may read."""

    places: Array  # (n, 2) [mm]
    approaches: Array  # (n, 2) unit vectors of the last move; zero where it is not known
    compliance: Array  # (n, 2, 2) [mm/N] of the hanging sled; zero for effects not on the sled


@dataclass(frozen=True)
class Change:
    """What an effect does to places, and its slopes with everything else held."""

    moved: Array  # (n, 2) [mm] to be added to the places
    by_parameter: Array  # (n, 2, p) [mm per unit]
    by_place: Array  # (n, 2, 2) of `moved` by the places themselves


LabParameter = PythonParameter


@dataclass(frozen=True, kw_only=True)
class LabEffect(PythonEffect):
    """One physical cause that lies in what is measured and never in what the machine is sent."""

    where: ClassVar[str] = "lab"

    needs: str  # what measurements must hold to feel it
    acts_on: str  # SLED, EDGES or TAPE
    change: Callable[[Array, Seen], Change]  # of parameters (p,) and what is seen
    hidden_as: str  # what the bench does to a board by the first parameter: drag, skew or strain
