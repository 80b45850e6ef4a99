"""A virtual machine and its owner: it cuts as the judge says, and its readings are true."""

from dataclasses import replace

import numpy as np
import pytest
from plumb.bench.boards import plan, size_for
from plumb.bench.causes import MAKER, Hidden, causes_of
from plumb.grid.options import Grid
from plumb.grid.program import marks_list, program
from plumb.line.sender import Sender
from plumb.marks.read import read_marks
from plumb.model.reach import plain_machine
from plumb.plan.case import PlannedCheck
from plumb.vm.garage import Garage, astray
from plumb.vm.owner import InProcessPort, VirtualOwner, set_up, true_value


def hiding(effect: str, millimetres: float = 3.0) -> Hidden:
    cause = causes_of(effect)[0]
    return Hidden(((cause, size_for(cause, plan(5, 5), millimetres)),))


@pytest.mark.parametrize("feed", ["top", "bottom"])
def test_a_machine_without_a_fault_cuts_where_it_should(tmp_path, feed):
    garage = Garage(Hidden(), friction=0.0, settings=replace(MAKER, feed=feed))
    owner = VirtualOwner(garage, noise=0.0)
    set_up(port := InProcessPort(owner.machine), owner.settings)
    path = tmp_path / "marks.toml"
    grid, machine = Grid(columns=2, rows=2, repeats=False), plain_machine(owner.settings)
    Sender(port).stream(program(grid, machine).splitlines())
    path.write_text(owner.tape.fill(marks_list(grid, machine), owner.machine))
    marks = read_marks(path, sheet=MAKER.sheet).marks
    assert {mark.name for mark in marks} == {"1", "2", "3", "4"}
    for mark in marks:
        assert mark.measured == pytest.approx(mark.target, abs=0.12)


def test_the_simulated_owners_readings_are_true_and_no_better_than_a_tapes():
    owner = VirtualOwner(Garage(hiding("chain_pitch"), motor_gap=2981.0))
    (gap,) = owner.check([PlannedCheck("motor_gap", 1.0)])
    assert abs(gap.value - 2981.0) < 4
    assert gap.value != 2981.0
    assert true_value(owner.garage, "chain_pitch.left") > 5e-4
    assert true_value(owner.garage, "chain_stretch.compliance") == 5.17e-6
    assert true_value(owner.garage, "motor_level.height_difference") == 0
    assert true_value(owner.garage, "sled_friction.drag") == owner.garage.friction


def test_an_unexplained_field_moves_marks_by_its_size():
    hidden = Hidden(outside="bump", outside_mm=3.0)
    across, up = np.meshgrid(np.linspace(-1100, 1100, 5), np.linspace(-500, 500, 5))
    places = np.stack([across.ravel(), up.ravel()], axis=1)
    moved = astray(hidden, places, 4)
    assert np.sqrt(np.mean(np.sum(moved**2, axis=1))) == pytest.approx(3.0)
    # A place is moved alike whatever else is asked about.
    assert astray(hidden, places[7:8], 4) == pytest.approx(moved[7:8])
    assert not astray(Hidden(), places, 4).any()
    garage = Garage(hidden, seed=4)
    assert garage.read(places) == pytest.approx(places + moved)
