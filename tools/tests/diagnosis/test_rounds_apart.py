"""Rounds of marks or distances that do not go together: another sheet, chains hung again."""

from dataclasses import replace

import numpy as np
import pytest
from plumb.diagnosis import diagnose
from plumb.diagnosis.evidence import moved_rounds
from plumb.diagnosis.explanation import Board, explain
from plumb.diagnosis.outliers import MixedPair, find_mixed_up
from plumb.fit.inputs import Inputs
from plumb.fit.observations import model_and_observations
from plumb.marks.form import marks_toml
from plumb.marks.read import Measurements, Round, join_measurements
from plumb.settings.machine import machine_toml
from synthetic import BELIEVED, distances_between, grid, marks_on

PITCH = replace(BELIEVED, effects={"chain_pitch": {"left": 0.002, "right": 0.0005}})
SKIPPED = replace(PITCH, effects={**PITCH.effects, "chain_zero": {"left": 6.35, "right": 0.0}})


def rounds(second, seed=1, **how):
    """Nine marks of PITCH, then the same nine of another machine in a second file."""
    parts = [
        Measurements(
            marks_on(machine, BELIEVED, grid(3, 3), noise=0.5, seed=seed + i),
            source=f"{'ab'[i]}.toml",
            rounds=(Round(**(how if i else {})),),
        )
        for i, machine in enumerate((PITCH, second))
    ]
    return join_measurements(parts)


CHANGED = pytest.mark.parametrize(
    ("second", "flag"),
    [(SKIPPED, "chains_rezeroed"), (replace(PITCH, motor_center_x=4.0), "new_sheet")],
)


@CHANGED
def test_rounds_that_do_not_go_together_are_named_with_the_way_out(second, flag):
    diagnosis = diagnose(Inputs(BELIEVED, rounds(second), sigma=0.5))
    assert diagnosis.verdict == "not_in_library"
    assert len(diagnosis.disagreements) == 1
    assert diagnosis.disagreements[0].startswith("b does not go with the other rounds")
    assert "do not pool them" in diagnosis.disagreements[0]
    assert f"{flag} = true in b" in diagnosis.disagreements[0]


@CHANGED
def test_a_round_that_says_what_changed_goes_with_the_others(second, flag):
    diagnosis = diagnose(Inputs(BELIEVED, rounds(second, **{flag: True}), sigma=0.5))
    assert diagnosis.disagreements == ()
    assert (
        diagnosis.verdict in ("one_suspect", "cannot_tell") and "chain_pitch" in diagnosis.suspects
    )


def test_alike_rounds_raise_no_doubt():
    said = [
        diagnose(Inputs(BELIEVED, rounds(PITCH, seed), sigma=0.5)).disagreements
        for seed in range(9)
    ]
    assert said == [()] * 9


def test_the_doubt_about_a_round_is_printed(run, file):
    paths = [file("machine.toml", machine_toml(BELIEVED))]
    for i, machine in enumerate((PITCH, SKIPPED)):
        marks = marks_on(machine, BELIEVED, grid(3, 3), noise=0.5, seed=i)
        paths.append(file(f"{'ab'[i]}.toml", marks_toml(Measurements(marks, tape_sigma=0.5))))
    code, said, _ = run("diagnose", *paths)
    assert code == 1 and "b does not go with the other rounds" in said


SIGMA = 0.3


def file_of(name, machine, source):
    """All distances between twelve marks of a machine, each read with its noise."""
    exact = distances_between(marks_on(machine, BELIEVED, grid(4, 3)))
    read = tuple(
        replace(each, length=each.length + SIGMA * source.standard_normal())
        for each in exact.distances
    )
    return replace(exact, distances=read, source=f"{name}.toml")


def two_files(second, seed=1):
    source = np.random.default_rng(seed)
    return join_measurements([file_of("a", PITCH, source), file_of("b", second, source)])


def board_of(measurements):
    model, rows = model_and_observations(BELIEVED, measurements)
    return Board.of(model, rows, sigma=SIGMA)


def test_a_file_that_does_not_fit_the_other_is_named():
    diagnosis = diagnose(Inputs(BELIEVED, two_files(SKIPPED), sigma=SIGMA))
    assert diagnosis.verdict == "not_in_library" and diagnosis.outliers == ()
    (said,) = diagnosis.disagreements
    assert said.startswith("b does not go with the other rounds")
    assert "chains_rezeroed = true in b" in said
    alike = diagnose(Inputs(BELIEVED, two_files(PITCH), sigma=SIGMA))
    assert alike.disagreements == () and alike.suspects[:1] == ("chain_pitch",)


def test_a_change_between_files_moves_only_the_later_one():
    moves = moved_rounds(explain(board_of(two_files(PITCH))))
    assert {(move.number, move.cause) for move in moves} == {(1, "chains_rezeroed"), (1, "")}
    for move in moves:
        reach = np.abs(move.other.axes).reshape(2, 66, -1).max(axis=1)
        assert np.all(reach[0] < 1e-9) and np.all(reach[1] > 1e-3)
    alone = file_of("a", PITCH, np.random.default_rng(1))
    assert moved_rounds(explain(board_of(alone))) == []


@pytest.mark.parametrize("seed", range(4))
def test_a_change_between_files_is_not_called_an_exchange_of_readings(seed):
    assert find_mixed_up(board_of(two_files(SKIPPED, seed))).pairs == ()
    both = two_files(PITCH, seed)
    spans = list(both.distances)
    longest = max(range(66), key=lambda i: spans[i].length)
    first, second = spans[0], spans[longest]
    spans[0] = replace(first, length=second.length)
    spans[longest] = replace(second, length=first.length)
    mixed_up = find_mixed_up(board_of(replace(both, distances=tuple(spans))))
    assert mixed_up.pairs == (MixedPair(0, longest, is_mark=False),)
