"""Readings that no machine can have made, and the slip of the pen that explains them."""

import pytest
from plumb.marks.model import Mark, Measurements
from plumb.marks.plausible import far_reading
from plumb.marks.read import read_marks
from plumb.text.errors import InputError

SHEET = (2440.0, 1220.0)
CENTRES = [(-900.0, 400.0), (0.0, 400.0), (900.0, 400.0), (-900.0, -400.0), (900.0, -400.0)]


def marks_of(readings):
    """Marks A, B, ... at the centres, read there."""
    named = zip("ABCDE", CENTRES, readings, strict=True)
    return Measurements(tuple(Mark(name, sent, read) for name, sent, read in named))


def doubts(readings):
    measurements = marks_of(readings)
    by_mark = {mark.name: far_reading(measurements, mark, SHEET) for mark in measurements.marks}
    return {name: (doubt.mistake, doubt.corrected) for name, doubt in by_mark.items() if doubt}


def test_two_exchanged_readings_are_named_with_a_correction():
    a, b, *others = [(x + 3, y - 2) for x, y in CENTRES]
    assert doubts([b, a, *others]) == {
        "A": ("the readings of A and B may be exchanged", a),
        "B": ("the readings of B and A may be exchanged", b),
    }


def test_on_a_sheet_that_was_read_turned_round_no_marks_seem_exchanged():
    said = {words for words, _ in doubts([(-x, y) for x, y in CENTRES]).values()}
    assert said == {"the measured x runs the other way; check the frame"}


@pytest.mark.parametrize(
    ("reading", "mistake", "meant"),
    [
        ((400, 900), "x and y may be exchanged", (900, 400)),
        ((2120, 210), "measured counts from the top-left corner", (900, 400)),
        ((900 / 25.4, 400 / 25.4), "measured looks like inches", (900, 400)),
    ],
)
def test_a_slip_of_the_pen_is_named_with_a_correction(reading, mistake, meant):
    ((said, corrected),) = doubts([*CENTRES[:2], reading, *CENTRES[3:]]).values()
    assert said.startswith(mistake) and corrected == pytest.approx(meant)


def test_a_reading_half_a_metre_off_is_doubted_though_nothing_explains_it():
    assert doubts([*CENTRES[:4], (900, -900.1)]) == {"E": ("", None)}
    assert doubts([*CENTRES[:4], (900, -899.9)]) == {}


def test_a_far_distance_is_refused_with_the_names_of_its_ends(tmp_path):
    path = tmp_path / "marks.toml"
    ends = "".join(
        f'[[mark]]\nname = "{name}"\ntarget = [{x}, 0]\nunread = true\n'
        for name, x in (("A", 0), ("B", 508))
    )
    for size, remedy in ((20, "looks like inches"), (300, "check the names and the number")):
        path.write_text(f'frame = "machine"\n{ends}[[distance]]\nbetween = ["A", "B"]\nmm = {size}')
        with pytest.raises(InputError, match=rf"distance A-B: .*508 mm apart; {remedy}"):
            read_marks(path, sheet=SHEET)
