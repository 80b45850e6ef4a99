"""`machine.toml`: every setting by name, with the effects and how they were fitted."""

import math
import tomllib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from functools import partial
from typing import Annotated, Any

from pydantic import BeforeValidator

from plumb.settings.machine import (
    Controller,
    Feed,
    Frame,
    MachineSettings,
    PublishedSettings,
    SettingsFile,
    refuse_impossible,
)
from plumb.text.answers import meant
from plumb.text.errors import InputError, Source, naming
from plumb.text.files import parsed, read_text, write_whole
from plumb.text.tables import Number, Table, part, read_table, toml_text
from plumb.text.values import numbers, refuse_unknown

Known = Mapping[str, Sequence[str]] | None  # the parameters of each effect; None: any may be named
Effects = dict[str, dict[str, Number]]


class SheetTable(Table):
    """The table [sheet]."""

    width: Annotated[Number, meant("mm")]
    height: Annotated[Number, meant("mm")]


class MachineTable(Table):
    """A machine: the whole file, or that with which a board was cut."""

    controller: Controller = "plumb"
    feed: Feed
    sheet: SheetTable = part()
    frame: Frame = part()
    effects: Effects = part()
    published: PublishedSettings = part()


class FitTable(Table):
    """The table [fit]: errors of the marks [mm], and what was fitted."""

    start_rms: Number  # with the settings before
    rms: Number  # after the fit
    priced_rms: Number
    left_out_rms: Number
    sheet_rotation: Number  # [rad] counter-clockwise, of all sheets
    effects: tuple[str, ...] = ()  # that were fitted
    without: tuple[str, ...] = ()  # marks that took no part
    lab_effects: Effects = part()  # fitted, but no setting holds them


class CutWith(MachineTable):
    """The table [board.cut_with]."""

    file: str = ""
    sha256: str = ""


class BoardTable(Table):
    """A table [[board]]: a file of marks as the fit took it."""

    marks: str
    digest: str
    sheet: Annotated[
        tuple[float, float, float],
        BeforeValidator(partial(numbers, count=3)),
        meant("x, y in mm and rotation in rad, to the first sheet"),
    ] = (0.0, 0.0, 0.0)
    zeros: Annotated[
        tuple[float, float],
        BeforeValidator(partial(numbers, count=2)),
        meant("mm more chain, left and right, than at the first"),
    ] = (0.0, 0.0)
    cut_with: CutWith = part()


class MachineFile(MachineTable):
    """A machine.toml."""

    fit: FitTable | None = None
    board: tuple[BoardTable, ...] = ()


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


class FitRecord(FitTable):
    """The fit that gave these settings."""

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

    def is_of(self, digests: Iterable[str]) -> bool:
        """Return whether just the boards with these readings were fitted."""
        return {board.digest for board in self.boards} == set(digests)

    def board(self, digest: str) -> FittedBoard | None:
        """Return the board with these readings."""
        return next((board for board in self.boards if board.digest == digest), None)


def read_machine_toml(path: Source, *, known: Known = None) -> MachineSettings:
    """Return the settings of a machine.toml; known lists the parameters of each effect."""
    head = parsed(path, read_text(path), tomllib.loads, "TOML")
    if "mark" in head or "distance" in head:
        raise InputError(
            path, "holds marks, not settings", remedy="give SETTINGS first, then MARKS"
        )
    return machine_in(head, path, known=known)


def machine_in(head: Mapping[str, Any], source: Source, *, known: Known = None) -> MachineSettings:
    """Return the machine in the tables of a machine.toml. Raises InputError."""
    # A board says nothing without its fit.
    said = {"fit": {}, **head} if "board" in head else head
    file = read_table(MachineFile, said, source)
    machine = _machine(file, source, known)
    if file.fit is None:
        return machine
    boards = tuple(
        FittedBoard(**{**dict(board), "cut_with": _cut_with(board.cut_with, source, known)})
        for board in file.board
    )
    return replace(machine, fitted=FitRecord(**dict(file.fit), boards=boards))


def _cut_with(table: CutWith, source: Source, known: Known) -> MachineSettings:
    machine = _machine(table, source, known, place="board.cut_with.")
    return replace(machine, file=SettingsFile(table.file, table.sha256))


def _machine(
    table: MachineTable, source: Source, known: Known, *, place: str = ""
) -> MachineSettings:
    """Return the machine in a table; `place` goes before the names of its tables."""
    for name, parameters in table.effects.items():
        with naming(source, f"[{place}effects.{name}]"):
            if known is not None:
                refuse_unknown([name], known)
                refuse_unknown(parameters, known[name])
    settings = MachineSettings(
        controller=table.controller,
        feed=table.feed,
        sheet_width=table.sheet.width,
        sheet_height=table.sheet.height,
        effects=table.effects,
        published=table.published,
        **dict(table.frame),
    )
    refuse_impossible(settings, source, lambda name: _place_of(name, place))
    return settings


def _place_of(name: str, place: str) -> str:
    """Table and key of a setting, by our name for it."""
    if name in ("sheet_width", "sheet_height"):
        return f"[{place}sheet] {name.removeprefix('sheet_')}"
    if name == "motor_offset":
        return f"[{place}frame] motor_height minus half of [{place}sheet] height"
    return f"[{place}frame] {name}" if name in Frame.model_fields else f"[{place}published] {name}"


# A machine as the text of its file.

INTRODUCTION = """\
# How these numbers were fitted, in mm and rad; no part of the machine. The lab compares the same
# marks with it, and knows with which settings they were cut.
"""
TABLES: Mapping[str, Any] = {
    "sheet": SheetTable,
    "frame": Frame,
    "published": PublishedSettings,
    "board": BoardTable,
}
# What stands behind a number, by its table and key.
NOTES = {
    f"{table}.{key}": field.description
    for table, kind in TABLES.items()
    for key, field in kind.__pydantic_fields__.items()
}


def write_machine_toml(path: Source, settings: MachineSettings) -> None:
    """Write the settings so that reading gives back every number bit for bit."""
    write_whole(path, machine_toml(settings).encode("utf-8"))


def machine_toml(settings: MachineSettings, *, comment: str = "") -> str:
    """Return the text of a machine.toml; each line of the comment gets its #."""
    tables = _machine_tables(settings)
    machine_in(tables, "settings that cannot be written")
    lines = ["# Settings of one hanging machine, for plumb. Lengths in mm, forces in N."]
    lines += [f"# {line}".rstrip() for line in comment.splitlines()]
    parts = ["\n".join([*lines, ""]), toml_text(tables, NOTES)]
    if settings.fitted:
        parts += [INTRODUCTION, toml_text(_record_tables(settings.fitted), NOTES)]
    return "\n".join(parts)


def _machine_tables(settings: MachineSettings) -> dict[str, Any]:
    published = asdict(settings.published) if settings.published != PublishedSettings() else {}
    tables = {
        "controller": settings.controller,
        "feed": settings.feed,
        "sheet": {"width": settings.sheet_width, "height": settings.sheet_height},
        "frame": settings.frame,
        "effects": settings.effects,
        "published": {key: value for key, value in published.items() if value is not None},
    }
    return {name: said for name, said in tables.items() if said != {}}


def _record_tables(record: FitRecord) -> dict[str, Any]:
    boards: list[dict[str, Any]] = [
        {
            **vars(board),
            "cut_with": {
                **_file_of(board.cut_with),
                **_machine_tables(board.cut_with),
            },
        }
        for board in record.boards
    ]
    fit = record.model_dump(exclude={"boards"} if record.lab_effects else {"boards", "lab_effects"})
    return {"fit": fit, "board": boards}


def _file_of(settings: MachineSettings) -> dict[str, str]:
    file = settings.file
    return {"file": file.name, "sha256": file.sha256} if file else {}
