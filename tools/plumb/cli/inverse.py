"""`plumb inverse`: chain lengths for places, by the controller's formula or by our model."""

from __future__ import annotations

import argparse

import numpy as np

from plumb.cli.places_text import answered, answers_table, count_sentence
from plumb.cli.text import print_json
from plumb.fit.read_inputs import settings_in
from plumb.model.controllers import chain_lengths, clamped
from plumb.model.predict import FOUND, OUT_OF_REACH, Array, Codes, lengths
from plumb.settings.machine import MachineSettings
from plumb.text.errors import InputError
from plumb.text.points import read_pairs
from plumb.text.shown import unit


def run(arguments: argparse.Namespace) -> int:
    """Print chain lengths; 1 if some place is out of reach."""
    settings = settings_in(arguments.settings)
    points = read_pairs(arguments.points, names=("x", "y"))
    whose = arguments.controller or settings.controller
    moved = np.zeros(len(points), dtype=bool)
    if whose == "plumb":
        model = settings.as_plumb_model()
        chains, outcome = lengths(model, points, float32=arguments.float32)
    elif arguments.float32:
        raise InputError("--float32 is how our board computes; it needs --controller plumb")
    else:
        chains, outcome = published_lengths(settings, points, controller=whose)
        moved = (clamped(settings, points) != points).any(axis=1)
    answers, words = answered(chains, outcome)
    if arguments.json:
        print_json(
            {"controller": whose, "lengths": answers, "found": words, "moved_to_edge": moved}
        )
    else:
        said = count_sentence(words, "place")
        print(f"{said} Chain paid out from 12 o'clock, formula of {whose}; {unit()}.\n")
        if moved.any():
            print(f"{moved.sum()} off the sheet: the {whose} controller moves them to its edge.\n")
        print(answers_table(("x", "y"), points, ("left", "right"), answers, words))
    return int(bool((outcome != FOUND).any()))


def published_lengths(
    settings: MachineSettings, points: Array, *, controller: str
) -> tuple[Array, Codes]:
    """Chain paid out (n, 2) [mm] by a published formula, and FOUND (n,)."""
    chains, outcome = np.zeros_like(points), np.full(len(points), FOUND, dtype=np.uint8)
    for i, point in enumerate(points):
        try:
            chains[i] = chain_lengths(settings, point[np.newaxis], controller=controller)[0]
        except ValueError:
            outcome[i] = OUT_OF_REACH
    return chains, outcome
