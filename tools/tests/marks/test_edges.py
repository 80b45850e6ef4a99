"""Places counted from the edges of a sheet of 2440 by 1220 mm."""

import pytest
from plumb.marks.plausible import CORNERS, from_edges, in_machine

SHEET = (2440.0, 1220.0)
# A place 300 mm right of the middle and 110 mm above it, as a tape reads it.
READ = {
    "top-left": (1520.0, 500.0),
    "top-right": (920.0, 500.0),
    "bottom-left": (1520.0, 720.0),
    "bottom-right": (920.0, 720.0),
}


def test_every_corner_has_a_reading():
    assert set(READ) == set(CORNERS)


@pytest.mark.parametrize("corner", CORNERS)
def test_a_place_is_read_from_the_edges_of_a_corner_and_back(corner):
    assert from_edges((300, 110), sheet=SHEET, corner=corner) == READ[corner]
    assert in_machine(READ[corner], sheet=SHEET, corner=corner) == (300, 110)
