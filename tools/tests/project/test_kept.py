"""Tests of tools/bench/kept.py: a simulation is run again whenever what it depends on changed."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "bench"))
import kept as simulations


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
