"""Boards of the judge with something hidden, through every command that reads marks: each answers,
or refuses in one line; none ends in a traceback, and no number of an answer is nonsense."""

import re
import warnings
from itertools import product
from pathlib import Path

import numpy as np
import pytest
from boards import PUBLISHED, cut
from kinds import KINDS, slip
from plumb.hidden import MAKER, plan
from plumb.marks.form import marks_toml
from plumb.settings import write_machine_toml

DATA = Path(__file__).resolve().parents[1] / "data"
QUICK = {"compare": (), "diagnose": (), "add": ("--effect", "auto")}
COMMANDS = {**QUICK, "next": (), "calibrate": ("-o", "new.toml"), "report": ("-o", "r.html")}
# A row, a column and a square of marks settle little; so do three marks.
GRIDS = ((5, 3), (3, 3), (5, 5), (3, 1), (1, 4), (2, 2), (7, 3), (4, 2))
KNOWN = (MAKER, PUBLISHED)
FEW, MANY, TOGETHER = 5, 200, 50


def board_of(index):
    """Board number `index`: what is hidden, the layout and the settings take turns."""
    kind = list(KINDS.values())[index % len(KINDS)]
    # As many turns of the layout as it takes to meet every kind with each.
    turn = index // len(KINDS) + index
    settings, grid = [*product(KNOWN, GRIDS)][turn % (len(KNOWN) * len(GRIDS))]
    # Some boards are read as distances, without a stated noise.
    spans, stated = index % 7 == 3, None if index % 5 == 4 else kind.noise
    layout = plan(*grid, repeats=kind.repeats and min(grid) > 1, spans=spans)
    source = np.random.default_rng(index)
    hidden = kind.draw(source, index, kind.plan(25))
    board = cut(hidden, layout, seed=source, noise=kind.noise, tape_sigma=stated, settings=settings)
    if kind.slips and layout.again and not spans:
        board, _ = slip(board, kind.slips[index % len(kind.slips)], source)
    return settings, board.measurements


def written(folder, index):
    """The files of a board."""
    settings, measurements = board_of(index)
    folder.mkdir()
    write_machine_toml(folder / "machine.toml", settings)
    (folder / "marks.toml").write_text(marks_toml(measurements))


@pytest.fixture
def answer(run, tmp_path, monkeypatch):
    """Gives a board to some commands; a fault names the board and the command."""

    def answered(index, commands):
        folder = tmp_path / f"{index}"
        written(folder, index)
        monkeypatch.chdir(folder)
        for command, options in commands.items():
            case = f"board {index}, plumb {command}"
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                try:
                    code, said, complaint = run(command, "machine.toml", "marks.toml", *options)
                except Exception as error:
                    raise AssertionError(case) from error
            assert bool(said) == (code < 2), case
            assert code < 2 or complaint.count("\n") == 1, f"{case}: {complaint}"

    return answered


# On the last of these, five effects are named beside a pattern.
@pytest.mark.parametrize("index", [*range(FEW), 163])
def test_a_board_is_answered(index, answer):
    answer(index, QUICK)


ROW = re.compile(r"^2\. the frame alone +1 to \d+ +0\.\d\d mm +0\.\d\d mm$", re.MULTILINE)


@pytest.mark.parametrize("marks", ["frame_or_chain_zero.toml", "frame_or_runout.toml"])
def test_marks_that_the_frame_alone_may_explain_are_answered(marks, run, here):
    for command, options in COMMANDS.items():
        more = ["--details"] if command in ("diagnose", "calibrate") else []
        code, said, _ = run(command, DATA / "stock_bottom.ini", DATA / marks, *options, *more)
        assert code in (0, 1)
        if command in ("diagnose", "calibrate"):
            assert bool(ROW.search(said)) is (marks == "frame_or_runout.toml")


@pytest.mark.slow
@pytest.mark.parametrize("first", range(0, MANY, TOGETHER))
def test_many_boards_are_answered_by_every_command(first, answer):
    for index in range(first, first + TOGETHER):
        answer(index, COMMANDS)
