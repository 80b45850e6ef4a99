"""`plumb preview`: before any hole is drilled, which effects a plan of marks could tell apart."""

from __future__ import annotations

import argparse
from typing import Any

import plumb.grid as marks_grid
from plumb.cli.files import (
    add_controller,
    add_json,
    add_prior,
    add_settings,
    length,
    picture_form,
    settings_in,
    write_outputs,
)
from plumb.cli.text import millimetres, number, print_json, sentences, table
from plumb.cure.add import priors_with
from plumb.fit.problem import USUAL_SIGMA
from plumb.marks.read import Mark, Measurements, read_plan
from plumb.pictures.preview import draw_preview, shown
from plumb.plan.preview import APART, POWER, Outline, Preview, preview
from plumb.settings.machine import MachineSettings
from plumb.text.errors import InputError

HELP = "before any hole is drilled: which effects a plan of marks could tell apart"
EXIT = "Exit: 0 done; 2 an input cannot be used, and nothing was written."
COLUMNS, ROWS = 5, 3
SHOWN = 6  # additions that people are shown; --json has all
ALIKE = 2  # look-alikes in the table


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb preview`."""
    add_settings(parser)
    parser.add_argument(
        "plan",
        metavar="PLAN",
        nargs="?",
        help="marks whose targets are the plan, like the file of plumb grid --marks [a grid]",
    )
    for name, usual in (("columns", COLUMNS), ("rows", ROWS)):
        parser.add_argument(f"--{name}", metavar="N", type=int, help=f"of a grid [{usual}]")
    parser.add_argument(
        "--margin", metavar="MM", type=length, help="from outer marks to the sheet's edge [100]"
    )
    parser.add_argument(
        "--sigma",
        metavar="MM",
        type=length,
        help=f"reading error of one coordinate [tape_sigma_mm of PLAN, else {USUAL_SIGMA:g}]",
    )
    add_prior(parser)
    add_controller(parser)
    parser.add_argument("--picture", metavar="FILE", help="draw the table: .png, .svg or .pdf")
    add_json(parser)


def run(arguments: argparse.Namespace) -> int:
    """Preview, draw, print, and return the exit code."""
    form = picture_form(arguments.picture) if arguments.picture else ""
    settings = settings_in(arguments.settings)
    plan = _plan(arguments, settings)
    found = preview(
        settings,
        plan,
        sigma=arguments.sigma or plan.tape_sigma or USUAL_SIGMA,
        controller=arguments.controller,
        priors=priors_with(arguments.prior),
    )
    if arguments.picture:
        drawn = draw_preview(found, sheet=settings.sheet, form=form)
        read = [arguments.settings, *filter(None, [arguments.plan])]
        write_outputs({arguments.picture: drawn}, inputs=read)
    if arguments.json:
        print_json(as_json(found, written=arguments.picture))
    else:
        print(as_text(found))
    return 0


def _plan(arguments: argparse.Namespace, settings: MachineSettings) -> Measurements:
    """The marks of PLAN, or of a grid as plumb grid makes it."""
    given = {name: getattr(arguments, name) for name in ("columns", "rows", "margin")}
    asked = {name: value for name, value in given.items() if value is not None}
    if arguments.plan:
        for name in asked:
            raise InputError(
                f"--{name} is of a grid, and PLAN says where the marks are: leave one out"
            )
        return read_plan(arguments.plan, sheet=settings.sheet)
    grid = marks_grid.Grid(**{"columns": COLUMNS, "rows": ROWS, **asked})
    machine = marks_grid.Machine()._replace(
        sheet_width=settings.sheet_width, sheet_height=settings.sheet_height
    )
    try:
        marks_grid.check(grid, machine, lambda *place: None)
    except marks_grid.GridError as refusal:
        raise InputError(str(refusal)) from None
    side = tuple(float(value) for value in grid.approach)
    marks = tuple(
        Mark(str(mark.name), (mark.x, mark.y), (mark.x, mark.y), approach=side)
        for mark in marks_grid.marks(grid, machine)
    )
    return Measurements(marks, source=f"grid of {grid.columns} x {grid.rows}")


def as_json(found: Preview, *, written: str | None = None) -> dict[str, Any]:
    """The preview by the names of the interface."""
    return {
        "sigma_mm": found.sigma,
        "marks": found.marks,
        "distances": found.distances,
        "effects": found.effects,
        "snr": found.matrix,
        "outlines": [
            {
                "effect": one.effect,
                "typical_mm": one.raw,
                "hidden_share": one.hidden_share,
                "snr": one.seen,
                "smallest": one.smallest,
                "parameters": [
                    {"name": name, "smallest": size, "unit": unit}
                    for name, size, unit in one.parameters
                ],
                "alike": one.alike,
            }
            for one in found.outlines
        ],
        "pairs_told_apart": found.pairs,
        "additions": [
            {
                "kind": one.option.kind,
                "title": one.option.title,
                "do": one.option.do,
                "minutes": one.option.minutes,
                "pairs_told_apart": one.pairs,
            }
            for one in found.additions
        ],
        "written": [written] if written else [],
    }


def as_text(found: Preview) -> str:
    """The preview for people."""
    good = [one for one in found.outlines if one.smallest is not None and one.smallest <= 1]
    what = f"{found.marks} marks" + (f" and {found.distances} distances" if found.distances else "")
    first = (
        f"{what} read to {found.sigma:g} mm: {len(good)} of {len(found.outlines)} effects would "
        f"be found in their usual size, and {found.pairs} of {found.matrix.size} cells below are "
        f"told apart ({APART:g} or more)."
    )
    parts = [sentences([first], mark=""), _outline_table(found), _cells(found)]
    if found.additions:
        parts.append(_addition_table(found))
        best = found.additions[0].option
        parts.append(sentences([f"Best addition: {' '.join(best.do)}"], mark=""))
    return "\n\n".join(parts)


def _outline_table(found: Preview) -> str:
    rows = []
    for place, one in enumerate(found.outlines, 1):
        hidden = "-" if one.hidden_share is None else f"{100 * one.hidden_share:.0f} %"
        alike = ", ".join(one.alike[:ALIKE])
        more = len(one.alike) - ALIKE
        rows.append(
            [
                str(place),
                one.effect,
                f"{millimetres(one.raw)}",
                hidden,
                _smallest(one),
                f"{alike} +{more}" if more > 0 else alike or "-",
            ]
        )
    header = ["", "effect", "usual, mm", "in frame", "found from", "taken for"]
    note = (
        f"found from: the smallest size that is found in {100 * POWER:.0f} % of all cases, times "
        "the usual one"
    )
    return table(header, rows, left=2) + "\n" + sentences([note], mark="")


def _smallest(one: Outline) -> str:
    if one.smallest is None:
        return "never"
    first = one.parameters[0]
    own = f" ({number(first[1])} {first[2]})" if len(one.parameters) == 1 else ""
    return f"x {one.smallest:.2g}{own}".replace(" 1)", ")")


def _cells(found: Preview) -> str:
    header = ["", "reading errors beside", *(str(i) for i in range(1, len(found.effects) + 1))]
    rows = [
        [str(i + 1), name, *(shown(float(value)) for value in found.matrix[i])]
        for i, name in enumerate(found.effects)
    ]
    return table(header, rows, left=2)


def _addition_table(found: Preview) -> str:
    rows = [
        [one.option.title, f"{one.option.minutes:.0f}", f"{found.pairs} -> {one.pairs}"]
        for one in found.additions[:SHOWN]
    ]
    rows += [
        [one.option.title, f"{one.option.minutes:.0f}", f"{found.pairs} -> {one.pairs}"]
        for one in found.additions[SHOWN:]
        if one.option.kind == "many"
    ]
    return table(["what to add, best per minute first", "minutes", "cells told apart"], rows)
