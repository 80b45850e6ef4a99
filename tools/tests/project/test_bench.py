"""Tests of tools/bench: figures beside their budgets; a simulation runs again when it has to."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "bench"))
import firmware
import kept as simulations
import main as bench
from main import over_budget, table

FIGURES = {"inverse, sag": (13_425, 13_622), "inverse, stack": (412,), "lines a second": (240.0,)}
FIGURES |= {"share of the time": (0.102,)}
MOST = {"inverse, sag": 13_500, "share of the time": 0.12}
BUDGETS = {"most": MOST, "least": {"lines a second": 230}}


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


@pytest.fixture
def simulation(tmp_path, monkeypatch):
    """A program that notes each run and says what its dialogue says; fails without a dialogue."""
    monkeypatch.setattr(simulations, "KEPT", tmp_path / "kept")
    program, dialogue = tmp_path / "player", tmp_path / "a.nc"
    program.write_text('#!/bin/sh\necho run >>"$1.runs"\ncat "$1"\n')
    program.chmod(0o755)
    dialogue.write_text("hello")
    return program, dialogue


def said(program, dialogue, *arguments):
    """Its exit code, its output, and the number of runs so far."""
    done = simulations.kept([program, dialogue, *arguments], [dialogue], dialogue.name)
    runs = Path(f"{dialogue}.runs").read_text().count("run")
    return done.returncode, done.stdout, runs


def test_an_unchanged_simulation_is_not_run_twice(simulation):
    assert said(*simulation) == said(*simulation) == (0, "hello", 1)


def test_a_changed_simulation_is_run_again(simulation):
    program, dialogue = simulation
    said(program, dialogue)
    dialogue.write_text("goodbye")
    assert said(program, dialogue) == (0, "goodbye", 2)
    assert said(program, dialogue, "longer") == (0, "goodbye", 3)
    program.write_text(program.read_text() + "echo .\n")
    assert said(program, dialogue, "longer") == (0, "goodbye.\n", 4)


def test_a_failed_simulation_is_run_again(simulation):
    program, dialogue = simulation
    program.write_text(program.read_text() + "exit 1\n")
    assert [said(program, dialogue)[::2] for _ in range(2)] == [(1, 1), (1, 2)]
