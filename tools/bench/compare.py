"""Whether the figures may stand: against the recorded figures, and against the budgets."""

from collections.abc import Mapping

from costs import Costs

MOST_RISE = 0.02


def risen(now: Costs, recorded: Costs | None) -> list[str]:
    """Return one line for each figure that rose too far above its record, vanished or was never
    recorded.

    Figures of different compilers are not compared.
    """
    if recorded is None:
        return ["CHANGELOG.md has no table of costs"]
    if now.compiler != recorded.compiler:
        return []
    old, new = recorded.figures(), now.figures()
    lines = []
    for name in old | new:
        if name not in new:
            lines.append(f"{name}: recorded, but no longer measured")
        elif name not in old:
            lines.append(f"{name}: measured, but not recorded")
        elif new[name] > old[name] * (1 + MOST_RISE):
            rise = percent(old, new, name)
            lines.append(f"{name} rose from {old[name]:,} to {new[name]:,}{rise}")
    return lines


def percent(old: Mapping[str, int], new: Mapping[str, int], name: str) -> str:
    """Return the rise in per cent, where there is something to divide by."""
    return f" ({new[name] / old[name] - 1:+.1%})" if old[name] else ""


def over_budget(now: Costs, budgets: Mapping[str, int]) -> list[str]:
    """Return one line for each case whose median is over its budget, or that does not exist."""
    lines = []
    for name, most in budgets.items():
        if name not in now.cycles:
            lines.append(f"{name}: has a budget, but no such case is measured")
        elif now.cycles[name].median > most:
            median = now.cycles[name].median
            lines.append(f"{name}: {median:,} cycles, the budget is {most:,}")
    return lines
