"""How the numbers of a machine came about: the marks that they were fitted to, and what was left.

A machine.toml keeps it, so that the error which a fit promised can be seen again.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from plumb.settings.machine import MachineSettings


@dataclass(frozen=True)
class FittedBoard:
    """A file of marks as the fit took it."""

    marks: str  # the file's name
    digest: str  # of its readings, by marks/digest.py
    cut_with: MachineSettings  # in force when the marks were cut
    sheet: tuple[float, float, float] = (0.0, 0.0, 0.0)  # x, y [mm], rotation [rad], to the first
    zeros: tuple[float, float] = (0.0, 0.0)  # [mm] more chain left and right than at the first


@dataclass(frozen=True)
class FitRecord:
    """The fit that gave these settings."""

    start_rms: float  # [mm] of the marks with the settings before
    rms: float  # [mm] after the fit
    priced_rms: float  # [mm]
    left_out_rms: float  # [mm]
    sheet_rotation: float  # [rad] counter-clockwise, of all sheets
    effects: tuple[str, ...] = ()  # that were fitted
    without: tuple[str, ...] = ()  # marks that took no part
    # Fitted, but no setting holds them.
    lab_effects: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    boards: tuple[FittedBoard, ...] = ()

    def sheet_rise(self, sheet_width: float) -> float:
        """How far [mm] to raise the right end of the last sheet [mm wide] to undo its rotation."""
        return math.tan(self.last_sheet_rotation) * sheet_width

    @property
    def last_sheet_rotation(self) -> float:
        """[rad] counter-clockwise, of the sheet that was fitted last."""
        return self.sheet_rotation + (self.boards[-1].sheet[2] if self.boards else 0.0)

    def board(self, digest: str) -> FittedBoard | None:
        """The board with these readings."""
        return next((board for board in self.boards if board.digest == digest), None)

    def knows_other_settings(self, settings: MachineSettings) -> bool:
        """Whether some board was cut with other settings than these."""
        return any(board.cut_with != settings for board in self.boards)
