"""`plumb reach`: which part of the sheet a machine can use, and what limits the rest."""

import argparse
from dataclasses import dataclass

import numpy as np

from plumb.cli.arguments import add_shared
from plumb.cli.inputs import picture_form
from plumb.cli.output import write_outputs
from plumb.cli.screen import next_step, print_json, sentences, table
from plumb.fit.expected import Expected, expected_anywhere, expected_priors, expected_sentence
from plumb.fit.inputs import settings_in
from plumb.fit.problem import priors_with
from plumb.model.predict import REACH_LIMITS, REACH_WORDS
from plumb.model.reach import Give, Pull, Survey, conclusion_of, percent, survey_sheet
from plumb.pictures.drawing import Panel, draw
from plumb.text.answers import Internal, in_json, part
from plumb.text.values import bare, unit, worded

SIGNS = ".TSV#"  # by verdict
MEANING = (
    "usable",
    "too tight: a chain pulls more than its gearbox should",
    "too slack: a chain pulls less than its gears need to lie on one side",
    "too vertical: only a slack chain holds the sled, which gives sideways",
    "no sled hangs there, or its ring touches a sprocket",
)
CUT_THERE = ("--marks", "marks.toml", "--output", "grid.nc")
CUT = 10.0  # [N] the side force of a light cut
MAP_STEP = 4  # every fourth place of the survey
MAP_ROWS = 8  # characters are twice as high as wide


@dataclass(frozen=True)
class SheetReach:
    """The usable part of the sheet, and what limits the rest."""

    survey: Internal[Survey]
    expected: Expected | None  # None: no sled hangs on this sheet
    written: list[str]

    tightest = part("survey.tightest", Pull | None)
    slackest = part("survey.slackest", Pull | None)
    softest = part("survey.softest", Give | None)
    assumed = part("survey.assumed", tuple[str, ...], "What the settings do not say.")

    @in_json
    def usable_share(self) -> float:
        """The share of the sheet that the machine can use."""
        return self.survey.shares[REACH_WORDS[0]]

    @in_json
    def shares(self) -> dict[str, float]:
        """The share of the sheet of each verdict."""
        return {word.replace(" ", "_"): share for word, share in self.survey.shares.items()}

    @in_json
    def map(self) -> list[str]:
        """The sheet in characters, from the top down; edges included."""
        rows = self.survey.reached.verdict.reshape(len(self.survey.y), len(self.survey.x))
        return ["".join(SIGNS[each] for each in row) for row in rows[::MAP_ROWS, ::MAP_STEP]]


def run(arguments: argparse.Namespace) -> int:
    """Survey the sheet, print, and return the exit code."""
    form = picture_form(arguments.output, option="-o") if arguments.output else ""
    settings = settings_in(arguments.settings)
    priors_with(arguments.prior)  # refuses a number that is none
    survey = survey_sheet(settings)
    expected = expected_anywhere(settings, expected_priors(dict(arguments.prior)))
    answer = SheetReach(survey, expected, [arguments.output] if arguments.output else [])
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
    survey, expected, lines = answer.survey, answer.expected, answer.map
    edge = "+" + "-" * len(lines[0]) + "+"
    shares = survey.shares.values()
    legend = [
        sentences([meaning], mark=f"  {sign}  {percent(share):>6s}  ")
        for sign, share, meaning in zip(SIGNS, shares, MEANING, strict=True)
        if share
    ]
    parts = [
        conclusion_of(survey),
        *([sentences([expected_sentence(expected)], mark="")] if expected else []),
        "\n".join([edge, *(f"|{line}|" for line in lines), edge]),
        "\n".join(legend),
    ]
    if survey.tightest and survey.slackest and survey.softest:
        parts.append(_worst(survey.tightest, survey.slackest, survey.softest))
    if survey.assumed:
        parts.append(sentences(survey.assumed))
    return "\n\n".join(parts)


def _worst(tightest: Pull, slackest: Pull, softest: Give) -> str:
    rows = [
        ["tightest chain", f"{tightest.value:.1f} N", f"{REACH_LIMITS['most_tension']:g} N"],
        ["slackest chain", f"{slackest.value:.1f} N", f"{REACH_LIMITS['least_tension']:g} N"],
        ["softest place", f"{worded(softest.value)}/N", f"{worded(REACH_LIMITS['most_give'])}/N"],
    ]
    extremes: list[Pull | Give] = [tightest, slackest, softest]
    for row, extreme in zip(rows, extremes, strict=True):
        row += [f"{bare(extreme.place[0], 0)}, {bare(extreme.place[1], 0)}", extreme.side]
    rows[2][-1] = f"{CUT:g} N move it {worded(CUT * softest.value, 1)}"
    return table(["", "", "limit", f"at x, y [{unit()}]", ""], rows, words=[-1])


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
