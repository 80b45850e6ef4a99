"""Home marks: kept, read again, and a position that was lost is back with the bit in the hole."""

import numpy as np
from plumb.hidden import MAKER, Hidden, causes_of
from plumb.job.home import hole_program, home_fit, new_home_mark, repair_program
from plumb.model.predict import lengths
from plumb.vm.garage import marks_on, random_garage
from usual_machine import switched_on

LEFT, RIGHT = (-900.0, 250.0), (900.0, -250.0)
EVENING = 6000  # [ms] at rest, after which the position is in the memory
HAND = 0.3  # [mm] of a coordinate: how well a bit sits in its hole


class Workshop:
    """A virtual machine with its owner, who puts the bit into holes by hand."""

    def __init__(self, seed):
        hidden = Hidden(((causes_of("chain_pitch")[0], 1.0),))
        self.garage = random_garage(hidden, seed)
        self.machine = self.garage.machine()
        self.sender = switched_on(self.machine, self.garage.settings)
        self.machine.advance(EVENING)

    def send(self, *lines):
        self.sender.stream([*lines, "G4 P2000"])

    def place_at(self, x, y):
        """Where the sled truly is [mm] when the machine has gone to a place."""
        self.send(f"G0 X{x - 40} Y{y}", f"G1 X{x} Y{y} F700")
        return np.array(self.machine.sled)

    def lose_position(self):
        """The power goes while the sled moves."""
        self.machine.send(b"G1 X900 F700\n")
        self.machine.advance(3000)
        self.machine.cut_power()
        heard = []
        self.sender = switched_on(self.machine, said=heard.append)
        return heard

    def put_bit_at(self, place):
        """Motors without power; the owner holds the bit in the hole until the gears rest."""
        for _ in range(24):
            (there, here), _ = lengths(MAKER, np.array([place, self.machine.sled]))
            for side, missing in zip(("left", "right"), there - here, strict=True):
                self.machine.slip(side, missing)
            self.machine.advance(200)


def test_a_lost_position_is_restored_with_the_bit_in_the_hole():
    workshop, source = Workshop(seed=2), np.random.default_rng(2)
    marks = {
        name: new_home_mark(MAKER, name, place)
        for name, place in (("left", LEFT), ("right", RIGHT))
    }
    for mark in marks.values():
        workshop.send(*hole_program(mark))
    holes = dict(zip(marks, marks_on(workshop.machine.cuts()), strict=True))
    sites = [(0.0, 0.0), (-600.0, -300.0), (700.0, 300.0)]
    before = [workshop.place_at(*site) for site in sites]

    heard = workshop.lose_position()
    assert any("Position Lost" in line for line in heard)
    workshop.put_bit_at(holes["left"] + HAND * source.standard_normal(2))
    workshop.send(*repair_program(np.array(marks["left"].chains), where="home mark left"))
    workshop.send("G10 Z0")  # which may have been on its way too
    after = [workshop.place_at(*site) for site in sites]
    # As good as a touch, larger where the same chains move the sled more.
    assert np.abs(np.subtract(after, before)).max() < 4 * HAND

    # The second hole: the bit is put into it, and the machine shows where it believes to be.
    workshop.place_at(*RIGHT)
    workshop.send("G0 Z5")
    missed = np.array(workshop.machine.sled) - holes["right"]
    status = workshop.sender.status
    shown = np.array(status.place[:2]) - missed
    assert home_fit(MAKER, marks["right"], tuple(shown)).fits
