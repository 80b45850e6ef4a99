"""Slips next to hidden effects, and bumps, which are none."""

import re
from dataclasses import replace

import numpy as np
import pytest
from plumb.bench.boards import cut, plan
from plumb.bench.causes import MAKER, Hidden, causes_of
from plumb.diagnosis import diagnose
from plumb.fit.inputs import Inputs
from plumb.marks.read import Measurements, Round
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
    assert any(
        f"{again.name} stays" in said and "it is the machine there" in said
        for said in diagnosis.warnings
    )
