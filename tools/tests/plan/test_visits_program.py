"""Planned visits: the form that waits for their readings, and the way to them."""

import dataclasses

import numpy as np
import pytest
from plumb.marks.form import read_form
from plumb.marks.model import Mark
from plumb.plan.planned_visits import joined, marks_file, nowhere, refuse_way, sent
from plumb.text.errors import InputError
from plumb.text.values import MM
from synthetic import BELIEVED


def test_a_form_keeps_place_side_and_weight(file):
    targets = np.array([(-1000.0, 480.0), (20.0, -300.0)])
    sides = np.array([(0.0, 1.0), (0.6, -0.8)])
    visits = sent(BELIEVED, targets, controller="plumb", sled_weight=147.0, approaches=sides)
    text = marks_file(
        visits, sheet=BELIEVED.sheet, controller="plumb", said=("Four marks.",), unit=MM
    )
    read = read_form(file("form.toml", text), sheet=BELIEVED.sheet).measurements
    assert read.controller == "plumb" and len(read.marks) == 2
    for mark, target, side in zip(read.marks, targets, sides, strict=True):
        assert mark.target == pytest.approx(tuple(target), abs=0.001)
        assert mark.approach == pytest.approx(tuple(side), abs=0.001)
        assert mark.sled_weight == 147.0


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


UP, LEFT = (0.0, 1.0), (-1.0, 0.0)


@pytest.mark.parametrize("side", [None, UP, LEFT])
def test_marks_on_the_sheet_are_reached(side):
    refuse_way(BELIEVED, [Mark("1", (-1000, 500), approach=side), Mark("2", (0, -500))])


@pytest.mark.parametrize(
    ("place", "side", "why"),
    [
        ((0.0, -600.0), None, "leaves the sheet"),  # 40 mm below it there is no sheet
        ((1190.0, 0.0), LEFT, "leaves the sheet"),
        ((0.0, 620.0), None, "leaves the sheet"),
    ],
)
def test_a_path_off_the_sheet_is_refused(place, side, why):
    with pytest.raises(InputError, match=f"mark far {why}"):
        refuse_way(BELIEVED, [Mark("near", (0.0, 0.0)), Mark("far", place, approach=side)])


def test_the_weight_on_the_sled_counts():
    mark = Mark("1", (0.0, 560.0))
    refuse_way(BELIEVED, [mark])
    with pytest.raises(InputError, match="where the sled cannot hang well"):
        refuse_way(BELIEVED, [dataclasses.replace(mark, sled_weight=400.0)])


def test_the_way_between_two_marks_counts():
    low = dataclasses.replace(BELIEVED, motor_height=700.0)
    corners = [Mark("left", (-1000.0, 400.0)), Mark("right", (1000.0, 400.0))]
    for corner in corners:
        refuse_way(low, [corner])
    with pytest.raises(InputError, match="mark right passes where the sled cannot hang well"):
        refuse_way(low, corners)
