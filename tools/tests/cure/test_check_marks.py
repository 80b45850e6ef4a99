"""Check marks: a fit that holds is believed, a machine that has changed is noticed."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from plumb import api
from plumb.cure.check_marks import check_marks
from plumb.marks.model import Mark, Measurements, Round
from plumb.model.predict import lengths, places
from plumb.plan.planned_visits import check_places

EXAMPLE = Path(__file__).resolve().parents[3] / "docs" / "example"
TAPE = 0.5  # [mm]


@pytest.fixture(scope="module")
def inputs():
    return replace(api.read(EXAMPLE / "machine.toml", EXAMPLE / "marks.toml"), sigma=TAPE)


@pytest.fixture(scope="module")
def sent(inputs):
    return check_places(inputs.settings, inputs.measurements.targets)


def measured(inputs, sent, offsets):
    marks = tuple(
        Mark(name, tuple(place), tuple(place + offset), approach=(0.0, 40.0))
        for name, place, offset in zip("AB", sent, np.array(offsets, dtype=float), strict=True)
    )
    return Measurements(marks, rounds=(Round(cut_with=inputs.settings),))


def test_99_of_100_honest_checks_hold(inputs, sent):
    random = np.random.default_rng(7)
    base = check_marks(inputs, measured(inputs, sent, [[0, 0], [0, 0]]))
    held = 0
    for _ in range(40):
        # What the fit leaves open is small here, so the tape makes nearly all of it.
        noise = TAPE * random.standard_normal((2, 2))
        held += check_marks(inputs, measured(inputs, sent, noise)).holds
    assert 38 <= held <= 40
    assert base.holds


def test_a_motor_that_moved_is_noticed(inputs, sent):
    moved = replace(inputs.settings, motor_gap=inputs.settings.motor_gap + 6.0)
    chains = lengths(inputs.settings, sent)[0]
    there = places(moved, chains)[0]
    result = check_marks(inputs, measured(inputs, sent, there - sent))
    assert not result.holds
