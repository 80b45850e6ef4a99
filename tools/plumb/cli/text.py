"""What the commands print: a JSON object, or aligned tables."""

from __future__ import annotations

import json
import math
import textwrap
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

WIDTH = 96  # [characters] of wrapped sentences


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


def table(header: Sequence[str], rows: Sequence[Sequence[str]], *, left: int = 1) -> str:
    """Aligned columns; the first `left` of them to the left, numbers to the right."""
    grid = [list(header), *(list(row) for row in rows)]
    widths = [max(len(row[i]) for row in grid) for i in range(len(header))]
    lines = []
    for row in grid:
        cells = [
            cell.ljust(width) if i < left else cell.rjust(width)
            for i, (cell, width) in enumerate(zip(row, widths, strict=True))
        ]
        lines.append("  ".join(cells).rstrip())
    return "\n".join(lines)


def sentences(lines: Sequence[str], *, mark: str = "- ") -> str:
    """Sentences below each other, long ones wrapped."""
    return "\n".join(
        textwrap.fill(line, WIDTH, initial_indent=mark, subsequent_indent=" " * len(mark))
        for line in lines
    )


def millimetres(value: float | None, digits: int = 2) -> str:
    """A length for people; a dash where there is none."""
    if value is None or not math.isfinite(value):
        return "-"
    return f"{value + 0.0:.{digits}f}"


def about(value: float) -> str:
    """A length for a title: a decimal, two below a millimetre."""
    return f"{value:.1f}" if value >= 0.95 else f"{value:.2f}"


def signed(value: float | None, digits: int = 2) -> str:
    """An error for people, with its sign."""
    return "-" if value is None else f"{value:+.{digits}f}"


def number(value: float | None) -> str:
    """A parameter for people: four figures, six for what is measured in metres."""
    if value is None or not math.isfinite(value):
        return "-"
    return f"{value:.6g}" if abs(value) >= 100 else f"{value:.4g}"
