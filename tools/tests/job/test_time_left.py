"""Tests of the time left of a job: its timetable, corrected by the machine's pace."""

import numpy as np
import pytest
from plumb.bench.causes import MAKER
from plumb.firmware.settings import values_of
from plumb.job.time_left import TimeLeft, Timetable, timetable
from workshop import lines_of, run_dry

LINES = lines_of("fusion_pocket.nc")


def test_the_timetable_is_that_of_the_check():
    table = timetable(values_of(MAKER), LINES, (0.0, 0.0, 0.0))
    done = run_dry(LINES)
    assert table.whole == pytest.approx(done.seconds, abs=0.1)
    assert len(table.done_at) == len(LINES) + 1 and table.done_at[0] == 0
    assert (np.diff(table.done_at) >= 0).all()
    last = int(done.moves["line"][20])
    ends = done.moves["ends"][done.moves["line"] == last].max()
    assert table.done_at[last] == pytest.approx(ends, abs=0.1)


@pytest.mark.parametrize("slower", [0.5, 1.0, 1.6])
def test_time_left_follows_how_the_machine_runs(slower):
    """Each line takes 2 s by the timetable; the machine takes `slower` times as long."""
    left = TimeLeft(Timetable(np.arange(0.0, 2001.0, 2.0)), ahead=1.0)
    assert left.seconds == pytest.approx(2000)
    for line in range(501):
        left.note(100 + 2 * slower * line, line, pauses=False)
    assert left.share == pytest.approx(0.5, abs=0.01)
    assert left.seconds == pytest.approx(1000 * slower, rel=0.03)


def test_pauses_do_not_count_and_the_end_is_the_end():
    left = TimeLeft(Timetable(np.arange(0.0, 201.0, 2.0)), ahead=1.0)
    for line in range(51):
        left.note(2.0 * line, line, pauses=False)
    before = left.seconds
    left.note(5000.0, 50, pauses=True)
    left.note(5000.5, 50, pauses=False)
    assert left.seconds == pytest.approx(before, abs=1.0)
    left.note(5100.0, 100, pauses=False)
    assert left.seconds < 2 and left.share > 0.99
