"""A program run dry: the firmware itself reads and plans it, and simulates its motors (B99)."""

from __future__ import annotations

import re
from array import array
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import NDArray

from plumb._dry_run import COLUMNS, DryRun, pieces
from plumb.firmware.settings import CLIENT_NUMBERS, firmware_numbers
from plumb.line.sender import PlainError, plain
from plumb.model.predict import FOUND, Array, lengths
from plumb.settings.machine import MachineSettings
from plumb.text.errors import InputError, Source
from plumb.text.files import MB, read_text

__all__ = ["COLUMNS", "Done", "Refused", "Run", "pieces"]

AT_ONCE = 2000  # lines between two looks at how far it is
GOES_ON = 70  # $70: a line that would halt the machine is refused, and the next is done
SIMULATED = "B99 ON"
# A move as it is kept: its numbers are those of the firmware, which counts in single precision.
WIDE = {"line": "i4", "ends": "f8"}
MOVE = np.dtype([(name, WIDE.get(name, "f4")) for name in COLUMNS])
BLOCK = 50_000  # moves that are looked at together
STEP = 5.0  # [mm] between places that are looked at
Share = Callable[[float], None]


@dataclass(frozen=True)
class Refused:
    """A line that no client can send."""

    line: int
    why: str


@dataclass(frozen=True)
class Done:
    """Record of a machine that ran a program."""

    moves: Moves
    said: tuple[tuple[int, str], ...]  # line (counted from 1) and what the machine said to it
    refused: tuple[Refused, ...]
    seconds: float
    halted_at: int | None  # the line at which an alarm stopped it


class Run:
    """A machine with these settings, placed where it stands, that runs a program dry."""

    def __init__(
        self,
        settings: MachineSettings,
        *,
        start: tuple[float, float, float] = (0.0, 0.0, 0.0),
        numbers: Mapping[int, float] | None = None,
    ) -> None:
        """start [mm] of the bit; numbers of the firmware that the settings do not hold."""
        model = settings.as_plumb_model()
        chains, outcome = lengths(model, np.array([start[:2]]))
        if outcome[0] != FOUND:
            where = f"X{start[0]:g} Y{start[1]:g}"
            raise InputError(f"no sled can hang at {where}, where it is to begin")
        self._machine = DryRun()
        self._numbers = array("i")  # of the lines that were sent, as the file counts them
        self._kept: list[NDArray[np.void]] = []  # moves that have ended
        self._refused: list[Refused] = []
        given = {**CLIENT_NUMBERS, **(numbers or {}), GOES_ON: 1}
        lines = [f"${number}={value:g}" for number, value in given.items()]
        lines += [number.line for number in firmware_numbers(model)]
        left, right = chains[0]
        lines += [SIMULATED, f"B06 L{left:.4f} R{right:.4f}", f"G10 Z{start[2]:.4f}"]
        self._machine.send(lines)
        for number, text in self._machine.said():
            if text.startswith(("error:", "ALARM")):
                raise InputError(f"the firmware refuses {lines[number]!r}: {text}")
        self._setup = len(lines)
        self._begun = self._machine.seconds

    def send(self, lines: Sequence[str], *, first: int = 1, progress: Share | None = None) -> None:
        """Send lines of a file; `first` is the number of the first."""
        for begin in range(0, len(lines), AT_ONCE):
            sent = []
            for number, line in enumerate(lines[begin : begin + AT_ONCE], start=first + begin):
                try:
                    text = plain(line)
                except PlainError as error:
                    self._refused.append(Refused(number, str(error)))
                    continue
                if text:
                    sent.append(text)
                    self._numbers.append(number)
            self._machine.send(sent)
            self._keep()
            if progress:
                progress(min(1.0, (begin + AT_ONCE) / len(lines)))

    def _keep(self) -> None:
        """Take over the moves that have ended."""
        rows = self._machine.moves()
        self._kept.append(_narrow(rows[: self._machine.forget_ended()]))

    def finish(self) -> Done:
        """Let the moves end; everything that was done."""
        machine = self._machine
        machine.drain()
        self._keep()
        # The line in execution at an alarm has no answer.
        last = self._numbers[-1] if self._numbers else 1
        numbers = np.append(np.array(self._numbers, dtype=int), last)
        rows = np.concatenate([*self._kept, _narrow(machine.moves())])
        of_program = rows["line"] >= self._setup
        rows = rows if of_program.all() else rows[of_program]
        rows["line"] = numbers[rows["line"] - self._setup]
        rows["ends"] -= self._begun
        said = tuple(
            (int(numbers[line - self._setup]), text)
            for line, text in machine.said()
            if line >= self._setup
        )
        halted = int(numbers[machine.answered - self._setup]) if machine.is_halted else None
        seconds = machine.seconds - self._begun
        return Done(Moves(rows), said, tuple(self._refused), seconds, halted)

    @property
    def modes(self) -> dict[str, float]:
        """The modes with which the next line is read."""
        return self._machine.modes()

    @property
    def place(self) -> tuple[float, float, float]:
        """Where the program believes the bit to be at the end of all moves so far [mm]."""
        x, y, z = self._machine.place()
        return x, y, z

    @property
    def origin(self) -> tuple[float, float, float]:
        """Where the program's coordinates begin [mm]."""
        x, y, z = self._machine.origin()
        return x, y, z


def _narrow(rows: Array) -> NDArray[np.void]:
    """Return moves (n, columns) as they are kept."""
    kept = np.empty(len(rows), dtype=MOVE)
    for name, column in zip(COLUMNS, rows.T, strict=True):
        kept[name] = column
    return kept


# The moves of a job: a row each, and the places along them.

Flags = NDArray[np.bool_]
Rows = NDArray[np.intp]

IN_WOOD = -0.01  # [mm] of z: the bit is below the sheet's face
CLEAR = 5.0  # [mm] above the sheet, if a program goes no higher
TURN = 0.2  # [rad] of an arc between two places


@dataclass(frozen=True)
class Samples:
    """Places along moves."""

    move: Rows  # (k,) row of the move
    places: Array  # (k, 2) [mm]
    z: Array  # (k,) [mm]


@dataclass(frozen=True)
class Moves:
    """Moves with the numbers that plumb._dry_run.COLUMNS names."""

    rows: NDArray[np.void]  # (n,) of MOVE

    def __len__(self) -> int:
        return len(self.rows)

    def __getitem__(self, name: str) -> Array:
        """Return a number of all moves (n,) by its name."""
        return np.asarray(self.rows[name], dtype=float)

    def blocks(self) -> Iterator[tuple[int, Moves]]:
        """Yield the moves piece by piece, each with the number of its first move."""
        for first in range(0, len(self), BLOCK):
            yield first, Moves(self.rows[first : first + BLOCK])

    def only(self, those: Flags | Rows) -> Moves:
        """Return some of the moves; all of them take no room a second time."""
        if those.dtype == bool and those.all():
            return self
        return Moves(self.rows[those])

    @property
    def over_sheet(self) -> Flags:
        """Moves of the sled, not of a single chain (n,)."""
        return np.asarray(self["by_chains"] == 0)

    @property
    def rapid(self) -> Flags:
        """Moves at the greatest feed: G0, G28, and the ways of a drilling cycle (n,)."""
        return np.asarray(np.isinf(self["asked"]))

    @property
    def cut(self) -> Flags:
        """Moves with the bit in the wood (n,)."""
        deep = np.minimum(self["z_from"], self["z_to"]) < IN_WOOD
        return np.asarray(deep & self.over_sheet)

    @property
    def way(self) -> Array:
        """Length over all axes (n,) [mm]."""
        return np.hypot(self["length"], self["z_to"] - self["z_from"])

    def sampled(self, step: float | Array) -> Samples:
        """Return places along the moves, both ends included, at most `step` [mm] apart, for all
        or for each.
        """
        turns = np.abs(self["sweep"]) / TURN
        counts = np.ceil(np.maximum(self.way / step, turns)).astype(int) + 1
        counts = np.maximum(counts, 2)
        move = np.repeat(np.arange(len(self)), counts)
        first = np.cumsum(counts) - counts
        share = (np.arange(len(move)) - first[move]) / (counts[move] - 1)
        low, high = self["z_from"][move], self["z_to"][move]
        return Samples(move, self.places_at(move, share), low + share * (high - low))

    def places_at(self, move: Rows, share: Array) -> Array:
        """Return places (k, 2) [mm] at shares of some moves."""
        start = np.stack([self["from_x"], self["from_y"]], axis=1)[move]
        end = np.stack([self["to_x"], self["to_y"]], axis=1)[move]
        across = self["length"][move] > 0
        places = np.where(across[:, None], start + share[:, None] * (end - start), start)
        round_ = (self["sweep"][move] != 0) & across
        centre = np.stack([self["centre_x"], self["centre_y"]], axis=1)[move]
        from_centre, to_centre = start - centre, end - centre
        radius = np.hypot(*from_centre.T) * (1 - share) + np.hypot(*to_centre.T) * share
        angle = np.arctan2(from_centre[:, 1], from_centre[:, 0]) + share * self["sweep"][move]
        turned = centre + radius[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
        return np.asarray(np.where(round_[:, None], turned, places))


def safe_height(moves: Moves) -> float:
    """Return the z [mm] at which a job crosses the sheet, or a little above the sheet."""
    across = moves.over_sheet & (moves["length"] > 0)
    return max(CLEAR, float(moves["z_to"][across].max(initial=0.0)))


LARGEST_PROGRAM = 200 * MB

# What holds no program: settings, marks and tables, refused before any line is sent.

SETTINGS = "numbers are sent from a machine.toml"
PROGRAM = "give a program of G-code"
OTHERS = (
    (r"^\s*\[(maslow|advanced) settings\]", "holds settings of GroundControl", SETTINGS),
    (r"\A\s*\{.*\"(maslow|advanced) settings\"", "holds settings of WebControl", SETTINGS),
    (r"\A\s*\{", "holds JSON", PROGRAM),
    (r"^\s*\[\[(mark|distance)\]\]|^\s*numpositions\s*[=:]", "holds marks", PROGRAM),
    (r"\A\s*[^\s,;()]+(,[^\s,;()]+)+\s*$", "holds a table", PROGRAM),
    (r"\A\s*<(\?xml|svg|!doctype)", "holds a drawing or a page", "let a CAM program make G-code"),
    (r"\A\s*0\s+SECTION\s", "holds a drawing (DXF)", "let a CAM program make G-code"),
)
# What the firmware says of a line that is not G-code at all.
NO_CODE = re.compile(r"(this begins no word|a number is missing behind|there is no such code).*")


def program_in(path: Source, *, say: Callable[[str], None]) -> list[str]:
    """Return the lines of a program; InputError if it is not one.

    Old CAM programs write comments in the code page of Windows; `say` hears of it.
    """
    text = read_text(path, most=LARGEST_PROGRAM, say=say)
    refuse_what_is_no_program(path, text)
    return text.splitlines()


def refuse_other_files(source: Source, text: str) -> None:
    """InputError for a client's settings, marks, tables and JSON."""
    for pattern, what, remedy in OTHERS:
        if re.search(pattern, text, re.IGNORECASE | re.MULTILINE | re.DOTALL):
            raise InputError(source, f"{what}, not a program", remedy=remedy)


def refuse_what_is_no_program(source: Source, text: str) -> None:
    """InputError for a text that is something else, or begins with what the firmware cannot read.

    Later lines are left to the machine, and to `plumb check`.
    """
    refuse_other_files(source, text)
    if re.search(r"^\s*\[frame\]", text, re.MULTILINE):
        raise InputError(source, "holds settings of a machine", remedy=PROGRAM)
    number, first = _first(text.splitlines())
    machine = DryRun()
    machine.send([first])
    for _, said in machine.said():
        fault = NO_CODE.search(said)
        if fault and said.startswith(("ALARM", "error")):
            why = f"is not G-code ({fault[0].removesuffix(' Press Stop.').rstrip('.')})"
            raise InputError(source, why, place=f"line {number}", remedy=PROGRAM)


def _first(lines: Sequence[str]) -> tuple[int, str]:
    """Return the first line that the machine would get, and its number; an empty line if none can
    be.
    """
    for number, line in enumerate(lines, start=1):
        try:
            text = plain(line)
        except PlainError:
            break  # whoever sends says so
        if text:
            return number, text
    return 0, ""


# G-code that goes round a job with the bit above the sheet, slowly, before anything is cut.

FEED = 500.0  # [mm/min]


def hull_of(moves: Moves, samples: Samples) -> Array:
    """Return the corners (k, 2) [mm] of the smallest convex shape that holds all cuts."""
    places = samples.places[moves.cut[samples.move]]
    places = np.unique(np.round(places, 3), axis=0)
    spread = places - places.mean(axis=0) if len(places) else places
    if len(places) < 3 or np.linalg.matrix_rank(spread, tol=1e-3) < 2:
        return np.asarray(places[[0, -1]] if len(places) else places)
    return np.asarray(places[scipy.spatial.ConvexHull(places).vertices])


def outline_of(moves: Moves, samples: Samples, *, name: str) -> str:
    """Return a program that traces the hull, back to its first corner."""
    corners = hull_of(moves, samples)
    if not len(corners):
        return f"(plumb: {comment_of(name)} cuts nothing)\n"
    safe = safe_height(moves)
    lines = [
        f"(plumb: outline of {comment_of(name)}, bit {safe:.1f} mm above the sheet)",
        "G21 G90 G94 G17",
        f"G0 Z{safe:.3f}",
        f"G0 X{corners[0, 0]:.3f} Y{corners[0, 1]:.3f}",
    ]
    ring = [*corners[1:], corners[0]]
    lines += [f"G1 X{x:.3f} Y{y:.3f} F{FEED:g}" for x, y in ring]
    return "\n".join([*lines, "M5", ""])


def comment_of(name: str) -> str:
    """Return a file's name as a comment can hold it."""
    kept = [c if c.isascii() and c.isprintable() and c not in "()" else "_" for c in name]
    return "".join(kept)[:60]
