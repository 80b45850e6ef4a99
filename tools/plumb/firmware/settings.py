"""The firmware's settings by $-number: what there are, and what they mean to the kinematics."""

from collections.abc import Mapping
from dataclasses import dataclass
from decimal import Decimal
from hashlib import sha256
from math import inf, isclose, tau
from pathlib import Path

import numpy as np

from plumb import _core
from plumb.model.predict import FOUND, lengths, library
from plumb.settings import (
    SOURCES,
    TUNED,
    Key,
    MachineSettings,
    changed_client_file,
    frame_of,
    groundcontrol_changes,
    number_for_firmware,
    parse_client_file,
)
from plumb.text.errors import InputError, Source, naming, to_do
from plumb.text.files import IniText


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


def listed_settings() -> dict[int, Setting]:
    """Return those of the dump, by their $-number."""
    return {row.number: row for row in every_setting() if row.access == "listed"}


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
    with naming("the firmware refuses these settings"):
        apart = chains_apart(settings, {row.number: float(row.text) for row in numbers})
    if apart > WORST:
        raise InputError(
            f"the firmware would pay out chain that differs by {apart:.3f} mm from this machine's: "
            "check its numbers for sizes that no real machine has"
        )
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
    rows = listed_settings()
    listed = {number: value for number, value in numbers.items() if number in rows}
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
    rows = listed_settings()
    listed = {number: value for number, value in held.items() if number in rows}
    said = numbers_in_force(settings)
    with naming("the machine's numbers make no machine"):
        ours = machine_of({**listed, **said}, sheet=settings.sheet)
        on_ring = listed.get(KINEMATICS, RING) == RING
        if on_ring and chains_apart(ours, listed) <= WORST:
            return ()
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
        remedy = to_do(
            f"plumb read writes the machine's numbers into a file; cut with that, or write those "
            f"of {file} into the machine first",
            page="answer the question above",
        )
        raise InputError(f"{both_values(others, file, MACHINE)}. Which holds? " + remedy)


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
        remedy = to_do(
            "Cut and measure new marks; or, if the file's numbers hold, send it with --force",
            page="Cut and measure new marks; or, if the file's numbers hold, answer the question "
            "above",
        )
        raise InputError(f"{file} was fitted to marks of another machine: {both}. " + remedy)


def both_values(others: tuple[Difference, ...], file: str, machine: str) -> str:
    """Return numbers with their two values, in words."""
    said = ", ".join(
        f"{each.name} (${each.number}) is {each.in_file:.7g} in {file} and {each.in_machine:.7g} "
        f"in {machine}"
        for each in others[:SAID]
    )
    more = len(others) - SAID
    return f"{said}, and {more} more differ" if more > 0 else said


# The files that belong together: for the machine and its client, with a single carrier for each
# correction.
#
# A client sends the numbers that it keeps each time it connects, and the firmware adds them to its
# corrections. So whoever writes lines for the machine writes the client's numbers with them.


CHAIN_PER_TURN, FEED = 13, 38  # what clients work out before they send it
# The file in which each client keeps its numbers.
CLIENT_FILES = {"groundcontrol": "groundcontrol.ini", "webcontrol": "webcontrol.json"}
TYPE_THEM = "type these numbers into WebControl's settings"


@dataclass(frozen=True)
class ClientFiles:
    """Files for a client, and the owner's steps with them."""

    files: dict[str, bytes]  # by name; empty if there is nothing but to type
    steps: tuple[str, ...]  # in their order, a sentence each
    typed: dict[Key, str]  # numbers that the owner types into the client
    unsaid: tuple[str, ...]  # what the firmware cannot do, a sentence each


def client_files(
    settings: MachineSettings, *, client: str, firmware: str, original: Source | None, lines: str
) -> ClientFiles:
    """Return the files that make this machine out of the owner's: its lines, and the client's next
    to it.

    `lines` is the name of the first; `original` is the groundcontrol.ini whose other keys are kept.
    Raises InputError if it is missing, or if what the client sends would change the machine.
    """
    files: dict[str, bytes] = {}
    steps: tuple[str, ...] = ()
    numbers: tuple[SentSetting, ...] = ()
    if firmware == "published":
        # The client carries all corrections.
        if client == "none":
            raise InputError(
                to_do(
                    "--client none: the published firmware gets its numbers from a client; give "
                    "--client groundcontrol or webcontrol",
                    page="the published firmware gets its numbers from a client: open its file",
                )
            )
        changes = groundcontrol_changes(settings)
        values, unsaid = changes.values, changes.unsaid
    else:
        # The lines carry all corrections, and the client carries none.
        numbers = firmware_numbers(settings)
        files = {lines: gcode(numbers)}
        steps = (f"open {lines} in your sender like a program and run it: it sets the machine",)
        values, unsaid = _kept_by_client(settings), ()
        if client == "none":
            return ClientFiles(files, steps, {}, ())
    if client == "webcontrol" and original is None:
        typed = {key: number_for_firmware(value) for key, value in values.items()}
        return ClientFiles(files, (TYPE_THEM, *steps), typed, unsaid)
    name, content = _client_file(client, values, original, lines)
    if numbers:
        refuse_what_disturbs(settings, numbers, content, source=str(original))
    return ClientFiles({**files, name: content}, (_put_in_place(client, name), *steps), {}, unsaid)


def gcode(numbers: tuple[SentSetting, ...]) -> bytes:
    """Return the numbers as lines for the machine."""
    return "".join(f"{row.line}\n" for row in numbers).encode()


def client_numbers(ini: IniText) -> dict[int, float]:
    """Return what a client sends of this file that says where the sled hangs, by $-number."""

    def said(name: str) -> str:
        section, key = SOURCES[name]
        return ini.needed(key, section=section).value.lower()

    teeth, pitch = (
        ini.number(key, section=section)
        for section, key in (SOURCES["gear_teeth"], SOURCES["link_pitch"])
    )
    numbers = {
        KINEMATICS: 1.0 if said("kinematics") == "quadrilateral" else 2.0,
        CHAIN_PER_TURN: teeth * pitch,
        FEED: 1.0 if said("feed") == "top" else 2.0,
    }
    for setting in every_setting():
        section, _, key = setting.key.partition(": ")
        named = f"{section} Settings"
        is_said = key and ini.find(key, section=named)
        if is_said and "geometry" in setting.touches and setting.number not in numbers:
            numbers[setting.number] = ini.number(key, section=named)
    return numbers


def refuse_what_disturbs(
    settings: MachineSettings, numbers: tuple[SentSetting, ...], content: bytes, *, source: str
) -> None:
    """Refuse a client's file that would change the machine once its lines are there."""
    lines = {row.number: float(row.text) for row in numbers}
    sent = client_numbers(parse_client_file(content, source=source))
    both = {**lines, **sent}
    apart = chains_apart(settings, both)
    same_kind = sent[KINEMATICS] == lines[KINEMATICS]
    if same_kind and not _core.carried_twice(both) and apart <= WORST:
        return
    other = [n for n, value in sent.items() if n in lines and not np.isclose(value, lines[n])]
    said = ", ".join(f"${n} = {sent[n]:g} instead of {lines[n]:g}" for n in other)
    raise InputError(
        source,
        f"the client would send {said}, which is another machine",
        remedy="correct the file, or give the file of this machine",
    )


def _kept_by_client(settings: MachineSettings) -> dict[Key, float]:
    """Return what a client must keep so that it disturbs none of the lines."""
    said = {
        "motor_gap": settings.motor_gap,
        "motor_offset": settings.motor_offset,
        "rotation_radius": settings.rotation_radius,
        **dict.fromkeys(TUNED.values(), 0.0),
    }
    return {SOURCES[name]: round(value, 4) for name, value in said.items()}


def _client_file(
    client: str, values: Mapping[Key, float], original: Source | None, lines: str
) -> tuple[str, bytes]:
    """Name and content of the client's new file."""
    file = CLIENT_FILES[client]
    if original is None:
        raise InputError(
            to_do(
                f"--client {client} needs your {file}, whose other keys it keeps: give it with "
                "--original",
                page=f"your {file} is needed, whose other keys are kept: open it",
            )
        )
    if Path(original).suffix.lower() != Path(file).suffix:
        needs = to_do(f"--client {client} needs that file", page=f"open your {file}")
        raise InputError(original, f"is not a {file}", remedy=needs)
    name = Path(lines).with_name(f"{Path(lines).stem}-{file}")
    return str(name), changed_client_file(original, values)


def _put_in_place(client: str, name: str) -> str:
    if client == "webcontrol":
        return f"stop WebControl, put {name} in place of its webcontrol.json, and start it again"
    return f"close GroundControl, put {name} in place of its groundcontrol.ini, and connect"
