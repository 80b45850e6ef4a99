"""The guide replaces its settings' file; what was in it stays."""

import pytest
from plumb.guide.steps import keep_other


@pytest.fixture
def path(tmp_path):
    path = tmp_path / "machine.toml"
    path.write_bytes(b"first")
    return path


def names(path):
    return sorted(each.name for each in path.parent.iterdir())


def test_a_replaced_file_is_kept_once(path):
    keep_other(path, b"second")
    keep_other(path, b"second")
    assert names(path) == ["machine-old.toml", "machine.toml"]
    assert path.with_name("machine-old.toml").read_bytes() == b"first" == path.read_bytes()


def test_another_file_that_is_replaced_gets_a_further_name(path):
    keep_other(path, b"second")
    path.write_bytes(b"second")
    keep_other(path, b"third")
    assert path.with_name("machine-old-2.toml").read_bytes() == b"second"
    assert path.with_name("machine-old.toml").read_bytes() == b"first"
