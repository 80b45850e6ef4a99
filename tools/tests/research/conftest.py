"""What the tests of the research share."""

import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "tools/bench"))
from board import built_firmware  # noqa: E402


@pytest.fixture(scope="session")
def elf() -> str:
    """The flashed program, built once."""
    return str(built_firmware())
