"""Measures what kinematics and firmware cost and holds it against CHANGELOG.md and the budgets."""

import argparse
import re
import sys
import tomllib

import board
import firmware
from commands import ROOT, ToolError, output
from record import Budgets, Costs, over_budget, recorded, replaced, risen, table

CHANGELOG = ROOT / "CHANGELOG.md"


def main() -> int:
    """Measure; 0 if all may stand, 1 if not, 2 if it cannot be measured."""
    parser = argparse.ArgumentParser(prog="tools/bench/run", description=__doc__)
    parser.add_argument("--write", action="store_true", help="record the figures in CHANGELOG.md")
    wanted = parser.parse_args()
    try:
        return measure(write=wanted.write)
    except (ToolError, OSError) as error:
        print(f"bench: {error}", file=sys.stderr)
        return 2


def measure(*, write: bool) -> int:
    """Print the table; record it or compare it. 0 if it may stand."""
    text, limits = CHANGELOG.read_text(encoding="utf-8"), budgets()
    compiler = output("avr-gcc", "-dumpversion")
    sizes, timed = firmware.measure()
    if compiler not in output("avr-readelf", "-p", ".comment", board.FIRMWARE):
        print("bench: the firmware was built by another compiler: its size is not compared")
        sizes, timed = {}, sizes | timed
    costs = Costs(f"avr-gcc {compiler}", board.measure() | sizes, timed)
    shown = table(costs, limits)
    print(shown, end="\n\n")
    refused = over_budget(costs, limits)
    if write:
        CHANGELOG.write_text(replaced(text, shown), encoding="utf-8")
        print("bench: wrote the table in CHANGELOG.md")
    else:
        refused += against_record(costs, *recorded(text))
    print(*[f"bench: {line}" for line in refused] or ["bench: within record and budgets"], sep="\n")
    return int(bool(refused))


def against_record(costs: Costs, compiler: str, old: board.Figures) -> list[str]:
    """Return what rose, in one line; of another compiler's record only the budgets count."""
    if compiler != costs.compiler:
        print(f"bench: {costs.compiler} here, {compiler} in CHANGELOG.md: not compared")
        return []
    lines = risen(costs, old)
    more = f" (and {len(lines) - 1} more)" if len(lines) > 1 else ""
    remedy = "if that is meant, record it: tools/bench/run --write"
    return [f"{lines[0]}{more}; {remedy}"] if lines else []


def budgets() -> Budgets:
    """Return the budgets of this folder and of the build."""
    written = tomllib.loads((board.BENCH / "budgets.toml").read_text(encoding="utf-8"))
    build = (ROOT / "platformio.ini").read_text(encoding="utf-8")
    for name, row in (("maximum_size", firmware.FLASH), ("maximum_ram_size", firmware.RAM)):
        limit = re.findall(rf"^board_upload\.{name} = (\d+)$", build, re.MULTILINE)[0]
        written["most"][row] = int(limit)
    return Budgets(written["most"], written["least"])


if __name__ == "__main__":
    sys.exit(main())
