"""What `plumb practice` says: what is left of a budget, and the score of a game."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from plumb.cli.screen import headline, sentences, table
from plumb.text.values import bare, unit, worded
from plumb.vm.practice import Practice, Score


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
