"""`plumb preview`: before any hole is drilled, which effects a plan of marks could tell apart."""

from __future__ import annotations

import argparse
from dataclasses import dataclass

import plumb.grid as marks_grid
from plumb.cli.arguments import (
    add_controller,
    add_force,
    add_json,
    add_picture,
    add_prior,
    add_settings,
    add_units,
    file,
    length,
)
from plumb.cli.inputs import picture_form
from plumb.cli.output import write_outputs
from plumb.cli.screen import next_step, print_json, sentences, table
from plumb.diagnosis.unseen import share_words
from plumb.fit.inputs import settings_in
from plumb.fit.problem import USUAL_SIGMA, priors_with
from plumb.grid.options import APPROACH
from plumb.marks.read import Mark, Measurements, read_plan
from plumb.model.plain import noun_of, plain_before
from plumb.pictures.plan import draw_preview
from plumb.plan.preview import APART, POWER, Outline, Preview, preview
from plumb.settings.machine import MachineSettings
from plumb.text.errors import InputError
from plumb.text.values import bare, unit, worded

SHOWN = 6  # additions that people are shown; --json has all
ALIKE = 2  # look-alikes in the table


@dataclass(frozen=True)
class PreviewAnswer(Preview):
    """What a plan could tell, and the picture that was drawn of it."""

    written: list[str]


def run(arguments: argparse.Namespace) -> int:
    """Preview, draw, print, and return the exit code."""
    form = picture_form(arguments.picture) if arguments.picture else ""
    settings = settings_in(arguments.settings)
    plan = _plan(arguments, settings)
    outlook = preview(
        settings,
        plan,
        sigma=arguments.sigma or plan.tape_sigma or USUAL_SIGMA,
        controller=arguments.controller,
        priors=priors_with(arguments.prior),
    )
    if arguments.picture:
        drawn = draw_preview(outlook, sheet=settings.sheet, form=form)
        read = [arguments.settings, *filter(None, [arguments.plan])]
        write_outputs({arguments.picture: drawn}, inputs=read)
    if arguments.json:
        written = [arguments.picture] if arguments.picture else []
        print_json(PreviewAnswer(**vars(outlook), written=written))
    else:
        print(as_text(outlook))
        if not arguments.plan:
            print(f"\n{next_step('Cut it:', _cut(arguments))}")
    return 0


def _cut(arguments: argparse.Namespace) -> list[str]:
    """Return the command that makes this grid."""
    words = ["grid", "--settings", arguments.settings]
    words += ["--preset", arguments.preset] if arguments.preset else []
    words += [f"--margin={arguments.margin:g}"] if arguments.margin is not None else []
    return [*words, "--marks", "marks.toml", "--output", "grid.nc"]


def _plan(arguments: argparse.Namespace, settings: MachineSettings) -> Measurements:
    """Return the marks of PLAN, or of a grid as plumb grid makes it."""
    if arguments.plan:
        for name in ("preset", "margin"):
            if getattr(arguments, name) is not None:
                raise InputError(
                    f"--{name} is of a grid, and PLAN says where the marks are: leave --{name} out"
                )
        return read_plan(arguments.plan, sheet=settings.sheet)
    grid = marks_grid.PRESETS[arguments.preset] if arguments.preset else marks_grid.Grid()
    if arguments.margin is not None:
        grid = grid._replace(margin=arguments.margin)
    machine = marks_grid.PlainMachine()._replace(
        sheet_width=settings.sheet_width, sheet_height=settings.sheet_height
    )
    try:
        marks_grid.check(grid, machine, lambda *place: None)
    except marks_grid.GridError as refusal:
        raise InputError(str(refusal)) from None
    marks = tuple(
        Mark(str(mark.name), (mark.x, mark.y), (mark.x, mark.y), approach=APPROACH)
        for mark in marks_grid.touches_of(grid, machine)
    )
    return Measurements(marks, source=f"grid of {grid.columns} x {grid.rows}")


def as_text(outlook: Preview) -> str:
    """Return the preview for people."""
    what = f"{outlook.marks} marks"
    what += f" and {outlook.distances} distances" if outlook.distances else ""
    first = (
        f"{what} read to {worded(outlook.sigma)}: of {len(outlook.outlines)} causes in their usual "
        f"size, {outlook.seen} would show and {outlook.named} could be named."
    )
    parts = [sentences([first], mark=""), _outline_table(outlook), _cells(outlook)]
    if outlook.additions:
        parts.append(_addition_table(outlook))
        best = outlook.additions[0]
        parts.append(sentences([f"Best addition: {' '.join(best.do)}"], mark=""))
    return "\n\n".join(parts)


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


def _cells(outlook: Preview) -> str:
    note = f"the row's cause against each other, in reading errors: told apart from {APART:g} on"
    header = ["", "cause", *(str(i) for i in range(1, len(outlook.effects) + 1))]
    rows = [
        [str(i + 1), noun_of(name), *(shown(float(value)) for value in outlook.matrix[i])]
        for i, name in enumerate(outlook.effects)
    ]
    return table(header, rows, left=2, gap=1) + "\n" + sentences([note], mark="")


def _addition_table(outlook: Preview) -> str:
    rows = [
        [addition.title, f"{addition.minutes:.0f}", f"{outlook.named} -> {addition.named}"]
        for place, addition in enumerate(outlook.additions)
        if place < SHOWN or addition.kind == "many"
    ]
    return table(["what to add, best per minute first", "minutes", "causes named"], rows)


def shown(value: float) -> str:
    """Sigmas for people: a decimal below ten, none above."""
    return f"{value:.1f}" if value < 9.95 else f"{value:.0f}" if value < 99.5 else "99+"


# The arguments of `plumb preview`.

EXAMPLES = (
    "plumb preview groundcontrol.ini --preset twenty-five",
    "plumb preview groundcontrol.ini marks.toml --picture plan.png",
)
EXIT = "Exit: 0 done; 2 an input cannot be used, and nothing was written."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `plumb preview`."""
    add_settings(parser)
    parser.add_argument(
        "plan",
        metavar="PLAN",
        type=file,
        nargs="?",
        help="a file of marks whose targets are the plan, like that of plumb grid --marks [a grid]",
    )
    parser.add_argument(
        "--preset",
        choices=("nine", "fifteen", "twenty-five"),
        help="a grid as plumb grid makes it [15 marks, and 8 of them again]",
    )
    parser.add_argument(
        "--margin",
        metavar="MM",
        type=length,
        help="distance of the outer marks from the sheet's edge [100]",
    )
    parser.add_argument(
        "--sigma",
        metavar="MM",
        type=length,
        help="reading error of a coordinate [tape_sigma_mm of PLAN, else 0.5]",
    )
    add_prior(parser)
    add_controller(parser)
    add_picture(parser, "draw the plan and what to add to it")
    add_force(parser)
    add_units(parser)
    add_json(parser)
