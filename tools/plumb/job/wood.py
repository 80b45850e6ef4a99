"""The wood of a job: its bit and sheet, and the moves that spoil them."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Annotated

import numpy as np

from plumb._dry_run import Wood
from plumb.job.dry_run import (
    DEEP,
    GOUGES,
    IN_WOOD,
    STILL,
    Finding,
    Flags,
    Moves,
    Rows,
    Samples,
    pieces,
)
from plumb.model.predict import Array
from plumb.text.answers import key
from plumb.text.values import INCH

# The bit and the sheet of a job: as the owner says, else as the program's comments, else usual.


USUAL_BIT = 6.35  # [mm] 1/4 inch, what most of these machines cut with
USUAL_SHEET = 19.05  # [mm] 3/4 inch


@dataclass(frozen=True)
class Bit:
    """A bit, from some line of a program on."""

    line: int
    diameter: Annotated[float, key("diameter_mm")]  # the greatest
    half_angle: Annotated[float, key("half_angle_deg")] = 90.0  # from its axis; 90: it is flat
    length: Annotated[float | None, key("length_mm")] = (
        None  # of the cutting edge; None: not stated
    )

    @property
    def slope(self) -> float:
        """The slope of its edge away from its axis."""
        return 0.0 if self.half_angle >= 90 else 1 / math.tan(math.radians(self.half_angle))


@dataclass(frozen=True)
class Tools:
    """Bits of a job, and the sheet it is cut from."""

    bits: tuple[Bit, ...]  # in the order of the program; empty: none is named
    thickness: Annotated[float | None, key("sheet_mm")]  # None: not stated

    @staticmethod
    def of(
        lines: Sequence[str],
        *,
        diameter: float | None = None,
        length: float | None = None,
        thickness: float | None = None,
    ) -> Tools:
        """Return what the owner says, and what a program's comments say where he is silent [mm]."""
        bits = (Bit(1, diameter),) if diameter else tuple(_named(lines))
        if length:
            bits = tuple(replace(bit, length=length) for bit in bits or (Bit(1, USUAL_BIT),))
        return Tools(bits, thickness or _stock(lines))

    def at(self, line: Array) -> tuple[Rows, tuple[Bit, ...]]:
        """Return which bit cuts each line (n,), as a row of the bits."""
        bits = self.bits or (Bit(1, USUAL_BIT),)
        begins = [bit.line for bit in bits[1:]]  # the first also cuts what comes before its comment
        return np.searchsorted(begins, line, side="right"), bits


# What CAM programs write of a tool: Carbide Create, Fusion 360 and FreeCAD. The others name it in
# words, like `6mm endmill`, `End Mill {1/4 inch}` and `V-Bit {90 deg 12.7 mm}`.
NUMBER = r"(\d*\.?\d+)"
CARBIDE = re.compile(rf"TOOL/MILL,\s*{NUMBER},\s*{NUMBER},\s*{NUMBER},\s*{NUMBER}")
FUSION = re.compile(rf"\bT(\d+)\s+D=\s*{NUMBER}(?:.*?\bTAPER=\s*{NUMBER}\s*deg)?")
FREECAD = re.compile(rf"Diameter: {NUMBER}")
WORDS = re.compile(r"mill|bit\b|drill|cutter", re.IGNORECASE)
SIZE = re.compile(rf"(\d+)/(\d+)\s*(?:\"|in)|{NUMBER}\s*(mm|\"|in)", re.IGNORECASE)
ANGLE = re.compile(rf"{NUMBER}\s*deg", re.IGNORECASE)
STOCK = re.compile(rf"STOCK/BLOCK,\s*{NUMBER},\s*{NUMBER},\s*{NUMBER}")
CALL = re.compile(r"T(\d+)", re.IGNORECASE)


def _named(lines: Sequence[str]) -> Iterator[Bit]:
    """Bits that comments name; one of Fusion's list holds from the line that calls its number."""
    scale = _unit(lines)
    listed: dict[int, Bit] = {}
    latest: Bit | None = None
    for number, line in enumerate(lines, start=1):
        code, comment = _parted(line)
        fusion, called = FUSION.search(comment), CALL.search(code)
        bit = None
        if fusion:
            taper = float(fusion[3]) if fusion[3] else 90.0
            listed[int(fusion[1])] = Bit(number, scale * float(fusion[2]), taper)
        elif comment:
            bit = _in_comment(number, comment, scale)
        if called and int(called[1]) in listed:
            bit = replace(listed[int(called[1])], line=number)
        if bit and (latest is None or replace(bit, line=latest.line) != latest):
            latest = bit
            yield bit
    if latest is None:
        yield from list(listed.values())[:1]


def _in_comment(number: int, comment: str, scale: float) -> Bit | None:
    carbide, freecad = CARBIDE.search(comment), FREECAD.search(comment)
    if carbide:
        diameter, _, length, taper = (float(each) for each in carbide.groups())
        if taper:
            widest = diameter + 2 * length * math.tan(math.radians(taper))
            return Bit(number, scale * widest, taper)
        return Bit(number, scale * diameter, length=scale * length or None)
    if freecad:
        return Bit(number, float(freecad[1]))
    size = SIZE.search(comment) if WORDS.search(comment) else None
    if not size:
        return None
    numerator, denominator, value, unit = size.groups()
    wide = float(value) if value else float(numerator) / float(denominator)
    wide *= 1.0 if unit and unit.lower() == "mm" else INCH
    angle = ANGLE.search(comment)
    return Bit(number, wide, float(angle[1]) / 2 if angle else 90.0) if wide else None


def _stock(lines: Sequence[str]) -> float | None:
    for line in lines:
        stock = STOCK.search(line)
        if stock and float(stock[3]):
            return _unit(lines) * float(stock[3])
    return None


def _unit(lines: Sequence[str]) -> float:
    """Return the unit of a program's bare numbers [mm]."""
    for line in lines:
        unit = re.search(r"G2([01])(?!\d)", _parted(line)[0], re.IGNORECASE)
        if unit:
            return INCH if unit[1] == "0" else 1.0
    return 1.0


def _parted(line: str) -> tuple[str, str]:
    """Return the code of a line, and its comment."""
    if "(" not in line and ";" not in line:
        return line, ""
    code = re.sub(r"\([^)]*\)?|;.*", " ", line)
    return code, " ".join(" ".join(each) for each in re.findall(r"\(([^)]*)|;(.*)", line))


# Wood that a job takes away: a map of heights, and the moves that spoil it or the bit.


CHORD = 2.0  # [mm] of an arc that is led as straight
FINE = 8.0  # cells over the radius of the smallest bit
MOST_CELLS = 8e6
NARROWEST = 0.75  # of a cell: the least radius that surely covers the middle of one
GRAZE = 0.2  # of the bit's radius: wood that only its rim meets is no fault of a rapid move
ON, OFF = (3, 4), (2, 5, 30)  # M codes
SPOIL = 3.0  # [mm] that a cut may go into what lies under the sheet


@dataclass(frozen=True)
class Piece:
    """The finished piece."""

    bits: tuple[Bit, ...]
    thickness: Annotated[float, key("sheet_mm")]
    is_said: Annotated[bool, key("bit_is_said")]  # by the owner or the program, or it is the usual
    removed: Annotated[float, key("removed_mm3")]
    deepest: Annotated[float, key("deepest_mm")]  # below the face
    line: Annotated[int, key("deepest_line")]


@dataclass(frozen=True)
class WoodTaken:
    """The piece, and how deep each move went into wood that nothing had cut (n,) [mm]."""

    piece: Piece | None  # None where nothing is cut
    met: Array


def take(moves: Moves, tools: Tools) -> WoodTaken:
    """Lead the bit along moves over the sheet."""
    cut = moves.cut
    if not cut.any():
        return WoodTaken(None, np.zeros(len(moves)))
    which, bits = tools.at(moves["line"])
    radii = np.array([bit.diameter / 2 for bit in bits])
    slopes = np.array([bit.slope for bit in bits])
    low, high = _extent(moves, widest=float(radii[which[cut]].max()))
    coarsest = float(np.sqrt(np.prod(high - low) / MOST_CELLS))
    cell = max(float(radii[which[cut]].min()) / FINE, coarsest)
    columns, rows = (int(count) for count in np.ceil((high - low) / cell))
    wide = np.maximum(radii, NARROWEST * cell)
    wood = Wood(float(low[0]), float(low[1]), columns, rows, cell)
    met = np.zeros(len(moves))
    for first, block in moves.blocks():
        samples = _led(block)
        with_bit = which[first + samples.move]
        radius = np.where(np.diff(samples.move, prepend=-1) > 0, 0.0, wide[with_bit])
        ways = np.column_stack([samples.places, samples.z, radius, slopes[with_bit]])
        np.maximum.at(met, first + samples.move, wood.take(ways, GRAZE))
    depths = -np.minimum(moves["z_from"], moves["z_to"]) * cut
    piece = Piece(
        bits=tuple(bits[each] for each in np.unique(which[cut])),
        thickness=tools.thickness or USUAL_SHEET,
        is_said=bool(tools.bits),
        removed=-float(wood.heights().sum(dtype=float)) * cell**2,
        deepest=float(depths.max()),
        line=int(moves["line"][np.argmax(depths > depths.max() + IN_WOOD)]),
    )
    return WoodTaken(piece, met)


def _led(moves: Moves) -> Samples:
    """Return the places along moves through which the bit is led.

    A straight way is led in one, so that its depth is that of all of it.
    """
    return moves.sampled(np.where(moves["sweep"] != 0, CHORD, np.inf))


def _extent(moves: Moves, *, widest: float) -> Array:
    """Return the lower left and the upper right corner [mm] of all cuts of a bit so wide."""
    corners = []
    for _, block in moves.blocks():
        samples = _led(block)
        places = samples.places[block.cut[samples.move]]
        if len(places):
            corners += [places.min(axis=0) - widest, places.max(axis=0) + widest]
    return np.array([np.min(corners, axis=0), np.max(corners, axis=0)])


def spoiled(
    moves: Moves, taken: WoodTaken, tools: Tools, lines: Sequence[str]
) -> Iterator[Finding]:
    """Return what spoils the piece, the bit or the sheet: each cause once, with all its lines."""
    if taken.piece is None:
        return
    into = taken.met > -IN_WOOD
    turns = _turns(moves, lines)
    first = _causes(into & moves.rapid, moves)
    foreign = np.array(
        [bool(FOREIGN.search(lines[int(line) - 1])) for line in moves["line"][first]], bool
    )
    falls = (moves["z_to"] < moves["z_from"])[first]
    for those, says in (
        (foreign, FROM_TOP),
        (~foreign & falls, "a rapid move drives the bit {} mm down into wood that nothing has cut"),
        (~foreign & ~falls, "a rapid move crosses wood that nothing has cut, {} mm deep"),
    ):
        if those.any():
            rows = first[those]
            deepest = f"{taken.met[rows].max():.2f}"
            off = "" if turns[rows].any() else ", the spindle off"
            yield Finding(GOUGES, says.format(deepest) + off, _lines(moves, rows))
    still = np.flatnonzero(into & ~moves.rapid & ~turns)
    if len(still):
        yield Finding(
            STILL, "cuts with the spindle off: M3 has to stand before it", _lines(moves, still)
        )
    yield from _too_deep(moves, taken.piece, tools)


FROM_TOP = (
    "G53 drives the bit {} mm into the wood. Carbide Create means a place near the top of z, but "
    "here z is 0 at the face of the sheet: write G0 Z5 instead of G53 G0 Z-5"
)
FOREIGN = re.compile(r"G53(?!\d).*Z\s*-|Z\s*-.*G53(?!\d)", re.IGNORECASE)


def _causes(wrong: Flags, moves: Moves) -> Rows:
    """Rows of the wrong rapid moves, of those that follow on one another in the wood the first."""
    above = moves["z_to"] >= IN_WOOD
    stay = np.cumsum(~moves.rapid | above)
    rows = np.flatnonzero(wrong)
    _, first = np.unique(stay[rows], return_index=True)
    return np.asarray(rows[first])


def _turns(moves: Moves, lines: Sequence[str]) -> Flags:
    """Whether the program has the spindle turn in each move; always, where it never starts it."""
    switched = [(0, False)]
    for number, line in enumerate(lines, start=1):
        # The firmware's reader takes its time, and few lines hold an M.
        for letter, code, _ in pieces(line) if "M" in line.upper() else ():
            if letter == "M" and code in (*ON, *OFF):
                switched.append((number, code in ON))
    if not any(on for _, on in switched):
        return np.ones(len(moves), dtype=bool)
    at, states = (np.array(each) for each in zip(*switched, strict=True))
    return np.asarray(states[np.searchsorted(at, moves["line"], side="right") - 1])


def _too_deep(moves: Moves, piece: Piece, tools: Tools) -> Iterator[Finding]:
    """Cuts through the sheet into what carries it, and cuts deeper than a bit is long."""
    depth = -np.minimum(moves["z_from"], moves["z_to"]) * moves.cut
    which, bits = tools.at(moves["line"])
    lengths = np.array([bit.length or np.inf for bit in bits])[which]
    for limit, what, option in (
        (piece.thickness + SPOIL, f"the sheet is {piece.thickness:g} mm thick", "--thickness"),
        (lengths, f"the bit cuts only {lengths.min():g} mm", "--bit-length"),
    ):
        rows = np.flatnonzero(depth > limit)
        if len(rows):
            says = f"cuts {depth[rows].max():.2f} mm deep, and {what} ({option} says otherwise)"
            yield Finding(DEEP, says, _lines(moves, rows))


def _lines(moves: Moves, rows: Rows) -> tuple[int, ...]:
    return tuple(int(line) for line in np.unique(moves["line"][rows]))
