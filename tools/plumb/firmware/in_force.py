"""Whether a machine holds the numbers of a file: marks are cut by what it holds, whatever is open.

A board keeps its numbers, and a file keeps others: only chains of the same length make them the
same machine.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from hashlib import sha256
from math import isclose

from plumb.firmware.numbers import RING, WORST, chains_apart, values_of
from plumb.firmware.settings import every_setting, machine_of
from plumb.settings.machine import MachineSettings
from plumb.text.errors import InputError
from plumb.text.readers import to_do

SAME = 1e-5  # of a value: the machine prints seven digits
SAID = 3  # differences in a sentence
MACHINE = "the machine"
KINEMATICS, CENTER = 7, 64  # $-numbers; from the second on they are ours alone
SENT = (0, 1, 2, 3, KINEMATICS, 8, 13, 38)  # the frame, as a client sends it


@dataclass(frozen=True)
class Difference:
    """A number that a file and the machine say otherwise."""

    number: int
    name: str
    unit: str
    in_file: float
    in_machine: float


def differences(settings: MachineSettings, held: Mapping[int, float]) -> tuple[Difference, ...]:
    """The numbers of the file that a machine does not hold; none if its chains are those of the
    file. `held`: all that the machine lists. Raises InputError."""
    rows = {row.number: row for row in every_setting() if row.access == "listed"}
    listed = {number: value for number, value in held.items() if number in rows}
    said = numbers_in_force(settings)
    try:
        ours = machine_of({**listed, **said}, sheet=settings.sheet)
        on_ring = listed.get(KINEMATICS, RING) == RING
        if on_ring and chains_apart(ours, listed) <= WORST:
            return ()
    except ValueError as error:
        raise InputError(f"the machine's numbers make no machine: {error}") from None
    return tuple(
        Difference(number, rows[number].name, rows[number].unit, value, listed.get(number, 0.0))
        for number, value in sorted(said.items())
        if not isclose(value, listed.get(number, 0.0), rel_tol=SAME)
    )


def numbers_in_force(settings: MachineSettings) -> dict[int, float]:
    """What a machine holds of the chains while these settings are in force."""
    values = values_of(settings)
    if settings.controller == "plumb":
        return values
    # A client sends the frame and the published corrections; it has none of ours and no weights.
    published = settings.published
    return {
        **{number: values[number] for number in SENT},
        **{number: 0.0 for number in values if number >= CENTER},
        37: published.chain_sag_correction,
        40: published.left_tolerance,
        41: published.right_tolerance,
    }


def digest_of_numbers(held: Mapping[int, float]) -> str:
    """A name for what a machine holds."""
    return sha256(repr(sorted(held.items())).encode()).hexdigest()[:16]


def refuse_other_numbers(
    settings: MachineSettings, held: Mapping[int, float], *, file: str
) -> None:
    """InputError with both values if a machine does not hold the numbers of a file."""
    others = differences(settings, held)
    if others:
        raise InputError(f"{both_values(others, file, MACHINE)}. Which holds? {_answers(file)}")


def refuse_other_origin(settings: MachineSettings, held: Mapping[int, float], *, file: str) -> None:
    """InputError with both values if a machine holds numbers that the fit of a file knows nothing
    of: neither those of the file, nor any with which its marks were cut."""
    if settings.fitted is None or not settings.fitted.boards:
        return  # no fit made it, so there are no marks that others had cut
    known = [settings, *(board.cut_with for board in reversed(settings.fitted.boards))]
    each = [differences(machine, held) for machine in known]
    if all(each):
        name = known[1].file.name if known[1].file else "the settings of its marks"
        both = both_values(each[1], name, MACHINE)
        raise InputError(f"{file} was fitted to marks of another machine: {both}. {_over()}")


def both_values(others: tuple[Difference, ...], file: str, machine: str) -> str:
    """Numbers with their two values, in words."""
    said = ", ".join(
        f"{each.name} (${each.number}) is {each.in_file:.7g} in {file} and {each.in_machine:.7g} "
        f"in {machine}"
        for each in others[:SAID]
    )
    more = len(others) - SAID
    return f"{said}, and {more} more differ" if more > 0 else said


def _answers(file: str) -> str:
    return to_do(
        f"plumb read writes the machine's numbers into a file; cut with that, or write those of "
        f"{file} into the machine first",
        page="answer the question above",
    )


def _over() -> str:
    return to_do(
        "Cut and measure new marks; or, if the file's numbers hold, send it with --force",
        page="Cut and measure new marks; or, if the file's numbers hold, answer the question above",
    )
