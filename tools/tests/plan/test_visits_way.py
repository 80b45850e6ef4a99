"""The way to planned marks: refused where the sled cannot go."""

import dataclasses

import pytest
from plumb.marks.model import Mark
from plumb.plan.planned_visits import refuse_way
from plumb.text.errors import InputError
from synthetic import BELIEVED

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
