"""Reading measured marks, whatever the file's form; the front door to this room."""

from __future__ import annotations

import csv
import math
import re
import tomllib
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Annotated, Any, Literal, TypeVar

from pydantic import AfterValidator, BeforeValidator, StrictBool, ValidationInfo, model_validator

from plumb.marks.model import (
    Distance,
    Mark,
    Measurements,
    Point,
    Round,
    Typed,
    digest_of,
    refuse_exchanged_columns,
)
from plumb.settings import Controller, Known, MachineSettings, read_settings, settings_as_they_were
from plumb.text.answers import meant
from plumb.text.errors import InputError, Source, naming, to_do
from plumb.text.files import CODE, IniText, as_path, parsed, read_bytes, read_ini, read_text
from plumb.text.tables import KeyPath, Number, Table, read_table
from plumb.text.values import (
    INCH,
    UNITS,
    length,
    length_in,
    pair,
    point,
    refuse_unknown,
    with_quoted_fractions,
    within,
)

# Checks on marks that need the sheet: units, frame, and measured far from target.


MOST_ERROR = 500.0  # [mm] farther from its target a mark is a slip of the pen
FARTHEST_REPEAT = 100.0  # [mm] a repeat may lie this far from the first mark, whose hole is used up
OUTSIDE = 100.0  # [mm] a target may lie beyond the sheet's edge by this much
# [mm] marks closer together than this on a sheet ten times as wide were not spread on purpose
TOO_CLOSE = 100.0
SUSPICIOUS = 120.0  # [mm] nearer than this even a chain on the wrong tooth or link may be the cause
MOST_DISTANCE_ERROR = 200.0  # [mm]

Sheet = tuple[float, float]
_INCH_HINT = 'looks like inches; write units = "inch" at the top, or millimetres'


def to_machine(point: Point, *, sheet: Sheet) -> Point:
    """Return a point counted from the sheet's top-left corner, y down [mm], in the machine
    frame.
    """
    return point[0] - sheet[0] / 2, sheet[1] / 2 - point[1]


def checked(measurements: Measurements, *, sheet: Sheet) -> Measurements:
    """Return the same measurements, if they can be what they say on a sheet of that width and
    height.
    """
    source = measurements.source
    if not measurements.measured_marks and not measurements.distances:
        raise InputError(source, "has no measured mark", remedy="add measured positions")
    for distance in measurements.distances:
        with naming(source, f"distance {'-'.join(distance.between)}"):
            _refuse_unnamed(measurements, distance)
    for mark in measurements.marks:
        with naming(source, f"mark {mark.name}"):
            _refuse_useless(measurements, mark)
    with naming(source):
        _refuse_inches(measurements, sheet)
    for mark in measurements.marks:
        with naming(source, f"mark {mark.name}"):
            _refuse_outside(mark, sheet)
            _refuse_far(measurements, mark, sheet)
    for distance in measurements.distances:
        with naming(source, f"distance {'-'.join(distance.between)}"):
            _refuse_odd(measurements, distance)
    refuse_exchanged_columns(measurements)
    return measurements


def _refuse_unnamed(measurements: Measurements, distance: Distance) -> None:
    names = {mark.name for mark in measurements.marks}
    for name in distance.between:
        if name not in names:
            raise ValueError(
                f"there is no mark named '{name}'; add a [[mark]] with that name and its target"
            )


def _refuse_useless(measurements: Measurements, mark: Mark) -> None:
    """Refuse a mark that says nothing, or whose name does not say which mark it is."""
    first = measurements.target_of(mark.name)
    is_end = any(mark.name in distance.between for distance in measurements.distances)
    if mark.measured is None and not is_end:
        raise ValueError(
            "has no measured position and no distance uses it; "
            "add measured = [x, y], or remove the mark"
        )
    if math.dist(mark.target, first) > FARTHEST_REPEAT:
        raise ValueError(
            "the same name stands twice with targets far apart; "
            f"give another name, or for a repeat a target within {FARTHEST_REPEAT:g} mm"
        )
    if is_end and mark.target != first:
        raise ValueError(
            "a distance goes to this name, but it has two places; "
            "give the second place another name"
        )


def _refuse_inches(measurements: Measurements, sheet: Sheet) -> None:
    groups: dict[str, list[Point]] = {
        "targets": [mark.target for mark in measurements.marks],
        "measured positions": [measured for _, measured in measurements.readings],
    }
    # A mark or two, read several times, are close together without being in inches.
    if len(set(groups["targets"])) < 3 or max(sheet) < 10 * TOO_CLOSE:
        return
    for what, points in groups.items():
        if len(points) < 3:
            continue
        spread = max(
            max(point[axis] for point in points) - min(point[axis] for point in points)
            for axis in (0, 1)
        )
        if spread < TOO_CLOSE:
            raise ValueError(
                f"all {what} lie within {spread:.0f} mm of each other "
                f"on a sheet {sheet[0]:.0f} mm wide; {_INCH_HINT}"
            )


def _refuse_outside(mark: Mark, sheet: Sheet) -> None:
    x, y = mark.target
    if abs(x) > sheet[0] / 2 + OUTSIDE or abs(y) > sheet[1] / 2 + OUTSIDE:
        raise ValueError(
            f"target ({x:.1f}, {y:.1f}), counted from the middle of the sheet with y up, "
            f"is off the {sheet[0]:.0f} x {sheet[1]:.0f} mm sheet; check the frame (top-left "
            "corner with y down, or middle with y up), the units and the sheet size in the settings"
        )


def _refuse_far(measurements: Measurements, mark: Mark, sheet: Sheet) -> None:
    far = far_reading(measurements, mark, sheet)
    if far:
        frame = "check the frame (top-left corner with y down, or middle with y up) and the numbers"
        remedy = far.mistake or frame
        raise ValueError(f"measured {far.error:.0f} mm away from its target; {remedy}")


@dataclass(frozen=True)
class FarReading:
    """A reading farther from its target than any machine brings a mark."""

    error: float  # [mm]
    mistake: str  # the likely mistake, or nothing
    corrected: Point | None  # [mm] what was meant, if that was the mistake


def far_reading(measurements: Measurements, mark: Mark, sheet: Sheet) -> FarReading | None:
    """Return whether a mark's reading is too far from its target to be true."""
    if mark.measured is None:
        return None
    error = math.dist(mark.target, mark.measured)
    if error <= SUSPICIOUS:
        return None
    other = _exchanged(measurements, mark, mark.measured)
    if other:
        said = f"the readings of {mark.name} and {other.name} may be exchanged"
        return FarReading(error, said, other.measured)
    mistake, meant = _likely_mistake(mark.target, mark.measured, sheet)
    if mistake or error > MOST_ERROR:
        return FarReading(error, mistake, meant)
    return None


def _exchanged(measurements: Measurements, mark: Mark, measured: Point) -> Mark | None:
    """Return the mark that was read where this mark should be, and the other way round."""
    near = math.dist(mark.target, measured) / 5
    readings = measurements.readings
    far = [place for sent, place in readings if math.dist(sent.target, place) > SUSPICIOUS]
    # Where most are far the whole file is turned round, and marks only seem exchanged.
    for other, other_measured in readings if 2 * len(far) <= len(readings) else ():
        there = math.dist(other.target, measured)
        back = math.dist(mark.target, other_measured)
        if other.target != mark.target and max(there, back) < min(TOO_CLOSE, near):
            return other
    return None


def _likely_mistake(target: Point, measured: Point, sheet: Sheet) -> tuple[str, Point | None]:
    """Return the usual slip that would explain a mark far from its target, and what was meant."""
    meant = {
        sentence: undo(*measured) for sentence, undo in _slips(sheet[0] / 2, sheet[1] / 2).items()
    }
    best = min(meant, key=lambda sentence: math.dist(target, meant[sentence]))
    left = math.dist(target, meant[best])
    explained = left < min(TOO_CLOSE, math.dist(target, measured) / 5)
    return (best, meant[best]) if explained else ("", None)


def _slips(right: float, top: float) -> dict[str, Callable[[float, float], Point]]:
    """Return the usual slips of the pen and what undoes each; the sheet ends at right and
    top [mm].
    """
    corner_inches = f"measured, from the top-left corner, {_INCH_HINT}"
    from_middle = "measured counts from the middle, target from the top-left corner; use one frame"
    from_corner = "measured counts from the top-left corner, target from the middle; use one frame"
    from_below = "measured counts from the bottom-left corner; use one frame"
    return {
        "the measured y runs the other way; check the frame": lambda x, y: (x, -y),
        "the measured x runs the other way; check the frame": lambda x, y: (-x, y),
        "x and y may be exchanged": lambda x, y: (y, x),
        "x and y, from the corner, may be exchanged": lambda x, y: (
            top - y - right,
            top - x - right,
        ),
        from_corner: lambda x, y: (x - right, top - y),
        from_middle: lambda x, y: (x + right, top - y),
        from_below: lambda x, y: (x - right, y - top),
        f"measured {_INCH_HINT}": lambda x, y: (INCH * x, INCH * y),
        corner_inches: lambda x, y: (INCH * (x + right) - right, top - INCH * (top - y)),
    }


def _refuse_odd(measurements: Measurements, distance: Distance) -> None:
    first, second = (measurements.target_of(name) for name in distance.between)
    meant = math.dist(first, second)
    if abs(meant - distance.length) > MOST_DISTANCE_ERROR:
        inches = abs(meant - INCH * distance.length) < TOO_CLOSE
        remedy = _INCH_HINT if inches else "check the names and the number"
        said = f"measured {distance.length:g} mm, but the targets are {meant:.0f} mm apart"
        raise ValueError(f"{said}; {remedy}")


# Places counted from two edges of the sheet, as a tape measures them [mm].


def from_edges(place: Point, *, sheet: Sheet, corner: str) -> Point:
    """Return a place of the machine frame, counted from the two edges that meet in a corner."""
    right, top = _is_right(corner), _is_top(corner)
    x = sheet[0] / 2 - place[0] if right else sheet[0] / 2 + place[0]
    y = sheet[1] / 2 - place[1] if top else sheet[1] / 2 + place[1]
    return x, y


def in_machine(read: Point, *, sheet: Sheet, corner: str) -> Point:
    """Return the place in the machine frame that was read from the edges of a corner."""
    x = sheet[0] / 2 - read[0] if _is_right(corner) else read[0] - sheet[0] / 2
    y = sheet[1] / 2 - read[1] if _is_top(corner) else read[1] - sheet[1] / 2
    return x, y


def _is_right(corner: str) -> bool:
    return corner.endswith("right")


def _is_top(corner: str) -> bool:
    return corner.startswith("top")


# `marks.toml`: marks and distances by name, with how they were made.


def _weight(weight: float) -> float:
    """Return the weight [N], if a sled can weigh that much."""
    if not 30.0 <= weight <= 1000.0:  # below it somebody wrote kilograms or pounds
        raise ValueError(
            f"a sled of {weight:g} N is not possible; "
            "newtons are needed: 9.81 times kilograms, 4.448 times pounds"
        )
    return weight


def _name(value: object) -> str:
    """Return a mark's name; a whole number will do."""
    if isinstance(value, bool) or not isinstance(value, (str, int)):
        raise ValueError("text in quotes is needed")
    name = str(value).strip()
    if not name:
        raise ValueError("the name is empty; leave it out or fill it in")
    return name


def _two_names(value: object) -> tuple[str, str]:
    if not isinstance(value, list) or len(value) != 2:
        raise ValueError('two names are needed, as ["1", "2"]')
    first, second = map(_name, value)
    if first == second:
        raise ValueError(f"'{first}' is named twice; two different marks are needed")
    return first, second


def _direction(value: object) -> Point:
    along, across = pair(value)
    if along == across == 0:
        raise ValueError("[0, 0] is not a direction; leave approach out if it is not known")
    return along, across


def _place(value: object, info: ValidationInfo) -> Point:
    assert info.context is not None
    return point(value, unit=info.context)


def _size(value: object, info: ValidationInfo) -> float:
    """Return the length [mm] of a distance, whose key is its unit."""
    assert info.field_name is not None
    size = length(value, unit=UNITS[info.field_name])
    if size <= 0:
        raise ValueError("a distance is above zero")
    return size


Weight = Annotated[Number, AfterValidator(_weight)]
Place = Annotated[Point, BeforeValidator(_place), meant("a place, as [x, y]")]
Size = Annotated[float, BeforeValidator(_size)]
Chain = Annotated[float, AfterValidator(partial(within, low=0.0, high=20000.0))]  # [mm]


class MarkTable(Table):
    """A table [[mark]]."""

    name: Annotated[str, BeforeValidator(_name)] | None = None
    target: Place
    measured: Place | None = None
    unread: StrictBool = False
    approach: Annotated[Point, BeforeValidator(_direction)] | None = None
    sled_weight_n: Weight | None = None
    chains: Annotated[tuple[Chain, Chain], BeforeValidator(pair)] | None = None


class DistanceTable(Table):
    """A table [[distance]]."""

    between: Annotated[
        tuple[str, str], BeforeValidator(_two_names), meant('names of two marks, as ["1", "2"]')
    ]
    mm: Size | None = None
    inch: Size | None = None

    @model_validator(mode="after")
    def _refuse_two_lengths(self) -> DistanceTable:
        if (self.mm is None) == (self.inch is None):
            raise ValueError("mm or inch is missing, or both are there; write mm = 500.0")
        return self


class MarksFile(Table):
    """A marks.toml."""

    frame: Literal["sheet-top-left", "machine"]
    units: Literal["mm", "inch"] = "mm"
    date: Any = ""
    cut_with: str | None = None
    cut_with_digest: str = ""
    controller: Controller | None = None
    tape_sigma_mm: (
        Annotated[Number, AfterValidator(partial(within, low=0.001, high=50.0))] | None
    ) = None
    sled_weight_n: Weight | None = None
    steered: StrictBool = False
    chains_rezeroed: StrictBool = False
    new_sheet: StrictBool = False
    frame_moved: StrictBool = False
    mark: tuple[MarkTable, ...] = ()
    distance: tuple[DistanceTable, ...] = ()


def read_marks_toml(path: Source, *, sheet: Sheet, known: Known = None) -> Measurements:
    """Return the marks and distances of a marks.toml, moved to the machine frame; unread
    marks too.
    """
    head = parsed(path, with_quoted_fractions(read_text(path)), tomllib.loads, "TOML")
    file = read_table(MarksFile, head, path, context=UNITS.get(str(head.get("units", "mm")), 1.0))
    file_round = _round(path, file, known)
    sheet = file_round.cut_with.sheet if file_round.cut_with else sheet
    corner = sheet if file.frame == "sheet-top-left" else None
    return Measurements(
        marks=marks_of(file.mark, corner=corner, sled_weight=file.sled_weight_n),
        distances=tuple(
            Distance(each.between, each.mm or each.inch or 0.0) for each in file.distance
        ),
        controller=file.controller,
        tape_sigma=file.tape_sigma_mm,
        sled_weight=file.sled_weight_n,
        source=str(path),
        rounds=(file_round,),
        typed=Typed(corner, file.units),
        steered=file.steered,
    )


def _round(path: Source, file: MarksFile, known: Known) -> Round:
    """Return how the file's marks were cut; the path in cut_with starts at the file's folder."""
    cut_with, changed = None, ""
    if file.cut_with is not None:
        with naming(path, "cut_with"):
            kept = settings_as_they_were(as_path(path).parent / file.cut_with, file.cut_with_digest)
            if kept is None:
                changed = file.cut_with
            else:
                cut_with = read_settings(kept, known=known)
    return Round(
        date=str(file.date),
        cut_with=cut_with,
        changed=changed,
        chains_rezeroed=file.chains_rezeroed,
        new_sheet=file.new_sheet,
        frame_moved=file.frame_moved,
    )


def marks_of(
    tables: Sequence[MarkTable], *, corner: Sheet | None = None, sled_weight: float | None = None
) -> tuple[Mark, ...]:
    """Return all marks in the machine frame; without a name, an equal target makes a repeat.

    `corner`: the sheet from whose top left corner they count, y down.
    """
    names: dict[Point, str] = {}
    marks = []
    for index, said in enumerate(tables, 1):
        target, measured, approach = said.target, said.measured, said.approach
        if corner:
            target = to_machine(target, sheet=corner)
            measured = measured and to_machine(measured, sheet=corner)
            approach = approach and (approach[0], -approach[1])
        marks.append(
            Mark(
                name=said.name or names.setdefault(target, str(index)),
                target=target,
                measured=measured,
                approach=approach,
                sled_weight=sled_weight if said.sled_weight_n is None else said.sled_weight_n,
                chains=said.chains,
                is_unread=said.unread and measured is None,
            )
        )
    return tuple(marks)


# `marks.csv`: a mark per line in the machine frame, columns named in the first line.


# The columns of each key that a table [[mark]] of a marks.toml has.
COLUMNS = {
    "target": ("target_x_mm", "target_y_mm"),
    "measured": ("measured_x_mm", "measured_y_mm"),
    "approach": ("approach_x", "approach_y"),
    "sled_weight_n": ("sled_weight_n",),
    "chains": ("chain_left_mm", "chain_right_mm"),
}
NEEDED = (*COLUMNS["target"], *COLUMNS["measured"])
OPTIONAL = ("name", *COLUMNS["approach"], *COLUMNS["sled_weight_n"], *COLUMNS["chains"])


def read_marks_csv(path: Source) -> Measurements:
    """Return the marks of a comma-separated table; lines that begin with # are comments."""
    rows = _rows(path)
    if not rows:
        raise InputError(path, "has comments only", remedy=f"begin with a line {','.join(NEEDED)}")
    line, header = rows[0]
    titles = [cell.lower() for cell in header]
    columns = [_in_millimetres(title) for title in titles]
    units = {column: INCH for column, title in zip(columns, titles, strict=True) if column != title}
    with naming(path, f"line {line}"):
        _check_header(columns)
    if len(rows) == 1:
        raise InputError(path, "has no marks below its header", remedy="add one line for each mark")
    marks = []
    for line, cells in rows[1:]:
        with naming(path, f"line {line}"):
            if len(cells) != len(columns):
                many = f"{len(cells)} values where the header has {len(columns)}"
                raise ValueError(f"{many}; write one value for each column")
        marks.append(_mark(path, line, dict(zip(columns, cells, strict=True)), units))
    return Measurements(marks=marks_of(marks), source=str(path))


def _in_millimetres(title: str) -> str:
    """Return the column of a title; one in inches, like target_x_inch, is the same column in mm."""
    for ending in ("_inches", "_inch", "_in"):
        if title.endswith(ending) and f"{title.removesuffix(ending)}_mm" in NEEDED + OPTIONAL:
            return f"{title.removesuffix(ending)}_mm"
    return title


def _rows(path: Source) -> list[tuple[int, list[str]]]:
    """Line numbers and trimmed cells of all lines that are neither empty nor comments."""
    rows = []
    for line, text in enumerate(read_text(path).splitlines(), 1):
        if not text.strip() or text.lstrip().startswith("#"):
            continue
        try:
            cells = next(csv.reader([text], skipinitialspace=True, strict=True))
        except csv.Error as error:
            raise InputError(
                path,
                f"cannot be split into columns ({error})",
                place=f"line {line}",
                remedy="check the quotes",
            ) from None
        rows.append((line, [cell.strip() for cell in cells]))
    return rows


def _check_header(columns: list[str]) -> None:
    if len(columns) == 1 and (";" in columns[0] or "\t" in columns[0]):
        raise ValueError(
            "the columns are not separated by commas; save it comma-separated, with decimal points"
        )
    if len(set(columns)) < len(columns):
        twin = next(column for column in columns if columns.count(column) > 1)
        raise ValueError(f"column {twin} stands twice; remove a column")
    if not set(columns) & set(NEEDED):
        raise ValueError(f"the first line does not name the columns; begin with {','.join(NEEDED)}")
    refuse_unknown(columns, NEEDED + OPTIONAL)
    for column in NEEDED:
        if column not in columns:
            raise ValueError(f"column {column} is missing; needed are {', '.join(NEEDED)}")


def _mark(path: Source, line: int, row: dict[str, str], units: Mapping[str, float]) -> MarkTable:
    """Return the mark of a line, which is refused as a table [[mark]] would be."""
    said: dict[str, Any] = {"name": row["name"]} if row.get("name") else {}
    for key, columns in COLUMNS.items():
        if columns[0] in NEEDED or any(row.get(column) for column in columns):
            said[key] = []
            for column in columns:
                with naming(path, f"line {line}, {column}"):
                    typed = length_in(row.get(column, ""), unit=units.get(column, 1.0))
                said[key].append(typed)
    if "sled_weight_n" in said:
        (said["sled_weight_n"],) = said["sled_weight_n"]

    def place(where: KeyPath) -> str:
        return ", ".join([f"line {line}", *map(str, where[:1])])

    return read_table(MarkTable, said, path, place=place, context=1.0)


# The published `Calibration Measurements.ini`: marks in mm from the sheet's top-left corner.
#
# [global] numpositions, [actual_positions] x0 y0 ..., [target_positions] tx0 ty0 ...; y runs down.

_NUMBERED = re.compile(r"t?[xy](\d+)", re.IGNORECASE)


def read_marks_ini(path: Source, *, sheet: Sheet) -> Measurements:
    """Return the marks of a published measurement file, moved to the machine frame."""
    ini = read_ini(path)
    count = _count(ini)
    marks: list[Mark] = []
    names: dict[Point, str] = {}
    for index in range(count):
        target = to_machine(_point(ini, "target_positions", "t", index), sheet=sheet)
        measured = to_machine(_point(ini, "actual_positions", "", index), sheet=sheet)
        # The format has no names; the same target again is a repeat of the same mark.
        marks.append(Mark(names.setdefault(target, str(index)), target, measured))
    return Measurements(marks=tuple(marks), source=str(path))


def _count(ini: IniText) -> int:
    """Return how many positions the file says it has, if it has exactly those."""
    entry = ini.needed("numpositions", section="global")
    if not entry.value.isascii() or not entry.value.isdigit() or int(entry.value) == 0:
        raise InputError(
            ini.source,
            f"'{entry.value}' is not a count",
            place=entry.place,
            remedy="write how many marks there are",
        )
    count = int(entry.value)
    for other in ini.entries:
        numbered = _NUMBERED.fullmatch(other.key)
        if numbered and int(numbered[1]) >= count:
            raise InputError(
                ini.source,
                f"is beyond numpositions = {count}",
                place=other.place,
                remedy="numbers start at 0; correct numpositions or remove the mark",
            )
    return count


def _point(ini: IniText, section: str, prefix: str, index: int) -> Point:
    """Return a point of the file, as written [mm]."""
    x, y = (ini.number(f"{prefix}{axis}{index}", section=section) for axis in ("x", "y"))
    return x, y


__all__ = [
    "Distance",
    "Mark",
    "Measurements",
    "Round",
    "join_measurements",
    "read_marks",
    "without_marks",
]


def read_marks(path: Source, *, sheet: Sheet, known: Known = None) -> Measurements:
    """Return the marks of a file, in the machine frame [mm]; sheet is its width and height [mm].

    Marks that wait for their reading (`unread = true`) take no part. A file that names the settings
    it was cut with lies on the sheet of these; `known` lists each effect's parameters for them.
    """
    measurements = _without_unread(READERS[_form_of(path)](path, sheet, known))
    named = replace(measurements.rounds[0], digest=digest_of(measurements))
    return checked(
        replace(measurements, rounds=(named,)),
        sheet=named.cut_with.sheet if named.cut_with else sheet,
    )


def _without_unread(measurements: Measurements) -> Measurements:
    """Without the marks whose readings are yet to come; an end of distances stays, once."""
    ends = {name for distance in measurements.distances for name in distance.between}
    ends -= {mark.name for mark in measurements.marks if not mark.is_unread}
    kept = []
    for mark in measurements.marks:
        if not mark.is_unread or mark.name in ends:
            kept.append(mark)
            ends.discard(mark.name)
    return replace(measurements, marks=tuple(kept))


# How a file is read, by the form that _form_of() finds.
READERS: Mapping[str, Callable[[Source, Sheet, Known], Measurements]] = {
    "ini": lambda path, sheet, _: read_marks_ini(path, sheet=sheet),
    "toml": lambda path, sheet, known: read_marks_toml(path, sheet=sheet, known=known),
    "csv": lambda path, *_: read_marks_csv(path),
}


def _form_of(path: Source) -> str:
    """`ini`, `toml` or `csv`, by what the file says first and by its ending second."""
    text = read_bytes(path).decode("utf-8-sig", "replace").lower()
    lines = [line.strip() for line in text.splitlines()]
    lines = [line for line in lines if line and line[0] not in "#;"]
    if any(re.match(r"\[(maslow settings|sheet|effects\..*)\]", line) for line in lines):
        raise InputError(
            path, "holds settings, not marks", remedy="give SETTINGS first, then MARKS"
        )
    if any(re.match(r"numpositions\s*[=:]", line) for line in lines):
        return "ini"
    if any(re.match(r"\[\[(mark|distance)\]\]|frame\s*=", line) for line in lines):
        return "toml"
    if lines and any(column in lines[0] for column in NEEDED):
        return "csv"
    ending = Path(path).suffix.lower().lstrip(".")
    if ending in READERS:
        return ending
    if any(map(CODE.match, lines)):
        form = to_do("give the form that plumb grid --marks wrote", page="give a form of marks")
        raise InputError(path, "holds a program, not marks", remedy=form)
    raise InputError(
        path,
        "is none of the known forms of marks",
        remedy="give a Calibration Measurements.ini, a marks.toml or a marks.csv",
    )


# Several files of marks become a board: repeats, other marks, and what contradicts.

# How a reading is looked up in another file: target, or both ends of a distance, and sled weight.
ReadingKey = tuple[Point | frozenset[Point], float | None]
# What repeats of a mark share: target, sled weight, chains, approach, settings, zero, sheet.
MadeBy = tuple[Point, float | None, Point | None, Point | None, MachineSettings | None, int, int]
Value = TypeVar("Value", str, float)
FEWEST_COPIED = 5  # readings that agree to the last digit before a file passes for a copy


def join_measurements(parts: Iterable[Measurements]) -> Measurements:
    """Several files as a single board, in the order in which they were cut.

    A name with the same target, made in the same way, is a repeat. Otherwise it is a new mark, and
    all names of its file get the file's name in front.
    """
    several = tuple(parts)
    if len(several) == 1:
        return several[0]
    labels = _labels(several)
    rounds: list[Round] = []
    known: dict[str, list[MadeBy]] = {}
    joined: list[Measurements] = []
    weights = {part.sled_weight for part in several}
    typed = {part.typed for part in several}
    for number, part in enumerate(several):
        rounds.append(_next_round(part, labels[number], rounds))
        _refuse_a_copy(part, several[:number])
        numbered = _numbered(part, number)
        made = [(mark.name, _made(mark, rounds[number])) for mark in numbered.marks]
        clash = any(how not in known.get(name, [how]) for name, how in made)
        joined.append(_renamed(numbered, f"{labels[number]}:") if clash else numbered)
        for mark, (_, how) in zip(joined[-1].marks, made, strict=True):
            known.setdefault(mark.name, []).append(how)
    return Measurements(
        marks=tuple(mark for part in joined for mark in part.marks),
        distances=tuple(distance for part in joined for distance in part.distances),
        controller=_agreed([(part, part.controller) for part in several], "controller"),
        tape_sigma=_agreed([(part, part.tape_sigma) for part in several], "tape_sigma_mm"),
        # Each mark carries its weight.
        sled_weight=weights.pop() if len(weights) == 1 else None,
        source=" + ".join(part.source for part in several),
        # Alike in all files, or nothing is known of it.
        typed=typed.pop() if len(typed) == 1 else Typed(),
        rounds=tuple(rounds),
    )


def _numbered(part: Measurements, number: int) -> Measurements:
    """Return a file whose marks and distances belong to the round with this number."""
    return replace(
        part,
        marks=tuple(replace(mark, round=number) for mark in part.marks),
        distances=tuple(replace(distance, round=number) for distance in part.distances),
    )


def _refuse_a_copy(part: Measurements, before: tuple[Measurements, ...]) -> None:
    """Refuse a file with the numbers of another: the board would seem to have no noise."""
    for other in before:
        same = _readings(part).items() & _readings(other).items()
        common = _readings(part).keys() & _readings(other).keys()
        if len(same) == len(common) >= FEWEST_COPIED:
            raise InputError(
                part.source,
                f"its {len(same)} readings are those of {other.source} to the last digit",
                remedy="a copy is not a repeat: leave the copy out",
            )


def _readings(part: Measurements) -> dict[ReadingKey, tuple[float, ...]]:
    """Return what was read, by targets and sled weight: the first reading of each."""
    readings: dict[ReadingKey, tuple[float, ...]] = {}
    for mark, measured in part.readings:
        read = tuple(round(number, 6) for number in measured)
        readings.setdefault((_rounded(mark.target), mark.sled_weight), read)
    for distance in part.distances:
        ends = frozenset(_rounded(part.target_of(name)) for name in distance.between)
        readings.setdefault((ends, part.sled_weight), (distance.length,))
    return readings


def _rounded(point: tuple[float, float]) -> tuple[float, float]:
    return round(point[0], 3), round(point[1], 3)


def _labels(parts: tuple[Measurements, ...]) -> list[str]:
    """Return a short name of each file, no two alike."""
    paths = [Path(part.source) for part in parts]
    labels = [path.stem for path in paths]
    if len(set(labels)) == 1:
        labels = [path.parent.name or path.stem for path in paths]
    elif len(set(labels)) < len(labels):
        labels = [f"{path.parent.name}/{path.stem}" for path in paths]
    if len(set(labels)) < len(labels):
        labels = [f"{label} {number}" for number, label in enumerate(labels, 1)]
    return labels


def _next_round(part: Measurements, name: str, before: list[Round]) -> Round:
    """Return the round of a file after others; refuses a file whose frame moved."""
    file_round = part.rounds[0]
    if not before:
        return replace(file_round, name=name)
    if file_round.frame_moved:
        raise InputError(
            part.source,
            "frame_moved is true, so it cannot share a frame with the files before it",
            remedy="give it alone",
        )
    last = before[-1]
    return replace(
        file_round,
        name=name,
        zero_group=last.zero_group + file_round.chains_rezeroed,
        sheet_group=last.sheet_group + file_round.new_sheet,
    )


def _made(mark: Mark, file_round: Round) -> MadeBy:
    """Return everything that must be equal for two readings with the same name to be repeats."""
    made = (mark.target, mark.sled_weight, mark.chains, mark.approach)
    return (*made, file_round.cut_with, file_round.zero_group, file_round.sheet_group)


def _renamed(part: Measurements, prefix: str) -> Measurements:
    return replace(
        part,
        marks=tuple(replace(mark, name=prefix + mark.name) for mark in part.marks),
        distances=tuple(
            replace(distance, between=(prefix + distance.between[0], prefix + distance.between[1]))
            for distance in part.distances
        ),
    )


def _agreed(values: list[tuple[Measurements, Value | None]], key: str) -> Value | None:
    """Return the value of all files that give it."""
    said = [(part, value) for part, value in values if value is not None]
    for part, value in said[1:]:
        if value != said[0][1]:
            raise InputError(
                part.source,
                f"{key} is {value} here and {said[0][1]} in {said[0][0].source}",
                remedy="make them equal, or use each file alone",
            )
    return said[0][1] if said else None


def without_marks(measurements: Measurements, names: Iterable[str]) -> Measurements:
    """Return the measurements without the readings of some marks, and without distances from or to
    them.

    Raises InputError for a name that is not there.
    """
    gone = tuple(names)
    known = [mark.name for mark in measurements.marks]
    try:
        refuse_unknown(gone, known)
    except ValueError as error:
        raise InputError(to_do("--without", page="left out:") + f" {error}") from None
    return replace(
        measurements,
        marks=tuple(mark for mark in measurements.marks if mark.name not in gone),
        distances=tuple(
            distance for distance in measurements.distances if not {*distance.between} & {*gone}
        ),
    )
