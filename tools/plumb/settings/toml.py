"""`machine.toml`: every setting by name, with the effects and how they were fitted."""

from __future__ import annotations

import json
import math
import re
import tomllib
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from os import PathLike
from typing import Any

from plumb.settings.machine import (
    CHAIN_WEIGHT,
    CONTROLLERS,
    FEEDS,
    FRAME_FIELDS,
    SLED_WEIGHT,
    SPROCKET_RADIUS,
    MachineSettings,
    PublishedSettings,
    SettingsFile,
    check_effects,
    find_fault,
    frame_of,
)
from plumb.text.errors import InputError, naming, to_do
from plumb.text.files import parsed, read_text, write_whole
from plumb.text.values import number, numbers, one_of, refuse_unknown, text_of, texts


def read_machine_toml(
    path: str | PathLike[str], *, known: Mapping[str, Sequence[str]] | None = None
) -> MachineSettings:
    """Return the settings of a machine.toml; known lists the parameters of each effect."""
    head = parsed(path, read_text(path), tomllib.loads, "TOML")
    if "mark" in head or "distance" in head:
        raise InputError(
            path, "holds marks, not settings", remedy="give SETTINGS first, then MARKS"
        )
    with naming(path, "at the top"):
        refuse_unknown(head, (*MACHINE_KEYS, *FIT_KEYS))
    machine = machine_in(path, head, place="", known=known)
    return replace(machine, fitted=read_fit_record(path, head, known=known))


def write_machine_toml(path: str | PathLike[str], settings: MachineSettings) -> None:
    """Write the settings so that reading gives back every number bit for bit."""
    write_whole(path, machine_toml(settings).encode("utf-8"))


def machine_toml(settings: MachineSettings, *, comment: str = "") -> str:
    """Return the text of a machine.toml; each line of the comment gets its #."""
    fault = find_fault(settings)
    if fault:
        raise InputError(f"these settings cannot be written: {fault[0]}: {fault[1]}")
    check_effects("these settings", settings.effects, known=None)
    lines = ["# Settings of one hanging machine, for plumb. Lengths in mm, forces in N."]
    lines += [f"# {line}".rstrip() for line in comment.splitlines()]
    lines += ["", *machine_lines(settings, place="")]
    lines += fit_record_lines(settings.fitted) if settings.fitted else []
    return "\n".join(lines) + "\n"


# A machine as tables of a toml file: read strictly, written exactly.

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
    """Return the machine in a table; `place` goes before the names of its tables, as in
    `board.`.
    """
    source = Tables(path, head, place)
    sheet = source.numbers("sheet", allowed=("width", "height"), needed=("width", "height"))
    frame = source.numbers("frame", allowed=FRAME_FIELDS, needed=NEEDED_FRAME)
    published = source.numbers("published", allowed=PUBLISHED_FIELDS, needed=())
    effects = source.effects()
    check_effects(str(path), effects, known=known)
    if "feed" not in head:
        raise InputError(
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
        raise InputError(path, fault[1], place=_place_of(fault[0], place))
    return settings


def machine_lines(settings: MachineSettings, *, place: str) -> list[str]:
    """Return a machine in a table; `place` goes before the names of its tables."""
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
    """Return a name as TOML writes it; ours need no quotes."""
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
        """Return the numbers of a table, none unknown and none missing."""
        table = self.table(name, f"write a line [{self.place}{name}]")
        with naming(self.path, f"[{self.place}{name}]"):
            refuse_unknown(table, allowed)
            for key in needed:
                if key not in table:
                    raise ValueError(f"{key} is missing; add {key} = ... [{UNITS[key]}]")
        return self.numbers_in(table, f"[{self.place}{name}]")

    def effects(self) -> dict[str, dict[str, float]]:
        """Return all tables [effects.name]."""
        effects: dict[str, dict[str, float]] = {}
        for name, parameters in self.table("effects", "write [effects.NAME]").items():
            if not isinstance(parameters, dict):
                raise InputError(
                    self.path,
                    f"{name} is not an effect",
                    place=f"[{self.place}effects]",
                    remedy="write a line [effects.NAME] above its parameters",
                )
            effects[name] = self.numbers_in(parameters, f"[{self.place}effects.{name}]")
        return effects

    def table(self, name: str, remedy: str) -> dict[str, Any]:
        """Return a table that may be missing."""
        table = self.head.get(name, {})
        if not isinstance(table, dict):
            raise InputError(self.path, f"{self.place}{name} is not a table", remedy=remedy)
        return table

    def numbers_in(self, table: dict[str, Any], where: str) -> dict[str, float]:
        """Return the values of a table as numbers."""
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


# The part of a machine.toml that says how its numbers were fitted: [fit] and a [[board]] each.

FIT_KEYS = ("fit", "board")
NUMBER_KEYS = ("start_rms", "rms", "priced_rms", "left_out_rms", "sheet_rotation")
WORD_KEYS = ("effects", "without")
BOARD_KEYS = ("marks", "digest", "sheet", "zeros", "cut_with")
CUT_KEYS = ("file", "sha256", *MACHINE_KEYS)
INTRODUCTION = """
# How these numbers were fitted, in mm and rad; no part of the machine. The lab compares the same
# marks with it, and knows with which settings they were cut."""


def read_fit_record(
    path: str | PathLike[str],
    head: dict[str, Any],
    *,
    known: Mapping[str, Sequence[str]] | None,
) -> FitRecord | None:
    """Return what the file says of its fit; None if it says nothing."""
    if "fit" not in head and "board" not in head:
        return None
    tables = Tables(path, head, "")
    fit = tables.table("fit", "write a line [fit]")
    boards = head.get("board", [])
    if not isinstance(boards, list) or not all(isinstance(board, dict) for board in boards):
        raise InputError(path, "board is not a list of tables", remedy="write a line [[board]]")
    with naming(path, "[fit]"):
        refuse_unknown(fit, (*NUMBER_KEYS, *WORD_KEYS, "lab_effects"))
        words = {key: texts(fit.get(key, [])) for key in WORD_KEYS}
        for key in NUMBER_KEYS:
            if key not in fit:
                remedy = to_do("let plumb add write the file", page="let Correct write the file")
                raise ValueError(f"{key} is missing; {remedy}")
    lab = Tables(path, {"effects": fit.get("lab_effects", {})}, "fit.lab_")
    left = tables.numbers_in({key: fit[key] for key in NUMBER_KEYS}, "[fit]")
    return FitRecord(
        start_rms=left["start_rms"],
        rms=left["rms"],
        priced_rms=left["priced_rms"],
        left_out_rms=left["left_out_rms"],
        sheet_rotation=left["sheet_rotation"],
        effects=words["effects"],
        without=words["without"],
        lab_effects=lab.effects(),
        boards=tuple(_board(path, board, known) for board in boards),
    )


def _board(
    path: str | PathLike[str], board: dict[str, Any], known: Mapping[str, Sequence[str]] | None
) -> FittedBoard:
    with naming(path, "[[board]]"):
        refuse_unknown(board, BOARD_KEYS)
        marks, digest = text_of(board.get("marks")), text_of(board.get("digest"))
        sheet = numbers(board.get("sheet", [0, 0, 0]), 3)
        zeros = numbers(board.get("zeros", [0, 0]), 2)
    cut_with = Tables(path, board, "board.").table("cut_with", "write a line [board.cut_with]")
    with naming(path, "[board.cut_with]"):
        refuse_unknown(cut_with, CUT_KEYS)
        file = SettingsFile(text_of(cut_with.get("file", "")), text_of(cut_with.get("sha256", "")))
    machine = machine_in(path, cut_with, place="board.cut_with.", known=known, file=file)
    return FittedBoard(
        marks=marks,
        digest=digest,
        cut_with=machine,
        sheet=(sheet[0], sheet[1], sheet[2]),
        zeros=(zeros[0], zeros[1]),
    )


def fit_record_lines(record: FitRecord) -> list[str]:
    """Return the lines of a record, which reading gives back bit for bit."""
    lines = [INTRODUCTION, *table_lines("fit", {key: getattr(record, key) for key in NUMBER_KEYS})]
    lines += [f"{key} = {json.dumps(getattr(record, key))}" for key in WORD_KEYS]
    for name, sizes in record.lab_effects.items():
        lines += table_lines(f"fit.lab_effects.{key_text(name)}", sizes)
    for board in record.boards:
        lines += [
            "\n[[board]]",
            f"marks = {json.dumps(board.marks)}",
            f'digest = "{board.digest}"',
            f"sheet = {list(board.sheet)}  # x, y in mm and rotation in rad, to the first sheet",
            f"zeros = {list(board.zeros)}  # mm more chain, left and right, than at the first",
            "\n[board.cut_with]",
            *_file_lines(board.cut_with),
            *machine_lines(board.cut_with, place="board.cut_with."),
        ]
    return lines


def _file_lines(machine: MachineSettings) -> list[str]:
    if machine.file is None:
        return []
    return [f"file = {json.dumps(machine.file.name)}", f'sha256 = "{machine.file.sha256}"']


# How the numbers of a machine came about: the marks that they were fitted to, and what was left.
#
# A machine.toml keeps it, so that the error which a fit promised can be seen again.


@dataclass(frozen=True)
class FittedBoard:
    """A file of marks as the fit took it."""

    marks: str  # the file's name
    digest: str  # of its readings, by marks/model.py
    cut_with: MachineSettings  # in force when the marks were cut
    sheet: tuple[float, float, float] = (0.0, 0.0, 0.0)  # x, y [mm], rotation [rad], to the first
    zeros: tuple[float, float] = (0.0, 0.0)  # [mm] more chain left and right than at the first


@dataclass(frozen=True)
class FitRecord:
    """The fit that gave these settings."""

    start_rms: float  # [mm] of the marks with the settings before
    rms: float  # [mm] after the fit
    priced_rms: float  # [mm]
    left_out_rms: float  # [mm]
    sheet_rotation: float  # [rad] counter-clockwise, of all sheets
    effects: tuple[str, ...] = ()  # that were fitted
    without: tuple[str, ...] = ()  # marks that took no part
    # Fitted, but no setting holds them.
    lab_effects: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    boards: tuple[FittedBoard, ...] = ()

    def sheet_rise(self, sheet_width: float) -> float:
        """Return how far [mm] to raise the right end of the last sheet [mm wide] to undo its
        rotation.
        """
        return math.tan(self.last_sheet_rotation) * sheet_width

    @property
    def last_sheet_rotation(self) -> float:
        """[rad] counter-clockwise, of the sheet that was fitted last."""
        return self.sheet_rotation + (self.boards[-1].sheet[2] if self.boards else 0.0)

    def is_of(self, digests: Collection[str]) -> bool:
        """Return whether just the boards with these readings were fitted."""
        return {board.digest for board in self.boards} == set(digests)

    def board(self, digest: str) -> FittedBoard | None:
        """Return the board with these readings."""
        return next((board for board in self.boards if board.digest == digest), None)

    def knows_other_settings(self, settings: MachineSettings) -> bool:
        """Return whether some board was cut with other settings than these."""
        return any(board.cut_with != settings for board in self.boards)
