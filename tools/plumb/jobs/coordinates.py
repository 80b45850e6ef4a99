"""Where a program's coordinates begin: G54 to G59, the shift of G92, the tool's length."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from plumb.jobs.dry_run import Run

Place = tuple[float, float, float]
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
        """The lines that set them while the bit is at `place` [mm] of the machine.

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
    """The coordinates after a run, whose modes and coordinates this uses up."""
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
