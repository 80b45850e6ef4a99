"""plumb resume: after a halt anywhere the cut goes on as if nothing had happened."""

import re

import numpy as np
import pytest
from example_machine import INI
from plumb.bench.boards import MAKER
from plumb.job.check import check_job
from plumb.job.dry_run import GOUGES, HALTS, IN_WOOD
from plumb.job.resume import JobMachine, cycles_after, resume_at_line, resume_at_place, tools_after
from plumb.text.errors import InputError
from scipy.spatial import cKDTree
from workshop import NAMES, PROGRAMS, Workshop, lines_of, run_dry

MACHINE = JobMachine(MAKER, (0.0, 0.0, 0.0), {})
LINES = 8  # of each program that are tried
APART = 0.5  # [mm] at most between the cut after a halt and the cut without
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
    drawn = np.random.default_rng(len(lines)).permutation(len(lines))[:LINES]
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
    assert off.max() < APART
    rises = way["z_to"] > way["z_from"]
    deep = (samples.z < -0.1) & ~rises[samples.move]
    off, _ = cKDTree(cut).query(places[deep])
    assert off.max() < APART


def test_a_cycle_is_drilled_from_its_beginning():
    lines = ["G0 Z4", "G81 X9 Z-3 R1 F60", "X20", "(c)", "X30", "G80", "G0 X0"]
    begins = [resume_at_line(MACHINE, lines, line).first for line in range(1, 8)]
    assert begins == [1, 2, 2, 2, 2, 2, 7]
    in_force = cycles_after(["G82 Z-1", "G4 P1", "G1 X4", "G83 X5", "M2"])
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
    tools = tools_after(["M106 S80", "G4 S3", "M4 S100"])
    assert tools.spindle_lines == ["M4 S100"] and tools.laser_lines == ["M106 S100"]
    assert tools_after(["M106", "G1 X1"]).laser_lines == ["M106 S255"]
    assert tools_after(["M3 S5", "M106", "M30"]).spindle_lines == []
    assert tools_after(["M3"]).spindle_lines == ["M3"]
    assert tools_after(["M3 S5", "M2"]).spindle_lines == []
    assert tools_after(["M106 S80", "M107", "M3"]).spindle_lines == ["M3 S80"]


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
