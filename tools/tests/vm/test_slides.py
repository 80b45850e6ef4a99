"""A sled whose motors let go, or that loses an encoder: it stays, or its chain is braked."""

from dataclasses import dataclass, replace

import numpy as np
import pytest
from plumb.bench.boards import MAKER
from plumb.vm.garage import VirtualMachine
from usual_machine import declaration, switched_on, usual_machine

STAYS = "The motors stay on: so high on the sheet the sled would slide ($77). Park it lower."
SLIDES = "The sled slid with its motors off: they hold it until after its next move."
MOST = 1.5  # [mm] the chain gives 0.4 mm, and some more until its motor holds
CREEP = 0.5  # [mm] at most, of what was let go
HELD = 0.05  # [mm] at most, of what has power
USUAL = "$77=1.4"  # [N m]
TRUSTED = "$77=10"  # [N m] the machine believes that its gears hold any sled


@pytest.mark.parametrize(
    ("brain", "height", "setting", "warned", "most"),
    [
        ("host", 605.0, USUAL, STAYS, HELD),
        ("host", 450.0, USUAL, "", CREEP),
        ("host", 605.0, TRUSTED, SLIDES, MOST),
        pytest.param("mega", 605.0, TRUSTED, SLIDES, MOST, marks=pytest.mark.slow),
    ],
)
def test_a_sled_stays_where_it_was(brain, height, setting, warned, most, elf):
    machine = usual_machine(elf=elf if brain == "mega" else None)
    said: list[str] = []
    sender = switched_on(machine, MAKER, said=said.append)
    sender.stream([setting, declaration(machine), f"G0 X0 Y{height}", "G4 P0"])
    lowest = farthest_in(30, machine)
    sender.stream(["G1 X200 F600", "G4 P0"])
    x, y = machine.sled
    assert lowest < most
    assert (x, y) == pytest.approx((200, height), abs=CREEP)
    farthest_in(10, machine)
    sender.stream(["G1 X150", "G4 P0"])
    heard = [line for line in said if line in (STAYS, SLIDES)]
    # That they stay on is said once; each time that it slides is news.
    assert heard == ([STAYS] if warned == STAYS else [SLIDES] * len(heard))
    assert bool(heard) == bool(warned)
    assert (lowest > CREEP) == (warned == SLIDES)


def farthest_in(seconds: int, machine: VirtualMachine) -> float:
    """How far the sled goes [mm] from where it stands."""
    stood, farthest = machine.sled, 0.0
    for _ in range(10 * seconds):
        machine.advance(100)
        farthest = max(farthest, float(np.hypot(*np.subtract(machine.sled, stood))))
    return farthest


MOST_BEYOND = 3.0  # [mm] of a chain, beyond what a power cut lets it run
ALARM = b"ALARM: The sled is not keeping up"


@dataclass(frozen=True)
class Loss:
    """A machine whose left encoder is lost, at this feed [mm/min] or at rest."""

    feed: int
    seed: int = 0  # of its motors
    way: int = 1  # +1: its left chain pays out, -1: it winds in
    elf: str | None = None
    shield: int = 2

    def run(self, *, is_cut: bool) -> float:
        """How far the chain runs [mm] until it stands; `is_cut`: after a power cut instead."""
        machine = self.machine()
        begin = farthest = machine.chains[0]
        if is_cut:
            machine.cut_power()
        else:
            machine.set_wire("left", "encoder_unplugged", True)
            self.move_from_rest(machine)
        said = b""
        for _ in range(400):
            machine.advance(20)
            said += machine.take_said()
            farthest = max(farthest, machine.chains[0], key=lambda length: abs(length - begin))
        assert (ALARM in said) != is_cut
        machine.advance(500)
        assert machine.chains[0] == pytest.approx(farthest, abs=0.01), "it has to stand"
        return abs(farthest - begin)

    def machine(self) -> VirtualMachine:
        """The machine at the moment of the loss."""
        machine = usual_machine(elf=self.elf, seed=self.seed, shield=self.shield)
        sender = switched_on(machine, MAKER)
        # To and fro: the machine learns which duty the motors need either way.
        ways = [f"G1 X{self.way * x} F800" for x in (-140, -60, -100)]
        sender.stream([declaration(machine), *ways, "G4 P0"])
        if self.feed:
            machine.send(b"G1 X%d F%d\n" % (200 * self.way, self.feed))
        machine.advance(2000 if self.feed else 1500)
        return machine

    def move_from_rest(self, machine: VirtualMachine) -> None:
        """A rest with power, and then a slow move, which shows that an encoder is lost."""
        if self.feed == 0:
            machine.send(b"G4 S5\nG1 X%d F60\n" % (200 * self.way))
            machine.advance(5000)


@pytest.mark.parametrize(
    ("feed", "seed", "way"), [(0, 0, 1), (60, 1, -1), (200, 3, 1), (1000, 4, 1), (1000, 1, -1)]
)
def test_a_chain_without_encoder_is_braked(feed, seed, way):
    loss = Loss(feed, seed, way)
    assert loss.run(is_cut=False) < loss.run(is_cut=True) + MOST_BEYOND


@pytest.mark.parametrize("shield", [2, 3])
def test_the_flashed_program_brakes_it_on_either_driver(elf, shield):
    loss = Loss(200, seed=3, elf=elf, shield=shield)
    ran = loss.run(is_cut=False)
    assert 0.3 < ran < replace(loss, elf=None).run(is_cut=True) + MOST_BEYOND
