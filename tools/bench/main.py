"""Measures what kinematics and firmware cost and holds it against CHANGELOG.md and the budgets."""

import argparse
import sys
import tomllib

import absent
import board
import compare
import deepest
import effects
import firmware
import host
import table
from commands import ToolError
from costs import Costs

CHANGELOG = board.ROOT / "CHANGELOG.md"


def main() -> int:
    parser = argparse.ArgumentParser(prog="tools/bench/run", description=__doc__)
    parser.add_argument("--write", action="store_true", help="record the figures in CHANGELOG.md")
    parser.add_argument(
        "--deepest",
        action="store_true",
        help="search the lines that take the most stack, 6 minutes",
    )
    wanted = parser.parse_args()
    try:
        if wanted.deepest:
            return deepest.search()
        return measure(write=wanted.write)
    except (ToolError, table.TableError, OSError) as error:
        print(f"bench: {error}", file=sys.stderr)
        return 2


def measure(*, write: bool) -> int:
    """Print the table; records it or compares it. 0 if it may stand."""
    text = CHANGELOG.read_text(encoding="utf-8")
    costs = board.measure()
    costs.cycles[absent.ROW] = absent.cost(costs.cycles[absent.CASE])
    shown = table.exact_part(costs, load("published.toml"))
    shown += "\n\n" + table.host_part(*host.measure(host.ROUNDS if write else 1))
    print(shown, end="\n\n")
    whole = firmware.measure()
    print(firmware.table(whole), end="\n\n")
    refused = compare.over_budget(costs, load("budgets.toml")) + firmware.over_budget(whole)
    if write:
        text = effects.replaced(table.replaced(text, shown), effects.table(costs))
        text = firmware.replaced(text, firmware.table(whole))
        CHANGELOG.write_text(text, encoding="utf-8")
        print("bench: wrote the table in CHANGELOG.md")
    else:
        refused += against_record(costs, table.recorded(text))
    print(*[f"bench: {line}" for line in refused] or ["bench: within record and budgets"], sep="\n")
    return int(bool(refused))


def against_record(costs: Costs, recorded: Costs | None) -> list[str]:
    """Return what rose, in one line; says so where nothing can be compared."""
    if recorded and recorded.compiler != costs.compiler:
        print(f"bench: {costs.compiler} here, {recorded.compiler} in CHANGELOG.md: not compared")
    elif recorded and "whole firmware" not in costs.bytes:
        print("bench: the firmware was built by another compiler: its size is not compared")
        recorded.bytes.pop("whole firmware", None)
    risen = compare.risen(costs, recorded)
    if not risen:
        return []
    more = f" (and {len(risen) - 1} more)" if len(risen) > 1 else ""
    return [f"{risen[0]}{more}; if that is meant, record it: tools/bench/run --write"]


def load(name: str) -> dict:
    """Return a table of this folder."""
    return tomllib.loads((board.BENCH / name).read_text(encoding="utf-8"))


if __name__ == "__main__":
    sys.exit(main())
