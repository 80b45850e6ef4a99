"""The firmware's settings by $-number: what there are, and what they mean to the kinematics."""

from collections.abc import Mapping
from dataclasses import dataclass
from decimal import Decimal
from hashlib import sha256
from math import inf, isclose, tau

import numpy as np

from plumb import _core
from plumb.model.predict import FOUND, lengths, library
from plumb.settings.machine import MachineSettings, frame_of
from plumb.text.errors import InputError, to_do


@dataclass(frozen=True)
class Setting:
    """A row of the firmware's table."""

    number: int
    name: str
    unit: str
    kind: str  # "bool", "u8", "u16" or "float"
    access: str  # "listed", or "hidden" and "kept": not in the dump, set by B codes alone
    usual: float
    low: float
    high: float
    touches: list[str]  # what is worked out again, of TOUCHES in the page of settings
    step: int  # 0: any value; 255: any but zero; else whole values in steps from low
    key: str  # section and key of the published programs, or ""
    sentence: str
    change: str  # what is not as in the published firmware, or ""


def every_setting() -> list[Setting]:
    """Return all settings in the order of the firmware's dump."""
    return [Setting(**row) for row in _core.settings_table()]


def machine_of(numbers: Mapping[int, float], *, sheet: tuple[float, float]) -> MachineSettings:
    """Return the machine with which the firmware computes when these settings are not at their
    defaults.

    Raises ValueError in the firmware's words for a setting that it refuses.
    """
    effective = _core.effective(dict(numbers))
    effects: dict[str, dict[str, float]] = {}
    for name, value in effective["effects"].items():
        effect, _, parameter = name.partition(".")
        if value:
            effects.setdefault(effect, {})[parameter] = _plain(value)
    return MachineSettings(
        sheet_width=sheet[0],
        sheet_height=sheet[1],
        feed="top" if effective["over_top"] else "bottom",
        effects=effects,
        **frame_of({name: _plain(value) for name, value in effective["frame"].items()}),
    )


def _plain(value: float) -> float:
    """Return a number with the seven digits that the firmware's float holds."""
    return float(f"{value:.7g}")


def format_value(value: float) -> str:
    """Return a value as the firmware's dump writes it."""
    return _core.format_value(value)


# A fitted machine as the numbers that the firmware keeps, read back by the firmware.

RING, OVER_TOP, OFF_BOTTOM = 2, 1, 2  # what $7 and $38 say
# What a client sends in addition to the numbers of the frame: without it z stands still.
CLIENT_NUMBERS: Mapping[int, float] = {29: 1300, 15: 1000, 18: 18}
WORST = 0.01  # [mm] of chain by which rounding to the firmware's floats may move a place


@dataclass(frozen=True)
class SentSetting:
    """A setting as it is sent."""

    number: int
    name: str
    text: str
    unit: str

    @property
    def line(self) -> str:
        """The line that sets it."""
        return f"${self.number}={self.text}"


def firmware_numbers(settings: MachineSettings) -> tuple[SentSetting, ...]:
    """Return every number that says where the sled of this machine hangs, in the order of the dump.

    The published corrections are zero, as the effects hold all there is. Raises InputError if the
    firmware would refuse a number, or would compute chains that differ by more than WORST.
    """
    values = values_of(settings)
    rows = {setting.number: setting for setting in every_setting()}
    numbers = tuple(
        SentSetting(number, rows[number].name, format_value(value).strip(), rows[number].unit)
        for number, value in sorted(values.items())
    )
    _refuse_what_differs(settings, {row.number: float(row.text) for row in numbers})
    return numbers


def values_of(settings: MachineSettings) -> dict[int, float]:
    numbers = {
        0: settings.sheet_width,
        1: settings.sheet_height,
        2: settings.motor_gap,
        3: settings.motor_offset,
        7: RING,
        8: settings.rotation_radius,
        13: tau * settings.sprocket_radius,
        37: 0.0,
        38: OVER_TOP if settings.feed == "top" else OFF_BOTTOM,
        40: 0.0,
        41: 0.0,
        62: settings.sled_weight,
        63: settings.chain_weight,
        64: settings.motor_center_x,
    }
    for effect in library():
        for parameter in effect["parameters"]:
            if parameter["setting"] is not None:
                size = settings.effect(effect["name"], parameter["name"])
                numbers[parameter["setting"]] = size
    return numbers


def _refuse_what_differs(settings: MachineSettings, numbers: dict[int, float]) -> None:
    try:
        apart = chains_apart(settings, numbers)
    except ValueError as error:
        raise InputError(f"the firmware refuses these settings: {error}") from None
    if apart > WORST:
        raise InputError(
            f"the firmware would pay out chain that differs by {apart:.3f} mm from this machine's: "
            "check its numbers for sizes that no real machine has"
        )


def chains_apart(settings: MachineSettings, numbers: Mapping[int, float]) -> float:
    """By how much the firmware's chains with these numbers differ from the machine's, over its
    sheet [mm]; infinite where the sled hangs nowhere.

    Raises ValueError in the firmware's words for a number that it refuses.
    """
    theirs = machine_of(numbers, sheet=settings.sheet)
    half = np.array(settings.sheet) / 2 - 50
    places = half * np.array([(x, y) for x in (-1, 0, 1) for y in (-1, 0, 1)])
    ours, outcome = lengths(settings, places)
    kept, kept_outcome = lengths(theirs, places)
    reached = (outcome == FOUND) & (kept_outcome == FOUND)
    return float(np.abs(ours - kept)[reached].max()) if reached.any() else inf


# The machine that a board's numbers describe.

WIDTH, HEIGHT = 0, 1  # $-numbers of the sheet


def machine_of_numbers(numbers: Mapping[int, float]) -> MachineSettings:
    """Return the machine of all the numbers that a board lists. Raises InputError."""
    known = {row.number for row in every_setting() if row.access == "listed"}
    listed = {number: value for number, value in numbers.items() if number in known}
    try:
        return machine_of(listed, sheet=(numbers[WIDTH], numbers[HEIGHT]))
    except (KeyError, ValueError) as error:
        raise InputError(f"the machine's numbers make no machine: {error}") from None


# Whether a machine holds the numbers of a file: marks are cut by what it holds, whatever is open.
#
# A board keeps its numbers, and a file keeps others: only chains of the same length make them the
# same machine.

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

    @property
    def said(self) -> tuple[str, str, str]:
        """Its name, and it as the file and as the machine say it."""
        file, machine = (
            setting_said(self.number, value, self.unit) for value in (self.in_file, self.in_machine)
        )
        return self.name, file, machine


def setting_said(number: int, value: float, unit: str) -> str:
    """Return a number as the machine lists it, with its unit: `$170 = 0.00000517 1/N`."""
    return f"${number} = {number_said(value)} {unit}".strip()


def number_said(value: float) -> str:
    """Return a number as exact as the machine says it, without an exponent."""
    return f"{Decimal(f'{value:.7g}'):f}"


def differences(settings: MachineSettings, held: Mapping[int, float]) -> tuple[Difference, ...]:
    """Return the numbers of the file that a machine does not hold; none if its chains are those of
    the file. `held`: all that the machine lists. Raises InputError.
    """
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
    """Return what a machine holds of the chains while these settings are in force."""
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


def called(number: int) -> tuple[str, str]:
    """Return the name and the unit of a $-number; empty where no setting has it."""
    rows = {row.number: row for row in every_setting()}
    return (rows[number].name, rows[number].unit) if number in rows else ("", "")


def digest_of_numbers(held: Mapping[int, float]) -> str:
    """Return a name for what a machine holds."""
    return sha256(repr(sorted(held.items())).encode()).hexdigest()[:16]


def refuse_other_numbers(
    settings: MachineSettings, held: Mapping[int, float], *, file: str
) -> None:
    """InputError with both values if a machine does not hold the numbers of a file."""
    others = differences(settings, held)
    if others:
        raise InputError(f"{both_values(others, file, MACHINE)}. Which holds? " + _answers(file))


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
        raise InputError(f"{file} was fitted to marks of another machine: {both}. " + _over())


def both_values(others: tuple[Difference, ...], file: str, machine: str) -> str:
    """Return numbers with their two values, in words."""
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
