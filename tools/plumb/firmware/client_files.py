"""The files that belong together: for the machine and its client, with a single carrier for each
correction.

A client sends the numbers that it keeps each time it connects, and the firmware adds them to its
corrections. So whoever writes lines for the machine writes the client's numbers with them.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from plumb import _core
from plumb.firmware.settings import (
    WORST,
    SentSetting,
    chains_apart,
    every_setting,
    firmware_numbers,
)
from plumb.settings.files import (
    SOURCES,
    Key,
    changed_client_file,
    groundcontrol_changes,
    number_for_firmware,
    parse_client_file,
)
from plumb.settings.machine import MachineSettings
from plumb.text.errors import InputError, Source, to_do
from plumb.text.ini import IniText

# What clients work out before they send it.
KINEMATICS, CHAIN_PER_TURN, FEED = 7, 13, 38
# The file in which each client keeps its numbers.
CLIENT_FILES = {"groundcontrol": "groundcontrol.ini", "webcontrol": "webcontrol.json"}
TYPE_THEM = "type these numbers into WebControl's settings"
CORRECTIONS = ("chain_sag_correction", "left_tolerance", "right_tolerance")


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
        **dict.fromkeys(CORRECTIONS, 0.0),
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
