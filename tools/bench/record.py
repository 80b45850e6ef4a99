"""The table of costs in CHANGELOG.md, what rose above it, and what is over a budget."""

import re
from dataclasses import dataclass

from board import Figures
from commands import ToolError

BEGIN = "<!-- costs: begin; written by tools/bench/run --write -->"
END = "<!-- costs: end -->"
NOTHING = "–"
MOST_RISE = 0.02
NOTE = """\
By {compiler} with the flags of platformio.ini, on a simulated Mega at 16 MHz: 16,000 cycles are a
millisecond. Cycles: median and most over the sheet; the budget is for the median. An effect's flash
is what a board saves without it in the list; below zero the compiler then inlines more.

Short moves are streamed with 126 characters ahead, all three motors on; with three axes the worse
of this and one long move, where all three turn. Interrupts of the serial line and the encoders that
fall into a tick count as its own."""


@dataclass(frozen=True)
class Costs:
    """The same source and compiler give the same figures anywhere."""

    compiler: str
    recorded: Figures  # cycles and bytes, held against the record too
    timed: Figures  # how the firmware keeps time: held against the budgets alone


@dataclass(frozen=True)
class Budgets:
    """What the first number of a figure may be."""

    most: dict[str, float]
    least: dict[str, float]


def table(costs: Costs, budgets: Budgets) -> str:
    """Return all figures next to their budgets."""
    limits = budgets.most | budgets.least
    rows = [
        f"| {name} | {' / '.join(map(shown, figure))} | "
        f"{shown(limits[name]) if name in limits else NOTHING} |"
        for name, figure in (costs.recorded | costs.timed).items()
    ]
    head = ["| the Mega | measured | budget |", "|---|---|---|"]
    return "\n".join([NOTE.format(compiler=costs.compiler), "", *head, *rows])


def shown(value: float) -> str:
    """Return a number with its thousands apart, a share in percent."""
    return f"{value:.1%}" if 0 < value < 1 else f"{value:,.0f}"


def replaced(text: str, written: str) -> str:
    """Return the text with another table between its marks."""
    before, _, after = cut(text)
    return f"{before}{BEGIN}\n{written}\n{END}{after}"


def recorded(text: str) -> tuple[str, Figures]:
    """Return the compiler and the figures that the table holds, those in percent left out."""
    _, written, _ = cut(text)
    compiler = re.search(r"avr-gcc \d+(\.\d+)*", written)
    figures: Figures = {}
    for line in written.splitlines():
        name, *cells = (cell.strip() for cell in line.strip("|").split("|"))
        if not line.startswith("| ") or name == "the Mega" or cells[0].endswith("%"):
            continue
        numbers = cells[0].replace(",", "").split(" / ")
        if not all(re.fullmatch(r"-?\d+", number) for number in numbers):
            raise ToolError(f"CHANGELOG.md: {cells[0]!r} is no number, in: {line}")
        figures[name] = tuple(map(int, numbers))
    return compiler[0] if compiler else "no compiler", figures


def cut(text: str) -> tuple[str, str, str]:
    """Return the text before the marks, between them and after them."""
    if text.count(BEGIN) != 1 or text.count(END) != 1 or text.index(BEGIN) > text.index(END):
        raise ToolError(f"CHANGELOG.md must hold once, each on its own line: {BEGIN} and {END}")
    before, _, rest = text.partition(BEGIN)
    written, _, after = rest.partition(END)
    return before, written, after


def risen(costs: Costs, old: Figures) -> list[str]:
    """Return one line for each figure that rose too far above its record, vanished or was never
    recorded.
    """
    lost = [name for name in old if name not in costs.recorded | costs.timed]
    lines = [f"{name}: recorded, but no longer measured" for name in lost]
    for name, figure in costs.recorded.items():
        was = old.get(name)
        if was is None or len(was) != len(figure):
            lines.append(f"{name}: measured, but not recorded")
        elif any(now > then + MOST_RISE * abs(then) for then, now in zip(was, figure, strict=True)):
            numbers = (" / ".join(map(shown, each)) for each in (was, figure))
            lines.append(f"{name} rose from {' to '.join(numbers)}")
    return lines


def over_budget(costs: Costs, budgets: Budgets) -> list[str]:
    """Return one line for each budget that is not kept, or of which nothing is measured."""
    figures, lines = costs.recorded | costs.timed, []
    for limits, sign in ((budgets.most, 1), (budgets.least, -1)):
        for name, limit in limits.items():
            if name not in figures:
                lines.append(f"{name}: has a budget, but no such case is measured")
            elif sign * figures[name][0] > sign * limit:
                lines.append(f"{name}: {shown(figures[name][0])}, the budget is {shown(limit)}")
    return lines
