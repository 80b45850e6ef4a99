"""Fixtures of the tests of the virtual machine."""

import os
import sys

import pytest
from example_machine import ROOT
from served_machine import Served


@pytest.fixture(scope="session")
def elf() -> str:
    """The flashed program, built once."""
    if os.name == "nt":
        pytest.skip("the simulated Mega needs Linux")
    sys.path.insert(0, str(ROOT / "tools/bench"))
    from board import built_firmware

    return str(built_firmware())


@pytest.fixture
def served(tmp_path):
    running = []

    def serve(*words: str) -> Served:
        running.append(Served(tmp_path, *words))
        return running[-1]

    yield serve
    for server in running:
        server.program.kill()
        server.program.wait()
