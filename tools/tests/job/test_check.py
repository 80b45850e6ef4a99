"""plumb check: what is wrong with a program, the wood, times, parts, their errors, its picture."""

import re
from dataclasses import replace

import numpy as np
import pytest
from example_machine import EXAMPLE
from plumb import _judge
from plumb.fit.inputs import Inputs
from plumb.hidden import MAKER
from plumb.job.check import Believed, Part, check_job, with_errors
from plumb.job.dry_run import (
    ARC,
    CHAINS,
    DEEP,
    GOUGES,
    GREATEST,
    HALTS,
    IGNORED,
    LEAVES,
    STILL,
    WAITS,
    Z,
    hull_of,
    outline_of,
)
from plumb.job.wood import Tools
from plumb.marks.read import read_marks
from plumb.model.predict import judged, lengths
from plumb.settings import read_settings
from workshop import NAMES, lines_of

SETTINGS, POCKET, MARKS = (
    EXAMPLE / name for name in ("groundcontrol.ini", "pocket.nc", "marks.toml")
)

OTHER = EXAMPLE.parents[1] / "tools/plumb/examples/madgrizzle-2018-09-04"


def square(x, y, size, depth=1.0):
    """Lines that cut a square with its lower left corner there."""
    corners = [(x + size, y), (x + size, y + size), (x, y + size), (x, y)]
    sides = [f"G1 X{x} Y{y} F600" for x, y in corners]
    return ["G0 Z3", f"G0 X{x} Y{y}", f"G1 Z{-depth} F60", *sides, "G0 Z3"]


def lines_and_kinds(lines):
    return [(each.line, each.kind) for each in check_job(MAKER, lines).findings]


@pytest.mark.parametrize(
    ("lines", "line", "says"),
    [
        (["G1 Z-1", "G1 X10"], 1, "no F says how fast to cut"),
        (["G1 Z-1 F100", "G1 X100 F0"], 2, "at which this takes 100 minutes"),
        (["G1 Z-1 F100", "G1 X100 F0.0001"], 2, "the feed is 1 mm/min"),
        (["G1 Z-1 F100", "G2 X10 Y0 R0"], 2, "R0 is the radius of no arc"),
    ],
)
def test_an_absurd_feed_or_arc_is_wrong(lines, line, says):
    (finding,) = check_job(MAKER, ["G0 Z5", *lines]).findings
    assert finding.is_wrong and finding.line == line + 1 and says in finding.says


@pytest.mark.parametrize("name", NAMES)
def test_nothing_is_wrong_with_the_programs(name):
    checked = check_job(MAKER, lines_of(name))
    assert checked.is_good
    assert {each.kind for each in checked.findings} <= {WAITS, IGNORED}
    assert checked.parts


def test_each_wrong_line_has_its_number_and_the_machines_words():
    lines = ["G21", "G41 D1", "G0 Z5", "G1 X--5 F100", "M98 P1", "G1 X5 A9", "G0 X9"]
    checked = check_job(MAKER, lines)
    said = {each.line: each.says for each in checked.findings}
    assert [each.kind for each in checked.findings] == [HALTS] * 4
    assert said[2] == "this machine does no G41"
    assert said[4] == "what follows is no number: X"
    assert said[6] == "there is no axis A"
    assert not checked.is_good


def test_the_sheets_edge_a_pause_and_a_foreign_code_are_found():
    assert lines_and_kinds(["G0 Z2", "G0 X1300", "G0 X0"]) == [(2, LEAVES)]
    assert lines_and_kinds(["M8", "G0 Z2", "T3 M6", "M0"]) == [(1, IGNORED), (3, WAITS)]
    assert lines_and_kinds(["G0 X0 Y-2500"])[0][1] in (HALTS, LEAVES)


def test_a_cut_in_a_corner_is_where_the_chains_cannot_hold_the_sled():
    checked = check_job(MAKER, square(-1219, -609, 60))
    assert not checked.is_good and checked.hanging is not None
    assert {bad.verdict for bad in checked.hanging.bad} == {"too vertical", "too slack"}
    assert min(bad.first for bad in checked.hanging.bad) == 3
    above = [line for line in square(-1219, -609, 60) if "Z-" not in line]
    assert check_job(MAKER, above).is_good


@pytest.mark.parametrize(
    ("lines", "cause", "asked", "feed"),
    [
        (["G1 Y-30 F3000"], GREATEST, 3000, 900),
        (["G1 Z-2 F300"], Z, 300, 18 * 3.17),
        (["G1 X30 Z-4 F640"], Z, 640, 18 * 3.17 * np.hypot(30, 4) / 4),
        (["G2 X2 I1 J0 F650"], ARC, 650, 60 * np.sqrt(100 * 1)),
        (["G0 Y400", "G0 X-1000", "G1 X-1100 Y440 F900"], CHAINS, 900, None),
    ],
)
def test_a_limit_that_slows_the_sled_is_named(lines, cause, asked, feed):
    slower = check_job(MAKER, lines, numbers={15: 900, 68: 700}).slower
    assert [each.because for each in slower] == [cause]
    assert slower[0].asked == pytest.approx(asked)
    assert slower[0].line == len(lines)
    assert slower[0].feed < asked
    if feed is not None:
        assert slower[0].feed == pytest.approx(feed, rel=0.02)


def test_times_are_given_for_the_programmed_feeds_and_the_limit():
    lines = ["G0 Z3", "G0 X0 Y0", "G1 X100 F1800", "G1 X190 F600"]
    lines += ["G93", "G1 X90 F30", "G1 X90 F30", "G94"]
    times = check_job(MAKER, lines, numbers={15: 900}).times
    assert times.asked == pytest.approx(100 / 30 + 9 + 2, abs=0.02)
    assert times.capped == pytest.approx(100 / 15 + 9 + 100 / 15, abs=0.02)
    assert times.cutting == pytest.approx(times.capped, abs=0.5)
    free = check_job(MAKER, lines[:4], numbers={15: 2000}).times
    assert free.asked == pytest.approx(free.capped) == pytest.approx(100 / 30 + 9, abs=0.02)


def test_cuts_that_lie_apart_are_parts_in_the_order_of_the_program():
    lines = [*square(100, 50, 40), *square(-200, 0, 30, depth=2.5), *square(105, 55, 10)]
    parts = check_job(MAKER, lines).parts
    assert [(part.first_line, part.last_line) for part in parts] == [(3, 24), (11, 16)]
    assert parts[0].low == pytest.approx((100, 50)) and parts[0].size == pytest.approx((40, 40))
    assert parts[1].size == pytest.approx((30, 30)) and parts[1].deepest == pytest.approx(-2.5)


TRUE = replace(
    MAKER,
    motor_gap=MAKER.motor_gap + 2,
    motor_height=MAKER.motor_height - 3,
    motor_center_x=2.0,
    effects={
        "chain_sag": {"weight_ratio_squared": 8.2e-12},
        "chain_stretch": {"compliance": 5.17e-6},
        "chain_pitch": {"left": 0.002, "right": 0.002},
    },
)


def example_inputs(settings):
    cut_with = read_settings(SETTINGS)
    return Inputs(settings, read_marks(MARKS, sheet=settings.sheet), cut_with=cut_with)


def true_errors(settings, places):
    """Where the judge hangs the example's true machine, less where it was sent."""
    chains, _ = lengths(settings.as_plumb_model(), places)
    weights = np.full(len(places), TRUE.sled_weight)
    return _judge.places(judged(TRUE), chains, pushes=0 * chains, weights=weights) - places


@pytest.mark.parametrize("file", ["groundcontrol.ini", "machine.toml"])
@pytest.mark.parametrize("corner", [(-400.0, -200.0), (200.0, -450.0), (-1000.0, 100.0)])
def test_a_part_comes_out_as_expected(file, corner):
    settings = read_settings(EXAMPLE / file)
    size = np.array([700.0, 300.0])
    steps = np.linspace(0, 1, 12)
    places = np.array([(x, y) for x in steps for y in steps]) * size + corner
    high = (corner[0] + size[0], corner[1] + size[1])
    part = Part(1, 2, corner, high, -3.0, places)
    part = with_errors(Believed.of(example_inputs(settings)), settings, part)
    true = true_errors(settings, places)
    design = np.column_stack([np.ones(len(places)), places - places.mean(axis=0)])
    stretch = np.linalg.lstsq(design, true, rcond=None)[0][1:]
    across, up, skew = stretch[0, 0], stretch[1, 1], stretch[0, 1] + stretch[1, 0]
    wanted = size[0] * across, size[1] * up, size[1] * skew
    for error, truth in zip((part.width_error, part.height_error, part.skew), wanted, strict=True):
        assert abs(error.mm - truth) < error.within < 1.5
    if file == "groundcontrol.ini":
        assert wanted[0] > 1 and part.width_error.mm == pytest.approx(wanted[0], abs=0.5)
    else:
        assert abs(part.width_error.mm) < 0.35


def test_the_outline_goes_round_everything_above_the_sheet():
    checked = check_job(MAKER, ["G0 Z8", "G0 X10", *square(100, 50, 40), "G0 X0 Y0"])
    program = outline_of(checked.done.moves, name="a (b).nc").splitlines()
    traced = check_job(MAKER, program)
    assert traced.is_good and not traced.parts
    corners = hull_of(checked.done.moves)
    assert {tuple(corner) for corner in corners} == {(100, 50), (140, 50), (140, 90), (100, 90)}
    moves = traced.done.moves
    slow = moves.only(~moves.rapid)
    assert slow["length"].sum() == pytest.approx(160) and (slow["z_to"] == 8).all()
    assert slow["asked"] == pytest.approx(500)
    assert (slow["to_x"][-1], slow["to_y"][-1]) == tuple(corners[0])


def test_a_hundred_thousand_lines_are_checked_and_the_share_that_is_done_grows():
    angles = np.arange(100_000) * 0.002
    lines = [
        f"G1 X{400 * np.cos(t):.3f} Y{300 * np.sin(1.01 * t):.3f} Z{np.sin(9 * t) - 2:.3f} F900"
        for t in angles
    ]
    shares = []
    checked = check_job(MAKER, lines, progress=shares.append)
    assert checked.is_good and len(checked.done.moves) > 99_000
    assert shares == sorted(shares) and 20 < len(shares) < 200 and shares[-1] == 1


def test_checking_a_program_in_pieces_gives_the_same_answers(ask, monkeypatch):
    whole = ask("check", POCKET, SETTINGS, "--marks", MARKS)
    monkeypatch.setattr("plumb.job.dry_run.BLOCK", 7)
    assert ask("check", POCKET, SETTINGS, "--marks", MARKS) == whole


def test_the_command_prints_all_findings(ask, run, tmp_path):
    outline = tmp_path / "outline.nc"
    traced = ("--outline", outline)
    code, answer = ask("check", POCKET, SETTINGS, "--marks", MARKS, *traced)
    assert code == 0 and answer["good"] and answer["written"] == [str(outline)]
    assert answer["parts"][0]["width_error"]["within"] > 0
    assert "G0 Z5.000" in outline.read_text()
    _, capped = ask("check", POCKET, SETTINGS, "--set", "15=500")
    assert capped["asked_seconds"] == answer["asked_seconds"]
    assert capped["asked_seconds"] < capped["capped_seconds"] < capped["cutting_seconds"]
    said = " ".join(run("check", POCKET, SETTINGS, "--set", "15=500")[1].split())
    assert "s at the feeds asked for, 40 s with none above $15" in said
    assert "above $15" not in run("check", POCKET, SETTINGS)[1]
    _, slower = ask("check", POCKET, SETTINGS, "--set", "18=6")
    assert slower["asked_seconds"] < slower["cutting_seconds"] < slower["seconds"]
    assert "askew" in run("check", POCKET, SETTINGS, "--marks", MARKS)[1]
    other = OTHER / "marks.toml"
    code, said, complaint = run("check", POCKET, EXAMPLE / "machine.toml", "--marks", other)
    assert (code, said) == (2, "") and complaint.startswith(f"plumb: {other}: was cut with another")
    code, said, _ = run("check", POCKET, SETTINGS, "--set", "18=6")
    assert "askew" not in said and "give --marks" in " ".join(said.split())
    slow = re.search(r"gets (\d+)$", said.replace("\n  ", " "), re.MULTILINE)
    assert code == 0 and slow and "gets 19" in said.replace("\n  ", " ")


def test_the_command_ends_with_1_where_something_is_wrong(ask, run, tmp_path):
    job = tmp_path / "job.nc"
    job.write_text("G0 Z2\nG41 D1\nG1 X1500 F600\n")
    code, answer = ask("check", job, SETTINGS)
    assert code == 1 and not answer["good"] and answer["hanging"] is None
    assert [each["line"] for each in answer["findings"] if each["wrong"]] == [2, 3]
    code, said, _ = run("check", job, SETTINGS)
    assert code == 1 and "2 lines of job.nc are wrong." in said
    assert "- line 2: the machine halts: this machine does no G41" in said


SLOT = ("G0 Z3", "G0 X100 Y50", "G1 Z-1 F60", "G1 X140 F600", "G0 Z3")


def test_a_cut_where_the_sled_hangs_badly_is_wrong_but_a_move_above_the_sheet_is_not():
    corner = ("G0 X-1215 Y-600", "G1 Z-1 F60", "G1 X-1200 F600", "G0 Z3")
    assert not check_job(MAKER, [*SLOT, *corner]).is_good
    assert check_job(MAKER, [*SLOT, "G0 X-1215 Y-600", "G0 X0 Y0"]).is_good


R = 6.35 / 2  # [mm] of the usual bit
PLUNGE = "a rapid move drives the bit {} mm down into wood that nothing has cut"
LOOP = "G1 Z-3 F60", "G2 X40 I20 F500"
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


def adaptive():
    """A pocket as FreeCAD's adaptive clearing cuts it: a helix down, then arcs that grow by a
    fifth of the bit. Behind each the bit goes back through what is cut, as a rapid at
    the full depth.
    """
    lines = ["(Exported by FreeCAD)", "(TC: 6mm endmill)", "G21 G90", "M3 S18000", "G0 Z5"]
    for depth in (-3.0, -6.0):
        lines += ["G0 X2 Y0", f"G0 Z{depth + 3.2:.3f}"]
        lines += [f"G2 X-2 Y0 Z{depth + 1.5:.3f} I-2 J0 F600", f"G2 X2 Y0 Z{depth:.3f} I2 J0"]
        lines += [f"G2 X-2 Y0 Z{depth:.3f} I-2 J0", f"G2 X2 Y0 Z{depth:.3f} I2 J0"]
        for radius in np.arange(3.2, 30, 1.2):
            angles = np.radians(np.arange(-60, 61, 6))
            places = radius * np.column_stack([np.cos(angles), np.sin(angles)])
            begin = places[0] * (1 - 1.2 / radius)
            lines += [f"G0 X{begin[0]:.3f} Y{begin[1]:.3f}"]
            lines += [f"G1 X{x:.3f} Y{y:.3f} F900" for x, y in places]
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
        ([*LOOP, "G0 Z5", "G0 X20 Y20", "G0 Z-3", "G0 Z4"], []),
        ([*LOOP, "G0 Z5", "G0 X20 Y19", "G0 Z-3", "G0 Z4"], [(5, 1, PLUNGE.format("3.00"))]),
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
