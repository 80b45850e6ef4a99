"""What `plumb practice` says: the score of a game, and the rates of many."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

from plumb.cli.screen import headline, sentences, table
from plumb.text.shown import bare, unit, worded
from plumb.vm.game import Played
from plumb.vm.page import ratio_words
from plumb.vm.practice import Practice, Score
from plumb.vm.rates import Row, row_of, rows_of

HEADER = (
    "hidden",
    "games",
    "solved",
    "false",
    "marks",
    "minutes",
    "before",
    "after",
    "best",
    "ratio",
)


def left_sentence(game: Practice) -> str:
    """What is left of the budget."""
    return f"Left: {game.left.marks} marks and {game.left.minutes:.0f} minutes."


def score_text(score: Score) -> str:
    """The end of a game for people."""
    sled = score.sled
    rows = [
        ["as the settings were", bare(sled.before)],
        ["the frame fitted", bare(sled.frame)],
        ["yours", bare(sled.after)],
        ["with the truth known", bare(sled.known)],
    ]
    said = [score.sentence]
    said.append(
        f"You spent {score.spent.marks} marks and {score.spent.minutes:.0f} minutes"
        + (f", {score.hints} hints among them." if score.hints else ".")
    )
    said.append(f"The second sheet, as the tape reads it: {worded(score.cut)} RMS of shape.")
    return "\n\n".join(
        [
            headline(f"Hidden was {score.hidden}."),
            sentences(said, mark=""),
            table([f"error all over the sheet, {unit()} RMS", "left"], rows),
        ]
    )


def score_json(score: Score) -> dict[str, Any]:
    """The end of a game by the names of the interface."""
    return {
        "hidden": score.hidden,
        "named": score.named,
        "false": score.false,
        "missed": score.missed,
        "left_mm": {**asdict(score.sled), "second_sheet": score.cut},
        "spent": asdict(score.spent),
        "hints": score.hints,
    }


def as_text(games: Sequence[Played]) -> str:
    """The rates of many games for people."""
    rows = [*rows_of(games), *([row_of("all", games)] if len(games) > 1 else [])]
    note = (
        "Solved: just what is hidden was added, or reported as not in the library; interval of "
        "95 %. False: claims of what is not there, in all games. Before, after, best: error of the "
        f"sled all over the sheet without noise, {unit()} RMS; best is a fit of the same marks by "
        "somebody who knows what is hidden. Ratio: after to best."
    )
    return f"{table(HEADER, [cells(row) for row in rows], gap=1)}\n\n{sentences([note], mark='')}"


def cells(row: Row) -> list[str]:
    """A row of the table."""
    share, low, high = row.solved
    return [
        row.name,
        str(row.games),
        f"{100 * share:.0f} % ({100 * low:.0f}-{100 * high:.0f})",
        str(row.false),
        f"{row.marks:.0f}",
        f"{row.minutes:.0f}",
        bare(row.before),
        bare(row.after),
        bare(row.known),
        ratio_words(row.sled_ratio),
    ]


def as_json(games: Sequence[Played], *, interrupted: bool) -> dict[str, Any]:
    """The rates and the games by the names of the interface."""
    return {
        "interrupted": interrupted,
        "rows": [asdict(row) for row in rows_of(games)],
        "games": [asdict(game) for game in games],
    }
