"""Home marks: holes whose chains are kept. With the bit in such a hole a lost position is restored.

A hole that the machine made at a place was made with the chains that its settings pay out there.
Whatever these settings do not know was in the hole too, so the same chains are right when the bit
is back in it, also after the settings have become better.
"""

import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from math import dist
from pathlib import Path
from typing import Annotated

import numpy as np
from pydantic import BeforeValidator

from plumb.grid.options import APPROACH, PLUNGE_FEED, Grid
from plumb.model.predict import FOUND, Array, believed_lengths, places
from plumb.settings.machine import MachineSettings
from plumb.text.answers import in_json, key
from plumb.text.errors import InputError, Source
from plumb.text.files import parsed, read_text, write_whole
from plumb.text.tables import Table, part, read_table, toml_text
from plumb.text.values import pair

Point = tuple[float, float]
NAME = "home.toml"
HEAD = "# Home marks of a machine, for plumb: holes, and the chains with the bit in them. mm."
HOLE_DEPTH = 2.0  # [mm] so that a bit finds its place in the hole
USUAL = Grid()  # heights and feeds, as a grid has them
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
    try:
        left, right = believed_lengths(settings, np.array([place], dtype=float))[0].tolist()
    except ValueError as error:
        raise InputError(f"home mark {name}: {error}") from None
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
    where: Array = places_with(settings, np.array([mark.chains], dtype=float))[0]
    if not np.isfinite(where).all():
        raise InputError(f"home mark {mark.name}: with these settings its chains lead nowhere")
    return where


def home_fit(settings: MachineSettings, mark: HomeMark, shown: Point) -> HomeFit:
    """Return how well a home mark agrees with what the machine shows of the bit in it."""
    x, y = (place_of(settings, mark) - np.array(shown)).tolist()
    believed = believed_chains(settings, [HomeTouch(mark.name, mark.place, shown)])[0]
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


# Marks touched with the bit: where the hole is, and where the machine shows the bit in it.

TOUCH_SIGMA = 0.5  # [mm] of a coordinate: the bit in its hole, and the hole's place
MISREAD = 100.0  # [mm] of a touch: a slip of two links shows less
SAME = 3.0  # [mm] between two holes: a bit is wider
FAR = 50.0  # [mm] between holes from which on they are two places; nearer, they err alike


@dataclass(frozen=True)
class HomeTouch:
    """A mark with the bit in it. mm, from the middle of the sheet, y up."""

    name: str
    hole: Point  # where the mark is known to be
    shown: Point  # what the machine says of the bit in it


def refuse_repeated(touches: Sequence[HomeTouch]) -> None:
    """Raise InputError for a hole that is given twice: what it says counts once."""
    for (first, earlier), (second, later) in combinations(enumerate(touches, 1), 2):
        if dist(earlier.hole, later.hole) < SAME:
            raise InputError(
                f"touch {second} is touch {first} again; touch another hole far from it"
            )


def are_apart(touches: Sequence[HomeTouch]) -> bool:
    """Return whether two of the holes are far enough apart to be two places."""
    return any(dist(left.hole, right.hole) >= FAR for left, right in combinations(touches, 2))


def lost_sign(touch: HomeTouch) -> str:
    """Return the coordinate, x or y, whose sign was lost: the other sign shows the bit near the
    hole.
    """
    (x, y), (shown_x, shown_y) = touch.hole, touch.shown
    if dist(touch.hole, touch.shown) <= MISREAD:
        return ""
    flipped = {"x": (-shown_x, shown_y), "y": (shown_x, -shown_y)}
    near = [name for name, place in flipped.items() if dist((x, y), place) <= MISREAD]
    return near[0] if near else ""


def believed_chains(settings: MachineSettings, touches: Sequence[HomeTouch]) -> Array:
    """Return the chains (n, 2) [mm] that the machine believes at each touch. Raises InputError."""
    shown = np.array([touch.shown for touch in touches], dtype=float).reshape(-1, 2)
    try:
        return believed_lengths(settings, shown)
    except ValueError as error:
        raise InputError(f"what the machine shows cannot be: {error}") from None


def places_with(settings: MachineSettings, chains: Array) -> Array:
    """Return places (..., 2) [mm] for chains (..., 2) [mm]; NaN where no sled hangs."""
    where, outcome = places(settings.as_plumb_model(), chains.reshape(-1, 2))
    where = np.where((outcome == FOUND)[:, None], where, np.nan)
    return where.reshape(chains.shape)


def turned_back(holes: Array, turn: float) -> Array:
    """Holes (n, 2) [mm] that a tape read from the edges of a sheet, as the machine has them, if the
    sheet is turned [rad] counter-clockwise about its middle."""
    cosine, sine = np.cos(turn), np.sin(turn)
    back: Array = holes.reshape(-1, 2) @ np.array([[cosine, -sine], [sine, cosine]])
    return back
