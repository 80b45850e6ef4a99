"""A program that goes on with a job after a halt: modes, place and depth as the first had them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from plumb.job.dry_run import IN_WOOD, Flags, Moves, Rows, Run, pieces, safe_height
from plumb.model.plain import least
from plumb.model.predict import Array
from plumb.settings import MachineSettings
from plumb.text.errors import InputError

Place = tuple[float, float, float]
Word = tuple[str, float, dict[str, float]]
NO_CYCLE = 80  # modes of motion beyond it are drilling cycles
MODES = "G21 G90 G91.1 G94 G17 G80"


@dataclass(frozen=True)
class Resumed:
    """A program, and where it begins."""

    lines: tuple[str, ...]
    first: int  # the line of the job that is done first
    begins: Place  # [mm] of the machine: where the bit goes into the wood or the job goes on
    entry: CutMove | None  # where a move of the job is cut in two


@dataclass(frozen=True)
class JobMachine:
    """A machine on which the job runs."""

    settings: MachineSettings
    start: Place
    numbers: Mapping[int, float]

    def after(self, lines: Sequence[str]) -> Run:
        """Return a dry run of lines."""
        run = Run(self.settings, start=self.start, numbers=self.numbers)
        run.send(lines)
        return run


def resume_at_line(machine: JobMachine, lines: Sequence[str], line: int) -> Resumed:
    """Go on at a line: from the last place before it at which the bit was out of the wood."""
    if not 1 <= line <= len(lines):
        raise InputError(f"--line {line}: the program has {len(lines)} lines")
    moves = machine.after(lines).finish().moves
    done = _last_free(machine, lines, moves, line - 1)
    run = machine.after(lines[:done])
    begins = x, y, z = run.place
    head = _Head(machine, lines[:done], run, safe_height(moves))
    program = [*head.to_place((x, y, max(z, 0.0))), *head.modes(), *lines[done:]]
    return Resumed(tuple(program), done + 1, begins, None)


def resume_at_place(
    machine: JobMachine, lines: Sequence[str], place: tuple[float, float], line: int | None = None
) -> Resumed:
    """Go on where a cut passes nearest to a place [mm]; `line` picks one of several passes."""
    moves = machine.after(lines).finish().moves
    entry = entry_at(moves, place, line=line)
    run = machine.after(lines[: entry.line])
    if run.modes["motion"] > NO_CYCLE:
        # A hole is drilled from its beginning.
        return resume_at_line(machine, lines, entry.line)
    origin = run.origin
    head = _Head(machine, lines[: entry.line], run, safe_height(moves))
    program = [
        *head.to_place((*entry.place, head.safe)),
        *entry.program(origin),
        *head.modes(),
        *lines[entry.line :],
    ]
    return Resumed(tuple(program), entry.line, (*entry.place, entry.z), entry)


def _last_free(machine: JobMachine, lines: Sequence[str], moves: Moves, before: int) -> int:
    """Return how many lines were done when the bit was last out of the wood, outside of a cycle."""
    z = np.full(len(lines) + 1, np.nan)
    z[0] = machine.start[2]
    # The last move of a line counts.
    z[moves["line"].astype(int)] = moves["z_to"]
    known = np.maximum.accumulate(np.where(np.isnan(z), 0, np.arange(len(z))))
    modes = Modes()
    in_cycle = [modes.take(pieces(line)).is_in_cycle for line in lines[:before]]
    for done in range(before, 0, -1):
        if z[known[done]] >= IN_WOOD and not in_cycle[done - 1]:
            return done
    return 0


class _Head:
    """First lines of a resumed program, before the job goes on."""

    def __init__(self, machine: JobMachine, done: Sequence[str], run: Run, safe: float) -> None:
        """Take the run of the lines done, and use it up."""
        self.safe = safe
        self._begin, self._modes = run.origin, run.modes
        self._tools = modes_after(done)
        self._before = coordinates_of(machine.after([]))
        self._after = coordinates_of(run)

    def to_place(self, place: Place) -> list[str]:
        """Up, tool and spindle, across, and down to the height of `place` [mm] of the machine."""
        x, y, z = (each - begin for each, begin in zip(place, self._origin, strict=True))
        safe = self.safe - self._origin[2]
        machine = "G53 " if self._tools.declares else ""
        lines = [f"{MODES} G{54 + self._modes['system']:.0f}", f"{machine}G0 Z{safe:.4f}"]
        if self._modes["tool_in_spindle"]:
            lines.append(f"T{self._modes['tool_in_spindle']:.0f} M6")
        lines += self._tools.spindle_lines
        lines.append(f"{machine}G0 X{x:.4f} Y{y:.4f}")
        if self._tools.declares:
            lines += self._after.lines_at((*place[:2], self.safe), self._before)
            z = place[2] - self._begin[2]
        if place[2] != self.safe:
            lines.append(f"G0 Z{z:.4f}")
        return lines

    @property
    def _origin(self) -> Place:
        return (0.0, 0.0, 0.0) if self._tools.declares else self._begin

    def modes(self) -> list[str]:
        """Return the modes with which the job's next line is read."""
        modes = self._modes
        inches = bool(modes["inches"])
        feed = modes["feed"] / (25.4 if inches else 1.0)
        motion = min(modes["motion"], NO_CYCLE)
        words = [
            "G20" if inches else "G21",
            f"G{modes['plane']:.0f}",
            "G99" if modes["retracts_to_r"] else "G98",
            "G90.1" if modes["absolute_centres"] else "G91.1",
            f"F{feed:.5g}",
            f"G{motion:.0f}",
        ]
        last = ["G91" if modes["relative"] else "G90", "G93" if modes["inverse_time"] else "G94"]
        return [" ".join(words), " ".join(last), *self._tools.laser_lines]


# Where a cut is taken up again in the middle of a move, and the rest of that move.

NEAR = 5.0  # [mm] a cut passes a place
ALIKE = 1.0  # [mm] passes that are hardly farther away than the nearest
STEP, COARSE = 0.05, 5.0  # [mm] between places that are tried
SLOW = 100.0  # [mm/min] into the wood, where the program never goes straight down


@dataclass(frozen=True)
class CutMove:
    """A move of the job that is cut in two."""

    line: int
    rows: Moves  # the move and those behind it that the same line makes
    share: float  # of the first move that is done already
    place: tuple[float, float]  # [mm]
    z: float  # [mm]
    plunge: float  # [mm/min]
    passes: tuple[int, ...]  # lines of all cuts that pass there

    def program(self, origin: Sequence[float]) -> list[str]:
        """Into the wood, and the rest of the line; coordinates begin at `origin` [mm]."""
        down = f"G1 Z{self.z - origin[2]:.4f} F{self.plunge:g}"
        here = np.array(self.place)
        lines = [down]
        for row in range(len(self.rows)):
            end = np.array([self.rows["to_x"][row], self.rows["to_y"][row]])
            lines.append(self._move(row, here, end, origin))
            here = end
        return lines

    def _move(self, row: int, here: Array, end: Array, origin: Sequence[float]) -> str:
        rows = self.rows
        to = (*end, rows["z_to"][row])
        words = [f"{a}{b - o:.4f}" for a, b, o in zip("XYZ", to, origin, strict=True)]
        feed = rows["asked"][row]
        if np.isinf(feed):
            return " ".join(["G0", *words])
        sweep = rows["sweep"][row]
        if sweep == 0 or (row == 0 and self.share >= 1):
            return " ".join(["G1", *words, f"F{feed:g}"])
        centre = np.array([rows["centre_x"][row], rows["centre_y"][row]]) - here
        code = "G3" if sweep > 0 else "G2"
        return " ".join([code, *words, f"I{centre[0]:.4f} J{centre[1]:.4f} F{feed:g}"])


def entry_at(moves: Moves, place: tuple[float, float], *, line: int | None) -> CutMove:
    """Return where a cut passes nearest to a place; of several passes the first, or that near
    `line`.
    """
    cut = np.flatnonzero(moves.cut & ~moves.rapid)
    if line is not None:
        cut = cut[_same_run(moves, cut, line)]
    if not len(cut):
        which = "" if line is None else f" around line {line}"
        raise InputError(f"the program cuts nothing{which}")
    cut = cut[_near(moves.only(cut), place)]
    samples = moves.only(cut).sampled(STEP)
    away = np.hypot(*(samples.places - place).T)
    if away.min() > NEAR:
        nearest = samples.places[least(away)]
        raise InputError(
            f"no cut passes within {NEAR:g} mm of X{place[0]:g} Y{place[1]:g}; the nearest is at "
            f"X{nearest[0]:.1f} Y{nearest[1]:.1f}"
        )
    near = np.flatnonzero(away <= away.min() + ALIKE)
    # The sled goes away and comes back between two passes.
    stretches = np.split(near, np.flatnonzero(np.diff(near) > 1) + 1)
    passes = [int(stretch[least(away[stretch])]) for stretch in stretches]
    best = passes[0]
    row = int(cut[samples.move[best]])
    lines = moves["line"].astype(int)
    begin = np.flatnonzero(samples.move == samples.move[best])
    x, y = samples.places[best]
    return CutMove(
        line=int(lines[row]),
        rows=moves.only(np.flatnonzero((lines == lines[row]) & (np.arange(len(moves)) >= row))),
        share=float((best - begin[0]) / (len(begin) - 1)),
        place=(float(x), float(y)),
        z=float(samples.z[best]),
        plunge=_plunge(moves, row),
        passes=tuple(int(lines[cut[samples.move[each]]]) for each in passes),
    )


def _near(moves: Moves, place: tuple[float, float]) -> Rows:
    """Return the moves that may pass a place as near as the nearest."""
    samples = moves.sampled(COARSE)
    away = np.hypot(*(samples.places - place).T)
    return np.unique(samples.move[away <= away.min() + COARSE + ALIKE])


def _same_run(moves: Moves, cut: Rows, line: int) -> Flags:
    """Cuts between the lifts around a line."""
    # A run ends where the bit comes out of the wood.
    above = np.minimum(moves["z_from"], moves["z_to"]) >= 0
    run = np.cumsum(above | moves.rapid)
    of_line = cut[moves["line"][cut] >= line]
    return np.asarray(run[cut] == (run[of_line[0]] if len(of_line) else -1))


def _plunge(moves: Moves, row: int) -> float:
    """Return the feed with which the program last went straight down."""
    down = (moves["z_to"] < moves["z_from"]) & (moves["length"] == 0) & ~moves.rapid
    before = np.flatnonzero(down[: row + 1])
    return float(moves["asked"][before[-1]]) if len(before) else SLOW


# Where a program's coordinates begin: G54 to G59, the shift of G92, the tool's length.

FIRST, SYSTEMS = 54, 6  # G54 to G59
SAME = 1e-3  # [mm] less than this is rounding


@dataclass(frozen=True)
class Coordinates:
    """All that decides where the coordinates of a program begin [mm]."""

    systems: tuple[Place, ...]  # of G54 to G59
    in_force: int  # 0 is G54
    shift: Place  # of G92, in force or put aside
    is_aside: bool  # G92.2
    tool: float  # its length, G43.1

    @property
    def begin(self) -> Place:
        """Where the coordinates in force would begin if no shift were put aside [mm]."""
        x, y, z = (
            stored + shift
            for stored, shift in zip(self.systems[self.in_force], self.shift, strict=True)
        )
        return x, y, z + self.tool

    def lines_at(self, place: Place, before: Coordinates) -> list[str]:
        """Return the lines that set them while the bit is at `place` [mm] of the machine.

        Systems that are as they were `before` the program are left alone.
        """
        lines = [
            f"G10 L2 P{number} X{begin[0]:.4f} Y{begin[1]:.4f} Z{begin[2]:.4f}"
            for number, (begin, was) in enumerate(
                zip(self.systems, before.systems, strict=True), start=1
            )
            if not _is_same(begin, was)
        ]
        lines.append("G49" if abs(self.tool) < SAME else f"G43.1 Z{self.tool:.4f}")
        counted = [at - begin for at, begin in zip(place, self.begin, strict=True)]
        lines.append("G92 X{:.4f} Y{:.4f} Z{:.4f}".format(*counted))
        return [*lines, "G92.2"] if self.is_aside else lines


def coordinates_of(run: Run) -> Coordinates:
    """Return the coordinates after a run, whose modes and coordinates this uses up."""
    in_force = int(run.modes["system"])
    begin = run.origin
    with_shift = _after(run, "G92.3")
    without_tool = _after(run, "G49")
    without_shift = _after(run, "G92.1")
    systems = tuple(_after(run, f"G{FIRST + number}") for number in range(SYSTEMS))
    return Coordinates(
        systems,
        in_force,
        _difference(without_tool, without_shift),
        not _is_same(begin, with_shift),
        with_shift[2] - without_tool[2],
    )


def _after(run: Run, line: str) -> Place:
    run.send([line])
    return run.origin


def _difference(place: Sequence[float], other: Sequence[float]) -> Place:
    x, y, z = (at - begin for at, begin in zip(place, other, strict=True))
    return x, y, z


def _is_same(place: Place, other: Place) -> bool:
    return all(abs(each) < SAME for each in _difference(place, other))


# What lines of a program switch: motion and units, spindle and laser, coordinates.

SPINDLE = {3.0: "M3", 4.0: "M4", 5.0: "", 2.0: "", 30.0: "", 6.0: ""}  # by the number of the M
LASER = {106.0: True, 107.0: False, 2.0: False, 30.0: False}
DECLARES = (92.0, 92.1, 92.2, 92.3, 43.1)  # G codes that move the program's coordinates
CYCLES = (81.0, 82.0, 83.0)
MOTIONS = (0.0, 1.0, 2.0, 3.0, 80.0)  # each ends a cycle
SPEED = "S"
UNITS = {20.0: True, 21.0: False}  # whether a G code makes numbers inches
STRONGEST = 255.0  # of a laser without an S


@dataclass
class Modes:
    """Modes in force between two lines of a program, and the state of spindle and laser."""

    motion: int = 0
    before_cycle: int = 0  # the motion before the drilling cycle
    inches: bool = False
    relative: bool = False
    spindle: str = ""  # M3, M4 or nothing
    laser: bool = False
    speed: float | None = None  # the last S
    declares: bool = False  # G92, G43.1 or G10: where coordinates begin is the program's choice

    def take(self, line: Sequence[Word]) -> Modes:
        """Take over what a line switches; returns itself."""
        for letter, number, words in line:
            code = round(number, 1)
            if SPEED in words and not (letter == "G" and code == 4.0):
                self.speed = words[SPEED]
            if letter == "M":
                self.spindle = SPINDLE.get(code, self.spindle)
                self.laser = LASER.get(code, self.laser)
                if code == 106.0 and SPEED not in words:
                    self.speed = STRONGEST
                if code in (2, 30) and self.motion >= NO_CYCLE:
                    self.motion = 0
            if letter == "G":
                self._take_code(code, words)
        return self

    def _take_code(self, code: float, words: Mapping[str, float]) -> None:
        self.inches = UNITS.get(code, self.inches)
        self.relative = code == 91 if code in (90, 91) else self.relative
        if code in CYCLES and self.motion < NO_CYCLE:
            self.before_cycle = self.motion
        if code in (*CYCLES, *MOTIONS):
            self.motion = int(code)
        self.declares |= code in DECLARES or (code == 10.0 and "L" in words)

    @property
    def is_in_cycle(self) -> bool:
        """Whether a drilling cycle is in force."""
        return self.motion > NO_CYCLE

    @property
    def spindle_lines(self) -> list[str]:
        """The lines that switch the spindle on."""
        if not self.spindle:
            return []
        return [self.spindle if self.speed is None else f"{self.spindle} S{self.speed:g}"]

    @property
    def laser_lines(self) -> list[str]:
        """The lines that arm the laser."""
        return [f"M106 S{STRONGEST if self.speed is None else self.speed:g}"] if self.laser else []


def modes_after(lines: Sequence[str]) -> Modes:
    """Return the modes after these lines."""
    modes = Modes()
    for line in lines:
        modes.take(pieces(line))
    return modes
