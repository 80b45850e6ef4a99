"""The paper for a grid: its marks, with boxes to fill in."""

from pathlib import Path

import plumb.grid as marks_grid
from plumb.pictures.measuring_sheet import Hole, MeasuringSheet, ReadingRow, measuring_sheet
from plumb.text.values import Unit

TAPE = {
    "mm": "Read the tape in mm, to half a millimetre if you can.",
    "inch": "Read the tape in inches, to 1/32 if you can.",
}


def grid_paper(
    grid: marks_grid.Grid,
    machine: marks_grid.PlainMachine,
    unit: Unit,
    *,
    settings: str | None,
    form: str,
) -> bytes:
    """Return the pages, as a pdf, for a grid that was made with these settings; `form` waits for
    the numbers.
    """
    return measuring_sheet(content_of(grid, machine, unit, settings=settings, form=form))


def content_of(
    grid: marks_grid.Grid,
    machine: marks_grid.PlainMachine,
    unit: Unit,
    *,
    settings: str | None,
    form: str,
) -> MeasuringSheet:
    """Return what the pages say."""
    cut = f" These marks are cut with {Path(settings).name}." if settings else ""
    then = f"Then type the numbers into {Path(form).name}.{cut}"
    holes = _holes(grid, machine)
    return MeasuringSheet(
        title=f"Measuring sheet: {len(holes)} marks",
        how=(
            "x: from the left edge of the wood to the middle of the mark. "
            "y: from its top edge down to it.",
            f"{TAPE[unit.name]} A white dot is its neighbour made again: read both."
            if grid.repeats
            else TAPE[unit.name],
            then,
        ),
        words=("mark", "planned x", "planned y", "x", "y"),
        holes=holes,
        readings=tuple(
            ReadingRow(
                hole.name,
                (unit.bare(hole.x, 1), unit.bare(hole.y, 1)),
                "again" if hole.again else "",
            )
            for hole in holes
        ),
        sheet=(machine.sheet_width, machine.sheet_height),
    )


def _holes(grid: marks_grid.Grid, machine: marks_grid.PlainMachine) -> tuple[Hole, ...]:
    return tuple(
        Hole(
            mark.name,
            machine.sheet_width / 2 + mark.x,
            machine.sheet_height / 2 - mark.y,
            again=mark.visit > 0,
        )
        for mark in marks_grid.listed(marks_grid.touches_of(grid, machine))
    )
