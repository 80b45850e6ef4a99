"""The dry run against the virtual machine: the same firmware, with motors, chains and wood."""

import numpy as np
import pytest
from plumb.bench.causes import MAKER
from plumb.firmware.telemetry import telemetry_in
from plumb.job.dry_run import Run, pieces
from scipy.spatial import cKDTree
from workshop import NAMES, PROGRAMS, Workshop, lines_of, run_dry

APART = 0.35  # [mm] between the cut and the way of the dry run; steps of 0.1 mm and following error


@pytest.mark.parametrize("name", NAMES)
def test_time_and_cut_are_those_of_the_virtual_machine(name):
    workshop = Workshop()
    took = workshop.cut(lines_of(name))
    telemetry = telemetry_in("\n".join(workshop.sender.ask("B30")))
    assert (telemetry.slips, telemetry.last_slip) == ((0, 0), None), "no chain seems to slip"
    done = run_dry(lines_of(name))
    assert done.seconds == pytest.approx(took, rel=0.005)
    assert done.halted_at is None and not done.refused
    way = done.moves.sampled(0.1)
    tree = cKDTree(np.column_stack([way.places, way.z]))
    cut = np.array(workshop.machine.cuts())[:, 2:]
    cut[:, 2] *= -1
    off, _ = tree.query(cut)
    assert off.max() < APART
    # And all of the way that is in the wood was cut.
    rises = done.moves["z_to"] > done.moves["z_from"]
    deep = (way.z < -0.1) & ~rises[way.move]
    off, _ = cKDTree(cut).query(np.column_stack([way.places, way.z])[deep])
    assert off.max() < APART


def test_each_program_has_its_places():
    assert len(NAMES) == 13
    for name in NAMES:
        rows = [
            list(map(float, row.split()))
            for row in (PROGRAMS / name).with_suffix(".places").read_text().splitlines()
            if not row.startswith("#")
        ]
        for line, *place in rows:
            run = Run(MAKER)
            run.send(lines_of(name)[: int(line)])
            assert run.place == pytest.approx(place, abs=0.008), (name, line)


def test_an_alarm_ends_the_run():
    run = Run(MAKER)
    run.send(["G0 Z2", "B11 L S100 T1", "G0 X5"])
    assert run.finish().halted_at is None
    run = Run(MAKER, numbers={2: 4000.0})
    assert run.finish().seconds == 0


def test_a_line_is_cut_as_the_firmware_cuts_it():
    assert pieces("n5 g1x2.5 (a) M3 S99;b") == [
        ("G", 1.0, {"X": 2.5}),
        ("M", 3.0, {"S": 99.0}),
    ]
    assert pieces("G38.2 Z-5")[0][1] == pytest.approx(38.2)
    assert pieces("X--5") == [] == pieces("")
