"""Readings that are wrong: slips, exchanged numbers, rounds that do not go together; and bumps."""

import re
from dataclasses import replace

import numpy as np
import pytest
from boards import cut
from plumb.cure.add import add
from plumb.cure.decision import decide
from plumb.diagnosis import diagnose
from plumb.diagnosis.evidence import Reading, moved_rounds
from plumb.diagnosis.explanation import Board, explain
from plumb.diagnosis.readings import MixedPair, Shift, described, find_mixed_up, look_over
from plumb.fit.inputs import Inputs
from plumb.fit.observations import model_and_observations
from plumb.hidden import MAKER, Hidden, causes_of, plan
from plumb.marks.form import marks_toml
from plumb.marks.read import Distance, Mark, Measurements, Round, join_measurements
from plumb.settings import machine_toml
from plumb.words.verdict import sentence
from synthetic import BELIEVED, distances_between, grid, marks_on, read_elsewhere

LONG_CHAIN, STRETCH = causes_of("chain_pitch")[1], causes_of("chain_stretch")[0]
TWO = Hidden(((LONG_CHAIN, 1.5), (STRETCH, 1.5)))


@pytest.mark.parametrize("length", [5.0, 30.0])
def test_two_hidden_effects_hide_no_slip(length):
    board = cut(TWO, plan(5, 5), seed=11, noise=0.4, tape_sigma=0.4)
    slipped = read_elsewhere(board.measurements, 6, (0.6 * length, 0.8 * length))
    diagnosis = diagnose(Inputs(MAKER, slipped))
    assert diagnosis.verdict == "slip"
    assert [slip.name for slip in diagnosis.outliers] == [slipped.marks[6].name]
    assert diagnosis.outliers[0].offset == pytest.approx((0.6 * length, 0.8 * length), abs=1.5)
    assert "if it stays, it is the machine there" in diagnosis.outliers[0].sentence


@pytest.mark.parametrize("seed", range(2))
def test_a_bump_of_several_marks_is_not_a_slip_and_its_place_is_named(seed):
    board = cut(Hidden(outside="bump", outside_mm=1.0), plan(5, 5), seed=seed)
    diagnosis = diagnose(Inputs(MAKER, board.measurements))
    assert diagnosis.verdict == "not_in_library" and not diagnosis.outliers
    (said,) = [each for each in diagnosis.warnings if "no effect draws" in each]
    place = [float(number) for number in re.search(r"x (-?\d+) mm, y (-?\d+) mm", said).groups()]
    places = np.array([(x, y) for x in range(-1200, 1201, 50) for y in range(-600, 601, 50)])
    middle = places[np.argmax(np.sum(board.machine.field(places) ** 2, axis=1))]
    assert np.all(np.abs(place - middle) < 0.4 * np.array([1200, 600]))


@pytest.mark.parametrize("names", [("chain_plane", "sled_swing"), ("chain_stretch", "sheet_skew")])
def test_two_effects_are_named_beside_a_bump(names):
    causes = tuple((causes_of(name)[0], 2.5) for name in names)
    hidden = Hidden(causes, outside="bump", outside_mm=0.7)
    board = cut(hidden, plan(5, 5), seed=2, noise=0.2, tape_sigma=0.2)
    diagnosis = diagnose(Inputs(MAKER, board.measurements))
    assert {*diagnosis.likely} >= {*names} and diagnosis.is_finding


def test_an_error_confirmed_by_a_later_round_is_not_a_slip():
    board = cut(Hidden(), plan(5, 5), seed=2, noise=0.4, tape_sigma=0.4)
    slipped = read_elsewhere(board.measurements, 7, (5.0, 0.0))
    assert diagnose(Inputs(MAKER, slipped)).verdict == "slip"
    seen = tuple(np.add(slipped.marks[7].measured, (0.3, -0.2)))
    again = replace(slipped.marks[7], measured=seen, round=1)
    twice = Measurements((*slipped.marks, again), tape_sigma=0.4, rounds=(Round(), Round()))
    diagnosis = diagnose(Inputs(MAKER, twice))
    assert diagnosis.verdict == "not_in_library" and not diagnosis.outliers
    said = " ".join(diagnosis.warnings)
    assert f"{again.name} stays" in said and "it is the machine there" in said


TWICE = Hidden(((causes_of("chain_pitch")[1], 1.5), (causes_of("chain_stretch")[0], 0.8)))


@pytest.mark.parametrize("tape_sigma", [None, 0.4])
def test_a_slip_in_a_repeat_does_not_count_as_noise(tape_sigma):
    board = cut(TWICE, plan(5, 5, repeats=True), seed=3, noise=0.4, tape_sigma=tape_sigma)
    slipped = read_elsewhere(board.measurements, len(board.measurements.marks) - 2, (10.0, 0.0))
    diagnosis = diagnose(Inputs(MAKER, slipped))
    assert diagnosis.verdict == "slip" and diagnosis.noise.sigma < 0.6
    assert [slip.name for slip in diagnosis.outliers] == [slipped.marks[-2].name]
    assert diagnosis.outliers[0].length == pytest.approx(10, abs=1.5)
    assert "disagrees with its repeats" in sentence(diagnosis)
    assert decide(Inputs(MAKER, slipped)).addition is None


def test_an_addition_that_was_asked_for_says_what_disagrees():
    board = cut(Hidden(), plan(5, 5, repeats=True), seed=3, noise=0.4, tape_sigma=None)
    slipped = read_elsewhere(board.measurements, -1, (0.0, 10.0))
    addition = add(Inputs(MAKER, slipped), effects=["chain_sag"])
    assert addition.sigma_from == "marks" and addition.after_fit.sigma < 0.6
    assert any(said.startswith("remeasure mark") for said in addition.warnings)


def test_two_slips_do_not_hide_each_other():
    board = cut(Hidden(), plan(5, 5), seed=3, noise=0.4, tape_sigma=0.4)
    slipped = read_elsewhere(read_elsewhere(board.measurements, 5, (8.0, 0.0)), 19, (-5.0, 6.0))
    diagnosis = diagnose(Inputs(MAKER, slipped))
    assert diagnosis.verdict == "slip"
    assert {slip.name for slip in diagnosis.outliers} == {slipped.marks[i].name for i in (5, 19)}


def test_of_two_readings_the_one_off_the_frame_is_named_and_both_are_doubted():
    board = cut(Hidden(), plan(5, 5, times=2), seed=4, noise=0.4, tape_sigma=None)
    diagnosis = diagnose(Inputs(MAKER, read_elsewhere(board.measurements, 30, (6.0, 0.0))))
    assert diagnosis.verdict == "slip" and len(diagnosis.outliers) == 1
    assert diagnosis.outliers[0].offset[0] == pytest.approx(6, abs=1.5)
    assert "its other reading may be the wrong one" in diagnosis.outliers[0].sentence


def test_repeated_distances_are_checked_too():
    board = cut(Hidden(), plan(3, 3, spans=True, repeats=True), seed=4, noise=0.4, tape_sigma=0.4)
    spans = list(board.measurements.distances)
    spans[-1] = Distance(spans[-1].between, spans[-1].length + 9.0)
    diagnosis = diagnose(Inputs(MAKER, replace(board.measurements, distances=tuple(spans))))
    assert diagnosis.verdict == "slip" and diagnosis.noise.sigma < 0.6
    assert diagnosis.outliers[0].name == " - ".join(spans[-1].between)
    assert diagnosis.outliers[0].offset[0] == pytest.approx(9, abs=1.5)


def plain_board(columns=5, rows=3):
    return Measurements(marks_on(BELIEVED, BELIEVED, grid(columns, rows), noise=0.3))


def doubts(measurements, **how):
    return look_over(Inputs(BELIEVED, measurements, **how))


@pytest.mark.parametrize("sigma", [None, 0.3])
def test_a_reading_that_no_machine_explains_is_named_with_its_row(sigma):
    assert doubts(plain_board(), sigma=sigma) == ()
    (doubt,) = doubts(read_elsewhere(plain_board(), 8, (31.0, -22.0)), sigma=sigma)
    assert (doubt.index, doubt.is_mark) == (8, True)
    assert doubt.off == pytest.approx(np.hypot(31.0, 22.0), abs=2.0)
    assert doubt.sentence.startswith("it reads 38") and "remeasure" not in doubt.sentence


def test_a_reading_half_a_sheet_away_is_named_first_and_the_rest_is_looked_at_without_it():
    twice = read_elsewhere(read_elsewhere(plain_board(), 3, (700.0, 0.0)), 11, (0.0, 40.0))
    far, near = doubts(twice)
    assert (far.index, near.index) == (3, 11) and far.is_mark and near.is_mark
    assert far.off == pytest.approx(700.0, abs=2.0)
    assert "it reads 700 mm from where the mark was sent" in far.sentence
    only_far = read_elsewhere(plain_board(1, 1), 0, (900.0, 0.0))
    assert [doubt.index for doubt in doubts(only_far)] == [0]


def test_a_distance_is_counted_among_the_distances():
    spans = list(distances_between(plain_board(4, 3).marks).distances)
    spans[17] = replace(spans[17], length=spans[17].length + 23.0)
    marks = tuple(replace(mark, measured=None) for mark in plain_board(4, 3).marks)
    (doubt,) = doubts(Measurements(marks, tuple(spans)))
    assert (doubt.index, doubt.is_mark) == (17, False)
    assert doubt.off == pytest.approx(23.0, abs=2.0) and "too long" in doubt.sentence


def test_marks_that_wait_for_their_reading_are_no_slips():
    waiting = Mark("later", (0.0, 300.0), is_unread=True)
    marks = (waiting, *read_elsewhere(plain_board(), 8, (31.0, -22.0)).marks)
    (doubt,) = doubts(Measurements(marks))
    assert doubt.index == 9
    assert doubts(Measurements((waiting,))) == ()


def slip_of(read, expected, sigma=0.3):
    """The slip of a mark that was read here and expected there."""
    marks = Measurements((Mark("A", (0.0, 0.0), read),))
    offset = np.subtract(read, expected)
    return described(
        Shift(Reading(0, True), offset, np.full(2, sigma), 99.0), Inputs(BELIEVED, marks)
    )


def slip_of_distance(read, expected):
    """The slip of a distance."""
    ends = (Mark("A", (0.0, 0.0)), Mark("B", (900.0, 0.0)))
    marks = Measurements(ends, (Distance(("A", "B"), read),))
    offset = np.array([read - expected])
    return described(
        Shift(Reading(0, False), offset, np.array([0.3]), 99.0), Inputs(BELIEVED, marks)
    )


@pytest.mark.parametrize(
    ("read", "expected", "guess"),
    [
        ((412.0, 100.0), (421.0, 100.0), "412 written for 421?"),
        ((300.0, -200.0), (-200.0, 300.0), "x and y may be exchanged"),
        ((410.0, 100.0), (400.0, 100.0), "misread by 10 mm in x?"),
        ((400.0, 125.4), (400.0, 100.0), "misread by an inch in y?"),
        ((407.3, 107.3), (400.0, 100.0), ""),
    ],
)
def test_usual_mistakes_are_guessed(read, expected, guess):
    slip = slip_of(read, expected)
    assert slip.guess == guess and slip.expected == pytest.approx(expected)
    assert slip.length == pytest.approx(np.hypot(*np.subtract(read, expected)))


def test_digits_on_both_sides_of_the_point_are_neighbours():
    assert slip_of((412.3, 100.0), (413.2, 100.0), sigma=0.05).guess == "412.3 written for 413.2?"
    # With a digit between them they are not.
    assert slip_of((214.0, 100.0), (412.0, 100.0)).guess == ""


def test_five_deviations_are_surely_wrong():
    assert slip_of((412.0, 100.0), (421.0, 100.0), sigma=9 / 5.5).guess == "412 written for 421?"
    assert "written" not in slip_of((412.0, 100.0), (421.0, 100.0), sigma=9 / 4.5).guess


def test_a_distance_has_no_axis():
    slip = slip_of_distance(925.4, 900.0)
    assert slip.guess == "misread by an inch?" and slip.way == "too long"
    assert slip_of_distance(890.0, 900.0).way == "too short"


PITCH = replace(BELIEVED, effects={"chain_pitch": {"left": 0.002, "right": 0.0005}})
# Repeats 20 mm inwards of two corners, as `plumb grid` makes them: near enough to be mixed up.
TARGETS = np.vstack([grid(5, 3), [[-1080.0, 500.0], [1080.0, -500.0]]])
CLOSE_PAIRS = [(0, 15), (14, 16)]


def measured(marks):
    return Measurements(tuple(marks), source="a.toml")


def exchanged(marks, i, j):
    marks = list(marks)
    first, second = marks[i].measured, marks[j].measured
    marks[i], marks[j] = replace(marks[i], measured=second), replace(marks[j], measured=first)
    return marks


@pytest.mark.parametrize("pair", CLOSE_PAIRS)
def test_two_exchanged_marks_are_both_named_with_the_correction(pair):
    marks = marks_on(PITCH, BELIEVED, TARGETS, noise=0.3, seed=1)
    diagnosis = diagnose(Inputs(BELIEVED, measured(exchanged(marks, *pair)), sigma=0.3))
    assert diagnosis.verdict == "slip" and diagnosis.explanations == ()
    assert {slip.name for slip in diagnosis.outliers} == {str(name) for name in pair}
    for slip, other in zip(diagnosis.outliers, reversed(diagnosis.outliers), strict=True):
        assert f"that of {other.name} may be exchanged" in slip.sentence
        assert slip.length == pytest.approx(20, abs=2)


def repeated(seed):
    """The same marks, the last two by the names of the corners that they repeat."""
    marks = marks_on(PITCH, BELIEVED, TARGETS, noise=0.3, seed=seed)
    names = {repeat: marks[corner].name for corner, repeat in ((0, 15), (14, 16))}
    return [replace(mark, name=names.get(i, mark.name)) for i, mark in enumerate(marks)]


@pytest.mark.parametrize("pair", CLOSE_PAIRS)
def test_two_exchanged_readings_of_a_mark_name_it_without_itself(pair):
    marks = exchanged(repeated(1), *pair)
    slips = diagnose(Inputs(BELIEVED, measured(marks), sigma=0.3)).outliers
    assert [slip.name for slip in slips] == [str(pair[0])] * 2
    assert all(slip.sentence.endswith("; its two readings may be exchanged") for slip in slips)


@pytest.mark.parametrize(("index", "off"), [(16, 40.0), (0, -36.0)])
def test_a_misread_repeat_is_not_taken_for_two_exchanged_readings(index, off):
    marks = repeated(1)
    x, y = marks[index].measured
    marks[index] = replace(marks[index], measured=(x + off, y))
    (slip,) = diagnose(Inputs(BELIEVED, measured(marks), sigma=0.3)).outliers
    assert slip.name == marks[index].name
    assert slip.guess == "its other reading may be the wrong one"
    assert slip.length == pytest.approx(abs(off), abs=2)


def test_two_exchanged_distances_are_both_named():
    known = distances_between(marks_on(PITCH, BELIEVED, grid(3, 3), noise=0.2, seed=1))
    spans = list(known.distances)
    first, second = spans[3].length, spans[11].length
    spans[3], spans[11] = replace(spans[3], length=second), replace(spans[11], length=first)
    diagnosis = diagnose(Inputs(BELIEVED, replace(known, distances=tuple(spans)), sigma=0.3))
    named = {" - ".join(spans[i].between) for i in (3, 11)}
    assert diagnosis.verdict == "slip" and {slip.name for slip in diagnosis.outliers} == named
    assert all("may be exchanged" in slip.guess for slip in diagnosis.outliers)


def test_nothing_is_called_exchanged_without_need():
    for seed in range(3):
        marks = marks_on(PITCH, BELIEVED, TARGETS, noise=0.3, seed=seed)
        assert diagnose(Inputs(BELIEVED, measured(marks), sigma=0.3)).outliers == ()


def test_y_errors_with_the_wrong_sign_are_noticed():
    marks = [
        replace(mark, measured=(mark.measured[0], 2 * mark.target[1] - mark.measured[1]))
        for mark in marks_on(PITCH, BELIEVED, grid(5, 3), noise=0.3, seed=5)
    ]
    said = diagnose(Inputs(BELIEVED, measured(marks), sigma=0.3)).warnings
    assert any("with all y errors the other way round" in sentence for sentence in said)


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
