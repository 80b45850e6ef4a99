"""The machine's numbers over the line: listed, written, read back, and those of before."""

import pytest
from numbers_machine import NumbersMachine
from plumb.line.memory import kept_before, read_numbers, write_numbers
from plumb.line.sender import Sender
from plumb.text.errors import InputError


def test_all_numbers_are_read():
    assert read_numbers(Sender(NumbersMachine())) == {12: 2978.4, 15: 8113.73, 38: 0.0}


def test_a_board_without_numbers_is_refused():
    machine = NumbersMachine()
    machine.numbers = {}
    with pytest.raises(InputError, match="is it a Maslow's firmware"):
        read_numbers(Sender(machine))


def test_a_changed_number_is_reported_with_its_old_value():
    machine = NumbersMachine()
    written = write_numbers(Sender(machine), ["$12=2978.41", "$15 = 8113.73", "$38=15.5"])
    assert written.before == {12: 2978.4, 15: 8113.73, 38: 0.0}
    assert written.changed == {38: (0.0, 15.5)}  # $12: the machine prints seven digits
    assert machine.numbers[12] == 2978.41


@pytest.mark.parametrize("line", ["B05", "$12", "G1 X5", "$12=5 $13=6"])
def test_a_line_that_sets_no_number_is_refused_before_any_is_sent(line):
    machine = NumbersMachine()
    with pytest.raises(InputError, match=r"is not a number for the machine: \$N=VALUE"):
        write_numbers(Sender(machine), ["$38=15.5", line])
    assert machine.written == []


@pytest.mark.parametrize(
    ("line", "held"), [("$38=15.5", "38=0.0"), ("$15=8114.73", "15=8113.73"), ("$99=1", "99=None")]
)
def test_a_number_that_the_machine_does_not_hold_is_named(line, held):
    machine = NumbersMachine(forgets=(15, 38, 99))
    with pytest.raises(InputError, match=rf"holds \${held} though .* was sent"):
        write_numbers(Sender(machine), [line])


def test_a_machine_that_moves_gets_no_numbers():
    machine = NumbersMachine(speed=0.1)
    with pytest.raises(InputError, match="the machine moves"):
        write_numbers(Sender(machine), ["$38=15.5"])
    assert machine.written == []


def test_the_newest_numbers_come_back(tmp_path):
    for day, gap in (("2026-01-02", 2), ("2026-01-10", 3), ("2025-12-31", 1)):
        (tmp_path / f"machine-before-{day}.nc").write_text(f"$2={gap}\n$3=5\n")
    (tmp_path / "other-before-2027-01-01.nc").write_text("$2=4\n")
    assert kept_before(tmp_path / "machine.toml") == ["$2=3", "$3=5"]


def test_without_kept_numbers_there_is_a_remedy(tmp_path):
    with pytest.raises(InputError, match="nothing was kept when it was sent; send it first"):
        kept_before(tmp_path / "machine.toml")
