"""What `plumb inverse` and `plumb forward` say to people: counts and tables of places."""

from __future__ import annotations

import numpy as np

from plumb.cli.screen import table
from plumb.model.predict import FOUND, FOUND_WORDS, Array, Codes
from plumb.text.shown import bare, unit

Row = list[float] | None  # two numbers, or None where there is no answer


def answered(answers: Array, outcome: Codes) -> tuple[list[Row], list[str]]:
    """The answers (n, 2), None for those that may not be used, and the word of each outcome."""
    rows: list[Row] = [
        [float(number) for number in answer] if code == FOUND else None
        for answer, code in zip(answers, outcome, strict=True)
    ]
    return rows, [FOUND_WORDS[code] for code in outcome]


def count_sentence(words: list[str], noun: str) -> str:
    """How many of them have an answer."""
    good = words.count("yes")
    if good == len(words):
        return f"All {good} {noun}s found." if good > 1 else f"The {noun} was found."
    return f"{good} of {len(words)} {noun}s found."


def answers_table(
    given_names: tuple[str, str],
    given: np.ndarray,
    names: tuple[str, str],
    answers: list[Row],
    words: list[str],
) -> str:
    """What was given, with its answer, or the word for why there is none."""
    rows = []
    for pair, answer, word in zip(given, answers, words, strict=True):
        numbers: list[float | None] = [*answer] if answer else [None, None]
        rows.append(
            [
                *(f"{number:g}" if unit() == "mm" else bare(number, 3) for number in pair),
                *(bare(number, 4) for number in numbers),
                "" if word == "yes" else word,
            ]
        )
    return table([*given_names, *names, ""], rows, left=0)
