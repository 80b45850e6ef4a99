"""Tests of the wood that a job removes, and of moves that spoil the piece, the bit or the sheet."""

import numpy as np
import pytest
from plumb.bench.boards import MAKER
from plumb.job.check import check_job
from plumb.job.dry_run import DEEP, GOUGES, STILL
from plumb.job.wood import Tools

R = 6.35 / 2  # [mm] of the usual bit
PLUNGE = "a rapid move drives the bit {} mm down into wood that nothing has cut"
ARC = "G1 Z-3 F60", "G2 X40 I20 F500"
ACROSS = "a rapid move crosses wood that nothing has cut, {} mm deep"


def findings(*lines, **tools):
    return check_job(MAKER, lines, tools=Tools.of(lines, **tools)).findings


def gouges(*lines):
    """Line, count and words of each gouge."""
    wrong = findings(*lines, "G0 Z9")
    assert {each.kind for each in wrong} <= {GOUGES} and all(each.is_wrong for each in wrong)
    return [(each.line, each.count, each.says) for each in wrong]


def piece(*lines, **tools):
    return check_job(MAKER, lines, tools=Tools.of(lines, **tools)).piece


def adaptive(depths=(-3.0, -6.0), *, link=None):
    """A pocket as FreeCAD's adaptive clearing cuts it: a helix down, then arcs that grow by a
    fifth of the bit. Behind each the bit goes back through what is cut, as a rapid at
    the full depth.
    """
    lines = ["(Exported by FreeCAD)", "(TC: 6mm endmill)", "G21 G90", "M3 S18000", "G0 Z5"]
    for depth in depths:
        lines += ["G0 X2 Y0", f"G0 Z{depth + 3.2:.3f}"]
        lines += [f"G2 X-2 Y0 Z{depth + 1.5:.3f} I-2 J0 F600", f"G2 X2 Y0 Z{depth:.3f} I2 J0"]
        lines += [f"G2 X-2 Y0 Z{depth:.3f} I-2 J0", f"G2 X2 Y0 Z{depth:.3f} I2 J0"]
        for radius in np.arange(3.2, 30, 1.2):
            angles = np.radians(np.arange(-60, 61, 6))
            places = radius * np.column_stack([np.cos(angles), np.sin(angles)])
            begin = places[0] * (1 - 1.2 / radius)
            lines += [f"G0 X{begin[0]:.3f} Y{begin[1]:.3f}"]
            lines += [f"G1 X{x:.3f} Y{y:.3f} F900" for x, y in places]
            lines += [link] if link else []
        lines += ["G0 Z5"]
    return [*lines, "M5", "M30"]


def test_adaptive_clearing_may_return_through_the_cut():
    checked = check_job(MAKER, adaptive())
    assert checked.is_good and len(checked.done.moves) > 1000
    in_wood = checked.done.moves.rapid & checked.done.moves.cut
    assert in_wood.sum() > 45
    assert checked.piece.deepest == pytest.approx(6.0)


@pytest.mark.parametrize(
    ("lines", "wrong"),
    [
        (["G0 Z5", "G0 X10 Y10", "G0 Z-12"], [(3, 1, PLUNGE.format("12.00"))]),
        (["G20", "G0 Z.2", "G0 Z-.5"], [(3, 1, PLUNGE.format("12.70"))]),
        (["G0 Z5", "G0 Z-0.009"], []),
        (["G0 Z5", "G0 Z-0.02"], [(2, 1, PLUNGE.format("0.02"))]),
        # A hole that is there gives room, as far as it goes, and where it is.
        (["G1 Z-3 F60", "G0 Z5", "G0 Z-2.5", "G1 Z-5"], []),
        (["G1 Z-3 F60", "G0 Z5", "G0 Z-4", "G0 Z5"], [(3, 1, PLUNGE.format("1.00"))]),
        (["G1 Z-3 F60", "G0 Z5", "G0 X1", "G0 Z-3", "G0 Z5"], [(4, 1, PLUNGE.format("3.00"))]),
        (["G1 Z-3 F60", "G1 X40 F500", "G0 Z5", "G0 X21.3", "G0 Z-3", "G1 Z-4"], []),
        ([*ARC, "G0 Z5", "G0 X20 Y20", "G0 Z-3", "G0 Z4"], []),
        ([*ARC, "G0 Z5", "G0 X20 Y19", "G0 Z-3", "G0 Z4"], [(5, 1, PLUNGE.format("3.00"))]),
        # The way up gouges nothing, and neither does the way across behind a plunge.
        (["G0 Z-5", "G0 Z-3"], [(1, 1, PLUNGE.format("5.00"))]),
        (["G0 Z5", "G0 Z-5", "G0 X40", "G0 X60 Y9"], [(2, 1, PLUNGE.format("5.00"))]),
        (["G0 Z5", "G0 X9 Z-5", "G0 Z9"], [(2, 1, PLUNGE.format("5.00"))]),
        (["G1 Z-2 F60", "G0 X40", "G1 X50 F500", "G0 Z-1"], [(2, 1, ACROSS.format("2.00"))]),
        # Back through the slot is free; beyond it is wood.
        (["G1 Z-2 F60", "G1 X40 F500", "G0 X0", "G0 X40"], []),
        (["G1 Z-2 F60", "G1 X40 F500", "G0 X-9", "G0 X0"], [(3, 1, ACROSS.format("2.00"))]),
        (["G1 Z-2 F60", "G1 X40 F500", "G1 Z-4 F60", "G0 X9"], [(4, 1, ACROSS.format("2.00"))]),
        (["G0 Z2", "G0 Z-1", "G0 Z2", "G0 X9", "G0 Z-3", "G0 Z2"], [(2, 2, PLUNGE.format("3.00"))]),
        (["G0 Z2", "G83 X9 Z-6 R1 Q2 F50", "X20", "G80", "G0 X0"], []),
        (["G0 Z2", "G81 X9 Z-6 R-1 F50", "G80"], [(2, 1, PLUNGE.format("1.00"))]),
    ],
)
def test_a_rapid_into_wood_is_reported_once_with_its_cause(lines, wrong):
    assert gouges(*lines) == wrong


CARBIDE = ["(STOCK/BLOCK,100.00,100.00,18.00,0.00,0.00,18.00)", "G90", "G21"]
CARBIDE += ["(Move to safe Z to avoid workholding)", "G53G0Z-5.000", "M05"]
CARBIDE += ["(TOOL/MILL,3.17,0.00,12.00,0.00)", "M6T102", "M03S18000"]
CARBIDE += ["(PREPOSITION FOR RAPID PLUNGE)", "G0X40.000Y20.000", "Z0.500", "G1Z-0.762F381.0"]
CARBIDE += ["X80.000F1143.0", "G53G0Z-5.000", "M05", "M02"]


def test_the_safe_height_of_carbide_create_is_named_with_its_cure():
    (plunge,) = [each for each in findings(*CARBIDE) if each.is_wrong]
    assert (plunge.kind, plunge.line, plunge.count) == (GOUGES, 5, 2)
    assert plunge.says.startswith("G53 drives the bit 5.00 mm into the wood. Carbide Create means")
    assert "write G0 Z5 instead of G53 G0 Z-5" in plunge.says
    (first,) = [each for each in findings(*CARBIDE[:12]) if each.is_wrong]
    assert first.says.endswith(", the spindle off")


def test_a_cut_with_the_spindle_off_is_wrong_where_the_program_switches_it():
    cut = ["G1 Z-1 F60", "G1 X20 F500", "G0 Z5", "G0 X40", "G1 Z-1 F60", "G0 Z5"]
    assert findings(*cut) == () and findings(*cut, "M5") == ()
    assert findings("M3 S9000", *cut, "M5") == ()
    (late,) = findings(*cut[:4], "M3 S9000", *cut[4:])
    assert (late.kind, late.line, late.count) == (STILL, 1, 2)
    (off,) = findings("M3", *cut[:4], "M5", *cut[4:])
    assert (off.kind, off.line, off.count) == (STILL, 7, 1)
    assert findings("M3", "G1 Z-1 F60", "M5", "G1 Z5", "G1 X9") == ()
    # A line's own M code comes before its way.
    assert findings("M3 G1 Z-1 F60", "G1 X9", "G0 Z5") == ()
    assert [each.line for each in findings("M3", "G1 Z-1 F60 M5", "G0 Z5")] == [2]


def test_a_cut_through_the_sheet_may_go_a_little_into_what_lies_under_it():
    assert findings("G1 Z-22 F60", "G0 Z5") == ()
    (deep,) = findings("G1 Z-22.1 F60", "G1 X9 F500", "G0 Z5")
    assert (deep.kind, deep.line, deep.count, deep.is_wrong) == (DEEP, 1, 3, True)
    assert deep.says == (
        "cuts 22.10 mm deep, and the sheet is 19.05 mm thick (--thickness says otherwise)"
    )
    assert findings("G1 Z-22.1 F60", "G0 Z5", thickness=20.0) == ()
    (deep,) = findings("(STOCK/BLOCK,90,90,12.0,0,0,12.0)", "G1 Z-15.1 F60", "G0 Z5")
    assert "the sheet is 12 mm thick" in deep.says


def test_a_cut_deeper_than_the_bit_is_long_is_wrong():
    (deep,) = findings("G1 Z-16 F60", "G0 Z5", length=15.0)
    assert deep.says == (
        "cuts 16.00 mm deep, and the bit cuts only 15 mm (--bit-length says otherwise)"
    )
    assert findings("G1 Z-14.9 F60", "G0 Z5", length=15.0) == ()
    (deep,) = findings("(TOOL/MILL,3.17,0.00,12.00,0.00)", "G1 Z-12.5 F60", "G0 Z5")
    assert deep.kind == DEEP


@pytest.mark.parametrize(
    ("lines", "bits"),
    [
        (["G1 X9"], []),
        (["(TOOL/MILL,3.175,0.000,20.000,0.00)"], [(1, 3.175, 90, 20.0)]),
        (["(TOOL/MILL,0.0, 0.00, 10.00, 45.00)"], [(1, 20.0, 45, None)]),
        (["G20", "(TOOL/MILL,0.25,0.000,0.000,0.00)"], [(2, 6.35, 90, None)]),
        (["(T1 D=6.35 CR=0 - ZMIN=-4 - flat end mill)"], [(1, 6.35, 90, None)]),
        (
            ["(T1 D=6 CR=0 - flat)", "(T2 D=9 CR=0 TAPER=30deg - V)", "N5 T2 M6", "G1 X9", "T1M6"],
            [(3, 9, 30, None), (5, 6, 90, None)],
        ),
        (["(TC: 6mm endmill)", "(Compensated Tool Path. Diameter: 6.0)"], [(1, 6, 90, None)]),
        (["; End Mill {1/4 inch}"], [(1, 6.35, 90, None)]),
        (["(V-Bit {60 deg 12.7 mm})"], [(1, 12.7, 30, None)]),
        (['(End Mill 1/8")', "(Bit 6 mm)"], [(1, 3.175, 90, None), (2, 6, 90, None)]),
        (["(5mm drill)"], [(1, 5, 90, None)]),
        (["(3 mm deep pocket)", "(drill 4)"], []),
    ],
)
def test_the_bit_is_read_from_the_programs_comments(lines, bits):
    named = Tools.of(lines).bits
    assert [(each.line, each.length) for each in named] == [(bit[0], bit[3]) for bit in bits]
    numbers = [(each.diameter, each.half_angle) for each in named]
    assert np.allclose(numbers, [bit[1:3] for bit in bits])
    assert [each.diameter for each in Tools.of(lines, diameter=8.0).bits] == [8.0]
