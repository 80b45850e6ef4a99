"""Measurements on the sheet: marks and distances in the machine frame.

Machine frame: origin in the middle of the sheet, x right, y up, mm.
"""

import json
import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from hashlib import sha256

import numpy as np

from plumb.settings import MachineSettings
from plumb.text.errors import InputError

Point = tuple[float, float]


@dataclass(frozen=True)
class Round:
    """The conditions under which the marks of a file were cut."""

    name: str = ""  # of the file, for messages
    date: str = ""
    cut_with: MachineSettings | None = None  # in force; None: what the command line says
    changed: str = ""  # name of the settings in force, if their file is another by now
    digest: str = ""  # of the file's readings
    chains_rezeroed: bool = False  # since the file before
    new_sheet: bool = False  # or the old sheet lies elsewhere since the file before
    frame_moved: bool = False  # since the file before: a motor, the beam or the sled
    zero_group: int = 0  # counts how often the chains were zeroed again
    sheet_group: int = 0  # counts the sheets


@dataclass(frozen=True)
class Mark:
    """Where the sled was sent and where the mark was measured [mm], and how the sled came there."""

    name: str
    target: Point  # [mm]
    measured: Point | None = None  # [mm]; None for an end of distances only
    approach: Point | None = None  # direction of the last move, any length
    sled_weight: float | None = None  # [N]
    chains: Point | None = None  # [mm] left and right paid out, if the machine reported them
    round: int = 0  # index into the rounds
    is_unread: bool = False  # its reading is yet to come


@dataclass(frozen=True)
class Distance:
    """A measured distance [mm] between two marks, given by their names."""

    between: tuple[str, str]
    length: float  # [mm]
    round: int = 0  # index into the rounds: a later file may measure between marks of an earlier


@dataclass(frozen=True)
class Typed:
    """The form in which the places of a file were typed."""

    sheet: Point | None = None  # from its top left corner, y down; None: from its middle, y up
    unit: str = "mm"  # of UNITS in text/values.py

    def place(self, point: Point) -> Point:
        """Return a place of the machine frame [mm], counted from where it was typed [mm]."""
        x, y = point
        if self.sheet:
            x, y = x + self.sheet[0] / 2, self.sheet[1] / 2 - y
        return x, y

    def shift(self, shift: Point) -> Point:
        """Return a shift in the machine frame [mm], in the axes that were typed."""
        return shift[0], -shift[1] if self.sheet else shift[1]


@dataclass(frozen=True)
class Measurements:
    """All marks and distances of a board, and what is known about how they were taken."""

    marks: tuple[Mark, ...]
    distances: tuple[Distance, ...] = ()
    controller: str | None = None  # whose formula moved the sled
    tape_sigma: float | None = None  # [mm] reading error of a coordinate or distance
    sled_weight: float | None = None  # [N] of the whole file; each mark carries its weight already
    source: str = ""  # the path, for messages
    rounds: tuple[Round, ...] = (Round(),)  # in the order of the files
    typed: Typed = Typed()  # how the places were typed, so that they can be shown so
    steered: bool = False  # to drawn points: these are the readings, and the targets what it took
    _by_name: dict[str, Mark] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        """Index the marks by name; a repeated name keeps its first target."""
        first: dict[str, Mark] = {}
        for mark in self.marks:
            first.setdefault(mark.name, mark)
        object.__setattr__(self, "_by_name", first)

    @property
    def measured_marks(self) -> tuple[Mark, ...]:
        """The marks whose position was measured: the rows of `targets` and `measured`."""
        return tuple(mark for mark in self.marks if mark.measured is not None)

    @property
    def readings(self) -> tuple[tuple[Mark, Point], ...]:
        """These marks, each with its measured position [mm]."""
        return tuple((mark, mark.measured) for mark in self.marks if mark.measured is not None)

    @property
    def targets(self) -> np.ndarray:
        """Where the measured marks were sent, (n, 2) [mm]."""
        return _rows([mark.target for mark in self.measured_marks])

    @property
    def measured(self) -> np.ndarray:
        """The measured positions of these marks, (n, 2) [mm]."""
        return _rows([measured for _, measured in self.readings])

    @property
    def off_target(self) -> float | None:
        """The RMS distance of measured marks from their targets [mm]; None without such marks."""
        if not self.measured_marks:
            return None
        return float(np.sqrt(np.mean(np.sum((self.measured - self.targets) ** 2, axis=1))))

    @property
    def distance_targets(self) -> np.ndarray:
        """Where both ends of each distance were sent, (m, 2 ends, 2) [mm]."""
        ends = [[self.target_of(name) for name in distance.between] for distance in self.distances]
        return np.array(ends, dtype=float).reshape(-1, 2, 2)

    @property
    def distance_lengths(self) -> np.ndarray:
        """The measured distances, (m,) [mm]."""
        return np.array([distance.length for distance in self.distances], dtype=float)

    @property
    def repeats(self) -> dict[str, tuple[int, ...]]:
        """Rows of `measured` that share a name, for the names that were measured twice or more."""
        rows: dict[str, list[int]] = {}
        for row, mark in enumerate(self.measured_marks):
            rows.setdefault(mark.name, []).append(row)
        return {name: tuple(numbers) for name, numbers in rows.items() if len(numbers) > 1}

    def target_of(self, name: str) -> Point:
        """Return where the mark of that name was sent [mm]."""
        return self._by_name[name].target


def _rows(points: list[Point]) -> np.ndarray:
    return np.array(points, dtype=float).reshape(-1, 2)


# What a file of marks says, as a short text: equal readings have equal texts.


def digest_of(measurements: Measurements) -> str:
    """Return the SHA-256 of all marks and distances with their readings."""
    marks = [
        (mark.name, mark.target, mark.measured, mark.approach, mark.sled_weight, mark.chains)
        for mark in measurements.marks
    ]
    distances = [(distance.between, distance.length) for distance in measurements.distances]
    return sha256(json.dumps([marks, distances]).encode()).hexdigest()


# The error of a tape reading, by how fine the tape's lines are.

# What the hand adds, whatever the tape: hook, parallax, the middle of a hole. A tape with
# millimetre lines then gives the usual 0.5 mm (USUAL_SIGMA of the fit).
HAND = 0.4  # [mm]


def tape_sigma(finest: float) -> float:
    """Return standard deviation of a coordinate [mm] by the finest division of the tape [mm]."""
    return round(math.hypot(HAND, finest / math.sqrt(12)), 2)


# Targets and readings in each other's columns: then the readings lie on a lattice, and the targets
# do not.

FEWEST = 6  # different places, below which chance may line up readings
MUCH = 2  # this many times as many numbers in the targets as in the readings
ALIKE = 0.005  # [mm] numbers nearer than this are the same


def refuse_exchanged_columns(measurements: Measurements) -> None:
    """Ask about targets that look read and readings that look planned.

    Who plans marks uses few numbers, over and over: rows and columns share theirs. Readings differ
    by their errors. A machine that was steered to drawn points turns this round.
    """
    sent = [mark.target for mark, _ in measurements.readings]
    read = [place for _, place in measurements.readings]
    if measurements.steered or min(len(set(sent)), len(set(read))) < FEWEST:
        return
    if MUCH * _numbers_in(read) <= _numbers_in(sent):
        raise InputError(
            measurements.source,
            "the measured positions lie in rows and columns and the targets do not: are target "
            "and measured exchanged?",
            remedy="exchange the two, or write steered = true at the top of a marks.toml if you "
            "steered the sled to drawn points",
        )


def _numbers_in(points: Sequence[Point]) -> int:
    """Return how many different numbers their coordinates are made of."""
    return sum(len({round(point[axis] / ALIKE) for point in points}) for axis in (0, 1))
