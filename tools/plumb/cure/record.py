"""What a new machine.toml keeps of the fit that gave its numbers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from plumb.board.rounds import POSE_AXES, ZERO_AXES
from plumb.cure.add import Addition
from plumb.fit.inputs import Inputs
from plumb.marks.read import Round
from plumb.settings.fit_record import FitRecord, FittedBoard


def record_of(result: Addition, inputs: Inputs, *, without: Sequence[str] = ()) -> FitRecord:
    """The fit as its machine.toml keeps it; `without` names the marks that took no part."""
    fitted = result.after_fit
    unknowns = {estimate.name: estimate.value for estimate in fitted.estimates}
    return FitRecord(
        start_rms=result.raw.rms,
        rms=result.after.fit_rms,
        priced_rms=result.after.priced_rms,
        left_out_rms=result.after.left_out_rms,
        sheet_rotation=fitted.sheet_rotation,
        effects=result.effects_added,
        without=tuple(without),
        lab_effects=fitted.lab_effects,
        boards=tuple(_board(each, unknowns, inputs) for each in inputs.measurements.rounds),
    )


def _board(file_round: Round, unknowns: dict[str, float], inputs: Inputs) -> FittedBoard:
    sheet, zero = f"sheet{file_round.sheet_group + 1}", f"zero{file_round.zero_group + 1}"
    x, y, rotation = (unknowns.get(f"{sheet}.{axis}", 0.0) for axis in POSE_AXES)
    left, right = (unknowns.get(f"{zero}.{axis}", 0.0) for axis in ZERO_AXES)
    in_force = file_round.cut_with or inputs.cut_with or inputs.settings
    return FittedBoard(
        marks=file_round.name or Path(inputs.measurements.source).name,
        digest=file_round.digest,
        cut_with=replace(in_force, fitted=None),
        sheet=(x, y, rotation),
        zeros=(left, right),
    )
