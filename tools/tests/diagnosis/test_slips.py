"""Slips next to hidden effects, and bumps, which are none."""

from dataclasses import replace

import numpy as np
import pytest
from plumb.bench.boards import cut, plan
from plumb.bench.causes import MAKER, Hidden, causes_of
from plumb.diagnosis import diagnose
from plumb.diagnosis.clean import felt_effects
from plumb.diagnosis.explanation import KNOWN, Board, explain
from plumb.diagnosis.noise import Noise
from plumb.diagnosis.weighing import LinearBoard, Metric, weigh
from plumb.fit.inputs import Inputs
from plumb.fit.observations import observe
from plumb.marks.read import Measurements, Round

PITCH, STRETCH = causes_of("chain_pitch")[1], causes_of("chain_stretch")[0]
TWO = Hidden(((PITCH, 1.5), (STRETCH, 1.5)))


def with_slip(measurements, index, by):
    """The measurements with one reading off by some millimetres."""
    marks = list(measurements.marks)
    marks[index] = replace(marks[index], measured=tuple(np.add(marks[index].measured, by)))
    return replace(measurements, marks=tuple(marks))


@pytest.mark.parametrize("length", [5.0, 10.0, 30.0])
def test_two_hidden_effects_hide_no_slip(length):
    board = cut(TWO, plan(5, 5), seed=11, noise=0.4, tape_sigma=0.4)
    slipped = with_slip(board.measurements, 6, (0.6 * length, 0.8 * length))
    diagnosis = diagnose(Inputs(MAKER, slipped))
    assert diagnosis.verdict == "slip"
    assert [slip.name for slip in diagnosis.outliers] == [slipped.marks[6].name]
    assert diagnosis.outliers[0].offset == pytest.approx((0.6 * length, 0.8 * length), abs=1.5)
    assert "if it stays, it is the machine there" in diagnosis.outliers[0].sentence


def test_a_bump_of_several_marks_is_no_slip():
    for seed in range(3):
        hidden = Hidden(outside="bump", outside_mm=1.0)
        diagnosis = diagnose(Inputs(MAKER, cut(hidden, plan(5, 5), seed=seed).measurements))
        assert diagnosis.verdict == "not_in_library" and not diagnosis.outliers
        assert any("farthest off at" in said for said in diagnosis.warnings)


@pytest.mark.parametrize("round_number", [0, 1])
def test_what_a_second_reading_confirms_is_the_machine(round_number):
    board = cut(Hidden(), plan(5, 5), seed=2, noise=0.4, tape_sigma=0.4)
    slipped = with_slip(board.measurements, 7, (5.0, 0.0))
    assert diagnose(Inputs(MAKER, slipped)).verdict == "slip"
    again = replace(
        slipped.marks[7],
        measured=tuple(np.add(slipped.marks[7].measured, (0.3, -0.2))),
        round=round_number,
    )
    twice = Measurements(
        (*slipped.marks, again), tape_sigma=0.4, rounds=(Round(),) * (1 + round_number)
    )
    diagnosis = diagnose(Inputs(MAKER, twice))
    assert diagnosis.verdict == "not_in_library" and not diagnosis.outliers
    assert any(
        f"{again.name} stays" in said and "it is the machine there" in said
        for said in diagnosis.warnings
    )


def test_accounts_are_weighed_by_the_density_of_the_readings():
    # Evidence from the covariance of the readings, written out in full.
    rows = observe(MAKER, cut(TWO, plan(3, 3), seed=1, noise=0.4, tape_sigma=0.4).measurements)
    frame = explain(Board.of(MAKER, rows, sigma=0.4))
    known, scale = frame.board.frame, frame.board.problem.scale
    slopes = frame.slopes[: rows.count]
    read = frame.residual[: rows.count] + slopes[:, known] @ frame.unknowns[known]
    largest = {"chain_stretch": 2e-5, "sheet_skew": 0.01}

    def evidence(names, slip=None):
        parts = []
        for share in (0.3, 1.0):
            covariance = np.eye(rows.count) + slopes[:, known] @ slopes[:, known].T
            for name in names:
                column = frame.board.columns([name])[0]
                drawn = slopes[:, column] / scale[column] * largest[name] * share
                covariance += np.outer(drawn, drawn)
            if slip is not None:
                covariance[2 * slip : 2 * slip + 2, 2 * slip : 2 * slip + 2] += np.eye(2) * 1e4
            chi = read @ np.linalg.solve(covariance, read)
            parts.append(-(chi + np.linalg.slogdet(covariance)[1]) / 2 - np.log(2))
        return np.logaddexp(*parts)

    sets = [(), ("chain_stretch",), ("chain_stretch", "sheet_skew")]
    linear = LinearBoard.of(frame, felt_effects(frame), Noise(0.4, KNOWN, "stated"))
    metric = Metric.of(linear)
    wanted = [evidence(names) for names in sets]
    parts = linear.parts(sets)
    assert metric.evidences(parts)[:, 0] == pytest.approx(wanted, abs=1e-6)
    before = np.array([0.0, -1.0, -2.0])
    ours = metric.outlier_evidences(parts, before, (40.0,))
    for slip in (0, 4):
        each = [evidence(names, slip) + weight for names, weight in zip(sets, before, strict=True)]
        assert ours[slip] == pytest.approx(np.logaddexp.reduce(each) - np.log(9), abs=1e-6)


def test_noise_that_was_estimated_makes_accounts_less_sure():
    board = cut(TWO, plan(5, 5), seed=1, noise=0.4, tape_sigma=0.4).measurements
    frame = explain(Board.of(MAKER, observe(MAKER, board), sigma=0.4))
    spreads = []
    for degrees in (6.0, 1e7, KNOWN):
        clean = weigh(frame, felt_effects(frame), Noise(0.4, degrees, "repeats")).clean
        spreads.append(np.ptp(clean))
    assert spreads[0] < 0.9 * spreads[2] and spreads[1] == pytest.approx(spreads[2], rel=1e-3)
