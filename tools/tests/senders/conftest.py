"""Each sender with each brain at its port."""

import sys
from pathlib import Path

import pytest
from bcnc_program import Bcnc
from cncjs_program import Cncjs
from grbl_board import Board

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "tools/bench"))
from board import built_firmware  # noqa: E402

SENDERS = {each.name: each for each in (Cncjs, Bcnc)}
INSTALLED = ROOT / ".build/senders/note"


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
    if not INSTALLED.is_file():
        pytest.fail(f"{request.param}: not installed: run tools/setup senders", pytrace=False)
    program = SENDERS[request.param](tmp_path)
    yield program
    program.end()


@pytest.fixture
def connected(sender, board):
    """A sender that is connected to the machine."""
    sender.connect(board.port)
    return sender
