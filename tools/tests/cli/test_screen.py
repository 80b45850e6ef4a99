"""Output fits into 80 columns, has colour only on a screen, and shows how far long work is."""

import re

import numpy as np
import pytest
from example_machine import EXAMPLE, INI, MARKS
from plumb.cli import followed, screen
from plumb.cli.screen import Bar, table
from plumb.job.dry_run import TimeLeft, Timetable
from systems import widest

COLOUR = re.compile(r"\x1b\[[0-9;]*3[0-9]")
LONG = "a sentence of words that go on and on " * 4


@pytest.fixture(autouse=True)
def _no_screen(monkeypatch):
    for name in ("COLUMNS", "NO_COLOR", "FORCE_COLOR"):
        monkeypatch.delenv(name, raising=False)


@pytest.mark.parametrize(
    "command",
    [
        ("grid", "--settings", INI, "--details"),
        ("add", INI, MARKS, "--effect", "auto", "--patch"),
        ("effects",),
        ("bench", "--kinds", "one", "--marks", "9", "--boards", "1"),
        ("reach", EXAMPLE / "machine.toml"),
    ],
    ids=lambda command: command[0],
)
def test_no_line_is_longer_than_80_columns(command, run):
    code, said, complaint = run(*command)
    assert code < 2 and complaint == ""
    assert widest(said) <= 80, said
    assert "…" not in said and "\x1b" not in said


def test_columns_of_words_wrap_and_numbers_stay_whole():
    rows = [["first", "1234.5678", LONG], ["second", "-1.0", "short"]]
    lines = table(["name", "number", "words"], rows, words=[-1]).splitlines()
    assert max(map(len, lines)) <= 80 and len(lines) == 5
    assert "first   1234.5678  a sentence" in lines[1] and "second       -1.0  short" in lines[-1]
    assert " ".join(" ".join(lines).split()).count("on and on") == 4


def test_a_number_that_cannot_be_is_coloured(monkeypatch):
    monkeypatch.setenv("FORCE_COLOR", "1")
    monkeypatch.setenv("TERM", "xterm")
    said = table(["number", ""], [["a", "impossible: b"], ["c", "d"]], words=[-1])
    assert len(COLOUR.findall(said)) == 1


class Terminal:
    """A standard error that is a terminal."""

    def __init__(self, *, watched):
        self.said, self._watched = "", watched

    def write(self, text):
        self.said += text
        return len(text)

    def flush(self):
        """Nothing is kept back."""

    def isatty(self):
        return self._watched


@pytest.mark.parametrize(
    ("watched", "patience", "shown"), [(True, 0.0, True), (True, 60.0, False), (False, 0.0, False)]
)
def test_a_bar_is_shown_on_a_terminal_if_the_work_takes_long(watched, patience, shown, monkeypatch):
    terminal = Terminal(watched=watched)
    monkeypatch.setattr(screen.sys, "stderr", terminal)
    bar = Bar("boards", patience=patience)
    bar.show(0.5, "half of them")
    bar.show(1.0)
    assert ("half of them" in terminal.said) == shown
    assert bool(terminal.said) == shown


TEXT = ["(a job)", "G0 X1", "", *(f"G1 X{x} F100" for x in range(8000))]
WHOLE = 2.0 * len(TEXT)


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
    screen = Terminal(watched=False)
    monkeypatch.setattr(followed.sys, "stderr", screen)
    follow(clock, seconds=185)
    lines = screen.said.splitlines()
    assert len(lines) == 3
    assert lines[0] == "line 32 of 8003, 4 h 15 min left, 0 % done"


def test_a_terminal_has_a_line_that_fits(clock, monkeypatch):
    shown = []
    monkeypatch.setattr(followed.sys, "stderr", Terminal(watched=True))
    monkeypatch.setattr(followed.Bar, "show", lambda self, share, what: shown.append((share, what)))
    follow(clock, seconds=4000, step=0.5)
    assert len(shown) > 7000
    shares = [share for share, _ in shown]
    assert np.diff(shares).min() > -1e-4 and shares[-1] == pytest.approx(4000 / WHOLE, rel=0.01)
    # Behind the words stand a bar of 20 and a percent of 4, a space before each.
    assert max(len(what) for _, what in shown) + 26 <= 80
