"""A board that is read once and refitted often: with these effects, and sizes held by hand.

What does not depend on the effects is worked out once: which chains were paid out, and how good a
reading is. Fits are kept. A search begins at the numbers of the fit before, unless the last digit
counts.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from threading import Lock
from typing import Protocol

from plumb.board.observations import Observations, different_numbers
from plumb.cure.noise import FitNoise, noise_of
from plumb.fit.fit import Fit, fit
from plumb.fit.inputs import Inputs
from plumb.fit.patch import PATCH
from plumb.model.catalogue import effect_names, parameter_names
from plumb.model.lab_effects import LAB_EFFECTS
from plumb.model.lab_effects.lab_effect import EDGES, SLED, TAPE
from plumb.settings.machine import MachineSettings
from plumb.text.errors import InputError
from plumb.text.readers import to_do
from plumb.text.values import refuse_unknown

MOST_KEPT = 64  # fits


class TooFewError(InputError):
    """The marks are too few for the effects that were chosen."""


class Weighted(Protocol):
    """fit() with all but the effects and the priors."""

    def __call__(self, *, effects: Sequence[str] = (), priors: Mapping[str, float]) -> Fit: ...


@dataclass(frozen=True)
class Chosen:
    """Effects to add, in their order, and parameters of theirs that keep a size."""

    effects: tuple[str, ...] = ()
    held: Mapping[str, float] = field(default_factory=dict)  # by full name, `effect.parameter`

    @property
    def parameters(self) -> tuple[str, ...]:
        """Of its effects, by full name."""
        return tuple(name for effect in self.effects for name in parameter_names(effect))

    def first(self, count: int) -> Chosen:
        """The first effects alone."""
        effects = self.effects[:count]
        mine = {
            name: size for name, size in self.held.items() if name.rpartition(".")[0] in effects
        }
        return Chosen(effects, mine)


class LiveBoard:
    """The board of some inputs; several threads may ask it."""

    def __init__(self, inputs: Inputs, *, warm: bool = True) -> None:
        """warm: a search begins at the last fit. Raises InputError for marks out of reach."""
        self.inputs = inputs
        self._warm = warm
        model, rows = inputs.model_and_observations()
        self.model: MachineSettings = model
        self.rows: Observations = rows
        self.noise: FitNoise = noise_of(inputs, model, rows)
        self._fits: dict[object, Fit] = {}
        self._last: Fit | None = None
        self._fitting = Lock()

    def refuse(self, chosen: Chosen) -> None:
        """Raise InputError for what these marks cannot settle, and for what nobody knows."""
        refuse_unknown_effects(chosen.effects)
        try:
            refuse_unknown(chosen.held, chosen.parameters)
        except ValueError as error:
            held = to_do("--hold", page="a held size:")
            raise InputError(f"{held} {error}") from None
        self._refuse_too_few(chosen)
        self._refuse_unfelt(chosen.effects)

    def weighted(self, held: Mapping[str, float], near: Fit | None = None) -> Weighted:
        """fit() on this board, with all but the effects and the priors."""
        return partial(
            fit,
            self.model,
            self.rows,
            sigma=self.noise.sigma,
            degrees=self.noise.degrees,
            checked=self.inputs.checked,
            held=held,
            near=near,
        )

    def fit(self, chosen: Chosen) -> Fit:
        """The frame with the chosen effects; from what is kept, if it was fitted before."""
        key = (chosen.effects, tuple(sorted(chosen.held.items())))
        with self._fitting:
            if key not in self._fits:
                self._fits[key] = self._fit(chosen)
                while len(self._fits) > MOST_KEPT:
                    self._fits.pop(next(iter(self._fits)))
            self._last = self._fits[key]
            return self._last

    def _fit(self, chosen: Chosen) -> Fit:
        weighted = self.weighted(chosen.held, near=self._last if self._warm else None)
        return weighted(effects=chosen.effects, priors=self.inputs.priors)

    def _refuse_too_few(self, chosen: Chosen) -> None:
        measurements = self.inputs.measurements
        count = different_numbers(measurements, self.rows)
        frame = sum(sigma > 0 for sigma in self.inputs.priors.values())
        free = len([name for name in chosen.parameters if name not in chosen.held])
        if count < frame + free:
            raise TooFewError(
                f"{measurements.source}: {count} measured numbers cannot settle {frame + free} "
                f"unknowns ({frame} of frame and sheet, {free} of the effects); measure more "
                "marks, add fewer effects, or "
                + to_do(
                    "hold numbers that you know with --prior NAME=0",
                    page="write the numbers that you measured under What you know",
                )
            )

    def _refuse_unfelt(self, effects: Sequence[str]) -> None:
        """Refuse a lab effect that changes none of the measured numbers."""
        rows = self.rows
        approached = bool(rows.approaches[[*rows.mark_rows, *rows.distance_rows.ravel()]].any())
        felt = {SLED: approached, EDGES: len(rows.mark_rows) > 0, TAPE: True}
        for effect in LAB_EFFECTS:
            if effect.name in effects and not felt[effect.acts_on]:
                raise InputError(
                    f"{self.inputs.measurements.source}: {effect.name} needs {effect.needs}: "
                    "nothing here depends on it"
                )


def refuse_unknown_effects(names: Sequence[str]) -> None:
    """Raise InputError for an effect that is not in the catalogue."""
    known = effect_names()
    for name in names:
        if name == PATCH:
            raise InputError(
                to_do(
                    f"--effect {name}: it is no effect; give --patch to choose it knowingly",
                    page=f"{name} is no effect: choose others",
                )
            )
        if name not in known:
            option = to_do("--effect ", page="")
            raise InputError(
                f"{option}{name}: there is no effect of that name; known are {', '.join(known)}"
            )
