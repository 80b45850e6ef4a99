"""Findings of a dry run: answers to lines, times, and the pull of the chains."""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import computed_field

from plumb.job.dry_run import STEP, Done, Flags, Moves, Rows, pieces
from plumb.model.plain import greatest, least
from plumb.model.predict import CANNOT_HANG, REACH_WORDS, USABLE, Array, reach
from plumb.model.reach import with_soft_chains
from plumb.settings.machine import MachineSettings
from plumb.text.answers import Internal, in_json, key

HALTS, LEAVES, WAITS, IGNORED = "halts", "leaves the sheet", "waits", "ignored"
GOUGES, STILL, DEEP = "gouges", "spindle off", "too deep"
SINKS, FEED, NO_ARC = "may sink", "no feed", "no arc"
WRONG = (HALTS, LEAVES, GOUGES, STILL, DEEP, FEED, NO_ARC)


@dataclass(frozen=True)
class Finding:
    """Something about one or more lines."""

    kind: str
    says: str  # in the machine's words, or ours
    lines: Internal[tuple[int, ...]]

    @in_json
    def line(self) -> int:
        """The first of its lines."""
        return self.lines[0]

    @in_json
    def count(self) -> int:
        """The number of lines that have it."""
        return len(self.lines)

    @property
    def is_doubt(self) -> bool:
        """Whether it deserves a look though nothing is spoiled."""
        return self.kind == SINKS

    @computed_field(alias="wrong")
    @property
    def is_wrong(self) -> bool:
        """Whether the part is spoiled, or the machine stops."""
        return self.kind in WRONG


def findings_of(done: Done) -> tuple[Finding, ...]:
    """Return everything to say about lines, in their order."""
    refused = "plumb send refuses it: it"
    sayings = [(each.line, HALTS, f"{refused} {each.why}") for each in done.refused]
    sayings += [each for line, text in done.said if (each := _said(line, text))]
    lines: dict[tuple[str, str], list[int]] = {}
    for line, kind, says in sorted(set(sayings)):
        lines.setdefault((kind, says), []).append(line)
    return tuple(Finding(*each, tuple(those)) for each, those in lines.items())


def _said(line: int, text: str) -> tuple[int, str, str] | None:
    if text.startswith(("error: ", "ALARM: ")):
        return line, HALTS, text.partition(": ")[2]
    if text.startswith("This line leads beyond the sheet"):
        return line, LEAVES, text.partition(": ")[2]
    if text.endswith(" unsupported and ignored."):
        return line, IGNORED, text.split()[1]
    if text == "Maslow Paused":
        return line, WAITS, "the machine waits until the operator goes on"
    return None


# Programs that the machine runs but that cannot be intended.

LEAST_FEED = 5.0  # [mm/min]
F_WORD = re.compile(r"(?i)f\s*\.?\d")
R_OF_ZERO = re.compile(r"(?i)r\s*[-+]?(?:0+\.?0*|\.0+)(?![\d.])")


def meant_otherwise(done: Done, lines: Sequence[str]) -> Iterator[Finding]:
    """Yield feeds that are missing or next to nothing, and arcs of no radius."""
    moves = done.moves
    fed = ~moves.rapid & moves.over_sheet
    first = moves.only(np.flatnonzero(fed)[:1])
    if len(first) and not any(map(F_WORD.search, lines[: int(first["line"][0])])):
        feed = f"{first['asked'][0]:.0f} mm/min"
        says = f"no F says how fast to cut, so the machine keeps the feed that it has: {feed}"
        yield Finding(FEED, says, (int(first["line"][0]),))
    slow = moves.only(np.flatnonzero(fed & (moves["asked"] < LEAST_FEED)))
    for asked in np.unique(slow["asked"]):
        those = slow.only(slow["asked"] == asked)
        minutes = float((those.way / asked).sum())
        says = f"the feed is {asked:g} mm/min, at which this takes {minutes:.0f} minutes"
        yield Finding(FEED, says, tuple(np.unique(those["line"].astype(int)).tolist()))
    for number, line in enumerate(lines, start=1):
        if R_OF_ZERO.search(line) and any(
            letter == "G" and code in (2, 3) and words.get("R") == 0
            for letter, code, words in pieces(line)
        ):
            says = "R0 is the radius of no arc; the machine goes straight"
            yield Finding(NO_ARC, says, (number,))


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
    return (Finding(SINKS, says, (int(moves["line"][-1]),)),)


# Where the sled goes slower than the program asks, and how long the job takes.

LESS = 0.995  # of a feed: below it a limit acts
GREATEST, Z = "the greatest feed ($15)", "the speed of z ($18)"
ARC, CHAINS = "the arc", "the chains"
CAUSES = (GREATEST, Z, ARC, CHAINS)


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
    """The duration of a job [s], without the operator's pauses."""

    whole: float
    cutting: float
    rapid: float
    asked: float  # the cutting at the feeds of the program
    capped: float  # the cutting at the feeds of the program, none above $15


def slower_moves(moves: Moves) -> tuple[Slower, ...]:
    """Limits that act on cutting moves, those that act most often first."""
    # What z's speed allows grows with 1 / rise; on any other limit the rise has no say.
    z_speed = max((_z_speeds(each).max(initial=0.0) for _, each in moves.blocks()), default=0.0)
    causes = [_causes(each, float(z_speed) or np.inf) for _, each in moves.blocks()]
    cause_of = np.concatenate([np.zeros(0, dtype=np.int8), *causes])
    causes_seen = []
    for number, cause in enumerate(CAUSES):
        rows = np.flatnonzero(cause_of == number)
        if len(rows):
            worst = moves.only(rows[[least(moves.only(rows)["top"])]])
            numbers = int(worst["line"][0]), float(worst["asked"][0]), float(worst["top"][0])
            causes_seen.append(Slower(cause, len(rows), *numbers))
    return tuple(sorted(causes_seen, key=lambda each: -each.moves))


def _slowed(moves: Moves) -> Flags:
    """Return which cutting moves go slower than they are asked to."""
    works = ~moves.rapid & moves.over_sheet
    return np.asarray(works & (moves["top"] < LESS * moves["asked"]))


def _z_speeds(moves: Moves) -> Array:
    """Return the speed of z [mm/min] in moves that are slowed by their path; 0 in others."""
    top = moves["top"]
    rises = np.abs(moves["z_to"] - moves["z_from"]) / np.maximum(moves.way, 1e-9)
    return np.where(_slowed(moves) & (top < LESS * moves["feed"]), rises * top, 0.0)


def _causes(moves: Moves, z_speed: float) -> NDArray[np.int8]:
    """Return what slows each move, by its place in CAUSES; -1: nothing does."""
    by_path = moves["top"] < LESS * moves["feed"]
    speeds = _z_speeds(moves)
    causes = np.where(by_path, CAUSES.index(CHAINS), CAUSES.index(GREATEST))
    causes[by_path & (moves["sweep"] != 0)] = CAUSES.index(ARC)
    causes[(speeds > 0) & (speeds > 0.98 * z_speed)] = CAUSES.index(Z)
    return np.where(_slowed(moves), causes, -1).astype(np.int8)


def times_of(done: Done) -> Times:
    """Return its duration, and that of the cutting if no other limit acted."""
    moves = done.moves
    took = np.diff(np.concatenate([[0.0], moves["ends"]]))
    works = ~moves.rapid
    way, asked, feed = moves.way[works], moves["asked"][works], moves["feed"][works]
    return Times(
        whole=done.seconds,
        cutting=float(took[works].sum()),
        rapid=float(took[~works].sum()),
        asked=60 * float((way / asked).sum()),
        capped=60 * float((way / np.minimum(asked, feed)).sum()),
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

    unusable: Internal[Rows]  # moves, of those over the sheet, that pass such a place
    tension: Annotated[tuple[float, float], key("tension_n")]  # slackest and tightest chain
    give: Annotated[float, key("give_mm_per_n")]  # where the sled gives most
    give_line: int
    bad: tuple[BadReach, ...]
    assumed: tuple[str, ...]


def hanging_along(settings: MachineSettings, moves: Moves) -> Hanging | None:
    """Return what hangs along the cuts; None where nothing is cut."""
    if not moves.cut.any():
        return None
    machine, assumed = with_soft_chains(settings.as_plumb_model())
    seen = [np.unique(_cells(block.sampled(STEP).places)) for _, block in moves.blocks()]
    cells = np.unique(np.concatenate(seen))
    there = reach(machine, CELL * np.column_stack([cells.real, cells.imag]))
    counts = np.zeros(len(cells), dtype=int)  # of the cut places in each
    lines = np.zeros(len(cells), dtype=int)  # of the first cut there
    order: list[Rows] = []  # the cells, as cuts first come there
    unusable = []
    hit: list[list[Rows]] = [[] for _ in REACH_WORDS]  # lines that cut there
    for first, block in moves.blocks():
        samples = block.sampled(STEP)
        cell = np.searchsorted(cells, _cells(samples.places))
        verdict, cut = there.verdict[cell], block.cut[samples.move]
        unusable.append(first + np.unique(samples.move[verdict != USABLE]))
        cell, verdict, line = cell[cut], verdict[cut], block["line"][samples.move[cut]].astype(int)
        new, at = np.unique(cell, return_index=True)
        at = np.sort(at[counts[new] == 0])
        lines[cell[at]] = line[at]
        order.append(cell[at])
        counts += np.bincount(cell, minlength=len(cells))
        for number in np.unique(verdict[verdict != USABLE]):
            hit[number].append(np.unique(line[verdict == number]))
    come = np.concatenate(order)
    hangs = come[there.verdict[come] != CANNOT_HANG]
    bad = []
    for number, several in enumerate(hit):
        if several:
            those = np.unique(np.concatenate(several))
            share = float(counts[there.verdict == number].sum() / counts.sum())
            bad.append(BadReach(REACH_WORDS[number], len(those), int(those[0]), share))
    pulls, give, line_of = (0.0, 0.0), 0.0, int(moves["line"][0])
    if len(hangs):
        gives = there.give[hangs]
        softest = greatest(gives)
        give, line_of = max(float(gives[softest]), 0.0), int(lines[hangs[softest]])
        pulls = float(there.tension[hangs].min()), float(there.tension[hangs].max())
    return Hanging(np.concatenate(unusable), pulls, give, line_of, tuple(bad), assumed)


def _cells(places: Array) -> NDArray[np.complex128]:
    """Return the cell (k,) of each place, its column and its row in one number."""
    column, row = np.round(places / CELL).T + 0.0
    return np.asarray(column + 1j * row)
