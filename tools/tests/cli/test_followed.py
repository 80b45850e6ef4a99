"""Tests of the progress line of `plumb send`."""

import numpy as np
import pytest
from plumb.cli import followed
from plumb.job.time_left import TimeLeft, Timetable

TEXT = ["(a job)", "G0 X1", "", *(f"G1 X{x} F100" for x in range(8000))]
WHOLE = 2.0 * len(TEXT)


class Screen:
    """Standard error that is watched, or not."""

    def __init__(self, *, watched):
        self.watched, self.said = watched, ""

    def write(self, text):
        self.said += text

    def flush(self):
        pass

    def isatty(self):
        return self.watched


@pytest.fixture
def clock(monkeypatch):
    now = [1000.0]
    monkeypatch.setattr(followed, "monotonic", lambda: now[0])
    return now


def follow(clock, *, seconds, step=0.25, pauses=False):
    """A job whose lines take 2 s each, followed for a while."""
    job = followed.Followed(TEXT, TimeLeft(Timetable(np.arange(len(TEXT) + 1) * 2.0), ahead=1.0))
    every = int(2 / step)
    for tick in range(int(seconds / step)):
        clock[0] += step
        if tick % every == every - 1:
            job.answered(tick // every + 1)
        job.look(pauses=pauses)
    job.clear()


def test_without_a_terminal_a_line_is_printed_each_minute(clock, monkeypatch):
    screen = Screen(watched=False)
    monkeypatch.setattr(followed.sys, "stderr", screen)
    follow(clock, seconds=185)
    lines = screen.said.splitlines()
    assert len(lines) == 3
    assert lines[0] == "line 32 of 8003, 4 h 15 min left, 0 % done"


def test_a_terminal_has_a_line_that_fits(clock, monkeypatch):
    shown = []
    monkeypatch.setattr(followed.sys, "stderr", Screen(watched=True))
    monkeypatch.setattr(followed.Bar, "show", lambda self, share, what: shown.append((share, what)))
    follow(clock, seconds=4000, step=0.5)
    assert len(shown) > 7000
    shares = [share for share, _ in shown]
    assert np.diff(shares).min() > -1e-4 and shares[-1] == pytest.approx(4000 / WHOLE, rel=0.01)
    # Behind the words stand a bar of 20 and a percent of 4, a space before each.
    assert max(len(what) for _, what in shown) + 26 <= 80
