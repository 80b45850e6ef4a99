"""Several files of the same distances: each reading belongs to its file."""

from dataclasses import replace

import numpy as np
import pytest
from plumb.diagnosis import diagnose
from plumb.diagnosis.clean import clear_repeats, twins_that_agree
from plumb.diagnosis.doubts import round_warnings
from plumb.diagnosis.explanation import KNOWN, Board, explain
from plumb.diagnosis.noise import Noise, distance_spread, repeated_distances
from plumb.diagnosis.outliers import MixedPair, Reading, find_mixed_up, without
from plumb.diagnosis.weighing import rounds_columns
from plumb.fit.inputs import Inputs, Stated
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


@pytest.mark.parametrize("seed", range(4))
def test_a_file_that_does_not_go_with_the_other_is_named(seed):
    noise = Noise(SIGMA, KNOWN, "stated")
    torn = explain(board_of(two_files(SKIPPED, seed)), ("chain_pitch",))
    (said,) = round_warnings(torn, noise, ["a", "b"])
    assert said.startswith("b does not go with the other rounds")
    assert "chains_rezeroed = true in b" in said
    alike = explain(board_of(two_files(PITCH, seed)), ("chain_pitch",))
    assert round_warnings(alike, noise, ["a", "b"]) == []


def test_what_changed_between_files_moves_the_later_alone():
    frame = explain(board_of(two_files(PITCH)))
    columns, count = rounds_columns(frame), len(frame.board.rows.distances)
    assert count == 132
    assert not columns[: count // 2].any() and columns[count // 2 :].any()
    assert rounds_columns(explain(board_of(file_of("a", PITCH, np.random.default_rng(1))))) is None


def test_a_distance_repeats_those_of_its_file_and_of_others():
    rows = board_of(two_files(PITCH)).rows
    assert repeated_distances(rows) == [[i, i + 66] for i in range(66)]
    assert repeated_distances(rows, in_a_round=True) == []
    assert distance_spread(rows).degrees == 66
    assert distance_spread(rows).sigma == pytest.approx(SIGMA, rel=0.25)


def test_what_changed_between_files_is_no_slip():
    both = two_files(PITCH)
    changed = replace(both.distances[-1], length=both.distances[-1].length + 9.0)
    board = board_of(replace(both, distances=(*both.distances[:-1], changed)))
    assert clear_repeats(board, Stated(SIGMA)).outliers == ()
    confirmed = twins_that_agree(board.rows, SIGMA)
    assert Reading(0, False) in confirmed and Reading(131, False) not in confirmed
    # Read twice in a file, it is.
    again = replace(changed, length=changed.length - 9.0)
    board = board_of(replace(both, distances=(*both.distances[:-1], changed, again)))
    (slip,) = clear_repeats(board, Stated(SIGMA)).outliers
    assert slip.reading.index in (131, 132)


@pytest.mark.parametrize("seed", range(4))
def test_what_changed_between_files_is_no_exchange_of_readings(seed):
    assert find_mixed_up(board_of(two_files(SKIPPED, seed))).pairs == ()
    both = two_files(PITCH, seed)
    spans = list(both.distances)
    longest = max(range(66), key=lambda i: spans[i].length)
    first, second = spans[0], spans[longest]
    spans[0] = replace(first, length=second.length)
    spans[longest] = replace(second, length=first.length)
    mixed_up = find_mixed_up(board_of(replace(both, distances=tuple(spans))))
    assert mixed_up.pairs == (MixedPair(0, longest, is_mark=False),)


def test_a_file_that_does_not_go_with_the_other_is_no_slip():
    diagnosis = diagnose(Inputs(BELIEVED, two_files(SKIPPED), sigma=SIGMA))
    assert diagnosis.verdict == "not_in_library" and diagnosis.outliers == ()
    assert diagnosis.disagreements[0].startswith("b does not go with the other rounds")


def test_a_distance_that_is_left_out_takes_its_file_along():
    rows = board_of(two_files(PITCH)).rows
    rest = without(rows, Reading(3, False))
    assert rest.distance_rounds.tolist() == [0] * 65 + [1] * 66
    assert len(rest.distances) == len(rest.distance_rows) == 131
