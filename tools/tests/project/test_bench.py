"""Tests of tools/bench: the table is read back as written, rises and budgets are noticed."""

import sys
from dataclasses import replace
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]
BENCH = ROOT / "tools/bench"
sys.path.insert(0, str(BENCH))
import main as bench  # noqa: E402
import registry  # noqa: E402
from record import BEGIN, END, Budgets, Costs, over_budget, recorded, replaced, risen  # noqa: E402
from record import table as table_of  # noqa: E402

COSTS = Costs(
    "avr-gcc 5.4.0",
    {"inverse, sag": (13_425, 13_622), "inverse, flash": (1966,), "an effect, flash": (-100,)},
    {"lines a second": (240.0,), "share of the time": (0.102,)},
)
BUDGETS = Budgets({"inverse, sag": 13_500, "share of the time": 0.12}, {"lines a second": 230})
EMPTY = f"# What changed\n\n{BEGIN}\n{END}\n\n- A line after.\n"


def written(costs: Costs, text: str = EMPTY) -> str:
    return replaced(text, table_of(costs, BUDGETS))


def with_figure(name: str, *figure: int) -> Costs:
    return replace(COSTS, recorded={**COSTS.recorded, name: figure})


def test_what_is_written_is_read_back():
    compiler, figures = recorded(written(COSTS))
    assert compiler == COSTS.compiler
    assert figures == COSTS.recorded | {"lines a second": (240,)}
    assert risen(COSTS, figures) == []


def test_a_second_writing_replaces_the_first_and_nothing_else():
    smaller = with_figure("inverse, sag", 2, 3)
    again = written(smaller, written(COSTS))
    assert recorded(again) == recorded(written(smaller))
    assert again.startswith("# What changed\n") and again.endswith("\n\n- A line after.\n")


@pytest.mark.parametrize(
    ("name", "figure", "lines"),
    [
        ("inverse, sag", (20, 30), []),
        ("inverse, sag", (13_693, 13_622), []),  # by less than 2 %
        (
            "inverse, sag",
            (13_694, 13_622),
            ["inverse, sag rose from 13,425 / 13,622 to 13,694 / 13,622"],
        ),
        (
            "inverse, sag",
            (13_425, 14_000),
            ["inverse, sag rose from 13,425 / 13,622 to 13,425 / 14,000"],
        ),
        ("inverse, flash", (2005,), []),
        ("inverse, flash", (2006,), ["inverse, flash rose from 1,966 to 2,006"]),
        ("an effect, flash", (-90,), ["an effect, flash rose from -100 to -90"]),
        ("inverse, mud", (1,), ["inverse, mud: measured, but not recorded"]),
    ],
)
def test_a_rise_is_told_in_one_line(name, figure, lines):
    assert risen(with_figure(name, *figure), recorded(written(COSTS))[1]) == lines


def test_a_case_that_vanished_is_told():
    fewer = replace(COSTS, recorded={"inverse, sag": (13_425, 13_622)})
    lines = risen(fewer, recorded(written(COSTS))[1])
    assert len(lines) == 2 and all("no longer measured" in line for line in lines)


def test_figures_of_another_compiler_are_not_compared(capsys):
    other = replace(with_figure("inverse, sag", 9**9, 9**9), compiler="avr-gcc 7.3.0")
    assert bench.against_record(other, *recorded(written(COSTS))) == []
    assert "avr-gcc 5.4.0 in CHANGELOG.md: not compared" in capsys.readouterr().out
    same = replace(other, compiler=COSTS.compiler)
    (line,) = bench.against_record(same, *recorded(written(COSTS)))
    assert line.endswith("if that is meant, record it: tools/bench/run --write")


@pytest.mark.parametrize(
    ("budgets", "lines"),
    [
        (BUDGETS, []),
        (Budgets({"inverse, sag": 13_424}, {}), ["inverse, sag: 13,425, the budget is 13,424"]),
        (Budgets({}, {"lines a second": 241}), ["lines a second: 240, the budget is 241"]),
        (Budgets({"mud": 9**9}, {}), ["mud: has a budget, but no such case is measured"]),
    ],
)
def test_what_is_over_its_budget_is_told(budgets, lines):
    assert over_budget(COSTS, budgets) == lines


def test_every_budget_is_of_a_row_in_the_record():
    text = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    budgets = bench.budgets()
    assert all(f"\n| {name} | " in text for name in (*budgets.most, *budgets.least))


def test_the_list_of_effects_is_shortened_and_an_effect_taken_out_wherever_it_stands():
    names = [*registry.numbers()]
    short, left_out = registry.only(["chain_sag", "chain_pitch"])
    assert registry.ENTRY.findall(short) == [("160", "ChainSag"), ("180", "ChainPitch")]
    assert left_out == len(names) - 2
    for name in (names[0], "chain_sag", names[-1]):
        numbers = [number for number, _ in registry.ENTRY.findall(registry.without(name))]
        assert len(numbers) == len(names) - 1 and str(registry.numbers()[name]) not in numbers
