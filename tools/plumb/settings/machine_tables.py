"""A machine as tables of a toml file: read strictly, written exactly."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from os import PathLike
from typing import Any

from plumb.settings.controllers import CONTROLLERS
from plumb.settings.limits import check_effects, find_fault
from plumb.settings.machine import (
    CHAIN_WEIGHT,
    FEEDS,
    FRAME_FIELDS,
    SLED_WEIGHT,
    SPROCKET_RADIUS,
    MachineSettings,
    PublishedSettings,
    SettingsFile,
    frame_of,
)
from plumb.text.errors import InputError, naming, refusal
from plumb.text.values import number, one_of, refuse_unknown

NEEDED_FRAME = ("motor_gap", "motor_height", "rotation_radius")
# Of a file that does not say them.
USUAL_FRAME = {
    "motor_center_x": 0.0,
    "sprocket_radius": SPROCKET_RADIUS,
    "sled_weight": SLED_WEIGHT,
    "chain_weight": CHAIN_WEIGHT,
}
PUBLISHED_FIELDS = tuple(field.name for field in fields(PublishedSettings))
MACHINE_KEYS = ("controller", "feed", "sheet", "frame", "effects", "published")
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


def machine_in(
    path: str | PathLike[str],
    head: dict[str, Any],
    *,
    place: str,
    known: Mapping[str, Sequence[str]] | None,
    file: SettingsFile | None = None,
) -> MachineSettings:
    """The machine in a table; `place` goes before the names of its tables, as in `board.`."""
    source = Tables(path, head, place)
    sheet = source.numbers("sheet", allowed=("width", "height"), needed=("width", "height"))
    frame = source.numbers("frame", allowed=FRAME_FIELDS, needed=NEEDED_FRAME)
    published = source.numbers("published", allowed=PUBLISHED_FIELDS, needed=())
    effects = source.effects()
    check_effects(str(path), effects, known=known)
    if "feed" not in head:
        raise refusal(
            path, f"{place}feed is missing", remedy='write feed = "top" or feed = "bottom"'
        )
    with naming(path, f"{place}feed"):
        feed = one_of(head["feed"], FEEDS)
    with naming(path, f"{place}controller"):
        controller = one_of(head.get("controller", "plumb"), CONTROLLERS)
    settings = MachineSettings(
        sheet_width=sheet["width"],
        sheet_height=sheet["height"],
        feed=feed,
        controller=controller,
        effects=effects,
        published=PublishedSettings(**published),
        file=file,
        **frame_of({**USUAL_FRAME, **frame}),
    )
    fault = find_fault(settings)
    if fault:
        raise refusal(path, fault[1], place=_place_of(fault[0], place))
    return settings


def machine_lines(settings: MachineSettings, *, place: str) -> list[str]:
    """A machine in a table; `place` goes before the names of its tables."""
    lines = [f'controller = "{settings.controller}"', f'feed = "{settings.feed}"']
    sheet = {"width": settings.sheet_width, "height": settings.sheet_height}
    lines += table_lines(f"{place}sheet", sheet)
    lines += table_lines(f"{place}frame", settings.frame)
    for name, parameters in settings.effects.items():
        lines += table_lines(f"{place}effects.{key_text(name)}", parameters)
    if settings.published != PublishedSettings():
        values = {name: getattr(settings.published, name) for name in PUBLISHED_FIELDS}
        lines += table_lines(
            f"{place}published", {k: v for k, v in values.items() if v is not None}
        )
    return lines


def table_lines(name: str, values: Mapping[str, float]) -> list[str]:
    lines = ["", f"[{name}]"]
    for key, value in values.items():
        unit = UNITS.get(key) if "effects." not in name else None
        lines.append(f"{key_text(key)} = {float(value)!r}" + (f"  # {unit}" if unit else ""))
    return lines


def key_text(name: str) -> str:
    """A name as TOML writes it; ours need no quotes."""
    if not re.fullmatch(r"[A-Za-z0-9_-]+", name):
        raise InputError(f"'{name}' cannot be the name of an effect; use letters, digits and _")
    return name


@dataclass(frozen=True)
class Tables:
    """The tables of a machine, and where they stand."""

    path: str | PathLike[str]
    head: dict[str, Any]
    place: str

    def numbers(
        self, name: str, *, allowed: Sequence[str], needed: Sequence[str]
    ) -> dict[str, float]:
        """The numbers of a table, none unknown and none missing."""
        table = self.table(name, f"write a line [{self.place}{name}]")
        with naming(self.path, f"[{self.place}{name}]"):
            refuse_unknown(table, allowed)
            for key in needed:
                if key not in table:
                    raise ValueError(f"{key} is missing; add {key} = ... [{UNITS[key]}]")
        return self.numbers_in(table, f"[{self.place}{name}]")

    def effects(self) -> dict[str, dict[str, float]]:
        """All tables [effects.name]."""
        effects: dict[str, dict[str, float]] = {}
        for name, parameters in self.table("effects", "write [effects.NAME]").items():
            if not isinstance(parameters, dict):
                raise refusal(
                    self.path,
                    f"{name} is not an effect",
                    place=f"[{self.place}effects]",
                    remedy="write a line [effects.NAME] above its parameters",
                )
            effects[name] = self.numbers_in(parameters, f"[{self.place}effects.{name}]")
        return effects

    def table(self, name: str, remedy: str) -> dict[str, Any]:
        """A table that may be missing."""
        table = self.head.get(name, {})
        if not isinstance(table, dict):
            raise refusal(self.path, f"{self.place}{name} is not a table", remedy=remedy)
        return table

    def numbers_in(self, table: dict[str, Any], where: str) -> dict[str, float]:
        """The values of a table as numbers."""
        numbers = {}
        for key, value in table.items():
            with naming(self.path, f"{where} {key}"):
                numbers[key] = number(value)
        return numbers


def _place_of(name: str, place: str) -> str:
    """Table and key of a setting, by our name for it."""
    if name in ("sheet_width", "sheet_height"):
        return f"[{place}sheet] {name.removeprefix('sheet_')}"
    if name == "motor_offset":
        return f"[{place}frame] motor_height minus half of [{place}sheet] height"
    return f"[{place}frame] {name}" if name in FRAME_FIELDS else f"[{place}published] {name}"
