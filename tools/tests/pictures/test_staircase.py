"""staircase: a sheet and a bar for each step of a fall, with its words and to one scale."""

import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest
from plumb.pictures.fingerprints import (
    BARS,
    TALLEST,
    Stair,
    bar_height,
    columns_for,
    draw_staircase,
)
from plumb.pictures.scale import Panel

SHEET = (2438.4, 1219.2)
PLACES = np.array([[-1000.0, 500.0], [0.0, 500.0], [1000.0, -500.0]])
ERRORS = np.array([[1.0, -2.0], [0.0, 12.0], [0.3, 0.0]])
TITLES = ("As set", "Frame fitted", "+ chain sag", "On a new sheet")
STAIRS = [
    Stair(Panel(title, PLACES, ERRORS / 3**i, good=i > 0), 7.0 / 3**i)
    for i, title in enumerate(TITLES)
]


def test_each_step_says_what_it_is_and_what_is_left():
    drawn = draw_staircase(STAIRS, heading="Chain sag added", sheet=SHEET, form="svg").decode()
    ElementTree.fromstring(drawn)
    for said in ("Chain sag added", *TITLES, "7.0 mm RMS", "2.3 mm RMS", "0.78 mm RMS"):
        assert f"<!-- {said} -->" in drawn


def test_bars_stay_in_their_room_and_keep_their_proportion():
    assert bar_height(8.0, 8.0) == TALLEST < BARS - 0.3
    assert bar_height(2.0, 8.0) == pytest.approx(TALLEST / 4)


@pytest.mark.parametrize(
    ("sheets", "columns"), [(1, 1), (4, 4), (5, 5), (6, 3), (7, 4), (10, 5), (11, 4)]
)
def test_long_falls_take_rows_of_about_the_same_length(sheets, columns):
    assert columns_for(sheets) == columns


def test_marks_without_any_error_can_be_drawn():
    still = Stair(Panel("As set", PLACES, 0 * ERRORS), 0.0)
    assert draw_staircase([still], heading="", sheet=SHEET).startswith(b"\x89PNG")
