"""picture: a picture of errors, of the asked form and to one scale."""

import struct
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest
from plumb.pictures.sheet import FORMATS, Panel, draw, exaggeration, round_down

SHEET = (2438.4, 1219.2)
PLACES = np.array([[-1000.0, 500.0], [0.0, 500.0], [1000.0, -500.0]])
ERRORS = np.array([[1.0, -2.0], [0.0, 12.0], [0.3, 0.0]])
BEFORE = Panel("Before: 7.0 mm RMS", PLACES, ERRORS)
AFTER = Panel("After: 0.7 mm RMS", PLACES, ERRORS / 10, good=True)
STARTS = {"png": b"\x89PNG", "svg": b"<?xml", "pdf": b"%PDF"}


@pytest.mark.parametrize("form", FORMATS)
def test_each_form_is_what_it_says(form):
    assert draw([BEFORE, AFTER], sheet=SHEET, form=form).startswith(STARTS[form])


def test_a_picture_is_wide_enough_to_read_and_grows_with_each_sheet():
    sizes = [
        struct.unpack(">II", draw(panels, sheet=SHEET)[16:24])
        for panels in ([BEFORE], [BEFORE, AFTER])
    ]
    assert sizes[0][0] == sizes[1][0] >= 1000
    assert sizes[1][1] > sizes[0][1] + 500


def test_the_same_errors_give_the_same_bytes():
    assert draw([BEFORE], sheet=SHEET) == draw([BEFORE], sheet=SHEET)
    assert draw([BEFORE], sheet=SHEET) != draw([AFTER], sheet=SHEET)


def test_a_drawing_is_whole():
    ElementTree.fromstring(draw([BEFORE], sheet=SHEET, form="svg"))


@pytest.mark.parametrize(
    ("value", "rounded"), [(1.0, 1), (9.99, 5), (0.034, 0.03), (2.4, 2), (1200, 1000)]
)
def test_factors_are_round(value, rounded):
    assert round_down(value) == pytest.approx(rounded)


@pytest.mark.parametrize("largest", [0.2, 1.0, 15.0, 80.0])
def test_the_longest_arrow_is_long_but_stays_near_the_sheet(largest):
    assert 0.15 < exaggeration(largest, SHEET) * largest / SHEET[1] < 0.4


def test_marks_without_any_error_can_be_drawn():
    assert draw([Panel("none", PLACES, 0 * ERRORS)], sheet=SHEET).startswith(STARTS["png"])
