"""A board that is read once and refitted often: with these effects, and sizes held by hand.

What does not depend on the effects is worked out once: which chains were paid out, and how good a
reading is. Fits are kept. A search begins at the numbers of the fit before, unless the last digit
counts.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from threading import Lock
from typing import Protocol

from plumb.diagnosis.expected_error import Drawn, drawn_by
from plumb.diagnosis.explanation import Board, Explanation, explain
from plumb.diagnosis.noise import Noise
from plumb.diagnosis.outliers import described
from plumb.diagnosis.readings import clear_outliers
from plumb.firmware.settings import Difference, both_values, differences, numbers_in_force
from plumb.fit.compare import chain_errors, hung_places
from plumb.fit.covariates import PATCH, Covariate, covariates
from plumb.fit.fit import Fit, fit
from plumb.fit.inputs import Inputs
from plumb.fit.observations import Observations, different_numbers
from plumb.fit.problem import USUAL_SIGMA
from plumb.model.catalogue import effect_names, parameter_names
from plumb.model.lab_effects import EDGES, LAB_EFFECTS, SLED, TAPE
from plumb.model.predict import Array
from plumb.settings.machine import MachineSettings
from plumb.text.errors import InputError, to_do
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
        """Return the first effects alone."""
        effects = self.effects[:count]
        mine = {
            name: size for name, size in self.held.items() if name.rpartition(".")[0] in effects
        }
        return Chosen(effects, mine)


class LiveBoard:
    """The board of some inputs; several threads may ask it."""

    def __init__(self, inputs: Inputs, *, warm: bool = True, noise: Noise | None = None) -> None:
        """warm: a search begins at the last fit. noise: that of a diagnosis, if it is known.
        Raises InputError for marks out of reach.
        """
        self.inputs = inputs
        self._warm = warm
        model, rows = inputs.model_and_observations()
        self.model: MachineSettings = model
        self.rows: Observations = rows
        sigma = inputs.stated.sigma if inputs.stated else USUAL_SIGMA
        # Checks of effects count in a fit of these effects: the noise is the same for every fit.
        frame = [check for check in inputs.checked if "." not in check.name]
        board = Board.of(
            model, rows, sigma=sigma, priors=inputs.priors, checked=frame, unit=inputs.unit
        )
        self.noise, self.said = (noise, noise.notes) if noise else noise_of(inputs, board)
        self._fits: dict[object, Fit] = {}
        self._last: Fit | None = None
        self._fitting = Lock()

    def refuse(self, chosen: Chosen) -> None:
        """Raise InputError for what these marks cannot settle, and for unknown names."""
        refuse_unknown_effects(chosen.effects)
        try:
            refuse_unknown(chosen.held, chosen.parameters)
        except ValueError as error:
            held = to_do("--hold", page="a held size:")
            raise InputError(held + f" {error}") from None
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
        """Return the frame with the chosen effects; from what is kept, if it was fitted before."""
        key = (chosen.effects, tuple(sorted(chosen.held.items())))
        with self._fitting:
            if key not in self._fits:
                self._fits[key] = self._fit(chosen)
                while len(self._fits) > MOST_KEPT:
                    self._fits.pop(next(iter(self._fits)))
            self._last = self._fits[key]
            return self._last

    @cached_property
    def frame(self) -> Explanation:
        """The frame alone, with slopes by every effect."""
        return explain(
            Board.of(
                self.model,
                self.rows,
                sigma=self.noise.sigma,
                priors=self.inputs.priors,
                checked=self.inputs.checked,
                unit=self.inputs.unit,
            )
        )

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
                    f"--effect {name}: it is not an effect; give --patch to choose it knowingly",
                    page=f"{name} is not an effect: choose others",
                )
            )
        if name not in known:
            option = to_do("--effect ", page="")
            raise InputError(
                option + f"{name}: there is no effect of that name; known are {', '.join(known)}"
            )


# The noise of the readings to which effects are fitted, by the rule of the diagnosis.


def noise_of(inputs: Inputs, board: Board) -> tuple[Noise, tuple[str, ...]]:
    """Return the noise by the posterior of the diagnosis, and a sentence for each reading that
    is likelier off than not, and for what does not go together.
    """
    shifts, posterior = clear_outliers(board, inputs.stated)
    said = [described(shift, inputs).sentence for shift in shifts]
    return posterior.noise, (*said, *posterior.noise.notes)


# What the bench of the lab draws of a board: its errors in chain, covariates, suspects.
#
# Marks hang where the frame's fit has them. A few mm more or less turn no chain, so dots only rise
# and fall when an effect is added.


class BoardView:
    """The view of a board."""

    def __init__(self, board: LiveBoard) -> None:
        rows = board.rows
        self.board = board
        self.model = board.fit(Chosen()).settings
        self._places = hung_places(self.model, rows)[rows.mark_rows]

    @cached_property
    def covariates(self) -> tuple[Covariate, ...]:
        """Those of the marks."""
        marked = self.board.rows.mark_rows
        return tuple(
            replace(each, values=each.values[marked])
            for each in covariates(self.model, self.board.rows)
        )

    def chains(self, errors: Array) -> Array:
        """Errors of the marks (k, 2) [mm] as those of left and right chain; nan: out of reach."""
        rows = self.board.rows
        return chain_errors(self.model, self._places, errors, rows.sled_weights[rows.mark_rows])

    def drawn(self, *effects: str) -> Drawn:
        """Return what effects draw into the marks once the frame is refitted with them."""
        frame, rows = self.board.frame, self.board.rows
        explanation = explain(frame.board, effects, start=frame)
        return drawn_by(frame, explanation, rows)


# Whether the settings to be corrected are those of the machine that cut the marks.


def refuse_other_origin(inputs: Inputs) -> None:
    """InputError with both values if all marks say that another machine cut them than the settings
    say, or any that the settings were fitted to."""
    settings, record = inputs.settings, inputs.settings.fitted
    rounds = inputs.measurements.rounds
    named = [each.cut_with for each in rounds if each.cut_with]
    if inputs.cut_with or len(named) < len(rounds) or not named:
        return  # the settings in force are stated, or not known
    boards = record.boards if record else ()
    machines = [settings, *(board.cut_with for board in boards)]
    if any(not _apart(machine, cut_with) for machine in machines for cut_with in named):
        return
    file, newest = settings.file, named[-1]
    name, other = file.name if file else "the settings", newest.file
    was = other.name if other else "what its marks name"
    raise InputError(
        rounds[-1].name or inputs.measurements.source,
        f"was cut with another machine than {name}: "
        + both_values(_apart(settings, newest), name, was),
        remedy=to_do(
            f"give {was} instead of {name}, or say with --cut-with what the machine held",
            page=f"open {was}, or name in the form, as cut_with, what the machine held",
        ),
    )


def _apart(settings: MachineSettings, cut_with: MachineSettings) -> tuple[Difference, ...]:
    return differences(settings, numbers_in_force(cut_with))
