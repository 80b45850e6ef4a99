"""picture: a picture of errors, of the asked form and to one scale."""

import struct
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest
from plumb.pictures.scale import Panel
from plumb.pictures.sheet import FORMATS, draw

SHEET = (2438.4, 1219.2)
PLACES = np.array([[-1000.0, 500.0], [0.0, 500.0], [1000.0, -500.0]])
ERRORS = np.array([[1.0, -2.0], [0.0, 12.0], [0.3, 0.0]])
BEFORE = Panel("Before: 7.0 mm RMS", PLACES, ERRORS)
AFTER = Panel("After: 0.7 mm RMS", PLACES, ERRORS / 10, good=True)
STARTS = {"png": b"\x89PNG", "svg": b"<?xml", "pdf": b"%PDF"}


@pytest.mark.parametrize("form", FORMATS)
def test_each_form_is_what_it_says(form):
    assert draw(BEFORE, sheet=SHEET, form=form).startswith(STARTS[form])


def test_a_picture_is_wide_enough_to_read_and_a_title_gets_its_room():
    sizes = [
        struct.unpack(">II", draw(panel, sheet=SHEET)[16:24])
        for panel in (BEFORE, Panel("", PLACES, ERRORS))
    ]
    assert sizes[0][0] == sizes[1][0] >= 1000
    assert sizes[0][1] > sizes[1][1] + 40


def test_the_same_errors_give_the_same_bytes():
    assert draw(BEFORE, sheet=SHEET) == draw(BEFORE, sheet=SHEET)
    assert draw(BEFORE, sheet=SHEET) != draw(AFTER, sheet=SHEET)


def test_a_drawing_is_whole():
    ElementTree.fromstring(draw(BEFORE, sheet=SHEET, form="svg"))


def test_marks_without_any_error_can_be_drawn():
    assert draw(Panel("none", PLACES, 0 * ERRORS), sheet=SHEET).startswith(STARTS["png"])


@pytest.mark.parametrize(("count", "without", "with_names"), [(60, 60, 60), (61, 0, 61)])
def test_words_are_as_many_as_can_be_read_and_names_come_when_asked(count, without, with_names):
    places = np.array([[40.0 * i - 1190, 0.0] for i in range(count)])
    panel = Panel(
        "", places, np.full((count, 2), 0.5), names=tuple(f"mark{i}" for i in range(count))
    )
    plain, named = (draw(panel, sheet=SHEET, form="svg", names=on).decode() for on in (0, 1))
    assert plain.count("<!-- 0.7 -->") == without and "<!-- mark" not in plain
    assert named.count("<!-- mark") == with_names


@pytest.mark.parametrize("form", FORMATS)
def test_a_name_with_a_dollar_is_a_name_and_no_formula(form):
    named = Panel("$\\frac{$ 7.0 mm", PLACES, ERRORS, names=("$\\frac{$", "$5 $6", "c"))
    assert draw(named, sheet=SHEET, form=form, names=True).startswith(STARTS[form])
