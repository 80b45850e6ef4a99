"""Several files of the same distances: each reading belongs to its file."""

from dataclasses import replace

import numpy as np
import pytest
from plumb.diagnosis import diagnose
from plumb.diagnosis.explanation import Board, explain
from plumb.diagnosis.linear import moved_rounds
from plumb.diagnosis.outliers import MixedPair, find_mixed_up
from plumb.fit.inputs import Inputs
from plumb.fit.observations import model_and_observations
from plumb.marks.read import join_measurements
from synthetic import BELIEVED, distances_between, grid, marks_on

SIGMA = 0.3
PITCH = replace(BELIEVED, effects={"chain_pitch": {"left": 0.002, "right": 0.0005}})
SKIPPED = replace(PITCH, effects={**PITCH.effects, "chain_zero": {"left": 6.35, "right": 0.0}})


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
