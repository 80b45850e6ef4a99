"""`plumb forward`: places for chain lengths, by our model."""

from __future__ import annotations

import argparse

from plumb.cli.files import add_json, add_settings, settings_in
from plumb.cli.places_text import answered, answers_table, count_sentence
from plumb.cli.text import print_json
from plumb.model.predict import FOUND, places
from plumb.text.points import read_pairs

HELP = "places for chain lengths, by our model"
EXIT = "Exit: 0 done; 1 some lengths lead nowhere; 2 an input cannot be used."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb forward`."""
    add_settings(parser)
    parser.add_argument(
        "--lengths",
        metavar="FILE",
        required=True,
        help="CSV: left,right per line, mm paid out from 12 o'clock; a header is allowed",
    )
    add_json(parser)


def run(arguments: argparse.Namespace) -> int:
    """Print places; 1 if some lengths lead nowhere."""
    settings = settings_in(arguments.settings).as_plumb_model()
    chains = read_pairs(arguments.lengths, names=("left", "right"))
    sled, outcome = places(settings, chains)
    answers, words = answered(sled, outcome)
    if arguments.json:
        print_json({"places": answers, "found": words})
    else:
        print(f"{count_sentence(words, 'pair')} Places from the middle of the sheet, y up; mm.\n")
        print(answers_table(("left", "right"), chains, ("x", "y"), answers, words))
    return int(bool((outcome != FOUND).any()))
