"""`machine.toml`: every setting by name, with the effects; read strictly, written exactly."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import fields
from os import PathLike
from typing import Any

from plumb.settings.controllers import CONTROLLERS
from plumb.settings.limits import check_effects, find_fault
from plumb.settings.machine import (
    FEEDS,
    FRAME_FIELDS,
    MachineSettings,
    PublishedSettings,
)
from plumb.text.errors import InputError, naming, refusal
from plumb.text.files import read_text, write_whole
from plumb.text.values import number, one_of, refuse_unknown

NEEDED_FRAME = ("motor_gap", "motor_height", "rotation_radius")
PUBLISHED_FIELDS = tuple(field.name for field in fields(PublishedSettings))
HEAD_KEYS = ("controller", "feed", "sheet", "frame", "effects", "published")
UNITS = {
    "width": "mm",
    "height": "mm",
    "motor_gap": "mm between sprocket centres",
    "motor_height": "mm, sprocket centres above the middle of the sheet",
    "motor_center_x": "mm, middle between the sprockets right of the middle of the sheet",
    "rotation_radius": "mm from the bit to the end of the chain",
    "sprocket_radius": "mm",
    "sled_weight": "N",
    "chain_weight": "N/mm",
    "chain_sag_correction": "$37, 1e-12/mm^2",
    "left_tolerance": "$40, percent",
    "right_tolerance": "$41, percent",
    "chain_elasticity": "$45, 1/N",
    "holey_sled_weight": "$46, N",
    "chain_length": "$10, mm",
    "top_beam_tilt": "degrees",
}


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
        refuse_unknown(head, HEAD_KEYS)
    sheet = _numbers(path, head, "sheet", allowed=("width", "height"), needed=("width", "height"))
    frame = _numbers(path, head, "frame", allowed=FRAME_FIELDS, needed=NEEDED_FRAME)
    published = _numbers(path, head, "published", allowed=PUBLISHED_FIELDS, needed=())
    effects = _effects(path, head)
    check_effects(str(path), effects, known=known)
    if "feed" not in head:
        raise refusal(path, "feed is missing", remedy='write feed = "top" or feed = "bottom"')
    with naming(path, "feed"):
        feed = one_of(head["feed"], FEEDS)
    with naming(path, "controller"):
        controller = one_of(head.get("controller", "plumb"), CONTROLLERS)
    settings = MachineSettings(
        sheet_width=sheet["width"],
        sheet_height=sheet["height"],
        feed=feed,
        controller=controller,
        effects=effects,
        published=PublishedSettings(**published),
        **frame,
    )
    fault = find_fault(settings)
    if fault:
        raise refusal(path, fault[1], place=_place_of(fault[0]))
    return settings


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
    lines += ["", f'controller = "{settings.controller}"', f'feed = "{settings.feed}"']
    lines += _table("sheet", {"width": settings.sheet_width, "height": settings.sheet_height})
    lines += _table("frame", settings.frame)
    for name, parameters in settings.effects.items():
        lines += _table(f"effects.{_key(name)}", parameters)
    if settings.published != PublishedSettings():
        values = {name: getattr(settings.published, name) for name in PUBLISHED_FIELDS}
        lines += _table("published", {k: v for k, v in values.items() if v is not None})
    return "\n".join(lines) + "\n"


def _table(name: str, values: Mapping[str, float]) -> list[str]:
    lines = ["", f"[{name}]"]
    for key, value in values.items():
        unit = UNITS.get(key) if not name.startswith("effects.") else None
        lines.append(f"{_key(key)} = {float(value)!r}" + (f"  # {unit}" if unit else ""))
    return lines


def _key(name: str) -> str:
    """A name as TOML writes it; ours need no quotes."""
    if not re.fullmatch(r"[A-Za-z0-9_-]+", name):
        raise InputError(f"'{name}' cannot be the name of an effect; use letters, digits and _")
    return name


def _numbers(
    path: str | PathLike[str],
    head: dict[str, Any],
    name: str,
    *,
    allowed: Sequence[str],
    needed: Sequence[str],
) -> dict[str, float]:
    """The numbers of a table, none unknown and none missing."""
    table = head.get(name, {})
    if not isinstance(table, dict):
        raise refusal(path, f"{name} is not a table", remedy=f"write a line [{name}]")
    with naming(path, f"[{name}]"):
        refuse_unknown(table, allowed)
        for key in needed:
            if key not in table:
                raise ValueError(f"{key} is missing; add {key} = ... [{UNITS[key]}]")
    numbers = {}
    for key, value in table.items():
        with naming(path, f"[{name}] {key}"):
            numbers[key] = number(value)
    return numbers


def _effects(path: str | PathLike[str], head: dict[str, Any]) -> dict[str, dict[str, float]]:
    """All tables [effects.name]."""
    table = head.get("effects", {})
    if not isinstance(table, dict):
        raise refusal(path, "effects is not a table", remedy="write [effects.NAME]")
    effects: dict[str, dict[str, float]] = {}
    for name, parameters in table.items():
        if not isinstance(parameters, dict):
            raise refusal(
                path,
                f"{name} is not an effect",
                place="[effects]",
                remedy="write a line [effects.NAME] above its parameters",
            )
        effects[name] = {}
        for parameter, value in parameters.items():
            with naming(path, f"[effects.{name}] {parameter}"):
                effects[name][parameter] = number(value)
    return effects


def _place_of(name: str) -> str:
    """Table and key of a setting, by our name for it."""
    if name in ("sheet_width", "sheet_height"):
        return f"[sheet] {name.removeprefix('sheet_')}"
    if name == "motor_offset":
        return "[frame] motor_height minus half of [sheet] height"
    return f"[frame] {name}" if name in FRAME_FIELDS else f"[published] {name}"
