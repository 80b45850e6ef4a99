"""`plumb forward`: places for chain lengths, by our model."""

from __future__ import annotations

import argparse

from plumb.cli.places_text import answered, answers_table, count_sentence
from plumb.cli.text import print_json
from plumb.fit.read_inputs import settings_in
from plumb.model.predict import FOUND, places
from plumb.text.points import read_pairs
from plumb.text.shown import unit


def run(arguments: argparse.Namespace) -> int:
    """Print places; 1 if some lengths lead nowhere."""
    settings = settings_in(arguments.settings).as_plumb_model()
    chains = read_pairs(arguments.lengths, names=("left", "right"))
    sled, outcome = places(settings, chains)
    answers, words = answered(sled, outcome)
    if arguments.json:
        print_json({"places": answers, "found": words})
    else:
        said = count_sentence(words, "pair")
        print(f"{said} Places from the middle of the sheet, y up; {unit()}.\n")
        print(answers_table(("left", "right"), chains, ("x", "y"), answers, words))
    return int(bool((outcome != FOUND).any()))
