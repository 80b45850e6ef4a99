"""`plumb forward`: places for chain lengths, by our model."""

import argparse
from dataclasses import dataclass
from typing import Annotated

import numpy as np

from plumb.cli.arguments import add_shared, place, unit_of
from plumb.cli.inverse import Outcome, Pair, answered, answers_table, count_sentence
from plumb.cli.screen import print_json
from plumb.fit.inputs import settings_in
from plumb.model.predict import FOUND, places
from plumb.text.answers import key


@dataclass(frozen=True)
class PlacesAnswer:
    """Where the sled hangs on each pair of lengths [mm]."""

    places: tuple[Pair, ...]
    outcomes: Annotated[tuple[Outcome, ...], key("found")]


def run(arguments: argparse.Namespace) -> int:
    """Print places; 1 if some lengths lead nowhere."""
    settings = settings_in(arguments.settings).as_plumb_model()
    chains = np.array(arguments.lengths)
    sled, outcome = places(settings, chains)
    answers, words = answered(sled, outcome)
    if arguments.json:
        print_json(PlacesAnswer(answers, words))
    else:
        said = count_sentence(words, "pair")
        unit = unit_of(arguments)
        print(f"{said} Places from the middle of the sheet, y up; {unit.name}.\n")
        print(answers_table(("left", "right"), chains, ("x", "y"), answers, words, unit))
    return int(bool((outcome != FOUND).any()))


# The arguments of `plumb forward`.

EXAMPLES = (
    "plumb forward machine.toml 1695.8,1699 2889.51,1488.87",
    "plumb forward machine.toml 1695.8,1699 --json",
)
EXIT = "Exit: 0 done; 1 some lengths fit no place; 2 an input cannot be used."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `plumb forward`."""
    add_shared(parser, "settings")
    parser.add_argument(
        "lengths",
        metavar="LEFT,RIGHT",
        type=place,
        nargs="+",
        help="both chains, mm paid out from 12 o'clock",
    )
    add_shared(parser, "--units", "--json")
