"""The bit and the sheet of a job: as the owner says, else as the program's comments, else usual."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Annotated

import numpy as np

from plumb.job.dry_run import Rows
from plumb.model.predict import Array
from plumb.text.answers import key

USUAL_BIT = 6.35  # [mm] 1/4 inch, what most of these machines cut with
USUAL_SHEET = 19.05  # [mm] 3/4 inch
INCH = 25.4  # [mm]


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
