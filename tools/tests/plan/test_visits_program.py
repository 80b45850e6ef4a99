"""Planned visits as a program that cuts them, and as a form that waits for their readings."""

import numpy as np
import pytest
from plumb.marks.form import read_form
from plumb.plan.planned_visits import (
    joined,
    marks_file,
    nowhere,
    program,
    sent,
)
from plumb.text.values import MM
from synthetic import BELIEVED


def test_the_program_waits_before_the_first_mark_and_after_the_last():
    visits = sent(BELIEVED, [(0.0, 0.0), (300.0, 0.0)], controller="plumb", sled_weight=146.95)
    parts = program(visits, usual_weight=97.9).split("M0")
    assert [part.count("G1 Z-0.5") for part in parts] == [0, 2, 0]
    assert "let 5.0 kg more" in parts[0] and "G0 Z5" in parts[0] and "take off" in parts[1]
    assert parts[1].index("G0 X0 Y0") < parts[1].index("take off")
    usual = sent(BELIEVED, [(0.0, 0.0)], controller="plumb", sled_weight=97.9)
    assert "M0" not in program(usual, usual_weight=97.9)


def test_a_form_keeps_place_side_and_weight(file):
    targets, sides = (
        np.array([(-1000.0, 480.0), (20.0, -300.0)]),
        np.array([(0.0, 1.0), (0.6, -0.8)]),
    )
    visits = sent(
        BELIEVED,
        targets,
        controller="plumb",
        sled_weight=147.0,
        approaches=sides,
    )
    text = marks_file(
        visits, sheet=BELIEVED.sheet, controller="plumb", said=("Four marks.",), unit=MM
    )
    read = read_form(file("form.toml", text), sheet=BELIEVED.sheet).measurements
    assert read.controller == "plumb" and len(read.marks) == 2
    for mark, target, side in zip(read.marks, targets, sides, strict=True):
        assert mark.target == pytest.approx(tuple(target), abs=0.001)
        assert mark.approach == pytest.approx(tuple(side), abs=0.001)
        assert mark.sled_weight == 147.0


def test_instructions_are_comments_that_no_bracket_ends():
    visits = sent(BELIEVED, [(0.0, 0.0)], controller="plumb", sled_weight=98.0)
    long = "Cut and read a mark (0, 0) " + 20 * "and so on "
    lines = program(visits, usual_weight=98.0, do=[long]).splitlines()
    said = [line for line in lines if "and so on" in line]
    assert len(said) == 4 and all(line.count("(") == line.count(")") == 1 for line in said)
    assert max(map(len, said)) <= 72 and lines.index(said[-1]) < lines.index("G21")


def test_joined_visits_keep_everything():
    sides = np.array([(1.0, 0.0), (0.0, 0.0), (0.0, -1.0)])
    targets = [(-300.0, 100.0), (0.0, 100.0), (300.0, 100.0)]
    how = {"controller": "plumb", "sled_weight": 120.0, "approaches": sides}
    visits = sent(BELIEVED, targets, **how)
    back = joined(visits.taken([2]), nowhere(), visits.taken([0, 1]))
    assert back.names == ("300/100", "-300/100", "0/100") and len(back) == 3
    assert back.targets.tolist() == [list(targets[i]) for i in (2, 0, 1)]
    assert back.chains[1:] == pytest.approx(visits.chains[:2])
    read = back.marks(np.add(back.targets, (1.0, 2.0)))
    assert [mark.approach for mark in read] == [(0.0, -1.0), (1.0, 0.0), None]
    assert read[0].measured == (301.0, 102.0) and read[0].target == (300.0, 100.0)
    assert {mark.sled_weight for mark in read} == {120.0}
    rows = back.rows()
    assert rows.count == 6 and rows.mark_rows.tolist() == [0, 1, 2] and not rows.measured.any()
