"""drawing: a picture of the asked form, to a single scale, of which nothing is cut off."""

import struct
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest
from plumb.cli.drawing import FORMATS, Panel, columns_for, draw, factor_for, view_of
from synthetic import SHEET

PLACES = np.array([[-1000.0, 500.0], [0.0, 500.0], [1000.0, -500.0]])
ERRORS = np.array([[1.0, -2.0], [0.0, 12.0], [0.3, 0.0]])
BEFORE = Panel("Before: 7.0 mm RMS", PLACES, ERRORS)
AFTER = Panel("After: 0.7 mm RMS", PLACES, ERRORS / 10, good=True)
STARTS = {"png": b"\x89PNG", "svg": b"<?xml", "pdf": b"%PDF"}


def svg_of(*panels, **how):
    """The text of a picture, which is whole."""
    text = draw(panels, sheet=SHEET, form="svg", **how).decode()
    ElementTree.fromstring(text)
    return text


@pytest.mark.parametrize("form", FORMATS)
def test_each_picture_has_its_format_and_the_same_bytes_each_time(form):
    named = Panel("$\\frac{$ 7.0 mm", PLACES, ERRORS)
    first, again = (draw([named], sheet=SHEET, form=form) for _ in range(2))
    assert first.startswith(STARTS[form]) and first == again
    assert first != draw([AFTER], sheet=SHEET, form=form)


def test_a_picture_is_wide_enough_to_read():
    one, many = (
        struct.unpack(">II", draw([BEFORE] * count, sheet=SHEET)[16:24]) for count in (1, 6)
    )
    assert one[0] >= 1000 and many[0] >= 1000
    assert [columns_for(count) for count in (1, 4, 5, 6, 7, 10, 11)] == [1, 4, 5, 3, 4, 5, 4]


@pytest.mark.parametrize("size", [0.02, 1.0, 20.0])
@pytest.mark.parametrize("count", [(3, 3), (40, 25)])
def test_no_arrow_is_cut_off_and_none_reaches_far_past_its_neighbours(count, size):
    x, y = np.meshgrid(np.linspace(-1119, 1119, count[0]), np.linspace(-509, 509, count[1]))
    places = np.column_stack([x.ravel(), y.ravel()])
    panel = Panel("", places, size * np.tile([0.2, 12.0], (len(places), 1)))
    factor = factor_for([panel], SHEET)
    low, high = map(np.array, view_of([panel], SHEET, factor))
    for ends in (panel.predicted, panel.predicted + factor * panel.errors):
        assert (ends > low).all() and (ends < high).all()
    longest = factor * size * 12
    assert 0.15 * min(SHEET[1], 1100 * 3 / len(places) ** 0.5) < longest < 0.4 * SHEET[1]
    assert len(places) < 100 or longest < 1.6 * 55


def test_all_sheets_of_a_picture_share_a_stated_scale():
    assert factor_for([BEFORE, AFTER], SHEET) == factor_for([BEFORE], SHEET) == 30
    assert "30 times life size. The longest is 12.00 mm." in svg_of(BEFORE, AFTER)
    still = Panel("none", PLACES, 0 * ERRORS)
    assert "The longest is 0.00 mm" in svg_of(still)


@pytest.mark.parametrize(("count", "written"), [(60, 60), (61, 0)])
def test_a_picture_has_few_words(count, written):
    places = np.array([[40.0 * i - 1190, 0.0] for i in range(count)])
    assert svg_of(Panel("", places, np.full((count, 2), 0.5))).count("<!-- 0.7 -->") == written


def test_marks_that_repeat_each_other_have_one_number():
    panel = Panel("", np.array([[0.0, 0.0], [20.0, 0.0], [60.0, 0.0]]), np.full((3, 2), 0.5))
    assert svg_of(panel).count("<!-- 0.7 -->") == 2
