"""`marks.csv`: a mark per line in the machine frame, columns named in the first line."""

import csv
import re
from collections.abc import Mapping
from typing import Any

from plumb.marks.model import Mark, Measurements, Point
from plumb.marks.plausible import Sheet, to_machine
from plumb.marks.toml import MarkTable, marks_of
from plumb.text.errors import InputError, Source, naming
from plumb.text.files import read_text
from plumb.text.ini import IniText, read_ini
from plumb.text.tables import Path, read_table
from plumb.text.values import INCH, length_in, refuse_unknown

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

    def place(where: Path) -> str:
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
