"""What the tests of the virtual machine share."""

import pytest
from served_machine import Served


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
