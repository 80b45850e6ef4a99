"""Marks that the settings were fitted to: how they were cut, and where their sheet lay.

The file of the settings keeps it, as no setting holds it. So the error that a fit promised can be
seen again, and nobody takes fitted settings for those that the marks were cut with.
"""

from __future__ import annotations

from dataclasses import replace

from plumb.board.rounds import POSE_AXES, ZERO_AXES
from plumb.board.sighting import SHEET_ROTATION
from plumb.marks.read import Measurements
from plumb.settings.fit_record import FitRecord
from plumb.settings.machine import MachineSettings
from plumb.text.errors import refusal
from plumb.text.readers import to_do


def with_settings_in_force(
    settings: MachineSettings, part: Measurements, *, cut_with: MachineSettings | None
) -> Measurements:
    """A file of marks with the settings that it was cut with, if the fit's record knows them.

    What the marks or `cut_with` say goes first. Raises InputError where nobody says it and the
    settings were fitted to marks of others: the settings after a fit are not those before.
    """
    record, file_round = settings.fitted, part.rounds[0]
    board = record.board(file_round.digest) if record else None
    if file_round.cut_with or cut_with:
        return part
    if board:
        return replace(part, rounds=(replace(file_round, cut_with=board.cut_with),))
    if file_round.changed:
        raise refusal(
            part.source,
            f"was cut with {file_round.changed}, which has changed since",
            place="cut_with",
            remedy=to_do(
                "give the settings that were in force with --cut-with, or correct cut_with",
                page="put the settings that were in force into the folder, and name them there",
            ),
        )
    if record and record.knows_other_settings(settings) and not _reports_chains(part):
        name = settings.file.name if settings.file else "these settings"
        raise refusal(
            part.source,
            f"does not say which settings it was cut with, and {name} was fitted to marks that "
            f"were cut with {_others(record)}",
            remedy=to_do(
                f"give --cut-with SETTINGS ({name} itself if it was in force), or write cut_with "
                "in the marks.toml",
                page=f'write cut_with = "{name}" at the top of the form if it was in force, else '
                "the name of what was",
            ),
        )
    return part


def known_outside(
    settings: MachineSettings, measurements: Measurements, *, cut_with: MachineSettings | None
) -> dict[str, float]:
    """What the fit found outside of the machine, by the names of the fit's unknowns: how the sheet
    of each known board lay, how its chains were zeroed, and effects that no setting holds."""
    record = settings.fitted
    outside: dict[str, float] = {}
    if record is None:
        return outside
    for file_round in measurements.rounds:
        board = record.board(file_round.digest)
        in_force = file_round.cut_with or cut_with or settings
        if board is None or board.cut_with != in_force:
            continue
        outside |= _of_record(record)
        sheet, zero = file_round.sheet_group + 1, file_round.zero_group + 1
        names = [f"sheet{sheet}.{axis}" for axis in POSE_AXES]
        names += [f"zero{zero}.{axis}" for axis in ZERO_AXES]
        outside |= dict(zip(names, (*board.sheet, *board.zeros), strict=True))
    return outside


def _of_record(record: FitRecord) -> dict[str, float]:
    sizes = {
        f"{effect}.{name}": size
        for effect, parameters in record.lab_effects.items()
        for name, size in parameters.items()
    }
    return {SHEET_ROTATION: record.sheet_rotation, **sizes}


def _reports_chains(part: Measurements) -> bool:
    """Whether the machine reported the chains of every mark, so that no settings are needed."""
    return all(mark.chains is not None for mark in part.marks)


def _others(record: FitRecord) -> str:
    names = {board.cut_with.file.name for board in record.boards if board.cut_with.file}
    return " and ".join(sorted(names)) or "other settings"
