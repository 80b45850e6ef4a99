"""The picture of a checked program: its cuts, its ways above the sheet, and what is wrong."""

import numpy as np
from plumb.bench.causes import MAKER
from plumb.cli.check import _drawn
from plumb.job.check import check_job
from plumb.pictures import job as job_picture
from plumb.pictures.job import draw_job


def drawn(*lines):
    return _drawn(check_job(MAKER, lines), MAKER, "folder/job.nc")


def ends(ways):
    """The last place of each way [mm]."""
    return [tuple(np.round(way[-1], 3).tolist()) for way in ways]


def test_the_piece_is_shaded_by_its_depth_and_seen_whole():
    picture = draw_job(drawn(*SLOT), form="svg")
    assert picture.count(b"<image") == 3  # on the sheet, from near, in the legend
    assert b"depth of the finished piece, 0 to 1.00 mm" in picture
    low, high = job_picture._near(drawn(*SLOT))
    assert low[0] < 100 - 6.35 / 2 and high[0] > 140 + 6.35 / 2
    nothing = draw_job(drawn("G0 Z3", "G0 X9"), form="svg")
    assert b"<image" not in nothing and b"finished piece" not in nothing


SLOT = ("G0 Z3", "G0 X100 Y50", "G1 Z-1 F60", "G1 X140 F600", "G0 Z3")


def test_what_is_wrong_is_drawn_so():
    job = drawn(*SLOT, "G0 Z-1", "G0 X160", "G0 Z3")
    assert job.title == "job.nc: something is wrong" and not job.is_good
    assert ends(job.ways["bad"]) == [(160.0, 50.0)]


def test_a_cut_where_the_sled_hangs_badly_is_wrong_and_a_way_above_it_is_not():
    corner = ("G0 X-1215 Y-600", "G1 Z-1 F60", "G1 X-1200 F600", "G0 Z3")
    job = drawn(*SLOT, *corner)
    assert not job.is_good and ends(job.ways["bad"])[-1] == (-1200.0, -600.0)
    assert ends(job.ways["cut"])[-1] == (140.0, 50.0)
    above = drawn(*SLOT, "G0 X-1215 Y-600", "G0 X0 Y0")
    assert above.is_good and above.ways["bad"] == []
