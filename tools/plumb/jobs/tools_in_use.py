"""What lines of a program switch: spindle and laser, drilling cycles, coordinates."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from plumb.jobs.dry_run import pieces

SPINDLE = {3.0: "M3", 4.0: "M4", 5.0: "", 2.0: "", 30.0: "", 6.0: ""}  # by the number of the M
LASER = {106.0: True, 107.0: False, 2.0: False, 30.0: False}
DECLARES = (92.0, 92.1, 92.2, 92.3, 43.1)  # G codes that move the program's coordinates
CYCLES = (81.0, 82.0, 83.0)
MOTIONS = (0.0, 1.0, 2.0, 3.0, 80.0)  # each ends a cycle
SPEED = "S"
STRONGEST = 255.0  # of a laser without an S


@dataclass(frozen=True)
class ToolsInUse:
    """What turns or shines."""

    spindle: str  # M3, M4 or nothing
    laser: bool
    speed: float | None  # the last S
    declares: bool  # G92, G43.1 or G10: where coordinates begin is the program's choice

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


def tools_after(lines: Sequence[str]) -> ToolsInUse:
    """What is on after these lines."""
    spindle, laser, speed, declares = "", False, None, False
    for line in lines:
        for letter, code, words in pieces(line):
            code = round(code, 1)
            if SPEED in words and not (letter == "G" and code == 4.0):
                speed = words[SPEED]
            if letter == "M":
                spindle = SPINDLE.get(code, spindle)
                laser = LASER.get(code, laser)
            if letter == "M" and code == 106.0 and SPEED not in words:
                speed = STRONGEST
            if letter == "G" and (code in DECLARES or (code == 10.0 and "L" in words)):
                declares = True
    return ToolsInUse(spindle, laser, speed, declares)


def cycles_after(lines: Sequence[str]) -> list[bool]:
    """Whether a drilling cycle is in force after each line."""
    in_force, result = False, []
    for line in lines:
        for letter, code, _ in pieces(line):
            if letter == "G":
                in_force = code in CYCLES or (in_force and code not in MOTIONS)
            in_force = in_force and not (letter == "M" and code in (2.0, 30.0))
        result.append(in_force)
    return result
