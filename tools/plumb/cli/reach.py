"""`plumb reach`: which part of the sheet a machine can use, and what limits the rest."""

import argparse

from plumb.cli.arguments import add_shared, unit_of
from plumb.cli.screen import next_step, print_json, sentences, table
from plumb.fit.inputs import settings_in
from plumb.fit.problem import priors_with
from plumb.model.reach import Extreme
from plumb.plan.sheet_reach import SheetReach, reach_of
from plumb.text.values import Unit

CUT_THERE = ("--marks", "marks.toml", "--output", "grid.nc")
CUT = 10.0  # [N] the side force of a light cut


def run(arguments: argparse.Namespace) -> int:
    """Survey the sheet, print, and return the exit code."""
    settings = settings_in(arguments.settings)
    priors_with(arguments.prior)  # refuses a number that is none
    survey, expected = reach_of(settings, dict(arguments.prior))
    answer = SheetReach(survey=survey, expected=expected, unit=unit_of(arguments))
    if arguments.json:
        print_json(answer)
    else:
        print(as_text(answer))
        cut = ["grid", "--settings", arguments.settings, *CUT_THERE]
        print(f"\n{next_step('Cut marks where it is usable:', cut)}")
    return 0


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
    "plumb reach machine.toml --json",
)
EXIT = "Exit: 0 done; 2 an input cannot be used."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `plumb reach`."""
    add_shared(parser, "settings", "--prior", "--units", "--json")
