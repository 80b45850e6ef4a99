"""What the commands print: a JSON object, and numbers for people."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from typing import Any

import numpy as np


def print_json(answer: Mapping[str, Any]) -> None:
    """Print a single JSON object; what is not a finite number is null."""
    print(json.dumps(plain(answer), indent=2, allow_nan=False))


def plain(value: Any) -> Any:
    """The value in the types of JSON."""
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, np.ndarray):
        return plain(value.tolist())
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    if isinstance(value, np.generic):
        return plain(value.item())
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value


def about(millimetres: float) -> str:
    """A length for the title of a picture: a decimal, two below a millimetre."""
    return f"{millimetres:.1f}" if millimetres >= 0.95 else f"{millimetres:.2f}"


def number(value: float | None) -> str:
    """A parameter for people: four figures, six for what is measured in metres."""
    if value is None or not math.isfinite(value):
        return "-"
    return f"{value:.6g}" if abs(value) >= 100 else f"{value:.4g}"
