"""`plumb grid`: the G-code for calibration marks, by the room `grid`."""

from __future__ import annotations

import argparse
import contextlib
import io
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Annotated

import plumb.grid as marks_grid
from plumb.cli.arguments import add_json
from plumb.cli.output import refuse_twins, write_outputs
from plumb.cli.screen import next_step, print_json, sentences, table
from plumb.diagnosis.unseen import share_words
from plumb.fit.inputs import settings_in
from plumb.fit.problem import USUAL_SIGMA
from plumb.grid.options import APPROACH
from plumb.model.plain import noun_of, plain_before
from plumb.model.reach import refuse_way, with_soft_chains
from plumb.pictures.grid_paper import grid_paper
from plumb.plan.preview import POWER, Outline, Preview, as_read, preview
from plumb.settings.machine import MachineSettings
from plumb.text.answers import meant
from plumb.text.errors import InputError
from plumb.text.values import bare, unit, worded

Point = tuple[float, float]


@dataclass(frozen=True)
class PlannedTouch:
    """A mark that the program makes [mm]."""

    name: str
    target: Point
    visit: int  # 1, 2, ...: a repeat


@dataclass(frozen=True)
class PlannedGrid:
    """A grid of marks."""

    program: Annotated[str | None, meant("Null: it went into a file.")]
    marks: tuple[PlannedTouch, ...]
    approach: Point
    written: tuple[str, ...]
    details: Annotated[Preview | None, meant("What the marks could tell; null without --details.")]


def run(arguments: argparse.Namespace) -> int:
    """Make the grid as the tool does, unless our model of the machine refuses a place."""
    refuse_out_of_reach(arguments)
    told = _could_tell(arguments) if arguments.details else None
    if not arguments.json:
        code = 0
        if not told or arguments.output or arguments.marks or arguments.paper:
            code = _made(arguments)
        if code == 0 and told:
            print(_told(told))
        if code == 0 and arguments.output and arguments.marks:
            words = f"Cut {arguments.output}, write what you measure into {arguments.marks}, then:"
            measured = ["calibrate", arguments.settings or "groundcontrol.ini", arguments.marks]
            print(next_step(words, measured))
        return code
    try:
        marks_grid.program(*marks_grid.from_arguments(arguments))
    except marks_grid.GridError as error:
        raise InputError(str(error)) from None
    said = io.StringIO()
    with contextlib.redirect_stdout(said):
        code = _made(arguments)
    if code:
        return code
    grid, machine = marks_grid.from_arguments(arguments)
    print_json(
        PlannedGrid(
            program=None if arguments.output else marks_grid.program(grid, machine),
            marks=tuple(
                PlannedTouch(mark.name, (mark.x, mark.y), mark.visit)
                for mark in marks_grid.touches_of(grid, machine)
            ),
            approach=APPROACH,
            written=tuple(filter(None, (arguments.output, arguments.marks, arguments.paper))),
            details=told,
        )
    )
    return 0


def _made(arguments: argparse.Namespace) -> int:
    """Return the grid as the tool makes it, written as all results of the lab are."""
    read = [arguments.settings] if arguments.settings else []
    refuse_twins(arguments.output, arguments.marks, arguments.paper)
    if arguments.paper and not arguments.paper.lower().endswith(".pdf"):
        raise InputError(f"--paper {arguments.paper}: end the name with .pdf")

    def write(files: Mapping[str, bytes]) -> None:
        paper = {arguments.paper: _paper(arguments)} if arguments.paper else {}
        write_outputs({**files, **paper}, inputs=read)

    return marks_grid.run(arguments, "plumb", write)


def _paper(arguments: argparse.Namespace) -> bytes:
    """Return the sheet of paper for the readings."""
    grid, machine = marks_grid.from_arguments(arguments)
    form = arguments.marks or "marks.toml"
    return grid_paper(grid, machine, settings=arguments.settings, form=form)


def refuse_out_of_reach(arguments: argparse.Namespace) -> None:
    """Refuse a grid that the tool allows, but our model of the machine does not."""
    try:
        grid, machine = marks_grid.from_arguments(arguments)
        settings = _settings_of(arguments.settings, machine)
        refuse_way(grid, machine, settings)
    except marks_grid.GridError:
        return  # the grid refuses it when it is made


def _settings_of(path: str | None, machine: marks_grid.PlainMachine) -> MachineSettings:
    """Return the machine of the settings file, with the numbers that the tool goes by."""
    plain = MachineSettings(
        motor_gap=machine.motor_spacing,
        motor_height=machine.sheet_height / 2 + machine.motor_offset,
        rotation_radius=machine.rotation_radius,
        sheet_width=machine.sheet_width,
        sheet_height=machine.sheet_height,
        feed="top",
        sled_weight=machine.sled_weight_n,
    )
    if path is None:
        return with_soft_chains(plain)[0]
    settings = replace(
        settings_in(path).as_plumb_model(),
        motor_gap=plain.motor_gap,
        motor_height=plain.motor_height,
        rotation_radius=plain.rotation_radius,
        sheet_width=plain.sheet_width,
        sheet_height=plain.sheet_height,
        sled_weight=plain.sled_weight,
    )
    return with_soft_chains(settings)[0]


# What --details says: which causes such marks could show, before anything is cut.

ALIKE = 2  # look-alikes in the table


def _could_tell(arguments: argparse.Namespace) -> Preview:
    """Return what the marks could tell of the machine in the settings. Raises InputError."""
    if not arguments.settings:
        raise InputError("--details is of a machine: give its --settings too")
    try:
        grid, machine = marks_grid.from_arguments(arguments)
        marks_grid.program(grid, machine)
    except marks_grid.GridError as error:
        raise InputError(str(error)) from None
    plan = as_read(marks_grid.touches_of(grid, machine), marks_grid.spans_of(grid))
    return preview(settings_in(arguments.settings), plan, sigma=USUAL_SIGMA)


def _told(outlook: Preview) -> str:
    what = f"{outlook.marks} marks"
    what += f" and {outlook.distances} distances" if outlook.distances else ""
    first = (
        f"{what} read to {worded(outlook.sigma)}: of {len(outlook.outlines)} causes in their usual "
        f"size, {outlook.seen} would show and {outlook.named} could be named."
    )
    return "\n\n".join([sentences([first], mark=""), _outline_table(outlook)])


def _outline_table(outlook: Preview) -> str:
    rows = []
    for place, outline in enumerate(outlook.outlines, 1):
        alike = ", ".join(map(noun_of, outline.alike[:ALIKE]))
        more = len(outline.alike) - ALIKE
        rows.append(
            [
                str(place),
                noun_of(outline.effect),
                bare(outline.raw),
                share_words(outline.hidden_share),
                _smallest(outline),
                f"{alike} +{more}" if more > 0 else alike or "-",
            ]
        )
    header = ["", "effect", f"usual, {unit()}", "taken up", "found from", "taken for"]
    note = (
        f"found from: the smallest size that is found in {100 * POWER:.0f} % of all cases, times "
        "the usual size"
    )
    return table(header, rows, left=2, words=[-2, -1]) + "\n" + sentences([note], mark="")


def _smallest(outline: Outline) -> str:
    if outline.smallest is None:
        return "never"
    first = outline.parameters[0]
    alone = len(outline.parameters) == 1 and first.smallest is not None
    name, size = f"{outline.effect}.{first.name}", first.smallest or 0.0
    in_words = f" ({plain_before(name, size)})" if alone else ""
    return f"x {outline.smallest:.2g}{in_words}"


# The arguments of `plumb grid`.

EXAMPLES = (
    "plumb grid --settings groundcontrol.ini --output grid.nc --marks marks.toml",
    "plumb grid --settings groundcontrol.ini --preset twenty-five --details",
)
EXIT = "Exit: 0 done; 2 the grid cannot be made, and nothing was written."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `plumb grid`: those of the tool, and --json."""
    marks_grid.add_arguments(parser).add_argument(
        "--paper",
        metavar="FILE.pdf",
        help="also write a sheet to print: the holes with their numbers, and boxes to fill in",
    )
    parser.add_argument(
        "--details",
        action="store_true",
        help="also show what such marks could tell; without files, that alone",
    )
    add_json(parser)
