"""Lines with numbers for the machine: the right file's, and those that it had before."""

import pytest
from plumb.line.memory import kept_before
from plumb.text.errors import InputError


def test_the_newest_numbers_come_back(tmp_path):
    for day, gap in (("2026-01-02", 2), ("2026-01-10", 3), ("2025-12-31", 1)):
        (tmp_path / f"machine-before-{day}.nc").write_text(f"$2={gap}\n$3=5\n")
    (tmp_path / "other-before-2027-01-01.nc").write_text("$2=4\n")
    assert kept_before(tmp_path / "machine.toml") == ["$2=3", "$3=5"]


def test_without_kept_numbers_there_is_a_remedy(tmp_path):
    with pytest.raises(InputError, match="nothing was kept when it was sent; send it first"):
        kept_before(tmp_path / "machine.toml")
