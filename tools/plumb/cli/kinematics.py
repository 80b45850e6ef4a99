"""`plumb inverse` and `plumb forward`: places to chain lengths, and back."""

from __future__ import annotations

import argparse

import numpy as np

from plumb.cli.files import add_controller, add_json, add_settings, settings_in
from plumb.cli.text import millimetres, print_json, table
from plumb.model.controllers import chain_lengths, clamped
from plumb.model.predict import FOUND, FOUND_WORDS, OUT_OF_REACH, lengths, places
from plumb.settings.machine import MachineSettings
from plumb.text.errors import InputError
from plumb.text.points import read_pairs

INVERSE_HELP = "chain lengths for places, by the controller's formula or by our model"
INVERSE_EXIT = "Exit: 0 done; 1 some place is out of reach; 2 an input cannot be used."
FORWARD_HELP = "places for chain lengths, by our model"
FORWARD_EXIT = "Exit: 0 done; 1 some lengths lead nowhere; 2 an input cannot be used."


def add_inverse_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb inverse`."""
    add_settings(parser)
    parser.add_argument(
        "--points",
        metavar="FILE",
        required=True,
        help="CSV: x,y per line, mm from the middle of the sheet, y up; a header may stand",
    )
    parser.add_argument("--float32", action="store_true", help="compute as the board does")
    add_controller(parser)
    add_json(parser)


def add_forward_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb forward`."""
    add_settings(parser)
    parser.add_argument(
        "--lengths",
        metavar="FILE",
        required=True,
        help="CSV: left,right per line, mm paid out from 12 o'clock; a header may stand",
    )
    add_json(parser)


def run_inverse(arguments: argparse.Namespace) -> int:
    """Print chain lengths; 1 if some place is out of reach."""
    settings = settings_in(arguments.settings)
    points = read_pairs(arguments.points, names=("x", "y"))
    whose = arguments.controller or settings.controller
    moved = np.zeros(len(points), dtype=bool)
    if whose == "plumb":
        model = settings.as_plumb_model()
        chains, found = lengths(model, points, float32=arguments.float32)
    elif arguments.float32:
        raise InputError("--float32 is how our board computes; it needs --controller plumb")
    else:
        chains, found = published_lengths(settings, points, controller=whose)
        moved = (clamped(settings, points) != points).any(axis=1)
    chains = [list(own) if ok == FOUND else None for own, ok in zip(chains, found, strict=True)]
    words = [FOUND_WORDS[own] for own in found]
    if arguments.json:
        print_json(
            {
                "controller": whose,
                "lengths": chains,
                "found": words,
                "moved_to_edge": [bool(own) for own in moved],
            }
        )
    else:
        print(f"{_count(words, 'place')} Chain paid out from 12 o'clock, formula of {whose}; mm.\n")
        if moved.any():
            print(f"{moved.sum()} off the sheet: the {whose} controller moves them to its edge.\n")
        print(_table(("x", "y"), points, ("left", "right"), chains, words, digits=4))
    return int(any(word != "yes" for word in words))


def run_forward(arguments: argparse.Namespace) -> int:
    """Print places; 1 if some lengths lead nowhere."""
    settings = settings_in(arguments.settings).as_plumb_model()
    chains = read_pairs(arguments.lengths, names=("left", "right"))
    where, found = places(settings, chains)
    reached = [list(own) if ok == FOUND else None for own, ok in zip(where, found, strict=True)]
    words = [FOUND_WORDS[own] for own in found]
    if arguments.json:
        print_json({"places": reached, "found": words})
    else:
        print(f"{_count(words, 'pair')} Places from the middle of the sheet, y up; mm.\n")
        print(_table(("left", "right"), chains, ("x", "y"), reached, words, digits=4))
    return int(any(word != "yes" for word in words))


def published_lengths(
    settings: MachineSettings, points: np.ndarray, *, controller: str
) -> tuple[np.ndarray, np.ndarray]:
    """Chain paid out (n, 2) [mm] by a published formula, and FOUND (n,)."""
    chains, found = np.zeros_like(points), np.zeros(len(points), dtype=int)
    for i, point in enumerate(points):
        try:
            chains[i] = chain_lengths(settings, point[np.newaxis], controller=controller)[0]
        except ValueError:
            found[i] = OUT_OF_REACH
    return chains, found


def _count(words: list[str], noun: str) -> str:
    good = words.count("yes")
    if good == len(words):
        return f"All {good} {noun}s found." if good > 1 else f"The {noun} was found."
    return f"{good} of {len(words)} {noun}s found."


def _table(
    given_names: tuple[str, str],
    given: np.ndarray,
    names: tuple[str, str],
    results: list[list[float] | None],
    words: list[str],
    *,
    digits: int,
) -> str:
    rows = []
    for pair, result, word in zip(given, results, words, strict=True):
        values = result or [None, None]
        told = "" if word == "yes" else word
        rows.append(
            [*(f"{own:g}" for own in pair), *(millimetres(own, digits) for own in values), told]
        )
    return table([*given_names, *names, ""], rows, left=0)
