"""What a job takes out of the sheet, and moves that spoil the piece, the bit or the sheet."""

import numpy as np
import pytest
from plumb.bench.causes import MAKER
from plumb.job.bits import Tools
from plumb.job.check import check_job
from plumb.job.findings import DEEP, GOUGES, SINKS, STILL

R = 6.35 / 2  # [mm] of the usual bit
PLUNGE = "a rapid move drives the bit {} mm down into wood that nothing has cut"
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


def test_adaptive_clearing_goes_back_through_what_is_cut():
    checked = check_job(MAKER, adaptive())
    assert checked.is_good and len(checked.done.moves) > 1000
    in_wood = checked.done.moves.rapid & checked.done.moves.cut
    assert in_wood.sum() > 45
    assert checked.piece.deepest == pytest.approx(6.0)


def test_a_way_back_through_the_wood_is_one_finding_with_its_first_line_and_count():
    lines = adaptive(link="G0 X-20")
    (gouge,) = (each for each in findings(*lines) if each.kind == GOUGES)
    assert gouge.line == lines.index("G0 X-20") + 1
    assert gouge.says == ACROSS.format("3.00")
    assert gouge.count == lines.count("G0 X-20") == 46


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
        (["G1 Z-3 F60", "G2 X40 I20 F500", "G0 Z5", "G0 X20 Y20", "G0 Z-3", "G0 Z4"], []),
        (
            ["G1 Z-3 F60", "G2 X40 I20 F500", "G0 Z5", "G0 X20 Y19", "G0 Z-3", "G0 Z4"],
            [(5, 1, PLUNGE.format("3.00"))],
        ),
        # The way up gouges nothing, and neither does the way across behind a plunge.
        (["G0 Z-5", "G0 Z-3"], [(1, 1, PLUNGE.format("5.00"))]),
        (["G0 Z5", "G0 Z-5", "G0 X40", "G0 X60 Y9"], [(2, 1, PLUNGE.format("5.00"))]),
        (["G0 Z5", "G0 X9 Z-5", "G0 Z9"], [(2, 1, PLUNGE.format("5.00"))]),
        (["G1 Z-2 F60", "G0 X40", "G1 X50 F500", "G0 Z-1"], [(2, 1, ACROSS.format("2.00"))]),
        # Back through the slot is free; beyond it is wood.
        (["G1 Z-2 F60", "G1 X40 F500", "G0 X0", "G0 X40"], []),
        (["G1 Z-2 F60", "G1 X40 F500", "G0 X-9", "G0 X0"], [(3, 1, ACROSS.format("2.00"))]),
        (["G1 Z-2 F60", "G1 X40 F500", "G1 Z-4 F60", "G0 X9"], [(4, 1, ACROSS.format("2.00"))]),
        (
            ["G0 Z2", "G0 Z-1", "G0 Z2", "G0 X30", "G0 Z-3", "G0 Z2"],
            [(2, 2, PLUNGE.format("3.00"))],
        ),
        (["G0 Z2", "G83 X9 Z-6 R1 Q2 F50", "X20", "G80", "G0 X0"], []),
        (["G0 Z2", "G81 X9 Z-6 R-1 F50", "G80"], [(2, 1, PLUNGE.format("1.00"))]),
    ],
)
def test_a_rapid_into_wood_is_said_once_with_its_cause(lines, wrong):
    assert gouges(*lines) == wrong


def test_a_rim_that_touches_the_side_of_a_slot_is_no_gouge():
    slot = ["G1 Z-2 F60", "G1 X40 F500"]
    assert gouges(*slot, "G0 Y0.4", "G0 X0") == []
    assert len(gouges(*slot, "G0 Y1.2", "G0 X0")) == 1


CARBIDE = [
    "(STOCK/BLOCK,100.00,100.00,18.00,0.00,0.00,18.00)",
    "G90",
    "G21",
    "(Move to safe Z to avoid workholding)",
    "G53G0Z-5.000",
    "M05",
    "(TOOL/MILL,3.17,0.00,12.00,0.00)",
    "M6T102",
    "M03S18000",
    "(PREPOSITION FOR RAPID PLUNGE)",
    "G0X40.000Y20.000",
    "Z0.500",
    "G1Z-0.762F381.0",
    "X80.000F1143.0",
    "G53G0Z-5.000",
    "M05",
    "M02",
]


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


def test_the_volume_is_that_of_a_slot_and_of_a_cone():
    slot = piece("G1 Z-4 F60", "G1 X100 F500", "G0 Z5")
    assert slot.removed == pytest.approx(4 * (100 * 2 * R + np.pi * R**2), rel=0.01)
    assert (slot.deepest, slot.line, slot.is_said) == (4.0, 1, False)
    cone = piece("(V-Bit {90 deg 20 mm})", "G1 Z-6 F60", "G0 Z5")
    assert cone.removed == pytest.approx(np.pi * 6**3 / 3, rel=0.02)
    engraved = piece("(V-Bit {90 deg 20 mm})", "G1 Z-5 F60", "G1 X10 F500", "G0 Z9")
    assert engraved.removed == pytest.approx(10 * 5**2 + np.pi * 5**3 / 3, rel=0.02)
    ramp = piece("G1 Z0", "G1 X100 Z-10 F500", "G0 Z5", diameter=2.0)
    assert ramp.removed == pytest.approx(100 * 2 * 5, rel=0.05)
    assert piece("G0 Z5", "G1 X9 F500") is None


def test_heights_are_those_of_the_deepest_cut():
    lines = ["G1 Z-4 F60", "G1 X20 F500", "G1 Z-2", "G1 X0", "G1 Y20", "G0 Z5"]
    cut = piece(*lines)
    column = int((10 - cut.corner[0]) / cut.cell)
    assert cut.heights[int(-cut.corner[1] / cut.cell), column] == -4.0
    assert cut.heights[int((10 - cut.corner[1]) / cut.cell), column] == 0.0
    up = int((15 - cut.corner[1]) / cut.cell)
    assert cut.heights[up, int(-cut.corner[0] / cut.cell)] == -2.0


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
def test_the_bit_is_what_the_program_says(lines, bits):
    named = Tools.of(lines).bits
    assert [(each.line, each.length) for each in named] == [(bit[0], bit[3]) for bit in bits]
    numbers = [(each.diameter, each.half_angle) for each in named]
    assert np.allclose(numbers, [bit[1:3] for bit in bits])
    assert [each.diameter for each in Tools.of(lines, diameter=8.0).bits] == [8.0]


def test_a_finer_bit_leaves_wood_that_a_wide_one_takes():
    lines = ["G1 Z-2 F60", "G1 X40 F500", "G0 Y3", "G0 Z5"]
    assert findings(*lines, diameter=6.35)[0].kind == GOUGES
    finer = ["(2mm endmill)", "G1 Z-2 F60", "G0 Z5", "(20mm endmill)", "G0 X2", "G1 Z-2", "G0 Z5"]
    assert findings(*finer) == () and [bit.diameter for bit in piece(*finer).bits] == [2, 20]


def test_a_bit_narrower_than_a_cell_is_led_as_surely():
    wide = ["G1 Z-1 F60", "G1 X900 F900", "G1 Y500", "G1 X0", "G0 X900", "G0 Y0", "G0 X0"]
    assert findings(*wide, "G0 Z5", diameter=0.2) == ()
    cut = piece(*wide, "G0 Z5", diameter=0.2)
    assert cut.cell > 0.2
    for y in (0, 500):
        assert (cut.heights[int((y - cut.corner[1]) / cut.cell), 1:-2] == -1).all()
    assert (cut.heights[1:-2, int((900 - cut.corner[0]) / cut.cell)] == -1).all()


def test_an_arc_is_cut_round():
    cut = piece("G1 X0 Y0 F500", "G1 Z-1", "G2 X0 Y0 I100 J0", "G0 Z5", diameter=2.0)
    rows, columns = np.indices(cut.heights.shape)
    x, y = cut.corner[0] + (columns + 0.5) * cut.cell, cut.corner[1] + (rows + 0.5) * cut.cell
    off = np.abs(np.hypot(x - 100, y) - 100)
    assert (cut.heights[off < 0.98] == -1).all() and (cut.heights[off > 1.02] == 0).all()


def test_the_map_of_a_hundred_thousand_lines_says_where_the_bit_sinks():
    count = 25_000
    lines = ["G1 Z-3 F300"]
    for turn in range(count):
        x, y = turn % 250, turn // 250 * 3
        lines += [
            f"G1 X{x} Y{y} F900",
            f"G1 X{x + 0.5} Y{y + 2}",
            f"G1 X{x + 1} Y{y}",
            f"G0 X{x} Y{y}",
        ]
    checked = check_job(MAKER, lines)
    assert len(checked.done.moves) > 99_000
    assert {each.kind for each in checked.findings} <= {SINKS}
