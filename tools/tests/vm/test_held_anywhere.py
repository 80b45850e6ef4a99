"""Holds at any moment, and other feeds, leave the way of a program as it is."""

import numpy as np
import pytest
from plumb.bench.boards import MAKER
from scipy.spatial import cKDTree
from usual_machine import declaration, switched_on, usual_machine

HOLD, GO_ON = b"\x84", b"~"
FEEDS = [bytes([each]) for each in range(0x90, 0x95)]
STEP = 20  # [ms] between two looks
APART = 0.6  # [mm] between two looks the sled goes 0.33 mm
LONGEST = 600_000  # [ms]
AHEAD = 126  # characters that clients send ahead
PROGRAM = """
G21 G90
G0 X20 Y10
G1 Z-2 F300
G91 G1 X5 Y6 F900
X4
G90
G2 X49 Y16 R10
G20
G1 X2.2 Y0.2 F30
G93 G1 X2 Y0.6 F40
G94 F33
G21 G3 X50.8 Y15.24 I-8 J0 Z-3 F700
G92 X0 Y0
G1 X4 Y-6
Y-8
G0 Z3
G92.1
G99 G83 X60 Y5 Z-4 R1 Q2 F200
X66
G80
G0 Z4
G4 P300
G0 X70
"""


def machine_at_rest(elf=None):
    """A machine without errors at the middle of its sheet."""
    machine = usual_machine(elf=elf)
    sender = switched_on(machine, MAKER)
    sender.stream([declaration(machine)])
    machine.take_said()
    return machine


class Client:
    """Sends a program as clients do, and counts the answers."""

    def __init__(self, machine):
        self.machine = machine
        self.lines = [line.encode() + b"\n" for line in [*PROGRAM.split("\n")[1:-1], "G4 P0"]]
        self.sent = self.answered = 0
        self.is_held, self.holds = False, 0

    def press(self, source):
        """A hold or its end, or another feed, at a moment that is drawn."""
        draw = source.random()
        if draw < (0.03 if self.is_held else 0.015):
            self.machine.send(GO_ON if self.is_held else HOLD)
            self.holds += not self.is_held
            self.is_held = not self.is_held
        elif draw > 0.995:
            self.machine.send(source.choice(FEEDS))

    def pass_time(self):
        while self.sent < len(self.lines) and self.is_room():
            self.machine.send(self.lines[self.sent])
            self.sent += 1
        self.machine.advance(STEP)
        said = [line.strip() for line in self.machine.take_said().split(b"\n")]
        assert not [line for line in said if line.startswith((b"error", b"ALARM"))], said
        # A `~` that ends a hold has none.
        self.answered += said.count(b"ok")

    def is_room(self):
        waiting = self.lines[self.answered : self.sent + 1]
        return sum(map(len, waiting)) <= AHEAD

    def run(self, source):
        """Where the bit was, at every look [mm]."""
        places = []
        while len(places) * STEP < LONGEST:
            if source is not None and self.answered < len(self.lines):
                self.press(source)
            elif self.is_held:
                self.machine.send(GO_ON)
                self.is_held = False
            self.pass_time()
            places.append((*self.machine.sled, self.machine.height))
            if self.answered >= len(self.lines):
                return np.array(places)
        raise AssertionError(f"{self.answered} of {len(self.lines)} lines were answered")


MEGA = pytest.param(1, "mega", marks=pytest.mark.slow)


@pytest.mark.parametrize(("seed", "brain"), [(0, "host"), (1, "host"), MEGA])
def test_holds_at_any_moment_leave_the_path_unchanged(seed, brain, elf):
    usual = Client(machine_at_rest()).run(None)
    client = Client(machine_at_rest(elf if brain == "mega" else None))
    held = client.run(np.random.default_rng(seed))
    assert client.holds > 20 and len(held) > 1.3 * len(usual)
    assert cKDTree(usual).query(held)[0].max() < APART
    assert cKDTree(held).query(usual)[0].max() < APART
    assert held[-1] == pytest.approx(usual[-1], abs=0.1)
