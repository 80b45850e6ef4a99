"""What a lab effect is: parameters, words for people, and how it changes what is measured.

The words are those of the firmware's effects (lib/Kinematics/src/effect.h); the place differs.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
SLED = "sled"  # the sled comes to rest elsewhere, before the turn of the sheet
EDGES = "edges"  # what is read from the sheet's edges; distances between marks are as before
TAPE = "tape"  # everything that is read from a tape, distances too


@dataclass(frozen=True)
class Seen:
    """Places before an effect acts, and what it may look at besides."""

    places: Array  # (n, 2) [mm]
    approaches: Array  # (n, 2) unit vectors of the last move; zero where it is not known
    compliance: Array  # (n, 2, 2) [mm/N] of the hanging sled; zero for effects not on the sled


@dataclass(frozen=True)
class Change:
    """What an effect does to places, and its slopes with everything else held."""

    moved: Array  # (n, 2) [mm] to be added to the places
    by_parameter: Array  # (n, 2, p) [mm per unit]
    by_place: Array  # (n, 2, 2) of `moved` by the places themselves


@dataclass(frozen=True)
class LabParameter:
    """The words of a parameter for people; zero always means absent."""

    name: str
    unit: str
    low: float  # physically plausible range
    high: float
    typical: float  # size met in real workshops
    summary: str

    @property
    def words(self) -> dict[str, Any]:
        """The parameter in the form of the firmware's library; no setting holds it."""
        return {
            "name": self.name,
            "setting": None,
            "unit": self.unit,
            "low": self.low,
            "high": self.high,
            "typical": self.typical,
            "summary": self.summary,
        }


@dataclass(frozen=True)
class LabEffect:
    """One physical cause that lies in what is measured and never in what the machine is sent.

    Two laws hold for each: with every parameter zero no bit of any place changes, and every
    parameter has a slope at zero.
    """

    name: str
    summary: str  # the cause, in a sentence
    pattern: str  # what it does to marks on the sheet
    look_alikes: str
    remedy: str  # how to tell it apart or cure it
    needs: str  # what measurements must hold to feel it
    acts_on: str  # SLED, EDGES or TAPE
    parameters: tuple[LabParameter, ...]
    change: Callable[[Array, Seen], Change]  # of parameters (p,) and what is seen

    @property
    def parameter_names(self) -> tuple[str, ...]:
        """The parameters as a fit names them: `effect.parameter`."""
        return tuple(f"{self.name}.{parameter.name}" for parameter in self.parameters)

    @property
    def words(self) -> dict[str, Any]:
        """The effect in the form of the firmware's library, marked `lab`."""
        return {
            "name": self.name,
            "where": "lab",
            "summary": self.summary,
            "pattern": self.pattern,
            "look_alikes": self.look_alikes,
            "remedy": self.remedy,
            "empirical": False,
            "parameters": [parameter.words for parameter in self.parameters],
        }
