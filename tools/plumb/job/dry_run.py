"""A program run dry: the firmware itself reads and plans it, and simulates its motors (B99)."""

from __future__ import annotations

import re
from array import array
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated

import numpy as np
import scipy
from numpy.typing import NDArray
from pydantic import computed_field

from plumb._dry_run import COLUMNS, DryRun, pieces
from plumb.firmware.settings import CLIENT_NUMBERS, firmware_numbers, machine_of_numbers
from plumb.line.sender import PlainError, plain
from plumb.model.plain import greatest, least
from plumb.model.predict import CANNOT_HANG, FOUND, REACH_WORDS, USABLE, Array, lengths, reach
from plumb.model.reach import with_soft_chains
from plumb.settings import MachineSettings
from plumb.text.answers import Internal, in_json, key
from plumb.text.errors import InputError, Source
from plumb.text.files import MB, read_text

__all__ = ["COLUMNS", "Done", "Refused", "Run", "pieces"]

AT_ONCE = 2000  # lines between two looks at how far it is
GOES_ON = 70  # $70: a line that would halt the machine is refused, and the next is done
SIMULATED = "B99 ON"
# A move as it is kept: its numbers are those of the firmware, which counts in single precision.
WIDE = {"line": "i4", "ends": "f8"}
MOVE = np.dtype([(name, WIDE.get(name, "f4")) for name in COLUMNS])
BLOCK = 50_000  # moves that are looked at together
STEP = 5.0  # [mm] between places that are looked at
Share = Callable[[float], None]


@dataclass(frozen=True)
class Refused:
    """A line that no client can send."""

    line: int
    why: str


@dataclass(frozen=True)
class Done:
    """Record of a machine that ran a program."""

    moves: Moves
    said: tuple[tuple[int, str], ...]  # line (counted from 1) and what the machine said to it
    refused: tuple[Refused, ...]
    seconds: float
    halted_at: int | None  # the line at which an alarm stopped it


class Run:
    """A machine with these settings, placed where it stands, that runs a program dry."""

    def __init__(
        self,
        settings: MachineSettings,
        *,
        start: tuple[float, float, float] = (0.0, 0.0, 0.0),
        numbers: Mapping[int, float] | None = None,
    ) -> None:
        """start [mm] of the bit; numbers of the firmware that the settings do not hold."""
        model = settings.as_plumb_model()
        chains, outcome = lengths(model, np.array([start[:2]]))
        if outcome[0] != FOUND:
            where = f"X{start[0]:g} Y{start[1]:g}"
            raise InputError(f"no sled can hang at {where}, where it is to begin")
        self._machine = DryRun()
        self._numbers = array("i")  # of the lines that were sent, as the file counts them
        self._kept: list[NDArray[np.void]] = []  # moves that have ended
        self._refused: list[Refused] = []
        given = {**CLIENT_NUMBERS, **(numbers or {}), GOES_ON: 1}
        lines = [f"${number}={value:g}" for number, value in given.items()]
        lines += [number.line for number in firmware_numbers(model)]
        left, right = chains[0]
        lines += [SIMULATED, f"B06 L{left:.4f} R{right:.4f}", f"G10 Z{start[2]:.4f}"]
        self._machine.send(lines)
        for number, text in self._machine.said():
            if text.startswith(("error:", "ALARM")):
                raise InputError(f"the firmware refuses {lines[number]!r}: {text}")
        self._setup = len(lines)
        self._begun = self._machine.seconds

    def send(self, lines: Sequence[str], *, first: int = 1, progress: Share | None = None) -> None:
        """Send lines of a file; `first` is the number of the first."""
        for begin in range(0, len(lines), AT_ONCE):
            sent = []
            for number, line in enumerate(lines[begin : begin + AT_ONCE], start=first + begin):
                try:
                    text = plain(line)
                except PlainError as error:
                    self._refused.append(Refused(number, str(error)))
                    continue
                if text:
                    sent.append(text)
                    self._numbers.append(number)
            self._machine.send(sent)
            self._keep()
            if progress:
                progress(min(1.0, (begin + AT_ONCE) / len(lines)))

    def _keep(self) -> None:
        """Take over the moves that have ended."""
        rows = self._machine.moves()
        self._kept.append(_narrow(rows[: self._machine.forget_ended()]))

    def finish(self) -> Done:
        """Let the moves end; everything that was done."""
        machine = self._machine
        machine.drain()
        self._keep()
        # The line in execution at an alarm has no answer.
        last = self._numbers[-1] if self._numbers else 1
        numbers = np.append(np.array(self._numbers, dtype=int), last)
        rows = np.concatenate([*self._kept, _narrow(machine.moves())])
        of_program = rows["line"] >= self._setup
        rows = rows if of_program.all() else rows[of_program]
        rows["line"] = numbers[rows["line"] - self._setup]
        rows["ends"] -= self._begun
        said = tuple(
            (int(numbers[line - self._setup]), text)
            for line, text in machine.said()
            if line >= self._setup
        )
        halted = int(numbers[machine.answered - self._setup]) if machine.is_halted else None
        seconds = machine.seconds - self._begun
        return Done(Moves(rows), said, tuple(self._refused), seconds, halted)

    @property
    def modes(self) -> dict[str, float]:
        """The modes with which the next line is read."""
        return self._machine.modes()

    @property
    def place(self) -> tuple[float, float, float]:
        """Where the program believes the bit to be at the end of all moves so far [mm]."""
        x, y, z = self._machine.place()
        return x, y, z

    @property
    def origin(self) -> tuple[float, float, float]:
        """Where the program's coordinates begin [mm]."""
        x, y, z = self._machine.origin()
        return x, y, z


def _narrow(rows: Array) -> NDArray[np.void]:
    """Return moves (n, columns) as they are kept."""
    kept = np.empty(len(rows), dtype=MOVE)
    for name, column in zip(COLUMNS, rows.T, strict=True):
        kept[name] = column
    return kept


# The moves of a job: a row each, and the places along them.

Flags = NDArray[np.bool_]
Rows = NDArray[np.intp]

IN_WOOD = -0.01  # [mm] of z: the bit is below the sheet's face
CLEAR = 5.0  # [mm] above the sheet, if a program goes no higher
TURN = 0.2  # [rad] of an arc between two places


@dataclass(frozen=True)
class Samples:
    """Places along moves."""

    move: Rows  # (k,) row of the move
    places: Array  # (k, 2) [mm]
    z: Array  # (k,) [mm]


@dataclass(frozen=True)
class Moves:
    """Moves with the numbers that plumb._dry_run.COLUMNS names."""

    rows: NDArray[np.void]  # (n,) of MOVE

    def __len__(self) -> int:
        return len(self.rows)

    def __getitem__(self, name: str) -> Array:
        """Return a number of all moves (n,) by its name."""
        return np.asarray(self.rows[name], dtype=float)

    def blocks(self) -> Iterator[tuple[int, Moves]]:
        """Yield the moves piece by piece, each with the number of its first move."""
        for first in range(0, len(self), BLOCK):
            yield first, Moves(self.rows[first : first + BLOCK])

    def only(self, those: Flags | Rows) -> Moves:
        """Return some of the moves; all of them take no room a second time."""
        if those.dtype == bool and those.all():
            return self
        return Moves(self.rows[those])

    @property
    def over_sheet(self) -> Flags:
        """Moves of the sled, not of a single chain (n,)."""
        return np.asarray(self["by_chains"] == 0)

    @property
    def rapid(self) -> Flags:
        """Moves at the greatest feed: G0, G28, and the ways of a drilling cycle (n,)."""
        return np.asarray(np.isinf(self["asked"]))

    @property
    def cut(self) -> Flags:
        """Moves with the bit in the wood (n,)."""
        deep = np.minimum(self["z_from"], self["z_to"]) < IN_WOOD
        return np.asarray(deep & self.over_sheet)

    @property
    def way(self) -> Array:
        """Length over all axes (n,) [mm]."""
        return np.hypot(self["length"], self["z_to"] - self["z_from"])

    def sampled(self, step: float | Array) -> Samples:
        """Return places along the moves, both ends included, at most `step` [mm] apart, for all
        or for each.
        """
        turns = np.abs(self["sweep"]) / TURN
        counts = np.ceil(np.maximum(self.way / step, turns)).astype(int) + 1
        counts = np.maximum(counts, 2)
        move = np.repeat(np.arange(len(self)), counts)
        first = np.cumsum(counts) - counts
        share = (np.arange(len(move)) - first[move]) / (counts[move] - 1)
        low, high = self["z_from"][move], self["z_to"][move]
        return Samples(move, self.places_at(move, share), low + share * (high - low))

    def places_at(self, move: Rows, share: Array) -> Array:
        """Return places (k, 2) [mm] at shares of some moves."""
        start = np.stack([self["from_x"], self["from_y"]], axis=1)[move]
        end = np.stack([self["to_x"], self["to_y"]], axis=1)[move]
        across = self["length"][move] > 0
        places = np.where(across[:, None], start + share[:, None] * (end - start), start)
        round_ = (self["sweep"][move] != 0) & across
        centre = np.stack([self["centre_x"], self["centre_y"]], axis=1)[move]
        from_centre, to_centre = start - centre, end - centre
        radius = np.hypot(*from_centre.T) * (1 - share) + np.hypot(*to_centre.T) * share
        angle = np.arctan2(from_centre[:, 1], from_centre[:, 0]) + share * self["sweep"][move]
        turned = centre + radius[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
        return np.asarray(np.where(round_[:, None], turned, places))


def safe_height(moves: Moves) -> float:
    """Return the z [mm] at which a job crosses the sheet, or a little above the sheet."""
    across = moves.over_sheet & (moves["length"] > 0)
    return max(CLEAR, float(moves["z_to"][across].max(initial=0.0)))


LARGEST_PROGRAM = 200 * MB

# What holds no program: settings, marks and tables, refused before any line is sent.

SETTINGS = "numbers are sent from a machine.toml"
PROGRAM = "give a program of G-code"
OTHERS = (
    (r"^\s*\[(maslow|advanced) settings\]", "holds settings of GroundControl", SETTINGS),
    (r"\A\s*\{.*\"(maslow|advanced) settings\"", "holds settings of WebControl", SETTINGS),
    (r"\A\s*\{", "holds JSON", PROGRAM),
    (r"^\s*\[\[(mark|distance)\]\]|^\s*numpositions\s*[=:]", "holds marks", PROGRAM),
    (r"\A\s*[^\s,;()]+(,[^\s,;()]+)+\s*$", "holds a table", PROGRAM),
    (r"\A\s*<(\?xml|svg|!doctype)", "holds a drawing or a page", "let a CAM program make G-code"),
    (r"\A\s*0\s+SECTION\s", "holds a drawing (DXF)", "let a CAM program make G-code"),
)
# What the firmware says of a line that is not G-code at all.
NO_CODE = re.compile(r"(this begins no word|a number is missing behind|there is no such code).*")


def program_in(path: Source, *, say: Callable[[str], None]) -> list[str]:
    """Return the lines of a program; InputError if it is not one.

    Old CAM programs write comments in the code page of Windows; `say` hears of it.
    """
    text = read_text(path, most=LARGEST_PROGRAM, say=say)
    refuse_what_is_no_program(path, text)
    return text.splitlines()


def refuse_other_files(source: Source, text: str) -> None:
    """InputError for a client's settings, marks, tables and JSON."""
    for pattern, what, remedy in OTHERS:
        if re.search(pattern, text, re.IGNORECASE | re.MULTILINE | re.DOTALL):
            raise InputError(source, f"{what}, not a program", remedy=remedy)


def refuse_what_is_no_program(source: Source, text: str) -> None:
    """InputError for a text that is something else, or begins with what the firmware cannot read.

    Later lines are left to the machine, and to `plumb check`.
    """
    refuse_other_files(source, text)
    if re.search(r"^\s*\[frame\]", text, re.MULTILINE):
        raise InputError(source, "holds settings of a machine", remedy=PROGRAM)
    number, first = _first(text.splitlines())
    machine = DryRun()
    machine.send([first])
    for _, said in machine.said():
        fault = NO_CODE.search(said)
        if fault and said.startswith(("ALARM", "error")):
            why = f"is not G-code ({fault[0].removesuffix(' Press Stop.').rstrip('.')})"
            raise InputError(source, why, place=f"line {number}", remedy=PROGRAM)


def _first(lines: Sequence[str]) -> tuple[int, str]:
    """Return the first line that the machine would get, and its number; an empty line if none can
    be.
    """
    for number, line in enumerate(lines, start=1):
        try:
            text = plain(line)
        except PlainError:
            break  # whoever sends says so
        if text:
            return number, text
    return 0, ""


# G-code that goes round a job with the bit above the sheet, slowly, before anything is cut.

OUTLINE_FEED = 500.0  # [mm/min]


def hull_of(moves: Moves) -> Array:
    """Return the corners (k, 2) [mm] of the smallest convex shape that holds all cuts."""
    samples = moves.sampled(STEP)
    places = samples.places[moves.cut[samples.move]]
    places = np.unique(np.round(places, 3), axis=0)
    spread = places - places.mean(axis=0) if len(places) else places
    if len(places) < 3 or np.linalg.matrix_rank(spread, tol=1e-3) < 2:
        return np.asarray(places[[0, -1]] if len(places) else places)
    return np.asarray(places[scipy.spatial.ConvexHull(places).vertices])


def outline_of(moves: Moves, *, name: str) -> str:
    """Return a program that traces the hull, back to its first corner."""
    corners = hull_of(moves)
    if not len(corners):
        return f"(plumb: {comment_of(name)} cuts nothing)\n"
    safe = safe_height(moves)
    lines = [
        f"(plumb: outline of {comment_of(name)}, bit {safe:.1f} mm above the sheet)",
        "G21 G90 G94 G17",
        f"G0 Z{safe:.3f}",
        f"G0 X{corners[0, 0]:.3f} Y{corners[0, 1]:.3f}",
    ]
    ring = [*corners[1:], corners[0]]
    lines += [f"G1 X{x:.3f} Y{y:.3f} F{OUTLINE_FEED:g}" for x, y in ring]
    return "\n".join([*lines, "M5", ""])


def comment_of(name: str) -> str:
    """Return a file's name as a comment can hold it."""
    kept = [c if c.isascii() and c.isprintable() and c not in "()" else "_" for c in name]
    return "".join(kept)[:60]


# Findings of a dry run: answers to lines, times, and the pull of the chains.


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
    sayings = [(each.line, HALTS, f"it cannot be sent: it {each.why}") for each in done.refused]
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
    hit: list[list[Rows]] = [[] for _ in REACH_WORDS]  # lines that cut there
    for _, block in moves.blocks():
        samples = block.sampled(STEP)
        cell = np.searchsorted(cells, _cells(samples.places))
        verdict, cut = there.verdict[cell], block.cut[samples.move]
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
    return Hanging(pulls, give, line_of, tuple(bad), assumed)


def _cells(places: Array) -> NDArray[np.complex128]:
    """Return the cell (k,) of each place, its column and its row in one number."""
    column, row = np.round(places / CELL).T + 0.0
    return np.asarray(column + 1j * row)


# The time left of a program that is being sent, by its dry run and its progress so far.


STEADY = 20.0  # [s] of the dry run that the first seconds of a job are weighed against
# What else sets the pace, behind what clients send: accelerations, corners, chains.
PACE = (65, 66, 67, 68)


@dataclass(frozen=True)
class Timetable:
    """When each line of a program is done, by its dry run."""

    done_at: Array  # (lines + 1,) [s] after the begin; of line 0 zero

    @property
    def whole(self) -> float:
        """The program's duration [s]."""
        return float(self.done_at[-1])


def timetable(
    numbers: Mapping[int, float],
    lines: Sequence[str],
    place: tuple[float, float, float],
    *,
    progress: Share | None = None,
) -> Timetable | None:
    """Return the times of lines on a machine with these numbers, that stands at a place [mm]; None
    where it does not know how the sled hangs there.
    """
    pace = {number: numbers[number] for number in (*CLIENT_NUMBERS, *PACE) if number in numbers}
    try:
        run = Run(machine_of_numbers(numbers), start=place, numbers=pace)
    except InputError:
        return None  # what the machine thinks of its numbers it says itself
    run.send(lines, progress=progress)
    done = run.finish()
    done_at = np.zeros(len(lines) + 1)
    np.maximum.at(done_at, done.moves["line"].astype(int), done.moves["ends"])
    done_at = np.maximum.accumulate(done_at)
    done_at[-1] = max(done.seconds, float(done_at[-1]))
    return Timetable(done_at)


class TimeLeft:
    """The progress of a job: its timetable, corrected by the time taken so far.

    A machine may be slower than planned: its feed yields, or its operator turns it down. Pauses do
    not count.
    """

    def __init__(self, table: Timetable, *, ahead: float) -> None:
        """ahead [s]: how much motion may be left of a line that is answered."""
        self._table, self._ahead = table, ahead
        self._ran = self._ran_at = 0.0  # [s] so far, and when a line was last done
        self._last: float | None = None
        self._done = 0.0

    def note(self, now: float, line: int, *, pauses: bool) -> None:
        """Note that the machine has taken a line, at a time [s]; `pauses`: it waits, or is held."""
        if self._last is not None and not pauses:
            self._ran += now - self._last
        self._last = now
        begun = float(self._table.done_at[max(0, line - 1)])
        done = max(begun, float(self._table.done_at[line]) - self._ahead, self._done)
        if done > self._done:
            self._done, self._ran_at = done, self._ran

    @property
    def share(self) -> float:
        """The share of the job's time that is over."""
        whole = self._ran + self.seconds
        return self._ran / whole if whole else 1.0

    @property
    def seconds(self) -> float:
        """The time left [s]."""
        slower = (self._ran_at + STEADY) / (self._done + STEADY)
        since = self._ran - self._ran_at
        return max(0.0, slower * (self._table.whole - self._done) - since)
