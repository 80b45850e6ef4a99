"""`machine.toml`: every setting by name, with the effects and how they were fitted."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import replace
from os import PathLike

from plumb.settings.fit_tables import FIT_KEYS, fit_record_lines, read_fit_record
from plumb.settings.limits import check_effects, find_fault
from plumb.settings.machine import MachineSettings
from plumb.settings.machine_tables import MACHINE_KEYS, machine_in, machine_lines
from plumb.text.errors import InputError, naming, refusal
from plumb.text.files import read_text, write_whole
from plumb.text.values import refuse_unknown


def read_machine_toml(
    path: str | PathLike[str], *, known: Mapping[str, Sequence[str]] | None = None
) -> MachineSettings:
    """The settings of a machine.toml; known lists the parameters of each effect."""
    try:
        head = tomllib.loads(read_text(path))
    except tomllib.TOMLDecodeError as error:
        raise refusal(path, f"is not valid TOML: {error}", remedy="mend that line") from None
    if "mark" in head or "distance" in head:
        raise refusal(path, "holds marks, not settings", remedy="give SETTINGS first, then MARKS")
    with naming(path, "at the top"):
        refuse_unknown(head, (*MACHINE_KEYS, *FIT_KEYS))
    machine = machine_in(path, head, place="", known=known)
    return replace(machine, fitted=read_fit_record(path, head, known=known))


def write_machine_toml(
    path: str | PathLike[str], settings: MachineSettings, *, comment: str = ""
) -> None:
    """Write the settings so that reading gives back every number bit for bit."""
    text = machine_toml(settings, comment=comment)
    write_whole(path, text.encode("utf-8"))


def machine_toml(settings: MachineSettings, *, comment: str = "") -> str:
    """The text of a machine.toml; each line of the comment gets its #."""
    fault = find_fault(settings)
    if fault:
        raise InputError(f"these settings cannot be written: {fault[0]}: {fault[1]}")
    check_effects("these settings", settings.effects, known=None)
    lines = ["# Settings of one hanging machine, for plumb. Lengths in mm, forces in N."]
    lines += [f"# {line}".rstrip() for line in comment.splitlines()]
    lines += ["", *machine_lines(settings, place="")]
    lines += fit_record_lines(settings.fitted) if settings.fitted else []
    return "\n".join(lines) + "\n"
