"""Whether the settings to be corrected are those of the machine that cut the marks."""

from __future__ import annotations

from plumb.firmware.in_force import Difference, both_values, differences, numbers_in_force
from plumb.fit.inputs import Inputs
from plumb.settings.machine import MachineSettings
from plumb.text.errors import refusal
from plumb.text.readers import to_do


def refuse_other_origin(inputs: Inputs) -> None:
    """InputError with both values if all marks say that another machine cut them than the settings
    say, or any that the settings were fitted to."""
    settings, record = inputs.settings, inputs.settings.fitted
    rounds = inputs.measurements.rounds
    named = [each.cut_with for each in rounds if each.cut_with]
    if inputs.cut_with or len(named) < len(rounds) or not named:
        return  # somebody said what was in force, or nobody did
    boards = record.boards if record else ()
    machines = [settings, *(board.cut_with for board in boards)]
    if any(not _apart(machine, cut_with) for machine in machines for cut_with in named):
        return
    file, newest = settings.file, named[-1]
    name, other = file.name if file else "the settings", newest.file
    was = other.name if other else "what its marks name"
    raise refusal(
        rounds[-1].name,
        f"was cut with another machine than {name}: "
        + both_values(_apart(settings, newest), name, was),
        remedy=to_do(
            f"give {was} instead of {name}, or say with --cut-with what the machine held",
            page=f"open {was}, or name in the form, as cut_with, what the machine held",
        ),
    )


def _apart(settings: MachineSettings, cut_with: MachineSettings) -> tuple[Difference, ...]:
    return differences(settings, numbers_in_force(cut_with))
