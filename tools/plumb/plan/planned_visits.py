"""Planned visits: where the sled would be sent, how heavy, from which side, by which chain."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields

import numpy as np

from plumb.board.observations import Observations
from plumb.marks.model import Mark
from plumb.model.predict import believed_lengths
from plumb.settings.machine import MachineSettings

Array = np.ndarray


@dataclass(frozen=True)
class Visits:
    """Visits of the sled whose places are yet to be read."""

    names: tuple[str, ...]  # (n,) of the marks; one that is on the sheet already is visited again
    targets: Array  # (n, 2) [mm]
    chains: Array  # (n, 2) [mm] the controller will pay out
    sled_weights: Array  # (n,) [N]
    approaches: Array  # (n, 2) unit vectors; zero if the side is not prescribed
    swapped: Array  # (n,) whether the chains hang on each other's sprockets

    def __len__(self) -> int:
        """How many visits."""
        return len(self.names)

    def taken(self, indices: Sequence[int]) -> Visits:
        """Some of them, in that order."""
        chosen = np.array(indices, dtype=int)
        names = tuple(self.names[i] for i in chosen)
        return Visits(names, *(getattr(self, field.name)[chosen] for field in fields(self)[1:]))

    def marks(self, places: Array) -> list[Mark]:
        """The visits as marks that were read at places (n, 2) [mm]."""
        return [
            Mark(
                name=name,
                target=tuple(self.targets[i].tolist()),
                measured=tuple(places[i].tolist()),
                approach=tuple(self.approaches[i].tolist()) if self.approaches[i].any() else None,
                sled_weight=float(self.sled_weights[i]),
                chains_swapped=bool(self.swapped[i]),
            )
            for i, name in enumerate(self.names)
        ]

    def rows(self) -> Observations:
        """The visits as observations whose readings are still zero."""
        count = len(self)
        return Observations(
            chains=self.chains,
            sled_weights=self.sled_weights,
            mark_rows=np.arange(count),
            measured=np.zeros((count, 2)),
            targets=self.targets,
            names=self.names,
            distance_rows=np.zeros((0, 2), dtype=int),
            distances=np.zeros(0),
            distance_rounds=np.zeros(0, dtype=int),
            approaches=self.approaches,
            # As the first round: for a few more marks nobody zeroes chains or takes another sheet.
            rounds=np.zeros(count, dtype=int),
            zero_groups=np.zeros(count, dtype=int),
            sheet_groups=np.zeros(count, dtype=int),
            swapped=self.swapped,
        )


def joined(*several: Visits) -> Visits:
    """Visits one after the other."""
    names = tuple(name for visits in several for name in visits.names)
    rest = [np.concatenate([getattr(v, f.name) for v in several]) for f in fields(Visits)[1:]]
    return Visits(names, *rest)


def nowhere() -> Visits:
    """No visit at all."""
    none = np.zeros((0, 2))
    return Visits((), none, none, np.zeros(0), none, np.zeros(0, dtype=bool))


def sent(
    settings: MachineSettings,
    targets: Array,
    *,
    controller: str,
    sled_weight: float,
    names: Sequence[str] | None = None,
    approaches: Array | None = None,
    swapped: bool = False,
) -> Visits:
    """Visits of targets (n, 2) [mm] by a machine with the settings in force; the approaches (n, 2)
    are zero if not given. Raises ValueError for a target that the controller cannot reach."""
    where = np.array(targets, dtype=float).reshape(-1, 2)
    count = len(where)
    return Visits(
        names=tuple(names) if names is not None else tuple(place_name(target) for target in where),
        targets=where,
        chains=believed_lengths(settings, where, controller=controller),
        sled_weights=np.full(count, float(sled_weight)),
        approaches=np.zeros((count, 2)) if approaches is None else np.array(approaches, float),
        swapped=np.full(count, swapped),
    )


def place_name(target: Array) -> str:
    """A name for a new mark: where it is sent [mm]."""
    return f"{target[0] + 0.0:.0f}/{target[1] + 0.0:.0f}"
