"""What a board is judged by, as it goes into a fit, a diagnosis and the proposals."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import KW_ONLY, dataclass, field

from plumb.board.observations import Observations, model_and_observations
from plumb.fit.problem import PRIORS, Checked
from plumb.marks.read import Measurements
from plumb.settings.machine import MachineSettings


@dataclass(frozen=True)
class Stated:
    """What somebody said that a reading is good to."""

    sigma: float  # [mm]
    is_final: bool = False  # given to the command: it is used as it is, whatever repeats say


@dataclass(frozen=True)
class Inputs:
    """A machine as its settings say, what was measured, and what else is known."""

    settings: MachineSettings
    measurements: Measurements
    _: KW_ONLY
    cut_with: MachineSettings | None = None  # in force when the marks were cut; None: `settings`
    controller: str | None = None  # whose formula moved the sled; None: as marks or settings say
    # Standard deviations of the frame's numbers.
    priors: Mapping[str, float] = field(default_factory=lambda: PRIORS)
    sigma: float | None = (
        None  # [mm] of one reading, used as it is; None: diagnosis/noise_sources.py
    )
    checked: Sequence[Checked] = ()  # numbers that were measured directly

    @property
    def stated(self) -> Stated | None:
        """What a reading is good to, as stated here or in the file of the marks."""
        if self.sigma:
            return Stated(self.sigma, is_final=True)
        tape = self.measurements.tape_sigma
        return Stated(tape) if tape else None

    def model_and_observations(self) -> tuple[MachineSettings, Observations]:
        """Our model of the settings, and what was observed; InputError for a bad target."""
        return model_and_observations(
            self.settings,
            self.measurements,
            cut_with=self.cut_with,
            controller=self.controller,
        )
