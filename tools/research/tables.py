"""What generated pages share: tables and numbers."""

from __future__ import annotations

from collections.abc import Sequence


def markdown_table(header: Sequence[str], rows: Sequence[Sequence[object]]) -> str:
    """Return a table in Markdown."""
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join(f"| {' | '.join(map(str, line))} |" for line in lines)


def mm(value: float | None) -> str:
    """Return a length [mm] with two decimals; a dash where there is none."""
    if value is None:
        return "-"
    return f"{value + 0.0:.2f}"


def percent(strain: float | None) -> str:
    """Return a strain in percent with two decimals; a dash where there is none."""
    if strain is None:
        return "-"
    return f"{100 * strain + 0.0:.2f}"
