"""Each sender with each brain at its port."""

import re
import sys
from pathlib import Path

import pytest
from bcnc_program import Bcnc
from cncjs_program import Cncjs
from grbl_board import Board
from streamer_programs import GrblStreamer, PygrblStreamer
from ugs_program import Ugs

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "tools/bench"))
from board import built_firmware  # noqa: E402

SENDERS = {each.name: each for each in (Cncjs, Bcnc, Ugs, GrblStreamer, PygrblStreamer)}
INSTALLED, FAILURE = (ROOT / ".build/senders" / name for name in ("note", "failure"))
NAME = re.compile(rf"\btest_(\w+)\[(?:host|Mega)-({'|'.join(SENDERS)})\]")


@pytest.fixture(scope="session", params=["host", "Mega"])
def brain(request) -> str | None:
    """The flashed program's file, or nothing for the firmware of the host."""
    return str(built_firmware()) if request.param == "Mega" else None


@pytest.fixture
def board(brain):
    """A machine at a port."""
    board = Board(brain)
    yield board
    board.end()


@pytest.fixture(params=list(SENDERS))
def sender(request, tmp_path, board):
    """A sender that runs and is not yet connected; it ends before its port goes."""
    if request.param != Ugs.name and not INSTALLED.is_file():
        why = FAILURE.read_text() if FAILURE.is_file() else "not installed: run tools/setup senders"
        pytest.fail(f"{request.param}: {why}", pytrace=False)
    program = SENDERS[request.param](tmp_path)
    yield program
    program.end()


@pytest.fixture
def connected(sender, board):
    """A sender that is connected to the machine."""
    sender.connect(board.port)
    return sender


def feature_of(name: str) -> tuple[str, str] | None:
    """The feature and the sender of a test's name."""
    if match := NAME.search(name):
        return match[1].replace("_", " "), match[2]
    return None


def pytest_collection_modifyitems(config, items):
    """A sender without a button for a feature is not asked for it."""
    lacking = [
        item
        for item in items
        if (named := feature_of(item.name)) and named[0] in SENDERS[named[1]].lacks
    ]
    items[:] = [item for item in items if item not in lacking]
    config.hook.pytest_deselected(items=lacking)
