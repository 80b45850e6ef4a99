"""Tests of this room ask the same of the same boards."""

import pytest
from asked_again import tried_in_full, tried_less  # noqa: F401
from plumb.settings import write_machine_toml
from synthetic import BELIEVED


@pytest.fixture
def maker(tmp_path):
    """The settings of the owner of the made-up marks, as a file."""
    path = tmp_path / "machine.toml"
    write_machine_toml(path, BELIEVED)
    return path
