"""By default an answer fits a screen, its verdict is read last, and every word is a maker's."""

import re
import shutil
from importlib import resources
from pathlib import Path

import pytest
from example_machine import ROOT, checked
from plumb.model.catalogue import effect_names, parameter_words
from systems import widest

BOARDS = {
    "simple": ROOT / "docs/example",
    "holes": resources.files("plumb") / "examples/madgrizzle-2018-09-02",
}
INI, MARKS = "groundcontrol.ini", "marks.toml"
AUTO = ("add", INI, MARKS, "--effect", "auto")
WRITTEN = (*AUTO, "-o", "machine.toml", "--client", "groundcontrol", "--original", INI)
COMMANDS = [("compare", INI, MARKS), ("diagnose", INI, MARKS), ("next", INI, MARKS)]
COMMANDS += [("calibrate", INI, MARKS), AUTO, WRITTEN, ("add", INI, MARKS, "--effect", "none")]
COMMANDS += [("settings", "machine.toml")]
DONE = ("calibrate", INI, MARKS, *checked())  # of the simple board
EACH = [(board, command) for board in BOARDS for command in COMMANDS] + [("simple", DONE)]
BOARDS["several"] = ROOT / "tools/tests/data/boards/real-25"
SCREEN, TEN = 24, 10  # lines
MOST_WORDS = 40
# Words of the field, and riddles: no default answer has them.
NOT_A_MAKERS = re.compile(
    r"\b(provable|counted|of that is shape|posterior|covariate|identifiable|chi-square|suspects?"
    r"|priors?|degrees of freedom|taken for the truth|fit the fit)\b",
    re.IGNORECASE,
)
ESCAPE = re.compile(r"\x1b\[[0-9;]*m")
BOLD = re.compile(r"^\x1b\[1(?:;3[123])?m[^\x1b]*\x1b\[0m$")


@pytest.fixture(autouse=True)
def _screen(here, monkeypatch):
    """A folder for a board, and a screen with colours."""
    monkeypatch.delenv("NO_COLOR", raising=False)
    for name, value in {"COLUMNS": "80", "TERM": "xterm", "FORCE_COLOR": "1"}.items():
        monkeypatch.setenv(name, value)


def put(board):
    """Its files, alone in the folder."""
    for path in Path().iterdir():
        path.unlink()
    for name in (INI, MARKS):
        shutil.copy(BOARDS[board] / name, name)


def answer(run, board, command):
    put(board)
    if command[0] == "settings":
        run(*WRITTEN)
    code, said, complaint = run(*command)
    assert code < 2 and complaint == ""
    return said.rstrip("\n").split("\n")


def verdict_of(lines):
    """Its lines: the last that are bold as a whole, and what follows them."""
    last = max(i for i, line in enumerate(lines) if BOLD.match(line))
    first = last
    while BOLD.match(lines[first - 1]) and first:
        first -= 1
    return lines[first : last + 1], lines[last + 1 :]


@pytest.mark.parametrize(("board", "command"), EACH)
def test_an_answer_fits_a_screen_ends_with_its_verdict_and_details_say_more(board, command, run):
    lines = answer(run, board, command)
    plain = [ESCAPE.sub("", line) for line in lines]
    assert len(plain) <= SCREEN and widest("\n".join(plain)) <= 80, "\n".join(plain)
    if command[0] == "calibrate":
        assert sum(bool(line) for line in plain) <= TEN + 3 * ("- " in "\n".join(plain[:3]))
    verdict, behind = verdict_of(lines)
    assert len(" ".join(map(lambda line: ESCAPE.sub("", line), verdict)).split()) <= MOST_WORDS
    # Behind it stands only what to do: no table, and a command at the end.
    assert behind[-1].startswith("  ") and len(behind) <= 11, "\n".join(plain)
    said = "\n".join(plain)
    assert not NOT_A_MAKERS.search(said), NOT_A_MAKERS.search(said)
    names = "|".join(map(re.escape, [*effect_names(), *parameter_words()]))
    assert not re.search(rf"\((?:{names})\)", said)
    if command[0] == "next":  # it says all that it knows
        return
    long = answer(run, board, (*command, "--details"))
    assert len(long) > len(lines)
    assert verdict_of(long)[1][-1] == behind[-1] or command[0] == "calibrate"
    assert not re.search(rf"\((?:{'|'.join(effect_names())})\)", "\n".join(long))


def test_a_verdict_has_its_colour_where_the_screen_has_colours(run, monkeypatch):
    command = ("compare", INI, MARKS)
    verdict, _ = verdict_of(answer(run, "simple", command))
    assert all(line.startswith("\x1b[1;33m") for line in verdict)
    monkeypatch.setenv("NO_COLOR", "1")
    assert ";3" not in "".join(answer(run, "simple", command))
    monkeypatch.delenv("FORCE_COLOR")
    assert "\x1b" not in "".join(answer(run, "simple", command))


@pytest.mark.parametrize(
    ("board", "more", "colour"),
    [
        ("simple", (), ";33m"),  # several causes are left
        ("simple", checked(), ";32m"),  # a single cause
        ("several", (), ";33m"),  # causes are named, and more is left than the library explains
        ("slip", (), ";31m"),  # a reading is wrong
    ],
)
def test_a_verdict_is_coloured_by_what_it_says(board, more, colour, run):
    put("simple" if board == "slip" else board)
    if board == "slip":
        marks = Path(MARKS).read_text()
        Path(MARKS).write_text(marks.replace("[1221.5, 111]", "[1251.5, 111]"))
    said = run("diagnose", INI, MARKS, *more)[1].rstrip("\n").split("\n")
    verdict, _ = verdict_of(said)
    assert all(f"\x1b[1{colour}" in line for line in verdict)
