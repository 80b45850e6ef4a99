"""`plumb reach`: which part of the sheet a machine can use, and what limits the rest."""

import argparse
from dataclasses import dataclass

import numpy as np

from plumb.cli.arguments import add_shared, picture_form, unit_of
from plumb.cli.output import write_outputs
from plumb.cli.screen import next_step, print_json, sentences, table
from plumb.fit.fit import priors_with
from plumb.fit.inputs import settings_in
from plumb.model.reach import Extreme, Survey, percent
from plumb.pictures.drawing import Panel, draw
from plumb.plan.preview import MEANING, SheetReach, reach_of
from plumb.text.values import Unit

CUT_THERE = ("--marks", "marks.toml", "--output", "grid.nc")
CUT = 10.0  # [N] the side force of a light cut


@dataclass(frozen=True, kw_only=True)
class ReachMap(SheetReach):
    """The usable part of the sheet, and the files that were written."""

    written: list[str]


def run(arguments: argparse.Namespace) -> int:
    """Survey the sheet, print, and return the exit code."""
    form = picture_form(arguments.output, option="-o") if arguments.output else ""
    settings = settings_in(arguments.settings)
    priors_with(arguments.prior)  # refuses a number that is none
    survey, expected = reach_of(settings, dict(arguments.prior))
    written = [arguments.output] if arguments.output else []
    unit = unit_of(arguments)
    answer = ReachMap(survey=survey, expected=expected, unit=unit, written=written)
    if arguments.output:
        write_outputs({arguments.output: drawn_map(survey, form=form)}, inputs=[arguments.settings])
    if arguments.json:
        print_json(answer)
    else:
        print(as_text(answer))
        cut = ["grid", "--settings", arguments.settings, *CUT_THERE]
        print(f"\n{next_step('Cut marks where it is usable:', cut)}")
    return 0


# Of places that are not usable, by verdict: red, green, blue and how much they cover.
COLOURS = (
    ("", (0.0, 0.0, 0.0, 0.0)),
    ("red", (0.56, 0.17, 0.13, 0.45)),
    ("blue", (0.12, 0.37, 0.55, 0.45)),
    ("violet", (0.42, 0.25, 0.63, 0.45)),
    ("grey", (0.27, 0.27, 0.27, 0.45)),
)


def drawn_map(survey: Survey, *, form: str = "png") -> bytes:
    """Return the sheet as a picture, shaded where it is not usable by the reason."""
    verdict = survey.reached.verdict.reshape(len(survey.y), len(survey.x))[::-1]
    shades = np.array([colour for _, colour in COLOURS])[verdict]
    shares = list(survey.shares.values())
    words = [
        f"{colour.capitalize()}: {meaning}, {percent(share)}."
        for (colour, _), meaning, share in zip(COLOURS, MEANING, shares, strict=True)
        if colour and share
    ]
    width, height = survey.sheet
    corners = ((-width / 2, -height / 2), (width / 2, height / 2))
    panel = Panel(f"{percent(shares[0])} of the sheet is usable", shades=shades, shaded=corners)
    return draw([panel], sheet=survey.sheet, words=words, form=form)


def as_text(answer: SheetReach) -> str:
    """Return the survey for people: conclusion, what is normal, map, worst places."""
    lines = answer.map[::2]  # characters are twice as high as wide
    edge = "+" + "-" * len(lines[0]) + "+"
    legend = [
        sentences([each.meaning], mark=f"  {each.sign}  {each.share:>6s}  ")
        for each in answer.legend
    ]
    parts = [
        answer.conclusion,
        *([sentences([answer.normal], mark="")] if answer.normal else []),
        "\n".join([edge, *(f"|{line}|" for line in lines), edge]),
        "\n".join(legend),
    ]
    if answer.extremes:
        rows = [_row(each, answer.unit) for each in answer.extremes]
        parts.append(
            table(["", "", "limit", f"at x, y [{answer.unit.name}]", ""], rows, words=[-1])
        )
    if answer.assumed:
        parts.append(sentences(answer.assumed))
    return "\n\n".join(parts)


def _row(extreme: Extreme, unit: Unit) -> list[str]:
    x, y = extreme.place
    place = f"{unit.bare(x, 0)}, {unit.bare(y, 0)}"
    if extreme.unit == "N":
        sizes = [f"{extreme.value:.1f} N", f"{extreme.limit:g} N"]
        return [extreme.title, *sizes, place, extreme.side]
    sizes = [f"{unit.worded(size)}/N" for size in (extreme.value, extreme.limit)]
    moved = unit.worded(CUT * extreme.value, 1)
    return [extreme.title, *sizes, place, f"{CUT:g} N move it {moved}"]


# The arguments of `plumb reach`.

EXAMPLES = (
    "plumb reach machine.toml",
    "plumb reach machine.toml -o reach.png",
)
EXIT = "Exit: 0 done; 2 an input cannot be used."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `plumb reach`."""
    add_shared(parser, "settings", output="draw the map: .png, .svg or .pdf")
    add_shared(parser, "--prior", "--force", "--units", "--json")
