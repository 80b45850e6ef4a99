"""A reading in doubt on a map of arrows."""

import numpy as np
from plumb.pictures.scale import Panel, Scale, spots_of
from plumb.pictures.sheet import Look, arrow_figure

SHEET = (2440.0, 1220.0)
PLACES = np.array([[-900.0, 400.0], [0.0, 0.0], [900.0, -400.0]])
ERRORS = np.array([[2.0, 1.0], [100.0, 0.0], [-1.0, 2.0]])


def test_it_is_ringed_and_scales_nothing():
    sure = Scale.of([spots_of(Panel("", PLACES, np.where([[1], [0], [1]], ERRORS, 0.0)))], SHEET)
    panel = Panel("", PLACES, ERRORS, doubted=(1,))
    scale = Scale.of([spots_of(panel)], SHEET)
    assert scale == sure
    rings = [
        line.get_xydata().tolist()
        for line in arrow_figure(panel, scale, Look()).axes[0].lines
        if line.get_gid() == "doubt"
    ]
    assert rings == [[[0.0, 0.0]]]
