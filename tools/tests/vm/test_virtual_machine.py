"""The virtual machine: motors, chains and sled under the firmware built for the host."""

import numpy as np
import pytest
from plumb import _judge, _vm
from plumb.bench.boards import MAKER
from plumb.line.memory import read_numbers, write_numbers
from plumb.line.sender import Sender
from plumb.model.predict import judged
from plumb.vm import garage as garage_room
from plumb.vm.garage import InProcessPort

NUMBERS = judged(MAKER)
COUNT = 63.5 / 8113.73  # [mm] of chain
# What the client sends: the model's numbers are those of the judge, and z moves at all.
SETTINGS = "$29=1300\n$7=2\n$8=139.1\n$62=97.9\n$63=0.00137293\n$160=8.2e-12\n$170=5.17e-6\n"


def said_by(machine, line: str, milliseconds: int) -> list[str]:
    """The machine's lines after a line was sent, status reports left out."""
    machine.send(line.encode() + b"\n")
    machine.advance(milliseconds)
    lines = machine.take_said().decode().splitlines()
    return [line for line in lines if not line.startswith(("<", "[PE"))]


def started(*, lines: str = SETTINGS, **options) -> _vm.VirtualMachine:
    """A machine that knows its settings and its chains."""
    machine = _vm.VirtualMachine(NUMBERS, **options)
    machine.start()
    machine.advance(3000)
    assert "ready" in machine.take_said().decode()
    assert said_by(machine, lines.strip(), 3000) == ["ok"] * lines.count("\n")
    assert "ok" in said_by(machine, "B06 L1651 R1651", 1000)
    return machine


@pytest.fixture
def machine():
    return started()


def test_the_sled_is_where_the_judge_says(machine):
    said_by(machine, "G0 X300 Y-200", 40_000)
    chains = np.array([machine.chains])
    rest = _judge.places(NUMBERS, chains, pushes=0 * chains, weights=np.array([97.9]))
    assert machine.sled == pytest.approx(tuple(rest[0]), abs=1e-6)
    assert machine.sled == pytest.approx((300, -200), abs=0.05)


def test_chains_off_the_bottom_bring_the_sled_where_the_judge_says():
    machine = started(over_top=False, lines=SETTINGS + "$38=2\n")
    for x, y in ((300, -200), (-700, 350)):
        said_by(machine, f"G0 X{x} Y{y}", 90_000)
        chains = np.array([machine.chains])
        weights = np.array([97.9])
        rest = _judge.places(NUMBERS, chains, pushes=0 * chains, weights=weights, over_top=False)
        assert machine.sled == pytest.approx(tuple(rest[0]), abs=1e-6)
        assert machine.sled == pytest.approx((x, y), abs=0.05)
        over = _judge.places(NUMBERS, chains, pushes=0 * chains, weights=weights)
        assert np.hypot(*(over - rest)[0]) > 20
    # A chain off the bottom is paid out as the count falls.
    count, paid = machine.count("left"), machine.chains[0]
    said_by(machine, "G0 X-600", 30_000)
    turned = (machine.count("left") - count) * COUNT
    assert turned == pytest.approx(paid - machine.chains[0], abs=2 * COUNT)
    assert machine.chains[0] - paid > 50


@pytest.mark.parametrize(("over_top", "feed"), [(True, 2), (False, 1)])
def test_a_feed_that_the_settings_have_wrong_winds_in_what_should_be_paid_out(over_top, feed):
    """Motor and encoder are both taken the wrong way, so the machine itself cannot notice."""
    machine = started(over_top=over_top, lines=f"{SETTINGS}$38={feed}\n")
    left, _ = machine.chains
    said_by(machine, "G0 X100", 20_000)
    assert machine.chains[0] < left - 20


def test_friction_leaves_the_sled_behind_on_the_side_it_came_from():
    places = []
    for first in (-100, 300):
        machine = started(friction=8.0)
        said_by(machine, f"G0 X{first}", 30_000)
        said_by(machine, "G0 X100", 30_000)
        places.append(machine.sled[0])
    assert 0.02 < places[1] - places[0] < 1
    free = started()
    said_by(free, "G0 X100", 30_000)
    assert places[0] < free.sled[0] < places[1]


def test_numbers_that_are_said_to_be_held_outlive_a_reset():
    """Whoever opens the line next resets the board, and a new board stores for three seconds."""
    machine = _vm.VirtualMachine(NUMBERS)
    machine.start()
    sender = Sender(InProcessPort(machine))
    sender.await_start()
    write_numbers(sender, ["$62=101"])
    machine.stop()
    machine.start()
    again = Sender(InProcessPort(machine))
    again.await_start()
    assert read_numbers(again)[62] == 101


def test_a_sled_of_twenty_kilograms_travels_without_an_alarm():
    machine = started(lines=SETTINGS.replace("$62=97.9", "$62=196.1"))
    machine.set("sled_weight", 196.1)
    for place in ((-370, -290), (1100, -290), (-1100, -540), (0, -40)):
        machine.send(b"G0 X%d Y%d\n" % place)
        since = machine.seconds
        while machine.sled != pytest.approx(place, abs=5):
            machine.advance(200)
            assert machine.seconds - since < 240
        assert "ALARM" not in machine.take_said().decode()


def test_impossible_values_are_refused():
    with pytest.raises(ValueError, match="no number color"):
        _vm.VirtualMachine({"color": 1.0})
    with pytest.raises(ValueError, match="no sled can hang"):
        _vm.VirtualMachine(NUMBERS, paid_out=100.0)
    with pytest.raises(RuntimeError, match=r"cannot read absent\.elf|no simulated Mega here"):
        _vm.VirtualMachine(NUMBERS, elf="absent.elf")
    machine = _vm.VirtualMachine(NUMBERS)
    with pytest.raises(ValueError, match="left, right or z"):
        machine.count("x")
    with pytest.raises(ValueError, match="no wire has the fault rust"):
        machine.set_wire("z", "rust", True)
    with pytest.raises(ValueError, match="4096"):
        machine.eeprom = b""


def test_what_the_simulated_mega_cannot_run_is_refused(run, monkeypatch):
    monkeypatch.setattr(garage_room, "VirtualMachine", without_simavr)
    code, _, said = run("vm", "--mega", "firmware.elf")
    assert code == 2
    assert said.splitlines()[-1] == "plumb: the lab was built without the simulated Mega"


def without_simavr(*_, **__):
    raise RuntimeError("the lab was built without the simulated Mega")
