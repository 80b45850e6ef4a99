"""`plumb reach`: which part of the sheet a machine can use, and what limits the rest."""

from __future__ import annotations

import argparse
from typing import Any

from plumb.cli.files import add_json, add_settings, limit, picture_form, settings_in, write_outputs
from plumb.cli.text import print_json, sentences, table
from plumb.model.predict import REACH_LIMITS, REACH_WORDS
from plumb.model.reach import Extreme, Survey, percent, survey
from plumb.pictures.reach import draw_map
from plumb.text.errors import InputError

HELP = "which part of the sheet a machine can use: chains too tight, too slack, sled too soft"
EXIT = "Exit: 0 done, the whole sheet is usable; 1 some of it is not; 2 an input cannot be used."

SIGNS = ".TSV#"  # by verdict
MEANING = (
    "usable",
    "too tight: a chain pulls more than its gearbox should",
    "too slack: a chain pulls less than its gears need to lie on one side",
    "too vertical: only a slack chain holds the sled, which gives sideways",
    "no sled hangs there, or its ring touches a sprocket",
)
OPTIONS = {
    "most_tension": ("N", "of a chain at its sprocket; motors stall near 290 N"),
    "least_tension": ("N", "of a chain at its sprocket; a slack-side bungee pulls about 18 N"),
    "least_free": ("MM", "of chain between ring and sprocket"),
    "most_give": ("MM_PER_N", "how far the sled may move for each newton that pushes it"),
}
CUT = 10.0  # [N] the side force of a light cut
MAP_STEP = 4  # every fourth place of the survey
MAP_ROWS = 8  # characters are twice as high as wide


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb reach`."""
    add_settings(parser)
    parser.add_argument("-o", "--output", metavar="FILE", help="draw the map: .png, .svg or .pdf")
    for name, (unit, meaning) in OPTIONS.items():
        parser.add_argument(
            "--" + name.replace("_", "-"),
            metavar=unit,
            type=limit,
            default=REACH_LIMITS[name],
            help=f"{meaning} [%(default)g]",
        )
    add_json(parser)


def run(arguments: argparse.Namespace) -> int:
    """Survey the sheet, print, and return the exit code."""
    limits = {name: getattr(arguments, name) for name in OPTIONS}
    if limits["least_tension"] >= limits["most_tension"]:
        raise InputError(
            f"--least-tension {limits['least_tension']:g} is not below --most-tension "
            f"{limits['most_tension']:g}: no chain can keep both"
        )
    form = picture_form(arguments.output, option="-o") if arguments.output else ""
    found = survey(settings_in(arguments.settings), **limits)
    if arguments.output:
        drawn = draw_map(found, form=form)
        write_outputs({arguments.output: drawn}, inputs=[arguments.settings])
    if arguments.json:
        print_json(as_json(found, written=arguments.output))
    else:
        print(as_text(found))
    return int(not found.all_usable)


def map_of(found: Survey) -> list[str]:
    """The sheet in characters, from the top down; edges included."""
    verdicts = found.reached.verdict.reshape(len(found.y), len(found.x))
    return ["".join(SIGNS[own] for own in row) for row in verdicts[::MAP_ROWS, ::MAP_STEP]]


def as_json(found: Survey, *, written: str | None = None) -> dict[str, Any]:
    """The survey as one object."""
    return {
        "usable_share": found.shares[REACH_WORDS[0]],
        "shares": {word.replace(" ", "_"): share for word, share in found.shares.items()},
        "limits": found.limits,
        "tightest": _extreme_json(found.tightest, "tension_n"),
        "slackest": _extreme_json(found.slackest, "tension_n"),
        "softest": _extreme_json(found.softest, "give_mm_per_n"),
        "assumed": found.assumed,
        "map": map_of(found),
        "written": [written] if written else [],
    }


def _extreme_json(own: Extreme | None, unit: str) -> dict[str, Any] | None:
    if own is None:
        return None
    side = {"side": own.side} if own.side else {}
    return {"place": own.place, unit: own.value, **side}


def as_text(found: Survey) -> str:
    """The survey for people: conclusion, map, worst places."""
    lines = map_of(found)
    edge = "+" + "-" * len(lines[0]) + "+"
    shares = found.shares.values()
    legend = [
        f"  {sign}  {percent(share):>6s}  {meaning}"
        for sign, share, meaning in zip(SIGNS, shares, MEANING, strict=True)
        if share
    ]
    parts = [
        _conclusion(found),
        "\n".join([edge, *(f"|{line}|" for line in lines), edge]),
        "\n".join(legend),
    ]
    if found.tightest and found.slackest and found.softest:
        parts.append(_worst(found, found.tightest, found.slackest, found.softest))
    if found.assumed:
        parts.append(sentences(found.assumed))
    return "\n\n".join(parts)


def _conclusion(found: Survey) -> str:
    if found.all_usable:
        return "The whole sheet is usable."
    if not found.shares[REACH_WORDS[0]]:
        return "No place of the sheet is usable."
    usable, *bad = [(word, share) for word, share in found.shares.items() if share]
    rest = ", ".join(f"{percent(share)} {word}" for word, share in bad)
    return f"{percent(usable[1])} of the sheet is usable; {rest}."


def _worst(found: Survey, tightest: Extreme, slackest: Extreme, softest: Extreme) -> str:
    limits = found.limits
    rows = [
        ["tightest chain", f"{tightest.value:.1f} N", f"{limits['most_tension']:g} N"],
        ["slackest chain", f"{slackest.value:.1f} N", f"{limits['least_tension']:g} N"],
        ["softest place", f"{softest.value:.2f} mm/N", f"{limits['most_give']:g} mm/N"],
    ]
    for row, own in zip(rows, (tightest, slackest, softest), strict=True):
        row += [f"{own.place[0]:.0f}, {own.place[1]:.0f}", own.side]
    rows[2][-1] = f"{CUT:g} N move it {CUT * softest.value:.1f} mm"
    return table(["", "", "limit", "at x, y", ""], rows)
