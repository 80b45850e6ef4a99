"""Home marks: holes whose chains are kept. With the bit in such a hole a lost position is restored.

A hole that the machine made at a place was made with the chains that its settings pay out there.
Whatever these settings do not know was in the hole too, so the same chains are right when the bit
is back in it, also after the settings have become better.
"""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import numpy as np
from pydantic import BeforeValidator

from plumb.grid import APPROACH, PLUNGE_FEED, Grid
from plumb.model.predict import FOUND, Array, believed_lengths, places
from plumb.settings import MachineSettings
from plumb.text.answers import in_json, key
from plumb.text.errors import InputError, Source, naming
from plumb.text.files import parsed, read_text, write_whole
from plumb.text.tables import Table, part, read_table, toml_text
from plumb.text.values import pair

Point = tuple[float, float]
NAME = "home.toml"
HEAD = "# Home marks of a machine, for plumb: holes, and the chains with the bit in them. mm."
HOLE_DEPTH = 2.0  # [mm] so that a bit finds its place in the hole
USUAL = Grid()  # heights and feeds, as a grid has them
TOUCH_SIGMA = 0.5  # [mm] of a coordinate: the bit in its hole, and the hole's place
SAME = 3.0  # [mm] between two holes: a bit is wider
SURE = 3.03  # sigmas of a coordinate: beyond this length 1 % of the errors in a plane lie


class HomeTable(Table):
    """A table [mark.NAME] of the file."""

    place: Annotated[Point, BeforeValidator(pair)]  # where the machine was when it made the hole
    chains: Annotated[Point, BeforeValidator(pair)]  # left and right paid out there
    date: str = ""
    settings: str = ""  # name of the settings' file then


class HomeMark(HomeTable):
    """A hole. mm, from the middle of the sheet, y up."""

    name: str


class HomeFile(Table):
    """The file of the home marks."""

    mark: dict[str, HomeTable] = part()


@dataclass(frozen=True)
class HomeFit:
    """The agreement of a second home mark with the first, by which the position was restored."""

    name: Annotated[str, key("mark")]
    error: Point  # [mm] of the hole, against what the machine shows with the bit in it
    chains: Point  # [mm] by which each chain is longer than the machine believes
    # [mm] within which two touches by hand agree, 99 of 100 times
    limit: Annotated[float, key("limit_mm")]

    @in_json
    def fits(self) -> bool:
        """Whether touching two holes by hand explains the error."""
        return float(np.hypot(*self.error)) <= self.limit


def home_file(settings: Source) -> Path:
    """Return where the home marks of a machine are: next to its settings."""
    return Path(settings).parent / NAME


def new_home_mark(
    settings: MachineSettings, name: str, place: Point, *, date: str = ""
) -> HomeMark:
    """Return a hole that the machine makes at a place by these settings. Raises InputError."""
    with naming(f"home mark {name}"):
        left, right = believed_lengths(settings, np.array([place], dtype=float))[0].tolist()
    file = settings.file.name if settings.file else ""
    return HomeMark.model_construct(
        name=name, place=place, chains=(left, right), date=date, settings=file
    )


def hole_program(mark: HomeMark) -> list[str]:
    """Return the lines of a program that makes the hole of a home mark, come to as a grid comes to
    its marks.
    """
    x, y = mark.place
    return [
        f"(Plumb: the hole of home mark {mark.name})",
        "G21",
        "G90",
        f"G0 Z{USUAL.safe_height:g}",
        f"G0 X{x - APPROACH[0]:.3f} Y{y - APPROACH[1]:.3f}",
        f"G1 X{x:.3f} Y{y:.3f} F{USUAL.feed:g}",
        f"G1 Z{-HOLE_DEPTH:g} F{PLUNGE_FEED:g}",
        f"G0 Z{USUAL.safe_height:g}",
    ]


def place_of(settings: MachineSettings, mark: HomeMark) -> Array:
    """Return where the machine shows the bit in a home mark (2,) [mm], by the settings of today."""
    where, outcome = places(settings.as_plumb_model(), np.array([mark.chains], dtype=float))
    if outcome[0] != FOUND:
        raise InputError(f"home mark {mark.name}: with these settings its chains lead nowhere")
    there: Array = where[0]
    return there


def home_fit(settings: MachineSettings, mark: HomeMark, shown: Point) -> HomeFit:
    """Return how well a home mark agrees with what the machine shows of the bit in it."""
    x, y = (place_of(settings, mark) - np.array(shown)).tolist()
    with naming("what the machine shows cannot be"):
        believed = believed_lengths(settings, np.array([shown], dtype=float))[0]
    left, right = (np.array(mark.chains) - believed).tolist()
    # Both holes are touched, and each was made with the bit once.
    return HomeFit(mark.name, (x, y), (left, right), limit=SURE * 2**0.5 * TOUCH_SIGMA)


def read_home_marks(path: Source) -> dict[str, HomeMark]:
    """Return the home marks of a file by name; none if there is no file. Raises InputError."""
    if not Path(path).exists():
        return {}
    head = parsed(path, read_text(path), tomllib.loads, "TOML")
    marks = read_table(HomeFile, head, path).mark
    return {name: HomeMark.model_construct(name=name, **dict(each)) for name, each in marks.items()}


def write_home_marks(path: Source, marks: Mapping[str, HomeMark]) -> None:
    """Replace the file in one step; every number comes back bit for bit."""
    tables = {
        mark.name: {key: getattr(mark, key) for key in HomeTable.model_fields}
        for mark in marks.values()
    }
    notes = {f"{name}.chains": "left and right paid out" for name in marks}
    write_whole(path, f"{HEAD}\n\n{toml_text({'mark': tables}, notes)}".encode())


# The G-code that declares chains as they are, while the bit is in a known hole.


def chains_line(chains: Array) -> str:
    """Return the line that tells the machine how long its chains are, left and right [mm]."""
    return f"B06 L{chains[0]:.3f} R{chains[1]:.3f}"


def repair_program(chains: Array, *, where: str) -> list[str]:
    """Return the lines of a program that declares chains with the bit at a place, said in words."""
    return [f"(Plumb: only with the bit in {where}, and nothing moved since)", chains_line(chains)]
