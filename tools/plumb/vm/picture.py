"""The virtual machine on a screen of characters: the sheet, its marks and the sled."""

from __future__ import annotations

from rich.text import Text

from plumb._vm import VirtualMachine

WIDTH, HEIGHT = 2438.4, 1219.2  # [mm] of the sheet
COLUMNS, ROWS = 72, 18  # characters are twice as high as wide


class VmPicture:
    """What rich draws, drawn again each time."""

    def __init__(self, machine: VirtualMachine) -> None:
        self._machine = machine

    def __rich__(self) -> Text:
        """The picture as it is now."""
        machine = self._machine
        grid = [[" "] * COLUMNS for _ in range(ROWS)]
        for _, _, x, y, _ in machine.cuts():
            _put(grid, x, y, ".")
        _put(grid, *machine.sled, "O" if machine.height > 0 else "X")
        left, right = machine.tensions
        lines = [
            "+" + "-" * COLUMNS + "+",
            *("|" + "".join(row) + "|" for row in grid),
            "+" + "-" * COLUMNS + "+",
            f"x {machine.sled[0]:8.1f}  y {machine.sled[1]:8.1f}  z {machine.height:6.2f} mm   "
            f"pull {left:4.0f} and {right:4.0f} N   {machine.seconds:7.0f} s",
        ]
        return Text("\n".join(lines))


def _put(grid: list[list[str]], x: float, y: float, sign: str) -> None:
    column = int((x / WIDTH + 0.5) * COLUMNS)
    row = int((0.5 - y / HEIGHT) * ROWS)
    if 0 <= column < COLUMNS and 0 <= row < ROWS:
        grid[row][column] = sign
