"""Five boards in words: what is hidden, what the tests of before said, and what is said today."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from textwrap import fill

from gate_boards import board_of
from gate_kinds import KINDS
from plumb.bench.boards import cut, plan
from plumb.bench.causes import MAKER, Hidden, causes_of
from plumb.diagnosis import Inputs, diagnose

SEED = 27001  # of the gates, as docs/diagnosis.md shows them
COLUMNS = 118  # of a line of a page


@dataclass(frozen=True)
class BoardInWords:
    """A board, and what was said of it."""

    title: str
    hidden: str  # for people
    inputs: Callable[[], Inputs]
    # Printed by `plumb diagnose` before all accounts were weighed in one posterior; that engine is
    # no longer in the tree, so its sentences are kept here.
    before: str

    @property
    def now(self) -> str:
        """What the lab says today."""
        return diagnose(self.inputs()).sentence


def _of_gates(kind: str, index: int) -> Callable[[], Inputs]:
    def inputs() -> Inputs:
        hidden = board_of(KINDS[kind], index, seed=SEED)
        return Inputs(hidden.kind.settings, hidden.board.measurements)

    return inputs


def _quiet_repeats() -> Inputs:
    """Return 35 marks, three of them read three times, whose repeats agree better by chance than
    readings do.
    """
    hidden = Hidden(((causes_of("sled_swing")[0], 3.0),))
    board = cut(hidden, plan(7, 5, repeats=True), seed=185, noise=0.3, tape_sigma=0.3)
    return Inputs(MAKER, board.measurements)


BOARDS = (
    BoardInWords(
        title="One effect, on a chain that stretches as all do",
        hidden="motor arms that bend; the chain stretches as usual, which the settings leave out, "
        "and 25 marks do not show it.",
        inputs=_of_gates("stock/one-25", 0),
        before="Something is missing: the fitted frame leaves 1.30 mm RMS. Most likely: motor arms "
        "that bend (frame_flex) and chain stretch (chain_stretch) (odds 1 to 1); next, motor arms "
        "that bend (frame_flex) (1 to 7).",
    ),
    BoardInWords(
        title="A rival of a size that no machine has",
        hidden="chain sag, 3.4 times the usual, and nine marks. A leaning frame draws the same "
        "arrows if it leans by 53 degrees.",
        inputs=_of_gates("known/one-9", 3),
        before="Something is missing (the fitted frame leaves 2.56 mm RMS), but the marks cannot "
        "tell which: chain sag (chain_sag); or a leaning frame (frame_lean).",
    ),
    BoardInWords(
        title="Repeats that agree by luck",
        hidden="a bit off the ring's centre; 35 marks with a noise of 0.3 mm as stated, and "
        "six repeats that happen to scatter by 0.16 mm.",
        inputs=_quiet_repeats,
        before="No effect of the library explains these marks, alone or up to three together: the "
        "fitted frame leaves 1.44 mm RMS, more than noise.",
    ),
    BoardInWords(
        title="A smooth error that no effect draws",
        hidden="a bump of 2 mm, of which the library knows nothing; 25 marks.",
        inputs=_of_gates("known/field-25", 0),
        before="No effect is proved: the fitted frame leaves 1.24 mm RMS. 3 effects at once could "
        "be it, but here 3 effects explain 28 % of all smooth errors. More marks tell.",
    ),
    BoardInWords(
        title="A reading that is off",
        hidden="nothing but a mark read 5 mm off, at -550/-500; 25 marks.",
        inputs=_of_gates("known/slips-0-25", 6),
        before="Nothing is provable: the fitted frame leaves 0.94 mm RMS, and noise alone could "
        "look like that.",
    ),
)


def boards_section() -> str:
    """Return each board in words."""
    return "\n\n".join(
        "\n".join(
            [
                lines_of(f"**{number}. {board.title}.** Hidden: {board.hidden}"),
                "",
                lines_of(f'- before: "{board.before}"', inset="  "),
                lines_of(f'- now: "{board.now}"', inset="  "),
            ]
        )
        for number, board in enumerate(BOARDS, 1)
    )


def lines_of(text: str, inset: str = "") -> str:
    """Return a paragraph of a page in lines."""
    return fill(text, COLUMNS, subsequent_indent=inset, break_on_hyphens=False)
