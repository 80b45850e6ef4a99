"""The table of costs in CHANGELOG.md: written between two marks, and read back from there."""

import re
from collections.abc import Mapping

from costs import Bytes, Costs, Cycles

BEGIN = "<!-- costs: begin; written by tools/bench/run --write -->"
END = "<!-- costs: end -->"
CLOCK = 16_000  # cycles per millisecond
NOTHING = "–"

Published = Mapping[str, Mapping]


class TableError(Exception):
    """A CHANGELOG.md whose table cannot be found or read."""


def exact_part(costs: Costs, published: Published) -> str:
    """Return the figures of the board as two tables, the published firmware's comparison them."""
    cycles = [
        f"On the Mega at 16 MHz, {costs.compiler}, flags of platformio.ini: least / median / most.",
        "",
        "| cycles | Plumb | median | published firmware | ratio of medians |",
        "|---|---|---|---|---|",
    ]
    for name, row in costs.cycles.items():
        theirs = published["cycles"].get(name)
        comparison = f"{NOTHING} | {NOTHING}"
        if theirs:
            comparison = f"{several(theirs)} | {theirs[1] / row.median:.1f}"
        cycles.append(f"| {name} | {several(row)} | {row.median / CLOCK:.2f} ms | {comparison} |")
    sizes = [
        "",
        "| bytes | flash | static RAM | stack | published firmware |",
        "|---|---|---|---|---|",
    ]
    for name, row in costs.bytes.items():
        sizes.append(f"| {name} | {' | '.join(map(number, row))} | {theirs_of(published, name)} |")
    return "\n".join(cycles + sizes)


def host_part(times: Mapping[str, float], unit: float) -> str:
    """Return times on the computer [ns], also in multiply-adds [ns] of the same computer."""
    lines = [
        f"On the computer that wrote this, never compared; {unit:.2f} ns is a multiply-add there,",
        "each waiting for the one before it.",
        "",
        "| host | time | in multiply-adds |",
        "|---|---|---|",
    ]
    lines += [f"| {name} | {duration(ns)} | {ns / unit:,.0f} |" for name, ns in times.items()]
    return "\n".join(lines)


def theirs_of(published: Published, name: str) -> str:
    """Return the published firmware's bytes in words."""
    theirs = published["bytes"].get(name, {})
    return ", ".join(f"{kind} {number(theirs[kind])}" for kind in theirs) or NOTHING


def several(row: Cycles | list[int]) -> str:
    """Return numbers in one cell."""
    return " / ".join(map(number, row))


def number(value: int | None) -> str:
    """Return a number with its thousands apart, or a dash."""
    return NOTHING if value is None else f"{value:,}"


def duration(ns: float) -> str:
    """Return a time in the unit in which it has one to three digits before the point."""
    for size, unit in ((1e6, "ms"), (1e3, "us")):
        if ns >= size:
            return f"{ns / size:.3g} {unit}"
    return f"{ns:.3g} ns"


def replaced(text: str, table: str) -> str:
    """Return the text with another table between its marks."""
    before, _, after = cut(text)
    return f"{before}{BEGIN}\n{table}\n{END}{after}"


def recorded(text: str) -> Costs | None:
    """Return the exact figures in the table; None if it holds none yet."""
    _, table, _ = cut(text)
    compiler = re.search(r"avr-gcc \d+(\.\d+)*", table)
    if not compiler:
        return None
    cycles, sizes, kind = {}, {}, ""
    for line in table.splitlines():
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        if not line.startswith("|") or set(line) <= set("|- "):
            kind = kind if line.startswith("|") else ""
        elif not kind:
            kind = cells[0]
        elif kind == "cycles":
            cycles[cells[0]] = Cycles(*three(cells[1].split("/"), line))
        elif kind == "bytes":
            sizes[cells[0]] = Bytes(*three(cells[1:4], line))
    return Costs(compiler[0], cycles, sizes)


def three(cells: list[str], line: str) -> list[int | None]:
    """Return the numbers of a row, which has three of them."""
    if len(cells) != 3:
        raise TableError(f"CHANGELOG.md: a row has 3 numbers, in: {line}")
    return [read(cell, line) for cell in cells]


def read(cell: str, line: str) -> int | None:
    """Return a number of the table."""
    plain = cell.strip().replace(",", "")
    if plain == NOTHING:
        return None
    if not plain.isdecimal():
        raise TableError(f"CHANGELOG.md: {cell.strip()!r} is no number, in: {line}")
    return int(plain)


def cut(text: str) -> tuple[str, str, str]:
    """Return the text before the marks, between them and after them."""
    if text.count(BEGIN) != 1 or text.count(END) != 1 or text.index(BEGIN) > text.index(END):
        raise TableError(f"CHANGELOG.md must hold once, each on its own line: {BEGIN} and {END}")
    before, _, rest = text.partition(BEGIN)
    table, _, after = rest.partition(END)
    return before, table, after
