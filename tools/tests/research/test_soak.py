"""Some minutes of work on a virtual machine: nothing drifts, nothing is late."""

from dataclasses import replace

import pytest
from soak import due_writes, soak


@pytest.fixture(scope="module")
def worked():
    return soak(5, seed=3)


def test_nothing_drifts_and_nothing_is_late(worked):
    assert worked.is_well, worked
    assert worked.hours > 5 / 60
    assert worked.lines > 40 and worked.rests > 1
    assert worked.holds > 5 and worked.feeds > 5
    assert 0 < worked.astray < 0.03
    assert 0.19 < worked.silence < 0.5
    assert worked.most_writes == 2


@pytest.mark.parametrize(
    "wrong",
    [
        {"astray": 0.06},
        {"drift": -0.02},
        {"silence": 1.6},
        {"late": 1},
        {"longest_tick": 10_000},
        {"most_writes": 3},
        {"complaints": ("ALARM: Halted",)},
    ],
)
def test_what_goes_wrong_is_not_well(worked, wrong):
    assert not replace(worked, **wrong).is_well


def test_a_position_takes_the_next_slot():
    assert [due_writes(rests) for rests in (0, 64, 65, 130)] == [2, 2, 4, 6]


def test_the_years_until_it_is_worn(worked):
    busy = replace(worked, hours=1.0, rests=65)
    assert busy.years == pytest.approx(100_000 / 2 / 2400)
