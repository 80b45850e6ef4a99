"""What a sheet shows: marks with their errors, repeats of a mark gathered at their middle."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

Array = np.ndarray
NEAR = 25.0  # [mm] between marks that repeat each other, whatever their names
SAME_NAME = 60.0  # [mm] between repeats of a name; farther apart it is the mark of another board


@dataclass(frozen=True)
class Panel:
    """A sheet with its errors [mm]."""

    title: str
    predicted: Array  # (n, 2)
    errors: Array  # (n, 2) measured - predicted
    good: bool = False  # drawn in the colour of success
    names: tuple[str, ...] = ()  # (n,) of the marks, if they are known


@dataclass(frozen=True)
class Spots:
    """The marks of a panel, each once."""

    names: tuple[str, ...]
    places: Array  # (k, 2) [mm]
    errors: Array  # (k, 2) [mm] mean of the repeats
    spreads: Array  # (k,) [mm] RMS distance of the repeats from their mean, 0 without repeats
    counts: Array  # (k,) how many readings

    def __len__(self) -> int:
        """How many marks."""
        return len(self.names)

    @property
    def longest(self) -> float:
        """Length of the largest mean error [mm]."""
        return float(np.hypot(*self.errors.T).max())

    def tips(self, factor: float) -> Array:
        """Where the arrows end (k, 2) [mm], drawn this many times life size."""
        tips: Array = self.places + factor * self.errors
        return tips


def spots_of(panel: Panel) -> Spots:
    """The marks of a panel, repeats as their mean."""
    names = panel.names or ("",) * len(panel.predicted)
    groups = _groups(names, panel.predicted)
    errors = np.array([panel.errors[rows].mean(axis=0) for rows in groups])
    spreads = [
        float(np.sqrt(np.mean(np.sum((panel.errors[rows] - mean) ** 2, axis=1))))
        for rows, mean in zip(groups, errors, strict=True)
    ]
    return Spots(
        names=tuple(names[rows[0]] for rows in groups),
        places=np.array([panel.predicted[rows].mean(axis=0) for rows in groups]),
        errors=errors,
        spreads=np.array(spreads),
        counts=np.array([len(rows) for rows in groups]),
    )


def _groups(names: tuple[str, ...], places: Array) -> list[list[int]]:
    """The rows of each mark: those near its first, or with its name and not far."""
    groups: list[list[int]] = []
    firsts = np.zeros((0, 2))
    for i, place in enumerate(places):
        gaps = np.hypot(*(firsts - place).T)
        limits = [SAME_NAME if names[i] and names[i] == names[rows[0]] else NEAR for rows in groups]
        near = np.flatnonzero(gaps <= np.array(limits))
        if len(near):
            groups[near[np.argmin(gaps[near])]].append(i)
        else:
            groups.append([i])
            firsts = np.vstack([firsts, place])
    return groups
