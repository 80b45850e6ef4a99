"""A chain hooked across the motors: what it pulls, and what it does to them."""

import numpy as np
import pytest
from plumb import _vm
from plumb.bench.causes import MAKER
from plumb.model.predict import judged

NUMBERS = {**judged(MAKER), "left.inward": 0.004, "right.inward": 0.006}
GAP, BEYOND = NUMBERS["motor_gap"], 12.7  # [mm]


def hooked(slack: float, **options) -> _vm.VirtualMachine:
    """A machine at rest, its left chain hooked on the right sprocket, and its firmware knows it."""
    machine = _vm.VirtualMachine(NUMBERS, **options)
    machine.hook_across("left", slack, BEYOND)
    machine.start()
    machine.advance(3000)
    said(machine, f"B06 L{machine.chains[0]:.3f} R{machine.chains[1]:.3f}", 1000)
    return machine


def said(machine: _vm.VirtualMachine, line: str, milliseconds: int) -> list[str]:
    """The machine's lines after a line was sent, status reports left out."""
    machine.send(line.encode() + b"\n")
    machine.advance(milliseconds)
    lines = machine.take_said().decode().splitlines()
    return [line for line in lines if not line.startswith(("<", "[PE"))]


def level(pull: float) -> float:
    """[N] The level part of a pull: each motor carries half of the chain."""
    return float(np.sqrt(pull**2 - (NUMBERS["left.weight"] * GAP / 2) ** 2))


def excess(pull: float) -> float:
    """[mm] A parabola's length less the gap, of a chain that stretches on a frame that gives."""
    sag = NUMBERS["left.weight"] ** 2 * GAP**3 / (24 * level(pull) ** 2)
    return sag - level(pull) * (NUMBERS["left.compliance"] * GAP + 0.010)


@pytest.mark.parametrize("slack", [30.0, 5.0, 0.5])
def test_a_slack_chain_pulls_as_a_parabola(slack):
    machine = hooked(slack)
    pull, drop = machine.across
    assert excess(pull) == pytest.approx(slack, rel=0.02)
    parabola = NUMBERS["left.weight"] * GAP**2 / (8 * level(pull))
    assert drop == pytest.approx(parabola, rel=0.02)


def test_the_hook_is_refused_where_nothing_could_hang():
    machine = _vm.VirtualMachine(NUMBERS)
    with pytest.raises(ValueError, match="over the top"):
        machine.hook_across("z", 5)
    with pytest.raises(ValueError, match="no chain of this length"):
        machine.hook_across("left", -200)
    below = _vm.VirtualMachine({**judged(MAKER)}, over_top=False, paid_out=1680)
    with pytest.raises(ValueError, match="over the top"):
        below.hook_across("left", 5)


def test_motors_without_power_give_way_until_their_friction_holds_the_chain():
    machine = _vm.VirtualMachine(NUMBERS)
    machine.hook_across("left", -6, BEYOND)
    tight = machine.across[0]
    machine.advance(2000)
    friction = 1.5 / 0.0101063  # [N] of the motor's 1.5 Nm on its sprocket
    assert tight > 1.4 * friction
    assert 0.5 * friction < machine.across[0] < friction  # they run on a little
    assert machine.count("left") > 0
    assert machine.count("right") > 0
