"""Numbers that were mixed up: exchanged readings, a sign of y, one file twice."""

from dataclasses import replace

import numpy as np
import pytest
from plumb.diagnosis import diagnose
from plumb.fit.inputs import Inputs
from plumb.marks.read import Measurements
from synthetic import BELIEVED, distances_between, grid, marks_on

PITCH = replace(BELIEVED, effects={"chain_pitch": {"left": 0.002, "right": 0.0005}})
# Repeats 20 mm inwards of two corners, as `plumb grid` makes them: near enough to be mixed up.
TARGETS = np.vstack([grid(5, 3), [[-1080.0, 500.0], [1080.0, -500.0]]])
CLOSE_PAIRS = [(0, 15), (14, 16)]


def board(marks):
    return Measurements(tuple(marks), source="a.toml")


def exchanged(marks, i, j):
    marks = list(marks)
    first, second = marks[i].measured, marks[j].measured
    marks[i], marks[j] = replace(marks[i], measured=second), replace(marks[j], measured=first)
    return marks


@pytest.mark.parametrize("pair", CLOSE_PAIRS)
def test_two_exchanged_marks_are_both_named_with_the_correction(pair):
    marks = marks_on(PITCH, BELIEVED, TARGETS, noise=0.3, seed=1)
    diagnosis = diagnose(Inputs(BELIEVED, board(exchanged(marks, *pair)), sigma=0.3))
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
    slips = diagnose(Inputs(BELIEVED, board(marks), sigma=0.3)).outliers
    assert [slip.name for slip in slips] == [str(pair[0])] * 2
    assert all(slip.sentence.endswith("; its two readings may be exchanged") for slip in slips)


@pytest.mark.parametrize(("index", "off"), [(16, 40.0), (0, -36.0)])
def test_a_misread_repeat_is_not_taken_for_two_exchanged_readings(index, off):
    marks = repeated(1)
    x, y = marks[index].measured
    marks[index] = replace(marks[index], measured=(x + off, y))
    (slip,) = diagnose(Inputs(BELIEVED, board(marks), sigma=0.3)).outliers
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
        assert diagnose(Inputs(BELIEVED, board(marks), sigma=0.3)).outliers == ()


def test_y_errors_with_the_wrong_sign_are_noticed():
    marks = [
        replace(mark, measured=(mark.measured[0], 2 * mark.target[1] - mark.measured[1]))
        for mark in marks_on(PITCH, BELIEVED, grid(5, 3), noise=0.3, seed=5)
    ]
    said = diagnose(Inputs(BELIEVED, board(marks), sigma=0.3)).warnings
    assert any("with all y errors the other way round" in sentence for sentence in said)
