"""`plumb grid`: the G-code for calibration marks, by the room `grid`."""

import argparse
import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated

from plumb.cli.arguments import add_shared, any_length, unit_of
from plumb.cli.output import refuse_twins, write_outputs
from plumb.cli.screen import in_text, next_step, print_json
from plumb.fit.fit import USUAL_SIGMA
from plumb.fit.inputs import settings_in
from plumb.grid import (
    APPROACH,
    NUMBERS,
    PRESETS,
    UNITS,
    Grid,
    PlainMachine,
    Touch,
    demand,
    marks_list,
    pairs,
    program,
    touches_of,
)
from plumb.model.reach import plain_machine, refuse_way, with_soft_chains
from plumb.plan.preview import Preview, as_read, preview
from plumb.settings import MachineSettings, cut_with_lines, with_form
from plumb.text.answers import meant
from plumb.text.errors import InputError
from plumb.words.proposals import causes

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
    """Plan the grid, write what was asked for, print, and return the exit code."""
    refuse_twins(arguments.output, arguments.marks)
    grid, machine, text = _planned(arguments)
    touches = touches_of(grid, machine)
    told = _could_tell(arguments, touches) if arguments.details else None
    files = _files(arguments, grid, machine, text)
    write_outputs(files, inputs=[arguments.settings] if arguments.settings else [])
    if arguments.json:
        print_json(
            PlannedGrid(
                program=None if arguments.output else text,
                marks=tuple(
                    PlannedTouch(mark.name, (mark.x, mark.y), mark.visit) for mark in touches
                ),
                approach=APPROACH,
                written=tuple(files),
                details=told,
            )
        )
        return 0
    if not arguments.output and (files or not told):
        print(text, end="")
    if told:
        print("\n\n".join(in_text(causes(told, unit_of(arguments)))))
    if arguments.output and arguments.marks:
        words = f"Cut {arguments.output}, write what you measure into {arguments.marks}, then:"
        measured = ["calibrate", arguments.settings or "groundcontrol.ini", arguments.marks]
        print(next_step(words, measured))
    return 0


def _planned(arguments: argparse.Namespace) -> tuple[Grid, PlainMachine, str]:
    """Return the grid, the machine that cuts it, and the program; InputError for a grid that cannot
    be made, or that is out of reach.
    """
    grid = grid_of(arguments)
    if arguments.settings:
        settings = settings_in(arguments.settings).as_plumb_model()
        machine = plain_machine(settings)
    else:
        machine = PlainMachine()
        settings = _usual(machine)
    text = program(grid, machine)
    refuse_way(grid, machine, with_soft_chains(settings)[0])
    return grid, machine, text


def grid_of(arguments: argparse.Namespace) -> Grid:
    """Return the grid of parsed options."""
    grid = PRESETS[arguments.preset] if arguments.preset else Grid()
    if arguments.places:
        grid = Grid(repeats=False, places=arguments.places)
    given = {name: value for name in NUMBERS if (value := getattr(arguments, name)) is not None}
    demand("margin" not in given or not grid.places, "--margin is of marks in columns and rows")
    return grid._replace(**given)


def _files(
    arguments: argparse.Namespace, grid: Grid, machine: PlainMachine, text: str
) -> dict[str, bytes]:
    """Return the program and its form, as far as they were asked for."""
    files: dict[str, bytes] = {}
    form = arguments.marks
    if form:
        # Readings that took an hour must not be lost to a second run.
        if os.path.isfile(form) and not arguments.force:
            raise InputError(form, "exists", remedy="move it away or give --marks another name")
        text = with_form(text, form, arguments.output) if arguments.output else text
        files[form] = marks_list(
            grid,
            machine,
            cut_with_lines(arguments.settings, form),
            new_sheet=arguments.new_sheet,
            units=arguments.units,
        ).encode("ascii")
    if arguments.output:
        files = {arguments.output: text.encode("ascii"), **files}
    return files


def _usual(machine: PlainMachine) -> MachineSettings:
    """Return the usual machine."""
    return MachineSettings(
        motor_gap=machine.motor_spacing,
        motor_height=machine.sheet_height / 2 + machine.motor_offset,
        rotation_radius=machine.rotation_radius,
        sheet_width=machine.sheet_width,
        sheet_height=machine.sheet_height,
        feed="top",
        sled_weight=machine.sled_weight_n,
    )


def _could_tell(arguments: argparse.Namespace, touches: Sequence[Touch]) -> Preview:
    """Return what the marks could tell of the machine in the settings. Raises InputError."""
    if not arguments.settings:
        raise InputError("--details is of a machine: give its --settings too")
    return preview(settings_in(arguments.settings), as_read(touches), sigma=USUAL_SIGMA)


# The arguments of `plumb grid`.

EXAMPLES = (
    "plumb grid --settings groundcontrol.ini --output grid.nc --marks marks.toml",
    "plumb grid --settings groundcontrol.ini --preset twenty-five --details",
)
EXIT = "Exit: 0 done; 2 the grid cannot be made, and nothing was written."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `plumb grid`."""
    group = parser.add_argument_group("which marks [15, and 8 of them again 20 mm further in]")
    either = group.add_mutually_exclusive_group()
    either.add_argument(
        "--preset", choices=PRESETS, help="one of these sets of marks, without repeats"
    )
    places = "marks there, in this order: from the sheet's middle (--places='-900,400 0,4in')"
    either.add_argument("--places", type=pairs, metavar="PLACES", help=places)
    _add_number(group, "margin")
    group = parser.add_argument_group("how they are made")
    for name in ("depth", "safe_height", "feed"):
        _add_number(group, name)
    group = parser.add_argument_group("files")
    settings = "groundcontrol.ini, webcontrol.json or machine.toml: the machine and its sheet"
    group.add_argument("--settings", metavar="FILE", help=settings)
    group.add_argument("--output", metavar="FILE", help="where the program goes [the screen]")
    group.add_argument("--marks", metavar="FILE", help="also write a marks.toml to fill in")
    group.add_argument(
        "--units", choices=UNITS, default="mm", help="of your tape, for the form [%(default)s]"
    )
    another = "the form says that its marks are on another sheet than those before"
    group.add_argument("--new-sheet", action="store_true", help=another)
    add_shared(parser, "--force")
    add_shared(parser, details="what such marks could tell; without files, that alone")
    add_shared(parser, "--json")


def _add_number(group: argparse._ArgumentGroup, name: str) -> None:
    meaning = f"{NUMBERS[name].meaning} [{Grid._field_defaults[name]:g}]"
    kind = float if name == "feed" else any_length
    group.add_argument(f"--{name.replace('_', '-')}", help=meaning, type=kind, metavar="N")
