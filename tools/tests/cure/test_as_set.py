"""Machines that are right already: calibrate leaves them as they are; machines that are off."""

from dataclasses import replace

import pytest
from plumb.bench.boards import plan
from plumb.bench.causes import MAKER
from plumb.cli.main import main
from plumb.cure.auto import add_auto
from plumb.fit.inputs import Inputs
from plumb.marks.read import Measurements
from plumb.settings.toml import write_machine_toml
from synthetic import csv_of, marks_on


def marks_of(true, seed):
    return marks_on(true, MAKER, plan(5, 3).targets, noise=0.5, seed=seed)


def answered(true, seed):
    measured = Measurements(marks_of(true, seed), (), tape_sigma=0.5, source="marks.toml")
    return add_auto(Inputs(MAKER, measured))


def test_a_machine_that_is_right_is_left_as_it_is():
    answers = [answered(MAKER, seed) for seed in range(10)]
    assert sum(not answer.is_good for answer in answers) <= 1
    assert all(answer.addition is None for answer in answers if answer.is_good)


@pytest.mark.parametrize("seed", range(4))
def test_a_machine_that_is_off_by_more_than_noise_is_not_called_good(seed):
    off = replace(MAKER, motor_gap=MAKER.motor_gap + 3.0)
    answer = answered(off, seed)
    assert not answer.is_good and answer.addition and answer.expected_mm < 0.3


def test_calibrate_says_that_nothing_is_to_be_done_and_ends(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    write_machine_toml("machine.toml", MAKER)
    (tmp_path / "marks.csv").write_text(csv_of(marks_of(MAKER, 1)))
    assert main(["calibrate", "machine.toml", "marks.csv"]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert said.endswith("Your machine is as good as these marks can show. Nothing to change.")
    assert "Over the sheet expect errors of 0." in said
    assert {each.name for each in tmp_path.iterdir()} == {"machine.toml", "marks.csv"}
