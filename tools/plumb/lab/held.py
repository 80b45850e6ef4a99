"""What the connected machine holds against what is open in the folder: never two machines in one
fit."""

from __future__ import annotations

from plumb.firmware.settings import (
    MACHINE,
    Difference,
    both_values,
    differences,
    digest_of_numbers,
    refuse_other_numbers,
    refuse_other_origin,
)
from plumb.fit.inputs import settings_in
from plumb.lab.choices import read_choices
from plumb.lab.machine_line import MachineLine
from plumb.lab.project import Project
from plumb.lab.taken import taken_marks
from plumb.text.errors import InputError


def held_otherwise(project: Project, line: MachineLine) -> tuple[Difference, ...]:
    """What the open settings and the connected machine say otherwise, as far as both are known."""
    choices, _ = read_choices(project)
    if not choices.settings or not line.state.numbers:
        return ()
    return differences(settings_in(project.path(choices.settings)), line.state.numbers)


def is_fit_of_machine(project: Project, line: MachineLine) -> bool:
    """Whether the open settings were fitted to marks of the machine as it is: they go into it
    next."""
    choices, _ = read_choices(project)
    if not choices.settings:
        return False
    record = settings_in(project.path(choices.settings)).fitted
    boards = record.boards if record else ()
    return any(not differences(board.cut_with, line.state.numbers) for board in boards)


def refuse_other_machine(project: Project, line: MachineLine) -> None:
    """InputError unless the machine, asked now, holds the numbers that its next marks name: those
    of the open settings, or of the form that somebody took."""
    choices, _ = read_choices(project)
    if not choices.settings:
        raise InputError("no settings are open; open the settings of the machine first")
    taken = taken_marks(project, choices)
    named = taken and taken.cut_with
    settings = named or settings_in(project.path(choices.settings))
    file = named.file.name if named and named.file else choices.settings
    refuse_other_numbers(settings, line.read_numbers(), file=file)


def refuse_unanswered(project: Project, line: MachineLine) -> None:
    """InputError while another machine is connected than is open: a correction would begin
    at other numbers than it holds."""
    others = held_otherwise(project, line)
    if others and not is_fit_of_machine(project, line):
        file = read_choices(project)[0].settings
        both = both_values(others, file, MACHINE)
        raise InputError(f"{both}. Which holds? Answer the question above, or disconnect")


def refuse_foreign_fit(project: Project, line: MachineLine, file: str, *, replaces: str) -> None:
    """InputError if a file was fitted to marks of another machine than is connected.

    `replaces` is the digest of the numbers that the owner gave up for those of the file.
    """
    held = line.read_numbers()
    if not replaces:
        refuse_other_origin(settings_in(project.path(file)), held, file=file)
    elif replaces != digest_of_numbers(held):
        raise InputError("the machine holds other numbers by now: look at them again")
