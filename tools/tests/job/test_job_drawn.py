"""The picture of a checked program: its cuts, its ways above the sheet, and what is wrong."""

import numpy as np
from plumb.bench.causes import MAKER
from plumb.cli.check import WRONG, _picture, near_view, sheet_of
from plumb.job.check import check_job


def drawn(*lines):
    """The sheet of a program, and the program as it was checked."""
    checked = check_job(MAKER, lines)
    return sheet_of(checked, MAKER, "folder/job.nc"), checked


def ends(ways):
    """The last place of each way [mm]."""
    return [tuple(np.round(way[-1], 3).tolist()) for way in ways.lines]


def test_the_piece_is_shaded_by_its_depth_and_seen_whole():
    sheet, checked = drawn(*SLOT)
    picture = _picture(checked, MAKER, "job.nc", form="svg")
    assert picture.count(b"<image") == 2  # on the sheet, and from near
    assert b"cut up to 1.00 mm deep" in picture
    low, high = near_view(checked)
    assert low[0] < 100 - 6.35 / 2 and high[0] > 140 + 6.35 / 2
    (left, _), (right, _) = sheet.shaded
    assert left < 100 and right > 140 and (sheet.shades[..., 3] > 0).any()
    nothing, checked = drawn("G0 Z3", "G0 X9")
    assert nothing.shades is None
    assert b"<image" not in _picture(checked, MAKER, "job.nc", form="svg")


SLOT = ("G0 Z3", "G0 X100 Y50", "G1 Z-1 F60", "G1 X140 F600", "G0 Z3")


def test_faults_are_drawn_in_their_colour():
    sheet, _ = drawn(*SLOT, "G0 Z-1", "G0 X160", "G0 Z3")
    assert sheet.title == "job.nc: something is wrong" and not sheet.good
    assert ends(sheet.ways[-1]) == [(160.0, 50.0)] and sheet.ways[-1].colour == WRONG


def test_a_cut_where_the_sled_hangs_badly_is_wrong_but_a_move_above_the_sheet_is_not():
    corner = ("G0 X-1215 Y-600", "G1 Z-1 F60", "G1 X-1200 F600", "G0 Z3")
    sheet, _ = drawn(*SLOT, *corner)
    assert not sheet.good and ends(sheet.ways[-1])[-1] == (-1200.0, -600.0)
    assert ends(sheet.ways[1])[-1] == (140.0, 50.0)
    above, _ = drawn(*SLOT, "G0 X-1215 Y-600", "G0 X0 Y0")
    assert above.good and above.ways[-1].lines == []
