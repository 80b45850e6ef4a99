"""B11 on a chain across the motors: how hard it pulls, how well it repeats, and when it stops."""

import re

import numpy as np
import pytest
from plumb import _vm
from plumb.bench.boards import MAKER
from plumb.model.predict import judged

NUMBERS = {**judged(MAKER), "left.inward": 0.004, "right.inward": 0.006}
GAP, BEYOND = NUMBERS["motor_gap"], 12.7  # [mm]
SAID = re.compile(r"Motor gap ([\d.]+) mm .* spread ([\d.]+) mm, (\d) pulls? with about (\d+) N\.")
DEAD = "The left motor hardly turns: check its supply, its cables and its encoder."
SLACK = "The chain is not tight yet: hook it on the other sprocket, send B11 again."


class Pulled:
    """A machine, its left chain hooked across, after a B11: what was said and what truly pulled."""

    def __init__(self, line: str, *, slack: float = 5.0, volts: float = 12.0, **options) -> None:
        self.machine = _vm.VirtualMachine(options.pop("numbers", NUMBERS), **options)
        self.machine.hook_across("left", slack, BEYOND)
        self.machine.set_motor_supply(volts)
        self.machine.start()
        self.machine.advance(3000)
        left, right = self.machine.chains
        self.machine.send(f"B06 L{left:.3f} R{right:.3f}\n".encode())
        self.machine.advance(1000)
        self.machine.take_said()
        self.machine.send(line.encode() + b"\n")
        self.lines: list[str] = []
        self.most_pull = self.seconds = 0.0

    def go_on(self, seconds: float) -> None:
        """Until the line is answered, or so long."""
        for _ in range(int(seconds * 100)):
            self.machine.advance(10)
            self.seconds += 0.01
            self.most_pull = max(self.most_pull, self.machine.across)
            heard = self.machine.take_said().decode().splitlines()
            self.lines += [each for each in heard if not each.startswith(("<", "[PE"))]
            if "ok" in self.lines:
                return

    def answered(self) -> list[str]:
        self.go_on(30)
        return self.lines[1:]


def numbers_of(lines: list[str]) -> tuple[float, float, int, int]:
    """Gap, spread, pulls and force of the line of B11."""
    match = SAID.match(lines[0])
    assert match and lines[1:] == ["ok"], lines
    gap, spread, pulls, force = match.groups()
    return float(gap), float(spread), int(pulls), int(force)


@pytest.mark.parametrize("volts", [13.0, 9.0])
def test_three_pulls_with_the_stated_force_whatever_the_supply(volts):
    pulled = Pulled("B11 S255 T15 L", volts=volts)
    gap, spread, pulls, force = numbers_of(pulled.answered())
    assert pulls == 3
    assert spread < 0.15
    assert force == pytest.approx(80, abs=3)
    assert pulled.machine.across == pytest.approx(force, rel=0.1)
    assert pulled.most_pull < 100
    assert gap == pytest.approx(pulled.machine.chains[0] - BEYOND, abs=spread + 0.02)


@pytest.mark.parametrize("seed", range(1, 5))
def test_motors_that_are_off_by_30_percent_pull_as_hard_as_stated(seed):
    pulled = Pulled("B11 S255 T15 L", seed=seed)
    _, spread, pulls, _ = numbers_of(pulled.answered())
    assert (pulls, spread < 0.5) == (3, True)
    assert 60 <= pulled.most_pull <= 106


def test_the_machine_stays_below_the_pull_of_a_sled_when_the_chain_is_tight_before():
    pulled = Pulled("B11 S255 T3 L", slack=-1.0)
    _, _, pulls, _ = numbers_of(pulled.answered())
    assert pulls >= 1
    assert pulled.most_pull < 145


@pytest.mark.parametrize("slack", [9.0, 40.0])
def test_it_never_takes_longer_than_the_seconds_of_its_line(slack):
    pulled = Pulled("B11 S255 T3 L", slack=slack)
    lines = pulled.answered()
    assert pulled.seconds < 3.3  # the line itself takes its time to come and to go
    assert (lines == [SLACK, "ok"]) == (slack > 20)


@pytest.mark.parametrize(
    ("wire", "at"), [("encoder_unplugged", 1.5), ("motor_unplugged", 3.0), ("channel_lost", 4.5)]
)
def test_a_lost_wire_stops_it(wire, at):
    pulled = Pulled("B11 S255 T15 L")
    pulled.go_on(at)
    pulled.machine.set_wire("left", wire, True)
    assert pulled.answered()[-2:] == [DEAD, "ok"]
    assert pulled.machine.duty("left") == 0
    assert pulled.most_pull < 110


@pytest.mark.parametrize("at", [2.5, 4.4])
def test_a_chain_that_comes_off_in_a_pull_is_wound_in_until_the_time_is_over(at):
    pulled = Pulled("B11 S255 T6 L")
    pulled.go_on(at)
    pulled.machine.hook_across("left", 200.0, BEYOND)
    lines = pulled.answered()
    assert lines[-1] == "ok" and 5 < pulled.seconds < 6.3
    assert pulled.machine.duty("left") == 0


@pytest.mark.parametrize(("volts", "at"), [(11.0, 1.2), (9.0, 4.0)])
def test_a_supply_that_sags_in_the_middle_stops_it(volts, at):
    pulled = Pulled("B11 S255 T15 L")
    pulled.go_on(at)
    pulled.machine.set_motor_supply(volts)
    assert pulled.answered() == [DEAD, "ok"]


def test_pulls_that_differ_are_reported():
    pulled = Pulled("B11 S255 T15 L")
    while pulled.machine.across < 75:
        pulled.go_on(0.02)
    pulled.machine.set("left.inward", 0.03)  # the bracket comes loose
    lines = pulled.answered()
    assert lines[1] == "The pulls differ: look after chain, hook and supply, send B11 again."
    assert numbers_of([lines[0], "ok"])[1] > 0.5


def test_the_flashed_program_pulls_as_the_host_does(elf):
    host, mega = (Pulled("B11 S255 T6 L", elf=each) for each in (None, elf))
    ours, theirs = (numbers_of(each.answered()) for each in (host, mega))
    np.testing.assert_allclose(theirs[0], ours[0], atol=0.15)
    assert theirs[2] == ours[2]
    assert mega.most_pull == pytest.approx(host.most_pull, rel=0.1)
