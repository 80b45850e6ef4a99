# The types of the compiled judge; tools/judge/binding.cpp says what the function does.
import numpy as np
from numpy.typing import NDArray

Numbers = NDArray[np.float64]

def places(
    numbers: dict[str, float],
    chains: Numbers,
    *,
    pushes: Numbers,
    weights: Numbers,
    over_top: bool = ...,
) -> Numbers: ...
