"""The settings of a machine, and the `machine.toml` that holds them.

Lengths in mm, forces in N, in the machine frame (origin in the middle of the sheet, y up).
"""

from __future__ import annotations

import hashlib
import json
import math
import os
import re
import tomllib
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import asdict, dataclass, field, replace
from decimal import Decimal
from difflib import get_close_matches
from functools import partial
from pathlib import Path
from typing import Annotated, Any, Literal, NamedTuple, get_args

import numpy as np
from pydantic import BaseModel, BeforeValidator, Field, model_validator
from pydantic.dataclasses import dataclass as pydantic_dataclass

from plumb import _core
from plumb.text.answers import meant
from plumb.text.errors import InputError, Source, naming
from plumb.text.files import (
    CODE,
    IniEntry,
    IniText,
    parse_ini,
    parsed,
    read_bytes,
    read_ini,
    read_text,
    with_values,
    write_whole,
)
from plumb.text.tables import Number, Table, part, read_table, refuse_other_keys, toml_text
from plumb.text.values import number_in, numbers, refuse_unknown

GRAVITY = 9.81  # [N/kg]
SLED_WEIGHT = 97.9  # [N] 22 pounds, the published default
CHAIN_WEIGHT = 0.00137293  # [N/mm] 0.14 kg/m, the published data of #25 chain
HOLEY_CHAIN_WEIGHT = 0.001372  # [N/mm] as the catenary release rounds it
SPROCKET_RADIUS = 10 * 6.35 / (2 * math.pi)  # [mm] ten teeth of 6.35 mm
Feed = Literal["top", "bottom"]


class Frame(Table):
    """The seven numbers that every machine has; docs/words.md says what each is."""

    motor_gap: Annotated[Number, meant("mm between sprocket centres")]
    motor_height: Annotated[Number, meant("mm, sprocket centres above the middle of the sheet")]
    motor_center_x: Annotated[
        Number, meant("mm, middle between the sprockets right of the middle of the sheet")
    ] = 0.0
    rotation_radius: Annotated[Number, meant("mm from the bit to the end of the chain")]
    sprocket_radius: Annotated[Number, meant("mm")] = SPROCKET_RADIUS
    sled_weight: Annotated[Number, meant("N")] = SLED_WEIGHT
    chain_weight: Annotated[Number, meant("N/mm")] = CHAIN_WEIGHT


FRAME_FIELDS = tuple(Frame.model_fields)


@pydantic_dataclass(frozen=True)
class PublishedSettings:
    """Numbers that only the formulas of the published firmware need, in its units."""

    chain_sag_correction: Annotated[Number, meant("$37, 1e-12/mm^2")] = 0.0
    # Positive: the chain is longer than nominal.
    left_tolerance: Annotated[Number, meant("$40, percent")] = 0.0
    right_tolerance: Annotated[Number, meant("$41, percent")] = 0.0
    # None: not in the file. A weight of zero or less switches the catenary off.
    chain_elasticity: Annotated[Number | None, meant("$45, 1/N")] = None
    holey_sled_weight: Annotated[Number | None, meant("$46, N")] = None
    # Bound of its search for the position.
    chain_length: Annotated[Number, meant("$10, mm")] = 3360.0
    # Read, but used neither by stock nor by holey.
    top_beam_tilt: Annotated[Number, meant("degrees")] = 0.0

    @model_validator(mode="before")
    @classmethod
    def _refuse_other_keys(cls, said: Any) -> Any:
        return refuse_other_keys(cls, said)

    @property
    def catenary(self) -> tuple[float, float] | None:
        """Sled weight [N] and chain elasticity [1/N] of the catenary release; None: switched off.

        Raises InputError if the file did not say them: its firmware and its client differ in
        their defaults, so guessing would shift the marks by millimetres.
        """
        if self.holey_sled_weight is not None and self.holey_sled_weight <= 0:
            return None
        if self.holey_sled_weight is None or self.chain_elasticity is None:
            weightless = self.holey_sled_weight is None
            missing = "sledWeight ($46, N)" if weightless else "chainElasticity ($45, 1/N)"
            raise InputError(
                f"settings for controller holey: {missing} is missing; add it to the settings as "
                "the machine reports it"
            )
        return self.holey_sled_weight, self.chain_elasticity


class SettingsFile(NamedTuple):
    """The file that settings were read from."""

    name: str
    sha256: str


@dataclass(frozen=True)
class MachineSettings:
    """A machine: frame [mm, N], effects by name, and whose formula the controller uses."""

    motor_gap: float  # [mm] between sprocket centres
    motor_height: float  # [mm] sprocket centres above the middle of the sheet
    rotation_radius: float  # [mm] from the bit to where the chain ends
    sheet_width: float  # [mm]
    sheet_height: float  # [mm]
    feed: str  # "top": the chain leaves over the sprocket; "bottom": under it
    motor_center_x: float = 0.0  # [mm] middle between the sprockets, right of the sheet's middle
    sprocket_radius: float = SPROCKET_RADIUS  # [mm]
    sled_weight: float = SLED_WEIGHT  # [N]
    chain_weight: float = CHAIN_WEIGHT  # [N/mm]
    controller: str = "plumb"  # "stock", "holey" or "plumb"
    effects: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    published: PublishedSettings = field(default_factory=PublishedSettings)
    # How the numbers came about; no part of the machine.
    file: SettingsFile | None = field(default=None, compare=False, repr=False)
    fitted: FitRecord | None = field(default=None, compare=False, repr=False)

    @property
    def sheet(self) -> tuple[float, float]:
        """Width and height of the sheet [mm]."""
        return self.sheet_width, self.sheet_height

    @property
    def motor_offset(self) -> float:
        """Sprocket centres above the sheet's top edge [mm], as the published programs count."""
        return self.motor_height - self.sheet_height / 2

    @property
    def frame(self) -> dict[str, float]:
        """The seven numbers of the frame by name [mm, N]."""
        return {name: getattr(self, name) for name in FRAME_FIELDS}

    def effect(self, name: str, parameter: str) -> float:
        """Return a parameter of an effect; an effect that is not named is absent, so zero."""
        return self.effects.get(name, {}).get(parameter, 0.0)

    def as_plumb_model(self, *, controller: str | None = None) -> MachineSettings:
        """Return the machine on which the controller would be right, in our frame and effects;
        effects that are named already stay as they are.
        """
        whose = controller or self.controller
        if whose == "plumb":
            return self if self.controller == "plumb" else replace(self, controller="plumb")
        published = self.published
        numbers = {number: getattr(published, name) for number, name in TUNED.items()}
        sled_weight, chain_weight = self.sled_weight, self.chain_weight
        catenary = published.catenary if whose == "holey" else None
        derived = effects_said_by(numbers)
        if catenary:
            sled_weight, chain_weight = catenary[0], HOLEY_CHAIN_WEIGHT
            frame = {**self.frame, "sled_weight": sled_weight, "chain_weight": chain_weight}
            derived |= usual_effects(frame) | effects_said_by({ELASTICITY: catenary[1]})
        left, right = published.left_tolerance / 100, published.right_tolerance / 100
        return replace(
            self,
            controller="plumb",
            sled_weight=sled_weight,
            chain_weight=chain_weight,
            rotation_radius=self.rotation_radius / radius_in_published(left, right),
            effects={**present(derived), **self.effects},
            published=PublishedSettings(),
        )


def frame_of(values: Mapping[str, float]) -> dict[str, Any]:
    """Return the frame among numbers by name; what else there is does not matter."""
    return {name: values[name] for name in FRAME_FIELDS}


def radius_in_published(left: float, right: float) -> float:
    """Return the published rotation radius over the true radius, for two chain pitch strains.

    The published formula divides the whole straight part L by (1 + e), although its last piece, the
    radius R, is no chain: L/(1+e) - R' equals (L-R)/(1+e) if R' = R/(1+e). Both sides
    share a single R', so the mean remains; each is off by half of R times the strains' difference.
    """
    return (1 / (1 + left) + 1 / (1 + right)) / 2


# What numbers of the published programs say of our effects, and back, by the effects' headers.

Effects = dict[str, dict[str, float]]

# The $-numbers by which published settings describe chains, and what we call them.
TUNED = {37: "chain_sag_correction", 40: "left_tolerance", 41: "right_tolerance"}
ELASTICITY = 45  # of the catenary release [1/N]

# By effect and parameter: the published number and by how much it is larger than ours.
_SAID: dict[tuple[str, str], tuple[int, float]] = {
    (effect["name"], parameter["name"]): parameter["published"]
    for effect in _core.effects()
    for parameter in effect["parameters"]
    if parameter["published"]
}


def effects_said_by(numbers: Mapping[int, float]) -> Effects:
    """Return the parameters that published numbers set, even if they are zero."""
    effects: Effects = {}
    for (effect, parameter), (number, factor) in _SAID.items():
        if number in numbers:
            effects.setdefault(effect, {})[parameter] = numbers[number] / factor
    return effects


def usual_effects(frame: Mapping[str, float]) -> Effects:
    """Return what every machine with this frame has: the sizes to expect."""
    values = np.array([frame.get(name, 0.0) for name in _core.settings()], dtype=float)
    effects: Effects = {}
    for name, size in _core.usual(values, True).items():
        effect, _, parameter = name.partition(".")
        effects.setdefault(effect, {})[parameter] = size
    return effects


def present(effects: Mapping[str, Mapping[str, float]]) -> Effects:
    """Return those effects of which some parameter is not zero."""
    return {name: dict(sizes) for name, sizes in effects.items() if any(sizes.values())}


def tuned_numbers(effects: Mapping[str, Mapping[str, float]]) -> dict[str, float]:
    """Return the published settings, by our name for each, that say what these effects are."""
    return {
        TUNED[number]: factor * effects.get(effect, {}).get(parameter, 0.0)
        for (effect, parameter), (number, factor) in _SAID.items()
        if number in TUNED
    }


def is_tuned(effect: str, parameter: str) -> bool:
    """Return whether a setting of every published firmware says this parameter."""
    return _SAID.get((effect, parameter), (0, 0.0))[0] in TUNED


# The published controllers and ours, by the names that files and options use.

Controller = Literal["stock", "holey", "plumb"]  # whose formulas paid the chains out
CONTROLLERS: tuple[str, ...] = get_args(Controller)
CLIENTS = ("groundcontrol", "webcontrol", "none")  # what sends G-code; none keeps no numbers
FIRMWARES = ("plumb", "published")  # what the machine runs


# What a setting can sensibly be, and the sentence for a value that it cannot be.

_INCH = "looks like inches; write millimetres (1 inch = 25.4 mm)"
_NEWTON = "looks like kilograms or pounds; newtons are 9.81 times kilograms, 4.448 times pounds"


@dataclass(frozen=True)
class Limit:
    """The range of a setting, and what a value beyond it looks like."""

    low: float
    high: float
    unit: str
    below: str = ""
    above: str = ""
    zero: bool = False  # exactly zero is allowed too

    def fault(self, value: float) -> str | None:
        """Return the sentence for a value out of range, or None."""
        if not math.isfinite(value):
            return f"{value} is not a usable number"
        if self.low <= value <= self.high or (self.zero and value == 0):
            return None
        looks = self.below if 0 < value < self.low else self.above if value > self.high else ""
        hint = looks or f"{self.low:g} to {self.high:g} {self.unit} is possible".rstrip()
        return f"{value:g} {self.unit} is out of range; {hint}"


FRAME_LIMITS = {
    "sheet_width": Limit(200, 20000, "mm", below=_INCH),
    "sheet_height": Limit(100, 20000, "mm", below=_INCH),
    "motor_gap": Limit(400, 20000, "mm", below=_INCH),
    "motor_offset": Limit(50, 20000, "mm above the sheet's top edge", below=_INCH),
    "motor_center_x": Limit(-5000, 5000, "mm"),
    "rotation_radius": Limit(20, 1000, "mm", below=_INCH, zero=True),
    "sprocket_radius": Limit(2, 100, "mm", below=_INCH),
    "sled_weight": Limit(30, 1000, "N", below=_NEWTON),
    "chain_weight": Limit(
        1e-5,
        0.02,
        "N/mm",
        above="newtons for each millimetre are needed, 0.00981 times kg/m",
        zero=True,
    ),
}
PUBLISHED_LIMITS = {
    "chain_sag_correction": Limit(-1e5, 1e5, ""),
    "left_tolerance": Limit(-5, 5, "percent"),
    "right_tolerance": Limit(-5, 5, "percent"),
    "chain_elasticity": Limit(0, 1e-3, "1/N"),
    "holey_sled_weight": Limit(30, 1000, "N", below=_NEWTON),
    "chain_length": Limit(500, 65535, "mm", below=_INCH),
    "top_beam_tilt": Limit(-45, 45, "degrees"),
}


def find_fault(settings: MachineSettings) -> tuple[str, str] | None:
    """Return the name of the first impossible setting and a sentence about it, or None."""
    for name, limit in {**FRAME_LIMITS, **PUBLISHED_LIMITS}.items():
        value = getattr(settings if name in FRAME_LIMITS else settings.published, name)
        # The published firmware takes a sled weight of zero or less as a switch.
        if value is None or (name == "holey_sled_weight" and value <= 0):
            continue
        fault = limit.fault(value)
        if fault:
            return name, fault
    return None


def refuse_impossible(
    settings: MachineSettings, source: Source, place: Callable[[str], str]
) -> None:
    """Raise InputError for a setting that cannot be; `place` says where the file has it."""
    fault = find_fault(settings)
    if fault:
        raise InputError(source, fault[1], place=place(fault[0]))


# `machine.toml`: every setting by name, with the effects and how they were fitted.


Known = Mapping[str, Sequence[str]] | None  # the parameters of each effect; None: any may be named
NamedEffects = dict[str, dict[str, Number]]


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
    effects: NamedEffects = part()
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
    lab_effects: NamedEffects = part()  # fitted, but no setting holds them


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
        raise holds_marks(path)
    return machine_in(head, path, known=known)


def holds_marks(path: Source) -> InputError:
    """Return the refusal of a file of marks."""
    return InputError(path, "holds marks, not settings", remedy="give SETTINGS first, then MARKS")


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
        {**vars(board), "cut_with": {**_file_of(board.cut_with), **_machine_tables(board.cut_with)}}
        for board in record.boards
    ]
    fit = record.model_dump(exclude={"boards"} if record.lab_effects else {"boards", "lab_effects"})
    return {"fit": fit, "board": boards}


def _file_of(settings: MachineSettings) -> dict[str, str]:
    file = settings.file
    return {"file": file.name, "sha256": file.sha256} if file else {}


# Settings in the files of the published programs, read and written back; a `machine.toml` is read
# from here too.


Key = tuple[str, str]  # section and key of a file
MASLOW, ADVANCED = "Maslow Settings", "Advanced Settings"
Typed = Annotated[float, BeforeValidator(number_in)]


def _word(value: str) -> str:
    if value.lower() == "quadrilateral":
        raise ValueError(
            "Quadrilateral means a sled on two brackets, which the lab does not know; "
            "if your sled hangs on a ring or a linkage, write kinematicsType = Triangular"
        )
    return value.lower()


def _key(section: str, name: str, usual: Any = ...) -> Any:
    """Return where a setting is in the file; `usual`: its value in a file that lacks it."""
    return Field(usual, title=name, description=section)


class Published(BaseModel):
    """The machine according to the file of a client.

    Keys that have a usual value came later or belong to one program only.
    """

    kinematics: Annotated[Literal["triangular"], BeforeValidator(_word)] = _key(
        ADVANCED, "kinematicsType"
    )
    motor_gap: Typed = _key(MASLOW, "motorSpacingX")
    sheet_width: Typed = _key(MASLOW, "bedWidth")
    sheet_height: Typed = _key(MASLOW, "bedHeight")
    motor_offset: Typed = _key(MASLOW, "motorOffsetY")
    rotation_radius: Typed = _key(ADVANCED, "rotationRadius")
    gear_teeth: Typed = _key(ADVANCED, "gearTeeth")
    link_pitch: Typed = _key(ADVANCED, "chainPitch")
    chain_sag_correction: Typed = _key(ADVANCED, "chainSagCorrection")
    feed: Annotated[Feed, BeforeValidator(_word)] = _key(ADVANCED, "chainOverSprocket")
    left_tolerance: Typed = _key(ADVANCED, "leftChainTolerance", 0.0)
    right_tolerance: Typed = _key(ADVANCED, "rightChainTolerance", 0.0)
    chain_length: Typed = _key(ADVANCED, "chainLength", 3360.0)
    chain_elasticity: Typed | None = _key(ADVANCED, "chainElasticity", None)
    holey_sled_weight: Typed | None = _key(MASLOW, "sledWeight", None)
    top_beam_tilt: Typed = _key(ADVANCED, "topBeamTilt", 0.0)


# Which key of the file each of our settings comes from.
SOURCES: dict[str, Key] = {
    name: (str(field.description), str(field.title))
    for name, field in Published.model_fields.items()
}
# Other keys of the same files that look like a misspelt key of this list.
NEIGHBOURS = (
    "chainExtendLength",
    "sledWidth",
    "sledHeight",
    "sledCG",
    "bedDepth",
    "homeX",
    "homeY",
)


def read_settings_ini(path: Source) -> MachineSettings:
    """Return the settings of a groundcontrol.ini; it belongs to the stock controller."""
    ini = read_ini(path)
    if ini.find("numpositions", section="global"):
        raise holds_marks(path)
    sections = {section.lower() for section in ini.sections}
    if not sections & {MASLOW.lower(), ADVANCED.lower()}:
        raise InputError(
            path,
            f"has no section [{MASLOW}]",
            remedy="give the groundcontrol.ini from your home folder or a machine.toml",
        )
    return published_settings(ini)


def published_settings(ini: IniText) -> MachineSettings:
    """Return the settings that the entries of a client's file hold."""
    entries = _entries(ini)
    said = read_table(
        Published,
        {name: entry.value for name, entry in entries.items()},
        ini.source,
        place=lambda path: entries[str(path[0])].place,
    )
    numbers = said.model_dump()
    weight = said.holey_sled_weight
    settings = MachineSettings(
        motor_gap=said.motor_gap,
        motor_height=said.sheet_height / 2 + said.motor_offset,
        rotation_radius=said.rotation_radius,
        sheet_width=said.sheet_width,
        sheet_height=said.sheet_height,
        feed=said.feed,
        sprocket_radius=said.gear_teeth * said.link_pitch / (2 * math.pi),
        sled_weight=weight if weight is not None and weight > 0 else SLED_WEIGHT,
        controller="stock",
        published=PublishedSettings(**{name: numbers[name] for name in PUBLISHED_LIMITS}),
    )

    def place(name: str) -> str:
        if name == "sprocket_radius":
            return "gearTeeth x chainPitch / (2 pi)"
        return entries["holey_sled_weight" if name == "sled_weight" else name].place

    refuse_impossible(settings, ini.source, place)
    return settings


def _entries(ini: IniText) -> dict[str, IniEntry]:
    """Return the entries of our settings; a misspelt key is not a missing key."""
    entries = {}
    for name, (section, key) in SOURCES.items():
        entry = ini.find(key, section=section)
        near = None if entry else _misspelt(ini, key)
        if near:
            what = f"unknown key; did you mean {key}?"
            raise InputError(ini.source, what, place=near, remedy="correct it or remove the line")
        if entry or Published.model_fields[name].is_required():
            entries[name] = ini.needed(key, section=section)
    return entries


def _misspelt(ini: IniText, key: str) -> str | None:
    """Return the place of an entry whose key is unknown and nearly this key."""
    taken = {known.lower() for _, known in SOURCES.values()}
    taken |= {known.lower() for known in NEIGHBOURS}
    others = {entry.key.lower(): entry for entry in ini.entries if entry.key.lower() not in taken}
    near = get_close_matches(key.lower(), others, 1, cutoff=0.85)
    return others[near[0]].place if near else None


# Settings back into a `groundcontrol.ini`: the keys that change, and what cannot be said there.

# The published firmware collects all digits of a number in one 32-bit integer and knows no
# exponent; more digits would overflow silently.
MOST_DIGITS = 9
SAME = 1e-9  # relative; two values closer than this are the same in nine digits
NOTHING = 1e-15  # smaller numbers mean zero for every setting there is


@dataclass(frozen=True)
class GroundControlChanges:
    """Values by (section, key) as a groundcontrol.ini holds them, and what is lost on the way."""

    values: dict[Key, float]
    unsaid: tuple[str, ...]  # a sentence each


def groundcontrol_changes(settings: MachineSettings) -> GroundControlChanges:
    """Return the keys that express these settings for the published firmware, in its units."""
    ours = settings.as_plumb_model()
    published = published_machine(ours)
    said = {
        "motor_gap": published.motor_gap,
        "motor_offset": published.motor_offset,
        **tuned_numbers(ours.effects),
        "rotation_radius": published.rotation_radius,
    }
    # Rounded far below what any of them means, so that 1072.6 - 609.6 is 463 again.
    values = {SOURCES[name]: round(value, 10) for name, value in said.items()}
    return GroundControlChanges(values=values, unsaid=tuple(_unsaid(ours)))


def published_machine(settings: MachineSettings) -> MachineSettings:
    """Return this machine with the published firmware, which gets of it what its numbers
    can say.
    """
    ours = settings.as_plumb_model()
    chains = tuned_numbers(ours.effects)
    left, right = chains["left_tolerance"] / 100, chains["right_tolerance"] / 100
    return replace(
        ours,
        controller="stock",
        rotation_radius=ours.rotation_radius * radius_in_published(left, right),
        published=PublishedSettings(**chains),
    )


def _unsaid(ours: MachineSettings) -> Iterator[str]:
    """Yield everything in our model that no key of the published firmware can hold."""
    if ours.motor_center_x:
        yield f"the motors sit {ours.motor_center_x:g} mm off the middle: move the sheet instead"
    for name, parameters in ours.effects.items():
        for parameter, value in parameters.items():
            if value and not is_tuned(name, parameter):
                yield f"{name} {parameter} = {value:g} has no setting in the published firmware"


def changed_ini(original_path: Source, changes: Mapping[Key, float | str]) -> bytes:
    """Return the bytes of an ini file with some values replaced; equal numbers leave their line
    alone.
    """
    ini = read_ini(original_path)
    needed: dict[Key, str] = {}
    for (section, key), value in changes.items():
        new = new_value(value, original_path, place=f"[{section}] {key}")
        entry = ini.find(key, section=section)
        if entry is None or not same_number(entry.value, value):
            needed[section, key] = new
    text = with_values(ini, needed)
    parse_ini(text, source=str(original_path))
    return text.encode("utf-8", "surrogateescape")


def new_value(value: float | str, source: Source, *, place: str) -> str:
    """Return a value as a client's file has it. Raises InputError for what it cannot hold."""
    if isinstance(value, str):
        if any(sign in value for sign in "\r\n"):
            what = "the new value has a line break"
            raise InputError(source, what, place=place, remedy="write it on a single line")
        return value
    if not math.isfinite(value):
        raise InputError(source, f"{value} is not a usable number", place=place)
    return number_for_firmware(value)


def number_for_firmware(value: float) -> str:
    """Return a number as the published firmware can read it: no exponent, at most nine digits."""
    if abs(value) >= 10**MOST_DIGITS:
        raise ValueError(f"{value:g} has more digits than the published firmware can read")
    if abs(value) < NOTHING:
        return "0"
    text = f"{Decimal(f'{value:.{MOST_DIGITS}g}'):f}"
    return text.rstrip("0").rstrip(".") if "." in text else text


def same_number(old: str, new: float | str) -> bool:
    """Return whether a value of the file says the same already."""
    if isinstance(new, str):
        return old == new
    try:
        return math.isclose(float(old), new, rel_tol=SAME, abs_tol=NOTHING)
    except ValueError:
        return False


# Settings whatever the file's form: `groundcontrol.ini`, `webcontrol.json` or `machine.toml`.


def read_settings(path: Source, *, known: Known = None) -> MachineSettings:
    """Return the settings in a file of a client or ours; known lists each effect's parameters."""
    file = SettingsFile(Path(path).name, hashlib.sha256(read_bytes(path)).hexdigest())
    return replace(_read(path, known), file=file)


def _read(path: Source, known: Known) -> MachineSettings:
    text = read_bytes(path).decode("utf-8-sig", "replace").lstrip()
    if text.startswith("{"):
        return published_settings(parse_webcontrol(text, source=str(path)))
    if re.search(r"(?im)^\s*\[(maslow|advanced) settings\]|^\s*numpositions\s*[=:]", text):
        return read_settings_ini(path)
    ours = re.search(r"(?m)^\s*\[(sheet|frame|effects\..*|published|\[mark\])\]", text)
    if ours or Path(path).suffix.lower() == ".toml":
        return read_machine_toml(path, known=known)
    if Path(path).suffix.lower() == ".ini":
        return read_settings_ini(path)
    if CODE.search(text):
        why = "holds a program, not settings"
        raise InputError(path, why, remedy="give JOB first, then SETTINGS")
    raise InputError(
        path,
        "is none of the known forms of settings",
        remedy="give a groundcontrol.ini, a webcontrol.json or a machine.toml",
    )


def changed_client_file(original_path: Source, changes: Mapping[Key, float | str]) -> bytes:
    """Return the bytes of a client's file with some values replaced and all else as it was."""
    if Path(original_path).suffix.lower() == ".json":
        return changed_webcontrol(original_path, changes)
    return changed_ini(original_path, changes)


def parse_client_file(content: bytes, *, source: str) -> IniText:
    """Return the entries of a client's file."""
    text = content.decode("utf-8-sig", "surrogateescape")
    is_json = text.lstrip().startswith("{")
    return (parse_webcontrol if is_json else parse_ini)(text, source=source)


# `webcontrol.json`: the settings of WebControl, by the sections and keys of a groundcontrol.ini.


def parse_webcontrol(text: str, *, source: str) -> IniText:
    """Return the entries of the text of a webcontrol.json."""
    lines = tuple(text.splitlines(keepends=True))
    entries = [
        IniEntry(section, str(option["key"]), str(option["value"]), _line_of(option, lines))
        for section, option in _options(_loaded(text, source))
    ]
    return IniText(source, lines, tuple(entries))


def changed_webcontrol(original_path: Source, changes: Mapping[Key, float | str]) -> bytes:
    """Return the bytes of a webcontrol.json with some values replaced; equal numbers stay as they
    are.
    """
    text = read_text(original_path)
    document = _loaded(text, str(original_path))
    for (section, key), value in changes.items():
        new = new_value(value, original_path, place=f"{section}, {key}")
        same = [
            option
            for place, option in _options(document)
            if place == section and str(option["key"]).lower() == key.lower()
        ]
        if not same:
            if section not in document:
                raise InputError(original_path, f"has no section {section}")
            document[section].append({"key": key, "type": "string", "value": new})
        for option in same:
            if not same_number(str(option["value"]), value):
                option["value"] = new if isinstance(option["value"], str) else float(new)
    return json.dumps(document, indent=4, ensure_ascii=False).encode()


def _loaded(text: str, source: str) -> dict[str, Any]:
    """Return the document, if it is one of WebControl."""
    document = parsed(source, text, json.loads, "JSON")
    sections = document.values() if isinstance(document, dict) else ()
    if not any(isinstance(section, list) for section in sections):
        raise InputError(
            source,
            "is a JSON file, but not one of WebControl",
            remedy="give a webcontrol.json, a groundcontrol.ini or a machine.toml",
        )
    return dict(document)


def _options(document: dict[str, Any]) -> Iterator[tuple[str, dict[str, Any]]]:
    """Section and option of each setting that has a value."""
    for section, options in document.items():
        for option in options if isinstance(options, list) else ():
            if isinstance(option, dict) and {"key", "value"} <= option.keys():
                yield section, option


def _line_of(option: dict[str, Any], lines: tuple[str, ...]) -> int:
    """Return the line with the key of an option; the first line if it is written in another way."""
    wanted = f'"key": {json.dumps(option["key"])}'
    return next((number for number, line in enumerate(lines, 1) if wanted in line), 1)


# The settings in force while marks are cut: their file, and a digest of what moves the sled.
# A form names them, and a program names its form.
#
# GroundControl rewrites its file whenever a window is moved, so only the numbers count that say
# where the sled hangs.


# Keys of a client's file that say how long the chains are for a place; one bounds a search alone.
KEYS = {key.lower() for name, (_, key) in SOURCES.items() if name != "chain_length"}
ENDINGS = (".ini", ".json", ".toml")  # of settings
LONGEST = 60  # characters of a form's name in a comment
FORM = re.compile(r"^\(form: (.+)\)$", re.MULTILINE)


def cut_with_lines(settings: Source | None, form: str) -> str:
    """Return the lines of a form at that path that name the settings' file and keep its digest."""
    if settings is None:
        return ""
    name = json.dumps(_near(settings, form))
    return f'\ncut_with = {name}\ncut_with_digest = "{digest_of(settings)}"'


def with_form(program: str, form: str, path: str) -> str:
    """Return a program at that path with a comment that names the form for its readings, so that
    whoever sends it knows what it is to be cut with; without, where no comment can hold the name.
    """
    near = _near(form, path)
    if not near.isascii() or not near.isprintable() or set(near) & set("()") or len(near) > LONGEST:
        return program
    first, *rest = program.split("\n", 1)
    return "\n".join([first, f"(form: {near})", *rest])


def _near(path: Source, other: str) -> str:
    """Return how a file beside the other would name a path: whole if it is on another drive."""
    try:
        near = os.path.relpath(path, os.path.dirname(os.path.abspath(other)))
    except ValueError:
        near = os.path.abspath(path)
    return near.replace(os.sep, "/")


def form_of(program: str, path: str) -> str | None:
    """Return the form for the readings of a program at that path; None if it names none."""
    named = FORM.search(program)
    return os.path.join(os.path.dirname(path), named[1]) if named else None


def digest_of(settings: Source) -> str:
    """Return the SHA-256 of what a client's file says of the chains, or of a whole machine.toml."""
    content = read_bytes(settings)
    try:
        entries = parse_client_file(content, source=os.fspath(settings)).entries
    except InputError:
        entries = ()
    said = {
        entry.key.lower(): _plain(entry.value) for entry in entries if entry.key.lower() in KEYS
    }
    text = json.dumps(said, sort_keys=True).encode() if said else content
    return hashlib.sha256(text).hexdigest()


def settings_as_they_were(named: Path, digest: str) -> Path | None:
    """Return the file with the settings that a form names: the named, or if that says something
    else by now, a file next to it that says what it said. None if nobody kept them.
    """
    if not digest or _says(named, digest):
        return named
    for other in sorted(named.parent.iterdir()) if named.parent.is_dir() else ():
        if other.suffix in ENDINGS and not other.is_symlink() and _says(other, digest):
            return other
    return None if named.exists() else named


def _says(path: Path, digest: str) -> bool:
    with suppress(InputError):
        return path.is_file() and digest_of(path) == digest
    return False


def _plain(value: str) -> str:
    """Return a value by its meaning: 463 is 463.0, and Top is top."""
    try:
        return repr(float(value))
    except ValueError:
        return value.strip().lower()
