"""Machines that are right already: calibrate leaves them as they are; machines that are off."""

import numpy as np
import pytest
from plumb.bench.boards import TrueMachine, chains_for, plan
from plumb.bench.causes import MAKER, Hidden
from plumb.cli.main import main
from plumb.cure.decision import decide
from plumb.fit.inputs import Inputs
from plumb.marks.read import Mark, Measurements
from plumb.settings.toml import write_machine_toml
from synthetic import csv_of

PLAN = plan(5, 3)
NOISE = 0.5  # [mm]


def marks_of(wider, seed):
    """Tape readings of fifteen marks where the motors stand farther apart [mm] than is set."""
    machine = TrueMachine(Hidden(), motor_gap=MAKER.motor_gap + wider)
    chains = chains_for(PLAN, MAKER)
    where = machine.read(chains, approaches=PLAN.approaches, weights=PLAN.sled_weights)
    read = where + NOISE * np.random.default_rng(seed).standard_normal(where.shape)
    return tuple(
        Mark(str(i), tuple(target), tuple(place), approach=tuple(approach))
        for i, (target, place, approach) in enumerate(
            zip(PLAN.targets.tolist(), read.tolist(), PLAN.approaches.tolist(), strict=True)
        )
    )


def answered(wider, seed):
    measured = Measurements(marks_of(wider, seed), (), tape_sigma=NOISE, source="marks.toml")
    return decide(Inputs(MAKER, measured))


def good_of(wider, count):
    """How many of so many machines are called good."""
    return sum(answered(wider, seed).state == "good" for seed in range(count))


def test_a_machine_that_is_off_is_not_called_good():
    answer = answered(3.0, 1)
    assert answer.state != "good" and answer.addition and answer.expected_mm < 0.3


@pytest.mark.slow
def test_of_a_hundred_machines_few_are_misjudged(capsys):
    """How many are called good stands on the page of plumb calibrate."""
    good = {wider: good_of(wider, 100) for wider in (0.0, 1.0, 2.0)}
    with capsys.disabled():
        print(f"\n  called good of 100, by how much wider the motors stand [mm]: {good}")
    assert good[0.0] >= 95 and good[1.0] <= 5 and good[2.0] == 0


def test_calibrate_ends_when_there_is_nothing_to_do(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    write_machine_toml("machine.toml", MAKER)
    (tmp_path / "marks.csv").write_text(csv_of(marks_of(0.0, 1)))
    assert main(["calibrate", "machine.toml", "marks.csv"]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert said.endswith("Your machine is as good as these marks can show. Nothing to change.")
    assert "Over the sheet expect errors of 0." in said
    assert {each.name for each in tmp_path.iterdir()} == {"machine.toml", "marks.csv"}
