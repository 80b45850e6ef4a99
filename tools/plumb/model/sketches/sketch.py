"""What a sketch is: words for people, parameters, and how much longer it makes each chain."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from plumb.model.lab_effects.lab_effect import LabParameter

Array = NDArray[np.float64]
SketchParameter = LabParameter  # described in the same words


@dataclass(frozen=True)
class Strands:
    """Both strands of each visit as a sketch sees them; columns are left and right."""

    span: Array  # (n, 2) [mm] free chain between sprocket and ring
    across: Array  # (n, 2) [1] cosine of the strand's angle below the horizontal
    down: Array  # (n, 2) [1] its sine
    tension: Array  # (n, 2) [N]
    length: Array  # (n, 2) [mm] chain beyond the sprocket by all effects of the machine
    places: Array  # (n, 2) [mm] x and y of the sled


@dataclass(frozen=True)
class Sketch:
    """One physical cause on trial. Two laws hold as for every effect: with all parameters zero the
    chains are as long as before, and every parameter has a slope at zero."""

    name: str
    summary: str  # the cause, in a sentence
    pattern: str  # what it does to marks on the sheet
    look_alikes: str
    remedy: str  # how to tell it apart or cure it
    parameters: tuple[SketchParameter, ...]
    extra: Callable[[Array, Strands], Array]  # of parameters (p,): chain more (n, 2) [mm]

    @property
    def parameter_names(self) -> tuple[str, ...]:
        """The parameters as a fit names them: `effect.parameter`."""
        return tuple(f"{self.name}.{parameter.name}" for parameter in self.parameters)

    @property
    def words(self) -> dict[str, Any]:
        """The effect in the form of the firmware's library, marked `sketch`."""
        return {
            "name": self.name,
            "where": "sketch",
            "summary": self.summary,
            "pattern": self.pattern,
            "look_alikes": self.look_alikes,
            "remedy": self.remedy,
            "empirical": False,
            "parameters": [parameter.words for parameter in self.parameters],
        }
