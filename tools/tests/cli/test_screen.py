"""Output fits into 80 columns, loses nothing, and has colour only on a screen."""

import re
from pathlib import Path

import pytest
from plumb.cli import screen
from plumb.cli.screen import BAD, GOOD, OPEN, Bar, headline, table
from systems import widest

EXAMPLE = Path(__file__).resolve().parents[3] / "docs/example"
INI, MARKS = EXAMPLE / "groundcontrol.ini", EXAMPLE / "marks.toml"
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
        ("add", INI, MARKS, "--effect", "sprocket_runout", "frame_flex"),
        ("effects",),
        ("bench", "--kinds", "one", "--marks", "9", "--boards", "1"),
        ("settings", EXAMPLE / "machine.toml"),
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


@pytest.mark.parametrize(
    ("variables", "coloured"),
    [({}, False), ({"FORCE_COLOR": "1"}, True), ({"FORCE_COLOR": "1", "NO_COLOR": "1"}, False)],
)
def test_colour_only_where_it_is_wanted(variables, coloured, monkeypatch):
    monkeypatch.setenv("TERM", "xterm")
    for name, value in variables.items():
        monkeypatch.setenv(name, value)
    said = table(["number", ""], [["a", "impossible: b"], ["c", "d"]], words=[-1])
    assert bool(COLOUR.search(said)) == coloured
    assert len(COLOUR.findall(said)) in (0, 1)
    assert ("\x1b" in headline("All is well.")) == bool(variables)
    for kind, colour in ((GOOD, ";32m"), (OPEN, ";33m"), (BAD, ";31m"), ("", "")):
        said = headline("All is well.", kind)
        # With NO_COLOR a verdict is bold.
        shown = [each for each in (";31m", ";32m", ";33m") if each in said]
        assert shown == ([colour] if colour and coloured else [])


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
