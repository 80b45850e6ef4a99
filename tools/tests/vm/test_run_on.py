"""A chain whose encoder is lost is braked: it hardly runs farther than a power cut lets it."""

from dataclasses import dataclass, replace

import pytest
from plumb.bench.causes import MAKER
from plumb.vm.garage import VirtualMachine
from usual_machine import declaration, switched_on, usual_machine

MOST = 3.0  # [mm] of a chain, beyond what a power cut lets it run
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
    assert loss.run(is_cut=False) < loss.run(is_cut=True) + MOST


@pytest.mark.parametrize("shield", [2, 3])
def test_the_flashed_program_brakes_it_on_either_driver(elf, shield):
    loss = Loss(200, seed=3, elf=elf, shield=shield)
    ran = loss.run(is_cut=False)
    assert 0.3 < ran < replace(loss, elf=None).run(is_cut=True) + MOST
