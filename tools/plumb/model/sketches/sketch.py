"""What a sketch is: an effect on trial that makes chains longer or pushes the sled."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from plumb.model.python_effect import PythonEffect, PythonParameter

Array = NDArray[np.float64]
SketchParameter = PythonParameter


@dataclass(frozen=True)
class Strands:
    """Both strands of each visit as a sketch sees them; columns are left and right."""

    span: Array  # (n, 2) [mm] free chain between sprocket and ring
    across: Array  # (n, 2) [1] cosine of the strand's angle below the horizontal
    down: Array  # (n, 2) [1] its sine
    tension: Array  # (n, 2) [N]
    length: Array  # (n, 2) [mm] chain beyond the sprocket by all effects of the machine
    places: Array  # (n, 2) [mm] x and y of the sled


@dataclass(frozen=True, kw_only=True)
class Sketch(PythonEffect):
    """One physical cause on trial: chain that it adds, or a push on the sled, or both."""

    where: ClassVar[str] = "sketch"

    extra: Callable[[Array, Strands], Array] | None = None  # of parameters (p,): chain (n, 2) [mm]
    push: Callable[[Array, Strands], Array] | None = None  # force on the sled (n, 2) [N], x and y
