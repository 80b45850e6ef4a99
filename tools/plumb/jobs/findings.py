"""What the machine said to a program's lines, and moves that spoil a part, line by line."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from plumb.jobs.dry_run import Done
from plumb.jobs.moves import IN_WOOD, Moves

HALTS, LEAVES, GOUGES, WAITS, IGNORED = "halts", "leaves the sheet", "gouges", "waits", "ignored"
SINKS = "may sink"
WRONG = (HALTS, LEAVES, GOUGES)
ACROSS = 0.05  # [mm] over the sheet: more than z alone moves
SAME_HOLE = 0.1  # [mm] over the sheet between a plunge and a cut that made room for it


@dataclass(frozen=True)
class Finding:
    """Something about a line."""

    line: int
    kind: str
    says: str  # in the machine's words, or ours

    @property
    def is_wrong(self) -> bool:
        """Whether the part is spoiled, or the machine stops."""
        return self.kind in WRONG


def findings_of(done: Done) -> tuple[Finding, ...]:
    """Everything to say about lines, in their order."""
    refused = "plumb send refuses it: it"
    findings = [Finding(each.line, HALTS, f"{refused} {each.why}") for each in done.refused]
    findings += [finding for line, text in done.said for finding in _said(line, text)]
    findings += _gouges(done.moves)
    findings += _plunges(done.moves)
    return tuple(sorted(findings, key=lambda finding: finding.line))


def _said(line: int, text: str) -> Iterator[Finding]:
    if text.startswith("error: "):
        yield Finding(line, HALTS, text.removeprefix("error: "))
    elif text.startswith("ALARM: "):
        yield Finding(line, HALTS, text.removeprefix("ALARM: "))
    elif text.startswith("This line leads beyond the sheet"):
        yield Finding(line, LEAVES, text.partition(": ")[2])
    elif text.endswith(" unsupported and ignored."):
        yield Finding(line, IGNORED, text.split()[1])
    elif text == "Maslow Paused":
        yield Finding(line, WAITS, "the machine waits until the operator goes on")


def _gouges(moves: Moves) -> Iterator[Finding]:
    """G0 across the sheet with the bit in the wood."""
    low = np.minimum(moves["z_from"], moves["z_to"])
    fast = moves.rapid & moves.over_sheet & (moves["length"] > ACROSS)
    for row in np.flatnonzero(fast & (low < IN_WOOD)):
        deep = -float(low[row])
        yield Finding(
            int(moves["line"][row]), GOUGES, f"G0 crosses the sheet with the bit {deep:.2f} mm deep"
        )


def _plunges(moves: Moves) -> Iterator[Finding]:
    """G0 down into wood that nothing has cut; down a hole that is there, as pecks go, is none."""
    straight = moves.rapid & moves.over_sheet & (moves["length"] <= ACROSS)
    low = moves["z_to"]
    for row in np.flatnonzero(straight & (low < moves["z_from"]) & (low < IN_WOOD)):
        into = float(_depth_of_hole(moves, int(row)) - low[row])
        if into > -IN_WOOD:
            yield Finding(
                int(moves["line"][row]),
                GOUGES,
                f"G0 drives the bit {into:.2f} mm down into wood that nothing has cut",
            )


def _depth_of_hole(moves: Moves, row: int) -> float:
    """The z [mm] down to which earlier cuts have freed the place of a move; 0: nothing did."""
    x, y = moves["to_x"][row], moves["to_y"][row]
    middle = np.stack([moves["from_x"] + moves["to_x"], moves["from_y"] + moves["to_y"]]) / 2
    # No place of a move is farther from its middle than the way along it.
    near = np.hypot(*(middle - [[x], [y]])) <= moves["length"] + SAME_HOLE
    earlier = moves.cut & ~moves.rapid & (np.arange(len(moves)) < row)
    samples = moves.only(earlier & near).sampled(SAME_HOLE / 2)
    here = np.hypot(*(samples.places - (x, y)).T) <= SAME_HOLE
    return float(samples.z[here].min(initial=0.0))
