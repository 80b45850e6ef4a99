"""What a board is judged by, as it goes into a fit, a diagnosis and the proposals."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import KW_ONLY, dataclass, field

from plumb.board.observations import Observations, model_and_observations
from plumb.fit.problem import PRIORS, Checked
from plumb.marks.read import Measurements
from plumb.settings.machine import MachineSettings


@dataclass(frozen=True)
class Inputs:
    """A machine as its settings say, what was measured, and what is known besides."""

    settings: MachineSettings
    measurements: Measurements
    _: KW_ONLY
    cut_with: MachineSettings | None = None  # in force when the marks were cut; None: `settings`
    controller: str | None = None  # whose formula moved the sled; None: as marks or settings say
    # Standard deviations of the frame's numbers.
    priors: Mapping[str, float] = field(default_factory=lambda: PRIORS)
    sigma: float | None = None  # [mm] of one reading; None: as the marks say, or from the marks
    checked: Sequence[Checked] = ()  # numbers that were measured directly

    @property
    def stated_sigma(self) -> float | None:
        """[mm] of one reading, as stated here or in the file of the marks."""
        return self.sigma or self.measurements.tape_sigma

    def model_and_observations(self) -> tuple[MachineSettings, Observations]:
        """Our model of the settings, and what was observed; InputError for a bad target."""
        return model_and_observations(
            self.settings,
            self.measurements,
            cut_with=self.cut_with,
            controller=self.controller,
        )
