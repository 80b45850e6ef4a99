"""The dry run against the virtual machine: the same firmware, with motors, chains and wood."""

import ast
from pathlib import Path

import numpy as np
import plumb
import pytest
from plumb import _dry_run
from plumb.bench.causes import MAKER
from plumb.job.dry_run import Run, pieces
from plumb.text.errors import InputError
from scipy.spatial import cKDTree
from workshop import NAMES, PROGRAMS, Workshop, lines_of, run_dry

APART = 0.35  # [mm] between the cut and the way of the dry run; steps of 0.1 mm and following error


@pytest.mark.parametrize("name", NAMES)
def test_time_and_cut_are_those_of_the_virtual_machine(name):
    workshop = Workshop()
    took = workshop.cut(lines_of(name))
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


def test_each_program_says_where_it_goes():
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


def test_a_line_belongs_to_its_moves_also_behind_comments_and_empty_lines():
    lines = ["(a)", "", "G0 Z3", "; b", "G0 X5 Y5 (c)", "G81 X9 Z-1 R1 F50", "", "G80", "X1"]
    done = run_dry(lines)
    assert done.moves["line"].tolist() == [3, 5, 6, 6, 6, 6]
    assert done.said == ((9, "error: no motion is in force after G80; say G0 or G1"),)


def test_a_short_move_belongs_to_its_line_and_its_feed():
    moves = run_dry(["G1 X1 F600", "G4 P0", "X2", "F300 X3", "M5", "G0 X4", "M2"]).moves
    assert moves["line"].tolist() == [1, 3, 4, 6]
    assert moves["asked"].tolist() == [600, 600, 300, np.inf]


def test_moves_end_one_after_the_other_and_the_last_at_the_end():
    done = run_dry(lines_of("fusion_pocket.nc"))
    ends = done.moves["ends"]
    assert (np.diff(ends) > 0).all() and ends[0] > 0 and ends[-1] <= done.seconds
    single = run_dry(["G1 X100 F600"])
    assert single.moves["ends"][0] == pytest.approx(10.1, abs=0.3)


def test_an_alarm_ends_the_run():
    run = Run(MAKER)
    run.send(["G0 Z2", "B11 L S100 T1", "G0 X5"])
    assert run.finish().halted_at is None
    run = Run(MAKER, numbers={2: 4000.0})
    assert run.finish().seconds == 0


def test_what_no_client_can_send_is_noted_and_left_out():
    done = run_dry(["G0 X1", "G1 X2 ü", "G0 X" + "0" * 130 + "9", "G0 X3"])
    assert [each.line for each in done.refused] == [2, 3]
    assert done.moves["to_x"].tolist() == [1, 3]


def test_settings_that_the_firmware_refuses_are_refused():
    with pytest.raises(InputError, match="refuses '\\$15=-4'"):
        Run(MAKER, numbers={15: -4})
    with pytest.raises(InputError, match="no sled can hang at X0 Y2000"):
        Run(MAKER, start=(0.0, 2000.0, 0.0))


def test_the_types_name_what_the_module_has():
    tree = ast.parse(Path(plumb.__file__).with_name("_dry_run.pyi").read_text())
    machine = next(node for node in tree.body if isinstance(node, ast.ClassDef))
    stated = {node.name for node in machine.body if isinstance(node, ast.FunctionDef)}
    assert stated - {"__init__"} == {name for name in dir(_dry_run.DryRun) if name[0] != "_"}
    assert {node.name for node in tree.body if isinstance(node, ast.FunctionDef)} == {
        "pieces",
        "take_wood",
    }


def test_a_line_is_cut_as_the_firmware_cuts_it():
    assert pieces("n5 g1x2.5 (a) M3 S99;b") == [
        ("G", 1.0, {"X": 2.5}),
        ("M", 3.0, {"S": 99.0}),
    ]
    assert pieces("G38.2 Z-5")[0][1] == pytest.approx(38.2)
    assert pieces("X--5") == [] == pieces("")
