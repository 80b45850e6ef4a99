"""Tests of tools/bench: figures stand beside their budgets, and what is over one is told."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "bench"))
import firmware
import main as bench
from main import over_budget, table

FIGURES = {
    "inverse, sag": (13_425, 13_622),
    "inverse, stack": (412,),
    "lines a second": (240.0,),
    "share of the time": (0.102,),
}
BUDGETS = {
    "most": {"inverse, sag": 13_500, "share of the time": 0.12},
    "least": {"lines a second": 230},
}


def test_a_figure_stands_beside_its_budget():
    rows = table(FIGURES, BUDGETS).splitlines()
    assert "| inverse, sag | 13,425 / 13,622 | 13,500 |" in rows
    assert "| share of the time | 10.2% | 12.0% |" in rows
    assert "| inverse, stack | 412 | – |" in rows


@pytest.mark.parametrize(
    ("changed", "lines"),
    [
        ({}, []),
        ({"most": {"inverse, sag": 13_424}}, ["inverse, sag: 13,425, the budget is 13,424"]),
        ({"least": {"lines a second": 241}}, ["lines a second: 240, the budget is 241"]),
        ({"most": {"mud": 9**9}}, ["mud: has a budget, but no such case is measured"]),
    ],
)
def test_a_figure_over_its_budget_is_reported(changed, lines):
    assert over_budget(FIGURES, BUDGETS | changed) == lines


def test_the_bench_reads_the_budgets_of_the_build():
    most = bench.budgets()["most"]
    assert (most[firmware.FLASH], most[firmware.RAM]) == (184_320, 5_632)


def test_static_ram_and_the_deepest_stack_with_a_quarter_fit_into_the_mega():
    assert bench.budgets()["most"]["static RAM, deepest stack and a quarter of it"] == 8_192
