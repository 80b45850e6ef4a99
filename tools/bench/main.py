"""Measures what kinematics and firmware cost on the Mega and holds it against the budgets."""

import re
import sys
import tomllib

import board
import firmware
from board import Figures
from commands import ROOT, ToolError

NOTHING = "–"


Budgets = dict[str, dict[str, float]]  # for the first number of a figure: "most" or "least"


def main() -> int:
    """Print the table; 0 if every budget is kept, 1 if not, 2 if it cannot be measured."""
    try:
        figures, limits = board.measure() | firmware.measure(), budgets()
    except (ToolError, OSError) as error:
        print(f"bench: {error}", file=sys.stderr)
        return 2
    refused = over_budget(figures, limits)
    print(table(figures, limits), end="\n\n")
    print(*[f"bench: {line}" for line in refused] or ["bench: within all budgets"], sep="\n")
    return int(bool(refused))


def budgets() -> Budgets:
    """Return the budgets of this folder and of the build."""
    written = tomllib.loads((board.BENCH / "budgets.toml").read_text(encoding="utf-8"))
    build = (ROOT / "platformio.ini").read_text(encoding="utf-8")
    for name, row in (("maximum_size", firmware.FLASH), ("maximum_ram_size", firmware.RAM)):
        limit = re.findall(rf"^board_upload\.{name} = (\d+)$", build, re.MULTILINE)[0]
        written["most"][row] = int(limit)
    return written


def table(figures: Figures, budgets: Budgets) -> str:
    """Return all figures next to their budgets."""
    limits = budgets["most"] | budgets["least"]
    rows = [
        f"| {name} | {' / '.join(map(shown, figure))} | "
        f"{shown(limits[name]) if name in limits else NOTHING} |"
        for name, figure in figures.items()
    ]
    return "\n".join(["| the Mega | measured | budget |", "|---|---|---|", *rows])


def shown(value: float) -> str:
    """Return a number with its thousands apart, a share in percent."""
    return f"{value:.1%}" if 0 < value < 1 else f"{value:,.0f}"


def over_budget(figures: Figures, budgets: Budgets) -> list[str]:
    """Return one line for each budget that is not kept, or of which nothing is measured."""
    lines = []
    for side, sign in (("most", 1), ("least", -1)):
        for name, limit in budgets[side].items():
            if name not in figures:
                lines.append(f"{name}: has a budget, but no such case is measured")
            elif sign * figures[name][0] > sign * limit:
                lines.append(f"{name}: {shown(figures[name][0])}, the budget is {shown(limit)}")
    return lines


if __name__ == "__main__":
    sys.exit(main())
