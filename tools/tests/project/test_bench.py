"""Tests of tools/bench: the table is read back as written, rises and budgets are noticed."""

import sys
import tomllib
from dataclasses import replace
from pathlib import Path

import pytest

BENCH = Path(__file__).resolve().parents[2] / "bench"
sys.path.insert(0, str(BENCH))
import absent  # noqa: E402
import compare  # noqa: E402
import registry  # noqa: E402
import table  # noqa: E402
from costs import Bytes, Costs, Cycles  # noqa: E402

COSTS = Costs(
    "avr-gcc 5.4.0",
    {
        "inverse, sag": Cycles(13_195, 13_425, 13_622),
        "forward, no guess": Cycles(38_693, 40_000, 1_058_852),
    },
    {"inverse": Bytes(1966, 0, 171), "constants": Bytes(None, 120, None)},
)
PUBLISHED = {
    "cycles": {"inverse, sag": [28_545, 30_597, 31_434]},
    "bytes": {"inverse": {"flash": 1738, "stack": 81}},
}
EMPTY = f"# What changed\n\n{table.BEGIN}\n{table.END}\n\n- A line after.\n"


def written(costs: Costs) -> str:
    shown = table.exact_part(costs, PUBLISHED) + "\n\n" + table.host_part({"fit": 4.2e6}, 1.5)
    return table.replaced(EMPTY, shown)


def with_cycles(name: str, *cycles: int) -> Costs:
    return replace(COSTS, cycles={**COSTS.cycles, name: Cycles(*cycles)})


def with_bytes(name: str, *sizes: int | None) -> Costs:
    return replace(COSTS, bytes={**COSTS.bytes, name: Bytes(*sizes)})


def test_what_is_written_is_read_back():
    assert table.recorded(written(COSTS)) == COSTS


@pytest.mark.parametrize(
    "text",
    ["", table.BEGIN, f"{table.END}\n{table.BEGIN}", EMPTY + EMPTY],
    ids=["none", "no end", "wrong order", "twice"],
)
def test_lost_marks_are_refused(text):
    with pytest.raises(table.TableError, match="must hold once"):
        table.replaced(text, "")


@pytest.mark.parametrize("cell", ["13,195 / many / 13,622", "13,195 / -1 / 13,622"])
def test_a_spoilt_number_is_named(cell):
    spoilt = written(COSTS).replace("13,195 / 13,425 / 13,622", cell)
    with pytest.raises(table.TableError, match=r"is no number, in: \| inverse, sag"):
        table.recorded(spoilt)


@pytest.mark.parametrize(
    "now",
    [
        COSTS,
        with_cycles("inverse, sag", 10, 20, 30),
        with_cycles("inverse, sag", 13_195, 13_693, 13_622),
        with_bytes("inverse", 2005, 0, 174),
    ],
    ids=["same", "smaller", "2 % more cycles", "2 % more bytes"],
)
def test_small_rises_and_all_falls_are_fine(now):
    assert compare.risen(now, COSTS) == []


@pytest.mark.parametrize(
    ("now", "line"),
    [
        (
            with_cycles("inverse, sag", 13_195, 13_694, 13_622),
            "inverse, sag: median cycles rose from 13,425 to 13,694 (+2.0%)",
        ),
        (
            with_cycles("inverse, sag", 14_000, 13_425, 13_622),
            "inverse, sag: least cycles rose from 13,195 to 14,000 (+6.1%)",
        ),
        (
            with_cycles("forward, no guess", 38_693, 40_000, 1_100_000),
            "forward, no guess: most cycles rose from 1,058,852 to 1,100,000 (+3.9%)",
        ),
        (
            with_bytes("inverse", 2006, 0, 171),
            "inverse: flash bytes rose from 1,966 to 2,006 (+2.0%)",
        ),
        (with_bytes("inverse", 1966, 1, 171), "inverse: ram bytes rose from 0 to 1"),
        (
            with_bytes("inverse", 1966, 0, 175),
            "inverse: stack bytes rose from 171 to 175 (+2.3%)",
        ),
        (
            with_bytes("inverse", 1966, 0, None),
            "inverse: stack bytes: recorded, but no longer measured",
        ),
        (
            with_bytes("constants", 7, 120, None),
            "constants: flash bytes: measured, but not recorded",
        ),
    ],
)
def test_a_rise_is_told_in_one_line(now, line):
    assert compare.risen(now, COSTS) == [line]


@pytest.mark.parametrize(
    ("budgets", "lines"),
    [
        ({"inverse, sag": 13_425, "forward, no guess": 40_000}, []),
        ({"inverse, sag": 13_424}, ["inverse, sag: 13,425 cycles, the budget is 13,424"]),
        ({"inverse, mud": 9**9}, ["inverse, mud: has a budget, but no such case is measured"]),
    ],
)
def test_a_median_over_its_budget_is_told(budgets, lines):
    assert compare.over_budget(COSTS, budgets) == lines


def test_budgets_and_published_figures_are_of_cases_that_exist():
    files = ["cases.h", "quadrilateral_cases.h", "motion_cases.h"]
    cases = registry.cases()
    cases += "".join((BENCH / name).read_text(encoding="utf-8") for name in files)
    tables = {path.stem: tomllib.loads(path.read_text()) for path in BENCH.glob("*.toml")}
    names = [*tables["budgets"], *tables["published"]["cycles"]]
    names.remove(absent.ROW)  # worked out from two builds, not a separate case
    assert names and all(f'{{"{name}", ' in cases for name in names)
