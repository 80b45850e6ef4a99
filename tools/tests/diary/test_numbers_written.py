"""Numbers that are written to the machine leave a way back, whatever happens on the way."""

import pytest
from numbers_machine import NumbersMachine
from plumb.diary.file import read_diary, write_and_keep
from plumb.line.memory import kept_before
from plumb.line.sender import Sender
from plumb.text.errors import InputError


def written(tmp_path, machine, *lines, back=False):
    path = tmp_path / "machine.toml"
    return write_and_keep(Sender(machine), path, list(lines), back=back)


def test_a_machine_that_took_only_some_numbers_can_have_the_old_back(tmp_path):
    machine = NumbersMachine(forgets=(38,))
    (tmp_path / "machine.toml").touch()
    with pytest.raises(InputError, match=r"holds \$38=0\.0 .*The old numbers are in .*before"):
        written(tmp_path, machine, "$12=2970", "$38=15.5")
    assert machine.numbers[12] == 2970
    lines = kept_before(tmp_path / "machine.toml")
    written(tmp_path, machine, *lines, back=True)
    assert machine.numbers[12] == 2978.4
    noted = read_diary(tmp_path).entries[-1].content
    assert noted["changed"]["$12"] == [2970, 2978.4] and noted["lines"] == lines
    assert kept_before(tmp_path / "machine.toml") == lines
