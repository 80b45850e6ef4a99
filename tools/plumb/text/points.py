"""Pairs of numbers from a comma-separated file: places x,y or chains left,right [mm]."""

from __future__ import annotations

from os import PathLike

import numpy as np

from plumb.text.errors import InputError, naming
from plumb.text.files import read_text
from plumb.text.values import number_in


def read_pairs(path: str | PathLike[str], *, names: tuple[str, str]) -> np.ndarray:
    """Return the pairs (n, 2) [mm]; a header of the two names and lines that begin with # are
    allowed.
    """
    form = f"write {','.join(names)} on each line, in mm"
    pairs: list[tuple[float, float]] = []
    headers = 0
    for line, text in enumerate(read_text(path).splitlines(), 1):
        if not text.strip() or text.lstrip().startswith("#"):
            continue
        cells = [cell.strip().strip('"') for cell in text.split(",")]
        if len(cells) != 2:
            many = "1 value" if len(cells) == 1 else f"{len(cells)} values"
            raise InputError(path, f"has {many} instead of 2", place=f"line {line}", remedy=form)
        if not pairs and not headers and _is_header(cells):
            headers += 1
            _check_header(path, line, cells, names, form)
            continue
        values = []
        for name, cell in zip(names, cells, strict=True):
            with naming(path, f"line {line}, {name}"):
                values.append(number_in(cell))
        pairs.append((values[0], values[1]))
    if not pairs:
        raise InputError(path, "has no numbers", remedy=form)
    return np.array(pairs)


def _is_header(cells: list[str]) -> bool:
    return all(cell[:1].isalpha() and cell.lower() not in ("nan", "inf") for cell in cells)


def _check_header(
    path: str | PathLike[str], line: int, cells: list[str], names: tuple[str, str], form: str
) -> None:
    """Refuse columns that are exchanged, or in another unit."""
    allowed = [{name, f"{name}_mm", f"{name} mm", f"{name} [mm]", f"{name} (mm)"} for name in names]
    if any(cell.lower() not in spellings for cell, spellings in zip(cells, allowed, strict=True)):
        raise InputError(
            path, f"the header is '{','.join(cells)}'", place=f"line {line}", remedy=form
        )
