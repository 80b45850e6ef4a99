"""The file that keeps a game between commands."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path

from plumb.text.errors import refusal, to_do
from plumb.text.files import read_text
from plumb.vm.budget import Spent
from plumb.vm.floor import SledError
from plumb.vm.practice import Practice, Score
from plumb.vm.secret import LEVELS

NAME = "game.json"


def game_text(game: Practice) -> str:
    """The text of the file."""
    return json.dumps({"plumb_practice": 1, **asdict(game)}, indent=1) + "\n"


def score_text(game: Practice, score: Score) -> str:
    """The text of the file of a game that is over."""
    return (
        json.dumps({"plumb_practice": 1, **asdict(game), "score": asdict(score)}, indent=1) + "\n"
    )


def score_in(folder: str) -> Score | None:
    """The score of a folder's game; None while it goes on, or if it cannot be read."""
    try:
        said = json.loads(read_text(Path(folder, NAME)))["score"]
        parts = {
            **said,
            "sled": SledError(**said["sled"]),
            "spent": Spent(**said["spent"]),
            **{name: tuple(said[name]) for name in ("named", "false", "missed")},
        }
        return Score(**parts)
    except (ValueError, TypeError, KeyError):
        return None


def game_in(folder: str) -> Practice:
    """The game of a folder; InputError if there is none."""
    path = Path(folder, NAME)
    if not path.exists():
        begin = to_do(f"begin: plumb practice start {folder}", page="begin a game")
        raise refusal(folder, "holds no game", remedy=begin)
    try:
        said = json.loads(read_text(path))
        sheet = {
            str(name): [(float(x), float(y)) for x, y in places]
            for name, places in said["sheet"].items()
        }
        spent = Spent(int(said["spent"]["marks"]), float(said["spent"]["minutes"]))
        numbers = {name: int(said[name]) for name in ("level", "seed", "visits", "hints")}
    except (ValueError, TypeError, KeyError, AttributeError):
        raise refusal(path, "is no game", remedy="begin another in a new folder") from None
    if numbers["level"] not in LEVELS:
        raise refusal(path, f"has no level {numbers['level']}", remedy="begin another game")
    return Practice(**numbers, spent=spent, sheet=sheet)
