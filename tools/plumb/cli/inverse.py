"""`plumb inverse`: chain lengths for places, by the controller's formula or by our model."""

import argparse
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated

import numpy as np

from plumb.cli.arguments import add_shared, place, unit_of
from plumb.cli.screen import print_json, table
from plumb.fit.inputs import settings_in
from plumb.model.predict import (
    FOUND,
    FOUND_WORDS,
    OUT_OF_REACH,
    Array,
    Codes,
    chain_lengths,
    clamped,
    lengths,
)
from plumb.settings import MachineSettings
from plumb.text.answers import among, key
from plumb.text.errors import InputError
from plumb.text.values import MM, Unit

Pair = tuple[float, float] | None  # None where there is no answer
Outcome = Annotated[str, among(FOUND_WORDS)]


@dataclass(frozen=True)
class ChainLengths:
    """Chain paid out for each place [mm], left and right."""

    controller: str
    lengths: tuple[Pair, ...]
    outcomes: Annotated[tuple[Outcome, ...], key("found")]
    moved_to_edge: tuple[bool, ...]


def run(arguments: argparse.Namespace) -> int:
    """Print chain lengths; 1 if some place is out of reach."""
    settings = settings_in(arguments.settings)
    points = np.array(arguments.places)
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
        print_json(ChainLengths(whose, answers, words, tuple(moved.tolist())))
    else:
        said = count_sentence(words, "place")
        unit = unit_of(arguments)
        print(f"{said} Chain paid out from 12 o'clock, formula of {whose}; {unit.name}.\n")
        if moved.any():
            print(f"{moved.sum()} off the sheet: the {whose} controller moves them to its edge.\n")
        print(answers_table(("x", "y"), points, ("left", "right"), answers, words, unit))
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


# The arguments of `plumb inverse`.

EXAMPLES = (
    "plumb inverse machine.toml 0,0 600,-300",
    "plumb inverse groundcontrol.ini 0,0 --controller plumb",
)
EXIT = "Exit: 0 done; 1 some place is out of reach; 2 an input cannot be used."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `plumb inverse`."""
    add_shared(parser, "settings")
    parser.add_argument(
        "places",
        metavar="X,Y",
        type=place,
        nargs="+",
        help="a place, mm from the middle of the sheet, y up",
    )
    parser.add_argument("--float32", action="store_true", help="compute as the board does")
    add_shared(parser, "--controller", "--units", "--json")


# What `plumb inverse` and `plumb forward` say to people: counts and tables of places.


def answered(answers: Array, outcome: Codes) -> tuple[tuple[Pair, ...], tuple[str, ...]]:
    """Return the answers (n, 2), None for those that may not be used, and the word of each
    outcome.
    """
    pairs = tuple(
        (float(answer[0]), float(answer[1])) if code == FOUND else None
        for answer, code in zip(answers, outcome, strict=True)
    )
    return pairs, tuple(FOUND_WORDS[code] for code in outcome)


def count_sentence(words: Sequence[str], noun: str) -> str:
    """Return how many of them have an answer."""
    good = words.count("yes")
    if good == len(words):
        return f"All {good} {noun}s found." if good > 1 else f"The {noun} was found."
    return f"{good} of {len(words)} {noun}s found."


def answers_table(
    given_names: tuple[str, str],
    given: np.ndarray,
    names: tuple[str, str],
    answers: Sequence[Pair],
    words: Sequence[str],
    unit: Unit,
) -> str:
    """Return what was given, with its answer, or the word for why there is none."""
    rows = []
    for pair, answer, word in zip(given, answers, words, strict=True):
        numbers: list[float | None] = [*answer] if answer else [None, None]
        rows.append(
            [
                *(f"{number:g}" if unit == MM else unit.bare(number, 3) for number in pair),
                *(unit.bare(number, 4) for number in numbers),
                "" if word == "yes" else word,
            ]
        )
    return table([*given_names, *names, ""], rows, left=0)
