"""What the machine said to a program's lines, and moves that spoil a part, line by line."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Annotated

import numpy as np
from pydantic import computed_field

from plumb.job.dry_run import IN_WOOD, Done, Flags, Moves, Samples
from plumb.model.plain import greatest, least
from plumb.model.predict import CANNOT_HANG, REACH_WORDS, USABLE, Array, Codes, reach
from plumb.model.reach import with_soft_chains
from plumb.settings.machine import MachineSettings
from plumb.text.answers import Internal, key

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

    @computed_field(alias="wrong")
    @property
    def is_wrong(self) -> bool:
        """Whether the part is spoiled, or the machine stops."""
        return self.kind in WRONG


def findings_of(done: Done) -> tuple[Finding, ...]:
    """Return everything to say about lines, in their order."""
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
    """Return the z [mm] down to which earlier cuts have freed the place of a move; 0:
    nothing did.
    """
    x, y = moves["to_x"][row], moves["to_y"][row]
    middle = np.stack([moves["from_x"] + moves["to_x"], moves["from_y"] + moves["to_y"]]) / 2
    # No place of a move is farther from its middle than the way along it.
    near = np.hypot(*(middle - [[x], [y]])) <= moves["length"] + SAME_HOLE
    earlier = moves.cut & ~moves.rapid & (np.arange(len(moves)) < row)
    samples = moves.only(earlier & near).sampled(SAME_HOLE / 2)
    here = np.hypot(*(samples.places - (x, y)).T) <= SAME_HOLE
    return float(samples.z[here].min(initial=0.0))


# Whether a job ends so high on the sheet that the sled may sink without its motors.

# Motors that rest are switched off, and the friction of their gears holds the chains: 1.5 Nm at a
# sprocket of 10.1 mm, or 148 N. It is known to 30 %, so some gears hold no more than this.
WEAK_GEARS = 104.0  # [N]


def ends_too_high(settings: MachineSettings, done: Done) -> tuple[Finding, ...]:
    """Return the end of a program, if a chain pulls there more than weak gears hold.

    In a pause and in a dwell the motors keep their power.
    """
    moves = done.moves.only(done.moves.over_sheet)
    if not len(moves):
        return ()
    x, y = float(moves["to_x"][-1]), float(moves["to_y"][-1])
    there = reach(with_soft_chains(settings.as_plumb_model())[0], np.array([[x, y]]))
    pull = float(there.tension.max())
    if there.verdict[0] == CANNOT_HANG or pull <= WEAK_GEARS:
        return ()
    says = (
        f"the program ends at X{x:.2f} Y{y:.2f}, where the sled may sink when its motors let go: "
        f"a chain pulls with {pull:.0f} N, and some gears hold no more than {WEAK_GEARS:.0f} N"
    )
    return (Finding(int(moves["line"][-1]), SINKS, says),)


# Where the sled goes slower than the program asks, and how long the job takes.

LESS = 0.995  # of a feed: below it a limit acts
GREATEST, Z = "the greatest feed ($15)", "the speed of z ($18)"
ARC, CHAINS = "the arc", "the chains"


@dataclass(frozen=True)
class Slower:
    """Moves that a limit slows."""

    because: str
    moves: int
    line: int  # of the slowest
    asked: Annotated[float, key("asked_mm_min")]  # there
    feed: Annotated[float, key("feed_mm_min")]  # there


@dataclass(frozen=True)
class Times:
    """How long a job takes [s]; the pauses of the operator do not count."""

    whole: float
    cutting: float
    rapid: float
    asked: float  # the cutting at the feeds of the program


def slower_moves(moves: Moves) -> tuple[Slower, ...]:
    """Limits that act on cutting moves, those that act most often first."""
    asked, feed, top = moves["asked"], moves["feed"], moves["top"]
    works = ~moves.rapid & moves.over_sheet
    slowed = works & (top < LESS * asked)
    causes = np.full(len(moves), GREATEST, dtype=object)
    by_path = top < LESS * feed
    rises = np.abs(moves["z_to"] - moves["z_from"]) / np.maximum(moves.way, 1e-9)
    # What z's speed allows grows with 1 / rise; on any other limit the rise has no say.
    z_speed = _z_speed(moves, by_path & slowed, rises)
    is_z = by_path & (rises * top > 0.98 * z_speed) & (rises > 0)
    causes[by_path] = CHAINS
    causes[by_path & (moves["sweep"] != 0)] = ARC
    causes[is_z] = Z
    causes_seen = []
    for cause in (GREATEST, Z, ARC, CHAINS):
        rows = np.flatnonzero(slowed & (causes == cause))
        if len(rows):
            worst = rows[least(top[rows])]
            numbers = float(asked[worst]), float(top[worst])
            causes_seen.append(Slower(cause, len(rows), int(moves["line"][worst]), *numbers))
    return tuple(sorted(causes_seen, key=lambda each: -each.moves))


def _z_speed(moves: Moves, those: Flags, rises: Array) -> float:
    """[mm/min] The greatest speed of z that any of those moves reaches."""
    return float((rises * moves["top"])[those].max(initial=0.0)) or np.inf


def times_of(done: Done) -> Times:
    """Return how long it takes, and what the cutting would take at the program's feeds."""
    moves = done.moves
    took = np.diff(np.concatenate([[0.0], moves["ends"]]))
    works = ~moves.rapid
    asked = moves.way[works] / np.minimum(moves["asked"], moves["feed"])[works] * 60
    return Times(
        whole=done.seconds,
        cutting=float(took[works].sum()),
        rapid=float(took[~works].sum()),
        asked=float(asked.sum()),
    )


# What the chains bear along a job: where it leaves the reach, the pulls and the give.

CELL = 4.0  # [mm] reach hardly changes over it


@dataclass(frozen=True)
class BadReach:
    """Cuts at places that are not usable."""

    verdict: str  # as `plumb reach` says it
    lines: int
    first: Annotated[int, key("first_line")]
    share: float  # of the cut places


@dataclass(frozen=True)
class Hanging:
    """Pulls and give along the cuts of a job."""

    verdict: Internal[Codes]  # (k,) USABLE ... of each sample
    tension: Annotated[tuple[float, float], key("tension_n")]  # slackest and tightest chain
    give: Annotated[float, key("give_mm_per_n")]  # where the sled gives most
    give_line: int
    bad: tuple[BadReach, ...]
    assumed: tuple[str, ...]


def hanging_along(
    settings: MachineSettings, moves: Moves, samples: Samples, limits: Mapping[str, float]
) -> Hanging | None:
    """Return what hangs along the cuts; None where nothing is cut."""
    cut = moves.cut[samples.move]
    if not cut.any():
        return None
    machine, assumed = with_soft_chains(settings.as_plumb_model())
    cells, back = np.unique(np.round(samples.places / CELL), axis=0, return_inverse=True)
    there = reach(machine, cells * CELL, **limits)
    back = back.reshape(-1)
    verdict = there.verdict[back]
    hangs = cut & (verdict != CANNOT_HANG)
    tension, give = there.tension[back], np.where(hangs, there.give[back], -1.0)
    softest = greatest(give)
    lines = moves["line"][samples.move].astype(int)
    pulls = (0.0, 0.0)
    if hangs.any():
        pulls = float(tension[hangs].min()), float(tension[hangs].max())
    bad = []
    for number, word in enumerate(REACH_WORDS):
        those = cut & (verdict == number)
        if number != USABLE and those.any():
            hit = np.unique(lines[those])
            bad.append(BadReach(word, len(hit), int(hit[0]), float(those.sum() / cut.sum())))
    return Hanging(
        verdict, pulls, max(float(give[softest]), 0.0), int(lines[softest]), tuple(bad), assumed
    )
