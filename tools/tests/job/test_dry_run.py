"""The dry run, and programs made from it: resumed, fixed, and how long they last."""

import re

import numpy as np
import pytest
from example_machine import INI
from plumb.cli.main import main
from plumb.firmware.settings import values_of
from plumb.firmware.telemetry import telemetry_in
from plumb.hidden import MAKER, Hidden
from plumb.job.check import check_job
from plumb.job.dry_run import (
    GOUGES,
    HALTS,
    IN_WOOD,
    SINKS,
    Run,
    TimeLeft,
    Timetable,
    pieces,
    timetable,
)
from plumb.job.fixes import fixed
from plumb.job.resume import JobMachine, modes_after, resume_at_line, resume_at_place
from plumb.job.wood import Tools
from plumb.settings import machine_toml, write_machine_toml
from plumb.text.errors import InputError
from plumb.vm.garage import random_garage
from scipy.spatial import cKDTree
from scipy.spatial.transform import Rotation
from usual_machine import switched_on
from workshop import NAMES, PROGRAMS, Workshop, lines_of, run_dry

APART = 0.35  # [mm] between the cut and the way of the dry run; steps of 0.1 mm and following error
AFTER_HALT = 0.5  # [mm] at most between the cut after a halt and the cut without


@pytest.mark.parametrize("name", NAMES)
def test_time_and_cut_are_those_of_the_virtual_machine(name):
    workshop = Workshop()
    took = workshop.cut(lines_of(name))
    telemetry = telemetry_in("\n".join(workshop.sender.ask("B30")))
    assert (telemetry.slips, telemetry.last_slip) == ((0, 0), None), "no chain seems to slip"
    done = run_dry(lines_of(name))
    assert done.seconds == pytest.approx(took, rel=0.005)
    assert done.halted_at is None and not done.refused
    way = done.moves.sampled(0.1)
    tree = cKDTree(np.column_stack([way.places, way.z]))
    cut = np.array(workshop.machine.cuts())[:, 2:]
    cut[:, 2] *= -1
    off, _ = tree.query(cut)
    assert off.max() < APART
    # And all of the way that is in the wood was cut.
    rises = done.moves["z_to"] > done.moves["z_from"]
    deep = (way.z < -0.1) & ~rises[way.move]
    off, _ = cKDTree(cut).query(np.column_stack([way.places, way.z])[deep])
    assert off.max() < APART


def test_each_program_has_its_places():
    assert len(NAMES) == 13
    for name in NAMES:
        rows = [
            list(map(float, row.split()))
            for row in (PROGRAMS / name).with_suffix(".places").read_text().splitlines()
            if not row.startswith("#")
        ]
        for line, *place in rows:
            run = Run(MAKER)
            run.send(lines_of(name)[: int(line)])
            assert run.place == pytest.approx(place, abs=0.008), (name, line)


def test_an_alarm_ends_the_run():
    run = Run(MAKER)
    run.send(["G0 Z2", "B11 L S100 T1", "G0 X5"])
    assert run.finish().halted_at is None
    run = Run(MAKER, numbers={2: 4000.0})
    assert run.finish().seconds == 0


def test_a_line_is_cut_as_the_firmware_cuts_it():
    assert pieces("n5 g1x2.5 (a) M3 S99;b") == [("G", 1.0, {"X": 2.5}), ("M", 3.0, {"S": 99.0})]
    assert pieces("G38.2 Z-5")[0][1] == pytest.approx(38.2)
    assert pieces("X--5") == [] == pieces("")


NEAR = 0.008  # [mm] from the arc: chords of 0.005 mm, and three decimals in the text
NORMAL = {"G17": (0, 0, 1), "G18": (0, 1, 0), "G19": (1, 0, 0)}
DRAWN = np.random.default_rng(18)


def judged(start, centre, plane, turn, climb):
    """Places of an arc (n, 3) that turns [rad] about the plane's normal by the right hand, and
    climbs [mm] along it.
    """
    shares = np.linspace(0, 1, 2001)[:, None]
    normal = np.array(NORMAL[plane], dtype=float)
    turned = Rotation.from_rotvec(shares * turn * normal).apply(np.subtract(start, centre))
    return centre + turned + shares * climb * normal


def line_of(plane, start, centre, way, *, with_radius):
    """The line for an arc, with the centre or, of less than a turn, the radius."""
    normal = np.array(NORMAL[plane])
    code = "G3" if way.turn > 0 else "G2"
    words = [f"{letter}{value:.3f}" for letter, value in zip("XYZ", way.end, strict=True)]
    ahead = (np.array(centre) - start) * (1 - normal)
    if with_radius:
        size = np.linalg.norm(ahead) * (1 if abs(way.turn) < np.pi else -1)
        words.append(f"R{size:.4f}")
    else:
        letters = zip("IJK", ahead, normal, strict=True)
        words += [f"{letter}{value:.3f}" for letter, value, off in letters if not off]
    return " ".join([plane, code, *words, "F900"])


class Way:
    """A drawn arc: where it begins, its centre, its turn [rad] and climb [mm]."""

    def __init__(self, plane):
        self.start = np.round(DRAWN.uniform((-60, -60, 2), (60, 60, 20)), 3)
        across = DRAWN.normal(size=3) * (1 - np.array(NORMAL[plane]))
        across *= DRAWN.uniform(0.5, 25) / np.linalg.norm(across)
        self.centre = np.round(self.start + across, 3)
        # Of half a turn no radius says the centre to more than a tenth of a millimetre.
        turn = DRAWN.choice([DRAWN.uniform(0.3, 2.6), DRAWN.uniform(3.7, 6.0)])
        self.turn = DRAWN.choice([-1, 1]) * turn
        climb = DRAWN.choice([0.0, 1.0]) * DRAWN.uniform(-8, 8)
        self.places = judged(self.start, self.centre, plane, self.turn, climb)
        self.end = self.places[-1]


def polyline(moves):
    """Where each move begins, and the end of the last (n + 1, 3)."""
    begins = np.column_stack([moves["from_x"], moves["from_y"], moves["z_from"]])
    last = [moves["to_x"][-1], moves["to_y"][-1], moves["z_to"][-1]]
    return np.vstack([begins, last])


def apart(places, corners):
    """Greatest distance of places (n, 3) from a line through corners."""
    begin, way = corners[:-1], np.diff(corners, axis=0)
    share = np.einsum("nkj,kj->nk", places[:, None] - begin, way) / np.sum(way**2, axis=1)
    nearest = begin + np.clip(share, 0, 1)[:, :, None] * way
    return np.linalg.norm(places[:, None] - nearest, axis=2).min(axis=1).max()


@pytest.mark.parametrize("plane", ["G18", "G19"])
@pytest.mark.parametrize("with_radius", [False, True])
def test_an_arc_runs_where_the_judge_turns_it(plane, with_radius):
    for _ in range(12):
        way = Way(plane)
        x, y, z = way.start
        line = line_of(plane, way.start, way.centre, way, with_radius=with_radius)
        done = run_dry([f"G0 X{x:.3f} Y{y:.3f} Z{z:.3f}", line])
        assert not done.said, line
        moves = done.moves.only(done.moves["line"] == 2)
        corners = polyline(moves)
        slack = 0.05 if with_radius else NEAR  # a radius places a centre less well
        assert apart(way.places, corners) < slack, line
        assert apart(corners, way.places) < slack, line
        # And in this order: each chord's middle comes later on the arc than the last.
        middles = (corners[1:] + corners[:-1]) / 2
        at = [np.linalg.norm(way.places - middle, axis=1).argmin() for middle in middles]
        assert (np.diff(at) > 0).all(), line
        assert (moves["asked"] == 900).all() and not moves.rapid.any()


def test_a_full_circle_returns_and_a_limit_of_z_cuts_it_flat():
    done = run_dry(["G0 Z10", "G18 G2 I5 K0 F900"])
    corners = polyline(done.moves.only(done.moves["line"] == 2))
    ring = judged((0, 0, 10), (5, 0, 10), "G18", -2 * np.pi, 0)
    assert apart(ring, corners) < NEAR and apart(corners, ring) < NEAR
    done = run_dry(["G0 Z10", "B17", "G18 G2 I5 K0 F900", "G0 X1"])
    corners = polyline(done.moves.only(done.moves["line"] == 3))
    assert corners[:, 2].max() == pytest.approx(10, abs=1e-3)
    assert corners[:, 2].min() == pytest.approx(5, abs=0.01)


MACHINE = JobMachine(MAKER, (0.0, 0.0, 0.0), {})
TRIED = 8  # of each program that are tried
NUMBERS = ("from_x", "from_y", "to_x", "to_y", "z_from", "z_to", "length", "sweep")


def same_moves(after, moves):
    """Whether the last moves of a resumed program are these, at the same feeds."""
    assert len(after) >= len(moves)
    tail = after.only(np.arange(len(after) - len(moves), len(after)))
    for name in NUMBERS:
        assert tail[name] == pytest.approx(moves[name], abs=0.02), name
    assert tail["asked"] == pytest.approx(moves["asked"], rel=1e-4)


@pytest.mark.parametrize("name", NAMES)
def test_from_any_line_on_the_same_moves_follow(name):
    lines = lines_of(name)
    moves = run_dry(lines).moves
    drawn = np.random.default_rng(len(lines)).permutation(len(lines))[:TRIED]
    for line in (1 + drawn).tolist():
        resumed = resume_at_line(MACHINE, lines, line)
        assert resumed.first <= line
        assert resumed.begins[2] >= IN_WOOD
        checked = check_job(MAKER, resumed.lines)
        same_moves(checked.done.moves, moves.only(moves["line"] >= resumed.first))
        assert not {each.kind for each in checked.findings} & {GOUGES, HALTS}
        assert resumed.lines[1].split()[-1].startswith("Z") and "G0 Z" in resumed.lines[1]


@pytest.mark.parametrize("name", NAMES)
def test_from_any_place_of_a_cut_on_the_same_moves_follow(name):
    lines = lines_of(name)
    moves = run_dry(lines).moves
    source = np.random.default_rng(len(lines))
    cut = np.flatnonzero(moves.cut & ~moves.rapid & (moves["length"] > 1))
    for row in source.choice(cut, min(len(cut), 4), replace=False):
        place = moves.places_at(np.array([row]), np.array([source.uniform(0.1, 0.9)]))[0]
        resumed = resume_at_place(MACHINE, lines, tuple(place), int(moves["line"][row]))
        entry = resumed.entry
        assert entry is not None
        assert np.hypot(*np.subtract(entry.place, place)) < 0.06
        checked = check_job(MAKER, resumed.lines)
        after = checked.done.moves
        # The rest of the move that is cut in two ends where the move ended.
        later = moves.only(moves["line"] > entry.line)
        same_moves(after, later)
        rest = after.only(np.arange(len(after) - len(later) - len(entry.rows), len(after)))
        whole = entry.rows
        assert rest["to_x"][0] == pytest.approx(whole["to_x"][0], abs=0.01)
        assert rest["to_y"][0] == pytest.approx(whole["to_y"][0], abs=0.01)
        assert rest["length"][0] == pytest.approx((1 - entry.share) * whole["length"][0], abs=0.05)
        assert (rest["sweep"][0] > 0) == (whole["sweep"][0] > 0)
        assert not {each.kind for each in checked.findings} & {GOUGES, HALTS}


@pytest.mark.parametrize("name", NAMES)
def test_the_cut_after_a_halt_is_the_cut_without(name):
    """The virtual machine is stopped in the middle of a line drawn by chance, then goes on."""
    lines = lines_of(name)
    way = run_dry(lines).moves
    source = np.random.default_rng(NAMES.index(name) + 7)
    line = int(source.choice(np.unique(way["line"][way.cut])))
    workshop = Workshop()
    workshop.cut(lines[: line - 1])
    workshop.machine.send(lines[line - 1].encode() + b"\n")
    workshop.machine.advance(int(source.integers(100, 900)))
    workshop.stop()
    workshop.cut(list(resume_at_line(MACHINE, lines, line).lines))
    cut = np.array(workshop.machine.cuts())[:, 2:] * (1, 1, -1)
    samples = way.sampled(0.1)
    places = np.column_stack([samples.places, samples.z])
    off, _ = cKDTree(places).query(cut)
    assert off.max() < AFTER_HALT
    rises = way["z_to"] > way["z_from"]
    deep = (samples.z < -0.1) & ~rises[samples.move]
    off, _ = cKDTree(cut).query(places[deep])
    assert off.max() < AFTER_HALT


def test_a_cycle_is_drilled_from_its_beginning():
    lines = ["G0 Z4", "G81 X9 Z-3 R1 F60", "X20", "(c)", "X30", "G80", "G0 X0"]
    begins = [resume_at_line(MACHINE, lines, line).first for line in range(1, 8)]
    assert begins == [1, 2, 2, 2, 2, 2, 7]
    several = ["G82 Z-1", "G4 P1", "G1 X4", "G83 X5", "M2"]
    in_force = [modes_after(several[:count]).is_in_cycle for count in range(1, 6)]
    assert in_force == [True, True, False, True, False]
    resumed = resume_at_place(MACHINE, lines, (20, 0))
    assert resumed.first == 2 and resumed.entry is None
    # Later holes go up to where these did.
    for code in ("G98", "G99"):
        later = resume_at_line(MACHINE, [lines[0], f"{code} {lines[1]}", *lines[2:]], 7)
        assert any(f" {code} " in line for line in later.lines)


def test_spindle_laser_tool_and_units_are_as_they_were():
    lines = ["G20", "T4 M6", "M3 S9000", "G0 Z0.2", "G1 Z-0.1 F5", "G91 X1 F20", "M5", "G90 G0 Z1"]
    resumed = resume_at_line(MACHINE, lines, 6)
    assert "T4 M6" in resumed.lines and "M3 S9000" in resumed.lines
    assert resumed.lines.index("T4 M6") < resumed.lines.index("M3 S9000")
    assert "G20 G17 G98 G91.1 F17.717 G0" in resumed.lines
    late = resume_at_line(MACHINE, [*lines, "G1 X0"], 9)
    assert late.first == 9 and "M3 S9000" not in late.lines and "T4 M6" in late.lines
    assert late.lines[-2:] == ("G90 G94", "G1 X0")
    tools = modes_after(["M106 S80", "G4 S3", "M4 S100"])
    assert tools.spindle_lines == ["M4 S100"] and tools.laser_lines == ["M106 S100"]
    assert modes_after(["M106", "G1 X1"]).laser_lines == ["M106 S255"]
    assert modes_after(["M3 S5", "M106", "M30"]).spindle_lines == []
    assert modes_after(["M3"]).spindle_lines == ["M3"]
    assert modes_after(["M3 S5", "M2"]).spindle_lines == []
    assert modes_after(["M106 S80", "M107", "M3"]).spindle_lines == ["M3 S80"]


@pytest.mark.parametrize("code", ["G92 X10 Y20", "G43.1 Z7", "G10 L2 P1 X30 Y-5", "G55"])
def test_coordinates_that_the_program_sets_are_set_again(code):
    lines = ["G0 X40 Y10", code, "G0 Z12", "G0 X5", "G1 Z-1 F60", "G1 X25 Y8 F500", "G0 Z12"]
    lines += ["X9", "G1 Z-2", "G2 X19 I5 J0", "G0 Z12"]
    moves = run_dry(lines).moves
    for line in (6, 8, 10):
        resumed = resume_at_line(MACHINE, lines, line)
        wanted = moves.only(moves["line"] >= resumed.first)
        same_moves(run_dry(resumed.lines).moves, wanted)
        # A machine that kept its power still has them.
        halted = MACHINE.after(lines[: line - 1])
        halted.send(resumed.lines)
        same_moves(halted.finish().moves, wanted)


LATER = {
    "another system": ("G10 L2 P2 X50 Y40 Z1\nG55", "G54"),
    "two of them": ("G10 L2 P3 X50\nG10 L20 P2 X3 Y4\nG56", "G55"),
    "a longer bit": ("G43.1 Z7", "G43.1 Z9"),
    "no tool's length": ("G43.1 Z7", "G49"),
    "no shift": ("G92 X10 Y20 Z5", "G92.1"),
    "a shift put aside": ("G92 X10 Y20 Z5", "G92.2"),
    "a shift taken back": ("G92 X10 Y20 Z5\nG92.2", "G92.3"),
    "both": ("G10 L2 P2 X50\nG55\nG43.1 Z7\nG92 Y9", "G92.1\nG54\nG49"),
}


@pytest.mark.parametrize("name", LATER)
def test_coordinates_that_the_program_changes_later_begin_as_before(name):
    first, later = (each.split("\n") for each in LATER[name])
    up = "G53 G0 Z12"
    lines = ["G0 X40 Y10", *first, up, "G0 X5", "G53 G1 Z-1 F60", "X25 Y8 F500", up]
    lines += [*later, up, "G0 X9 Y3", "G0 Z8", "G1 Z6", "X19", up]
    cut = lines.index("X25 Y8 F500") + 1
    moves = run_dry(lines).moves
    resumed = resume_at_line(MACHINE, lines, cut)
    wanted = moves.only(moves["line"] >= resumed.first)
    same_moves(run_dry(resumed.lines).moves, wanted)
    halted = MACHINE.after(lines[: cut - 1])
    halted.send(resumed.lines)
    same_moves(halted.finish().moves, wanted)


@pytest.mark.parametrize(
    ("code", "z"),
    [("G92 X10 Y20", -1), ("G43.1 Z7", -8), ("G92 Z15", 8), ("G10 L2 P1 X30 Y-5", -1)],
)
def test_so_are_coordinates_in_the_middle_of_a_cut(code, z):
    up = f"G0 Z{z + 12}"
    lines = ["G0 Z5", code, up, "G0 X5", f"G1 Z{z} F60", "G1 X25 Y8 F500", "G3 X65 I20", up, "X9"]
    moves = run_dry(lines).moves
    cut = moves.only(moves["line"] == 6)
    place = ((cut["from_x"][0] + cut["to_x"][0]) / 2, (cut["from_y"][0] + cut["to_y"][0]) / 2)
    resumed = resume_at_place(MACHINE, lines, place, 6)
    assert resumed.entry.share == pytest.approx(0.5, abs=0.01)
    after = check_job(MAKER, resumed.lines).done.moves
    same_moves(after, moves.only(moves["line"] > 6))
    rest = after.only(np.flatnonzero(after["asked"] == 500)[:1])
    for name in ("to_x", "to_y", "z_from", "z_to"):
        assert rest[name] == pytest.approx(cut[name], abs=0.02), name
    assert rest["length"] == pytest.approx(cut["length"] / 2, abs=0.1)


def test_the_first_pass_is_taken_unless_a_line_is_named():
    lines = ["G0 Z4", "G1 Z-1 F60", "G1 X50 F500", "Y20", "Y0", "X0", "G1 Z-2 F70", "X50", "G0 Z4"]
    resumed = resume_at_place(MACHINE, lines, (25, 1))
    assert resumed.first == 3 and resumed.entry.passes == (3, 6, 8)
    assert resumed.entry.z == pytest.approx(-1, abs=0.01) and resumed.entry.plunge == 60
    lines[6:6] = ["G0 Z3", "G0 X0"]
    third = resume_at_place(MACHINE, lines, (25, 1), line=9)
    assert third.first == 10 and third.entry.z == pytest.approx(-2, abs=0.01)
    assert "G1 Z-2.0000 F70" in third.lines


def test_impossible_values_are_refused():
    with pytest.raises(InputError, match="the program has 2 lines"):
        resume_at_line(MACHINE, ["G0 X1", "G0 X2"], 3)
    with pytest.raises(InputError, match=r"no cut passes within 5 mm of X9 Y50; .* X9\.0 Y0\.0"):
        resume_at_place(MACHINE, ["G1 Z-1 F60", "G1 X20 F500"], (9, 50))
    with pytest.raises(InputError, match="cuts nothing"):
        resume_at_place(MACHINE, ["G0 X20"], (9, 50))


def test_the_command_writes_the_program(run, ask, tmp_path):
    output = tmp_path / "rest.nc"
    job = PROGRAMS / "kirimoto_outline.nc"
    code, said, _ = run("resume", job, INI, "--line", "18", "-o", output)
    assert code == 0 and "goes on with line 11" in said
    assert output.read_text().startswith("(plumb: kirimoto_outline.nc from line 11 on)\nG21")
    assert "Look at it before you send it:" in said and f"{output}" in said
    code, answer = ask("resume", job, INI, "--line", "18", "-o", output)
    assert code == 0 and answer["written"] == [str(output)] and answer["passes"] == []
    assert (answer["line"], len(answer["begins_mm"])) == (11, 3)
    code, answer = ask("resume", job, INI, "--at=-60,65", "-o", output)
    assert (answer["line"], answer["passes"]) == (13, [13, 20]) and answer["begins_mm"][2] < 0
    code, said, report = run("resume", job, INI, "--at=-60,65")
    assert "Look at it" not in said + report
    assert code == 0 and "G1 Z-1.0000 F150\n" in said
    assert re.search(r"line 13, at X-60.\d\d Y65.\d\d, 1.00 mm deep", report.replace("\n", " "))
    assert "It cuts there again at line 20" in report
    code, _, complaint = run("resume", job, INI)
    assert code == 2 and "--line N, --at X,Y" in complaint


FUSION = """G90 G94
G17
G21
G28 G91 Z0.
G90
S12000 M3
G54
G0 X-50 Y10
Z15.
Z5.
G98 G81 X-50 Y10 Z-4. R2. F300
X-40
G80
Z15.
X0 Y0
Z5
G1 Z0 F300
G18 G2 X1 Z-1 I1 K0 F1000
G17
G1 X20
N5 G28 G91 Z0.
G90
G28 G91 X0. Y0.
G90
M5
M30""".splitlines()
# What it says to a machine that has a home and reads G80 as Fusion does, written by hand.
MEANT = [*FUSION]
MEANT[3], MEANT[20], MEANT[22] = "G91 G53 G0 Z15", "G91 G53 G0 Z15", "G91"
MEANT[14] = "G0 X0 Y0"


def fix(lines):
    findings = check_job(MAKER, lines, tools=Tools.of(lines)).findings
    return fixed(MACHINE, lines, findings, source="job.nc")


def cut(lines):
    """The finished piece, and the places of each cut."""
    checked = check_job(MAKER, lines, tools=Tools.of(lines))
    moves = checked.done.moves
    return checked, moves.only(moves.cut).sampled(0.5)


def assert_cuts_the_same(lines, others):
    (these, places), (those, other_places) = cut(lines), cut(others)
    assert these.done.halted_at is None and these.is_good, these.findings
    assert these.piece.removed == pytest.approx(those.piece.removed, rel=1e-9)
    np.testing.assert_allclose(places.places, other_places.places, atol=1e-3)
    np.testing.assert_allclose(np.minimum(places.z, 0), np.minimum(other_places.z, 0), atol=1e-3)
    assert these.piece.removed > 100


def test_a_fusion_program_runs_and_cuts_as_intended():
    mended = fix(FUSION)
    assert [each.line for each in mended.changes] == [4, 15, 21, 23]
    assert len(mended.lines) == len(FUSION)
    assert mended.lines[3] == "G91 G53 G0 Z15.000" and mended.lines[20] == "G91 G53 G0 Z15.000 G1"
    assert mended.lines[14] == "G0 X0 Y0"
    assert mended.lines[22] == "G91"
    assert_cuts_the_same(mended.lines, MEANT)
    assert fix(mended.lines) == type(mended)(mended.lines, ())


def test_a_retract_after_holes_cancels_the_motion_and_keeps_the_rest_of_its_line():
    lines = ["G0 Z3", "G81 X9 Z-4 R2 F200", "G80", "G28 G91 Z0 S9000 T2", "G90", "X20", "G0 X0"]
    mended = fix(lines)
    # A program that stays low gets the height that the check takes for clear.
    assert mended.lines[3] == "G91 S9000 T2 G53 G0 Z5.000 G80"
    assert mended.lines[5] == "G0 X20"
    assert_cuts_the_same(mended.lines, [*lines[:3], "G0 Z5", "G90", "G0 X20", "X0"])


@pytest.mark.parametrize("name", NAMES)
def test_a_program_that_runs_is_not_changed(name):
    assert fix(lines_of(name)).changes == ()


@pytest.mark.parametrize(
    ("says", "lines"),
    [
        # What is no habit that is known.
        ("line 2: cannot be fixed: G41 D1", ["G0 Z5", "G41 D1", "G1 Z-1 F200", "X5", "G0 Z5"]),
        # The program counts on from an unknown home.
        ("line 4", ["G0 Z5", "G28 X0 Y0", "G91", "G1 X5 Y5 Z-7 F300", "G90 G0 Z5"]),
        ("line 3", ["G0 Z5", "G91 G28 Z0", "G1 Z-12 F300", "X9", "G90 G0 Z5"]),
        ("line 4", ["G0 Z5", "G28 G91 X0 Y0", "G90 X5", "G1 Z-2 F300", "X9", "G0 Z5"]),
        # The way home would lead through the wood.
        ("line 3", ["G0 X9", "G1 Z-3 F300", "G28 X0 Y0", "G0 Z5"]),
        # In the middle of a cycle, which the way home may end or not.
        ("line 3", ["G0 Z5", "G81 X9 Z-3 R2 F200", "G28 G91 Z0", "G90 G80", "G0 Z5"]),
        # After G80 a place in the wood, and one without a motion in force.
        ("line 3", ["G81 X9 Z-3 R2 F200", "G80", "Z-4", "G0 Z5"]),
        ("line 4", ["G1 Z3 F300", "G81 X9 Z-3 R2 F200", "G80", "X20", "G0 Z5"]),
    ],
)
def test_a_line_without_an_equivalent_is_refused(says, lines):
    with pytest.raises(InputError) as refused:
        fix(lines)
    assert says in str(refused.value) and "\n" not in str(refused.value)
    assert str(refused.value).startswith("job.nc, line")


def test_the_command_writes_lists_or_refuses_the_changes(here, capsys):
    write_machine_toml("machine.toml", MAKER)
    (here / "job.nc").write_text("\n".join(FUSION))
    assert main(["check", "job.nc", "machine.toml"]) == 1
    assert "plumb check job.nc machine.toml --fix mended.nc" in capsys.readouterr().out
    for _ in range(2):  # the second time it replaces what it wrote
        assert main(["check", "job.nc", "machine.toml", "--fix", "out.nc"]) == 0
        said = capsys.readouterr().out
        assert said.startswith("out.nc cuts the same, with 4 lines changed:\n- line 4:")
        assert "Nothing is wrong with out.nc." in said
    mended = (here / "out.nc").read_text()
    assert mended.startswith("(plumb: job.nc as this machine runs it) ")
    assert len(mended.splitlines()) == len(FUSION)
    (here / "job.nc").write_text("G0 Z5\nG41 D1\nG1 Z-1 F200\n")
    assert main(["check", "job.nc", "machine.toml", "--fix", "other.nc"]) == 2
    assert not (here / "other.nc").exists()
    assert capsys.readouterr().err.count("\n") == 1


@pytest.mark.parametrize(
    ("line", "meant"),
    [
        ("G73 X10 Y10 Z-3 R1 Q1.5 F100", "G83 X10 Y10 Z-3 R1 Q1.5 F100"),
        ("G98 G73 X10 Y10 Z-3 R1 Q0 F100", "G98 G81 X10 Y10 Z-3 R1 F100"),
        ("G83 X10 Y10 Z-3 R1 Q0. F100", "G81 X10 Y10 Z-3 R1 F100"),
    ],
)
def test_chip_breaking_cycles_become_cycles_of_this_machine(line, meant):
    program = ["G0 Z5", line, "X30", "G80", "G0 Z5"]
    mended = fix(program)
    assert list(mended.lines) == ["G0 Z5", meant, *program[2:]]
    assert [change.line for change in mended.changes] == [2]


def test_a_height_near_another_machines_top_becomes_a_free_one_in_the_programs_unit():
    lines = ["G20", "G0 Z0.5", "G1 Z-0.1 F5", "X1 F20", "G0 Z0.5", "G53 G0 Z-0.5"]
    mended = fix([*lines, "G0 X0"])
    assert mended.lines[5] == "G53 G0 Z0.5000"
    assert_cuts_the_same(mended.lines, [*lines[:5], "G0 X0"])


WEAK = 2  # the seed of a machine whose gears hold little
LOW, HIGH = 200, 500  # [mm] y of rests that hold, and that may not


def rests(lines, settings=MAKER):
    """Lines at which the sled may sink."""
    checked = check_job(settings, lines)
    assert checked.is_good
    return [each.line for each in checked.findings if each.kind == SINKS]


# At the last of these places one chain alone pulls too hard.
@pytest.mark.parametrize(("x", "y", "lines"), [(0, LOW, []), (0, HIGH, [3]), (-500, 400, [3])])
def test_the_end_of_a_program_is_checked(x, y, lines):
    assert rests(["G21", "G0 Z5", f"G0 X{x} Y{y}"]) == lines
    assert rests(["G0 Z5", f"G0 X{x} Y{y}", "G0 Y0"]) == []


def test_a_machine_with_weak_gears_slides_only_where_the_check_says_so():
    garage = random_garage(Hidden(), WEAK)
    machine = garage.machine(elf=None)
    said: list[str] = []
    sender = switched_on(machine, garage.settings, said=said.append)
    for y, slides in ((LOW, False), (300, True)):
        sender.stream([f"G0 X0 Y{y}", "G4 P0"])
        machine.advance(6500)
        sender.listen()
        # The machine watches motors that it let go, and holds the sled again.
        assert any(line.startswith("The sled slid with its motors off") for line in said) is slides
        assert sender.status.place[1] == pytest.approx(y, abs=1.5)
        assert bool(rests(["G0 Z5", f"G0 X0 Y{y}"], garage.settings)) is slides
    machine.stop()


def test_a_caution_is_not_an_error(tmp_path, capsys):
    (tmp_path / "machine.toml").write_text(machine_toml(MAKER))
    job = ["M0", f"G0 X9 Y{HIGH}", "G0 X5"]
    (tmp_path / "job.nc").write_text("\n".join(["G0 Z5", *job, ""]))
    assert main(["check", str(tmp_path / "job.nc"), str(tmp_path / "machine.toml")]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "Nothing is wrong with job.nc, but look at line 4." in said
    assert "line 4: the program ends at X5.00 Y500.00, where the sled may sink" in said
    assert "a chain pulls with 137 N, and some gears hold no more than 104 N" in said


POCKET_LINES = lines_of("fusion_pocket.nc")


def test_the_timetable_is_that_of_the_check():
    table = timetable(values_of(MAKER), POCKET_LINES, (0.0, 0.0, 0.0))
    done = run_dry(POCKET_LINES)
    assert table.whole == pytest.approx(done.seconds, abs=0.1)
    assert len(table.done_at) == len(POCKET_LINES) + 1 and table.done_at[0] == 0
    assert (np.diff(table.done_at) >= 0).all()
    last = int(done.moves["line"][20])
    ends = done.moves["ends"][done.moves["line"] == last].max()
    assert table.done_at[last] == pytest.approx(ends, abs=0.1)


@pytest.mark.parametrize("slower", [0.5, 1.0, 1.6])
def test_time_left_follows_how_the_machine_runs(slower):
    """Each line takes 2 s by the timetable; the machine takes `slower` times as long."""
    left = TimeLeft(Timetable(np.arange(0.0, 2001.0, 2.0)), ahead=1.0)
    assert left.seconds == pytest.approx(2000)
    for line in range(501):
        left.note(100 + 2 * slower * line, line, pauses=False)
    assert left.share == pytest.approx(0.5, abs=0.01)
    assert left.seconds == pytest.approx(1000 * slower, rel=0.03)


def test_pauses_do_not_count_and_the_end_is_the_end():
    left = TimeLeft(Timetable(np.arange(0.0, 201.0, 2.0)), ahead=1.0)
    for line in range(51):
        left.note(2.0 * line, line, pauses=False)
    before = left.seconds
    left.note(5000.0, 50, pauses=True)
    left.note(5000.5, 50, pauses=False)
    assert left.seconds == pytest.approx(before, abs=1.0)
    left.note(5100.0, 100, pauses=False)
    assert left.seconds < 2 and left.share > 0.99
