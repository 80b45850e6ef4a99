"""Slips next to hidden effects and among repeats; and bumps, which are none."""

import re
from dataclasses import replace

import numpy as np
import pytest
from plumb.bench.boards import MAKER, Hidden, causes_of, cut, plan
from plumb.cure.add import add
from plumb.cure.decision import decide
from plumb.diagnosis import diagnose
from plumb.fit.inputs import Inputs
from plumb.marks.read import Distance, Measurements, Round
from plumb.words.verdict import sentence
from synthetic import read_elsewhere

PITCH, STRETCH = causes_of("chain_pitch")[1], causes_of("chain_stretch")[0]
TWO = Hidden(((PITCH, 1.5), (STRETCH, 1.5)))


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
