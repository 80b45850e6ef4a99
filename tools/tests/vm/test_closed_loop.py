"""The closed loop: a hidden effect is found, added, and the next sheet is better."""

from dataclasses import replace

import numpy as np
import pytest
from plumb.bench.boards import plan, size_for
from plumb.bench.causes import MAKER, Hidden, causes_of
from plumb.grid.options import Grid
from plumb.marks.read import read_marks
from plumb.plan.case import PlannedCheck
from plumb.plan.planned_visits import sent
from plumb.vm.garage import Garage, astray, random_garage
from plumb.vm.loop import closed_loop
from plumb.vm.owner import VirtualOwner, true_value

GRID = Grid(columns=5, rows=5)
NOISE = 0.4


def hiding(effect: str, millimetres: float = 3.0) -> Hidden:
    cause = causes_of(effect)[0]
    return Hidden(((cause, size_for(cause, plan(5, 5), millimetres)),))


@pytest.mark.parametrize("feed", ["top", "bottom"])
def test_a_machine_without_a_fault_cuts_where_it_should(tmp_path, feed):
    garage = Garage(Hidden(), friction=0.0, settings=replace(MAKER, feed=feed))
    owner = VirtualOwner(garage, noise=0.0)
    owner.switch_on()
    path = tmp_path / "marks.toml"
    path.write_text(owner.cut_grid(Grid(columns=2, rows=2, repeats=False)))
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


@pytest.mark.slow
def test_a_slip_is_read_again_and_then_the_effect_is_named():
    owner = VirtualOwner(random_garage(hiding("sled_swing", 6.0), 1), slip=10.0)
    loop = closed_loop(owner, grid=Grid(columns=5, rows=5, repeats=False))
    assert loop.auto.diagnosis.verdict == "one_suspect" and loop.auto.chosen == ("sled_swing",)
    # A reading costs no hole.


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


def test_a_halted_machine_starts_again_on_the_same_sheet():
    owner = VirtualOwner(random_garage(Hidden(), 3))
    owner.switch_on()
    owner.cut_grid(Grid(columns=2, rows=2, repeats=False))
    places = owner.tape.places
    owner.restart()
    assert owner.tape.places == places
    visits = sent(MAKER, np.array([(0.0, 0.0)]), controller="plumb", sled_weight=MAKER.sled_weight)
    form = owner.carry_out(visits)
    assert form.count("\nmeasured = ") == 1 and len(owner.tape.places) == 5
