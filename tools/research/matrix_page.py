"""The page tools/research/matrix.md: what the closed loop finds, and what is left of the error."""

from __future__ import annotations

import math
from collections.abc import Sequence

from game import Played
from game_rates import Row, row_of, rows_of
from kinds import CURABLE, FIRMWARE, KINDS
from tables import markdown_table

MARKS = ("25", "9")  # of the first sheet
SECOND_LINE = 1.3  # times what the truth allows: the most that a second sheet should be off
HEADER = (
    *("hidden", "marks", "games", "solved", "false claims", "marks cut", "minutes"),
    *("before", "after", "best", "after / best", "second sheet"),
)
INTRODUCTION = """# How often the closed loop finds what is hidden

Written by `tools/research/games.py --keep games.jsonl --write tools/research/matrix.md`. Run it to
see the same with other machines (`--seed`); a run that is stopped goes on where it was.

Each game hides something in [a virtual machine](../../docs/commands/vm.md): firmware, motors,
exact mechanics. Friction of 3 N, play in the gears, a frame and a sheet that are off by a few
millimetres are on all of them, and a tape reads to 0.4 mm. The lab's advice plays: cut a grid,
diagnose, follow the best proposal of `plumb next` at most twice while a question is open, add
what is most likely, send it, cut the grid again on a new sheet.

- *Hidden*: an effect by 3 mm RMS at the marks, but by four times its usual size at most; *two* of
  3 mm each; *unknown*: 3 mm of a bump, a cubic field or a tipping sled, in turns.
- *Solved*: just what is hidden was added, or what is unknown was called so. 95 % interval. A tilt
  of the motors and chains zeroed wrongly *are* the frame: marks cannot show them, so the lab is
  right to add nothing, and the error falls with the frame.
- *False claims*: effects added without a rival that are not there, in all games of a row.
- *Before, after, best* [mm]: RMS error of the sled all over the sheet, the sheet laid at its best,
  without noise; *best* is a fit of the same marks by somebody who knows what is hidden. *After /
  best* is the ratio of the means, with its standard deviation.
- *Second sheet*: the same ratio for the second sheet as a tape reads it. Where the lab adds just
  what is hidden, both fits are the same, and so are both sheets: the ratios are 1.
"""


def page(games: Sequence[Played]) -> str:
    """Return the whole page."""
    rows = [_cells(row) for row in rows_of(_sorted(games))]
    summary = [
        _cells(row_of(f"{name} {marks}", chosen))
        for marks in MARKS
        for name, kinds in (("one that shows", _CURABLE), ("all", tuple(KINDS)))
        if (chosen := _of(games, kinds, marks))
    ]
    return "\n".join([INTRODUCTION, markdown_table(HEADER, [*rows, *summary]), "", _second(games)])


_CURABLE = tuple(name for name in FIRMWARE if any(cause.effect == name for cause in CURABLE))


def _of(games: Sequence[Played], kinds: Sequence[str], marks: str) -> list[Played]:
    """Return the games of some kinds with this many marks on the first sheet."""
    rows = {f"{kind} {marks}" for kind in kinds}
    return [game for game in games if game.row in rows]


def _sorted(games: Sequence[Played]) -> list[Played]:
    order = [f"{kind} {marks}" for marks in MARKS for kind in KINDS]
    return sorted((game for game in games if game.row in order), key=lambda g: order.index(g.row))


def _cells(row: Row) -> list[str]:
    share, low, high = row.solved
    name, _, marks = row.name.rpartition(" ")
    return [
        name,
        marks,
        str(row.games),
        f"{100 * share:.0f} % ({100 * low:.0f} to {100 * high:.0f})",
        str(row.false),
        f"{row.marks:.0f}",
        f"{row.minutes:.0f}",
        *(f"{error:.2f}" for error in (row.before, row.after, row.known)),
        ratio_words(row.sled_ratio),
        ratio_words(row.cut_ratio),
    ]


def ratio_words(ratio: tuple[float, float]) -> str:
    """Return a ratio with its standard deviation, if there are games enough to tell."""
    value, error = ratio
    return f"{value:.2f}" + (f" +- {error:.2f}" if math.isfinite(error) else "")


def _second(games: Sequence[Played]) -> str:
    """Return the line for the second sheet, and whether it is reached."""
    chosen = _of(games, _CURABLE, "25")
    if not chosen:
        return ""
    value, error = row_of("", chosen).cut_ratio
    within = sum(game.cut_after <= SECOND_LINE * game.cut_known for game in chosen)
    judged = "reached" if value <= SECOND_LINE else "missed"
    return (
        f"The second sheet of a machine with an effect that shows, 25 marks, {len(chosen)} games:\n"
        f"{ratio_words((value, error))} times what the truth and the tape's noise allow; line <= "
        f"{SECOND_LINE}, {judged}.\n{within} of {len(chosen)} sheets are within it.\n"
    )
