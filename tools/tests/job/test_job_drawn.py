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


def test_each_way_is_of_its_kind():
    sheet, _ = drawn(*SLOT, "G0 X0 Y0")
    rapid, cut, bad = sheet.ways
    assert sheet.title == "job.nc: nothing is wrong" and sheet.good
    assert ends(cut)[-1] == (140.0, 50.0)
    assert ends(rapid)[-1] == (0.0, 0.0)
    assert (100.0, 50.0) in ends(rapid) and bad.lines == []
    assert [(spot.x, spot.y, spot.words) for spot in sheet.spots] == [(120.0, 50.0, "1")]


def test_what_is_wrong_is_drawn_so():
    sheet, _ = drawn(*SLOT, "G0 Z-1", "G0 X160", "G0 Z3")
    assert sheet.title == "job.nc: something is wrong" and not sheet.good
    assert ends(sheet.ways[-1]) == [(160.0, 50.0)] and sheet.ways[-1].colour == WRONG


def test_a_wrong_way_straight_down_is_seen_from_above():
    def dots(*lines):
        return [spot for spot in drawn(*lines)[0].spots if spot.colour == WRONG]

    assert dots(*SLOT) == dots(*SLOT, "G0 Z-1", "G0 X160", "G0 Z3") == []
    assert len(dots("G0 Z3", "G0 X100 Y50", "G0 Z-2", "G0 Z3")) == 1


def test_a_cut_where_the_sled_hangs_badly_is_wrong_and_a_way_above_it_is_not():
    corner = ("G0 X-1215 Y-600", "G1 Z-1 F60", "G1 X-1200 F600", "G0 Z3")
    sheet, _ = drawn(*SLOT, *corner)
    assert not sheet.good and ends(sheet.ways[-1])[-1] == (-1200.0, -600.0)
    assert ends(sheet.ways[1])[-1] == (140.0, 50.0)
    above, _ = drawn(*SLOT, "G0 X-1215 Y-600", "G0 X0 Y0")
    assert above.good and above.ways[-1].lines == []
