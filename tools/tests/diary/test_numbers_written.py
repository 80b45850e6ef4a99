"""Numbers that are written to the machine leave a way back, whatever happens on the way."""

import pytest
from numbers_machine import NumbersMachine
from plumb.diary.file import write_and_keep
from plumb.line.memory import kept_before
from plumb.line.sender import Sender
from plumb.text.errors import InputError


def written(tmp_path, machine, *lines, back=False):
    path = str(tmp_path / "machine.toml")
    return write_and_keep(Sender(machine), path, list(lines), back=back)


def test_the_old_numbers_are_kept_and_the_change_is_in_the_diary(tmp_path):
    (tmp_path / "machine.toml").write_text("")
    done, kept, failure = written(tmp_path, NumbersMachine(), "$38=15.5")
    assert done.changed == {38: (0.0, 15.5)} and failure == ""
    assert kept_before(tmp_path / "machine.toml") == ["$12=2978.4", "$15=8113.73", "$38=0"]
    assert "-before-" in kept and "15.5" in (tmp_path / "diary.jsonl").read_text()


def test_a_machine_that_took_only_some_numbers_can_have_the_old_back(tmp_path):
    machine = NumbersMachine(forgets=(38,))
    with pytest.raises(InputError, match=r"holds \$38=0\.0 .*The old numbers are in .*before"):
        written(tmp_path, machine, "$12=2970", "$38=15.5")
    assert machine.numbers[12] == 2970
    lines = kept_before(tmp_path / "machine.toml")
    written(tmp_path, machine, *lines, back=True)
    assert machine.numbers[12] == 2978.4
    assert kept_before(tmp_path / "machine.toml") == lines


def test_what_was_refused_before_it_was_sent_keeps_nothing(tmp_path):
    with pytest.raises(InputError, match="the machine moves: wait until it stands, then send"):
        written(tmp_path, NumbersMachine(speed=0.1), "$38=15.5")
    assert list(tmp_path.iterdir()) == []
