"""`marks.toml`: marks and distances by name, with how they were made."""

from __future__ import annotations

import tomllib
from collections.abc import Sequence
from functools import partial
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, BeforeValidator, StrictBool, ValidationInfo, model_validator

from plumb.marks.model import Distance, Mark, Measurements, Point, Round, Typed
from plumb.marks.plausible import Sheet, to_machine
from plumb.settings.cut_with import settings_as_they_were
from plumb.settings.files import read_settings
from plumb.settings.machine import Controller
from plumb.settings.toml import Known
from plumb.text.answers import meant
from plumb.text.errors import Source, naming
from plumb.text.files import as_path, parsed, read_text
from plumb.text.tables import Number, Table, read_table
from plumb.text.values import UNITS, length, pair, point, with_quoted_fractions, within

SLED_WEIGHT_RANGE = (30.0, 1000.0)  # [N] below it somebody wrote kilograms or pounds


def _weight(weight: float) -> float:
    """Return the weight [N], if a sled can weigh that much."""
    low, high = SLED_WEIGHT_RANGE
    if not low <= weight <= high:
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
