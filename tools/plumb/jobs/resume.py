"""A program that goes on with a job after a halt: modes, place and depth as the first had them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from plumb.jobs.coordinates import Coordinates, coordinates_of
from plumb.jobs.dry_run import Run
from plumb.jobs.entry import Entry, entry_at
from plumb.jobs.moves import IN_WOOD, Moves, safe_height
from plumb.jobs.tools_in_use import ToolsInUse, cycles_after, tools_after
from plumb.settings.machine import MachineSettings
from plumb.text.errors import InputError

Place = tuple[float, float, float]
NO_CYCLE = 80  # modes of motion beyond it are drilling cycles
MODES = "G21 G90 G91.1 G94 G17 G80"


@dataclass(frozen=True)
class Resumed:
    """A program, and where it begins."""

    lines: tuple[str, ...]
    first: int  # the line of the job that is done first
    begins: Place  # [mm] of the machine: where the bit goes into the wood or the job goes on
    entry: Entry | None  # where a move of the job is cut in two


@dataclass(frozen=True)
class Machine:
    """A machine on which the job runs."""

    settings: MachineSettings
    start: Place
    numbers: Mapping[int, float]

    def after(self, lines: Sequence[str]) -> Run:
        """A dry run of lines."""
        run = Run(self.settings, start=self.start, numbers=self.numbers)
        run.send(lines)
        return run


def resume_at_line(machine: Machine, lines: Sequence[str], line: int) -> Resumed:
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
    machine: Machine, lines: Sequence[str], place: tuple[float, float], line: int | None = None
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


def _last_free(machine: Machine, lines: Sequence[str], moves: Moves, before: int) -> int:
    """How many lines were done when the bit was last out of the wood, outside of a cycle."""
    z = np.full(len(lines) + 1, np.nan)
    z[0] = machine.start[2]
    # The last move of a line counts.
    z[moves["line"].astype(int)] = moves["z_to"]
    known = np.maximum.accumulate(np.where(np.isnan(z), 0, np.arange(len(z))))
    in_cycle = cycles_after(lines[:before])
    for done in range(before, 0, -1):
        if z[known[done]] >= IN_WOOD and not in_cycle[done - 1]:
            return done
    return 0


class _Head:
    """What a resumed program says before the job goes on."""

    def __init__(self, machine: Machine, done: Sequence[str], run: Run, safe: float) -> None:
        """The run is that of the lines done, and is used up."""
        self.safe = safe
        self._begin, self._modes = run.origin, run.modes
        self._tools: ToolsInUse = tools_after(done)
        self._before: Coordinates = coordinates_of(machine.after([]))
        self._after: Coordinates = coordinates_of(run)

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
        """The modes with which the job's next line is read."""
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
