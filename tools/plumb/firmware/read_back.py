"""The machine that a board's numbers describe."""

from __future__ import annotations

from collections.abc import Mapping

from plumb.firmware.settings import every_setting, machine_of
from plumb.settings.machine import MachineSettings
from plumb.text.errors import InputError

WIDTH, HEIGHT = 0, 1  # $-numbers of the sheet


def machine_of_numbers(numbers: Mapping[int, float]) -> MachineSettings:
    """The machine of all the numbers that a board lists. Raises InputError."""
    known = {row.number for row in every_setting() if row.access == "listed"}
    listed = {number: value for number, value in numbers.items() if number in known}
    try:
        return machine_of(listed, sheet=(numbers[WIDTH], numbers[HEIGHT]))
    except (KeyError, ValueError) as error:
        raise InputError(f"the machine's numbers make no machine: {error}") from None
