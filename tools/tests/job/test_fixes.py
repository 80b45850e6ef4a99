"""`plumb check --fix`: an equal program that this machine runs, and the wood that is cut stays."""

import re

import numpy as np
import pytest
from plumb.bench.boards import MAKER
from plumb.cli.main import main
from plumb.job.check import check_job
from plumb.job.fixes import fixed
from plumb.job.resume import JobMachine
from plumb.job.wood import Tools
from plumb.settings.machine import write_machine_toml
from plumb.text.errors import InputError
from workshop import NAMES, lines_of, run_dry

MACHINE = JobMachine(MAKER, (0.0, 0.0, 0.0), {})
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
    np.testing.assert_array_equal(these.piece.heights, those.piece.heights)
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
    assert len((here / "out.nc").read_text().splitlines()) == len(FUSION)
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


FREE = "G0 Z{up}"
HOLE = "G17 G98 G81 X{x:.4f} Y{y:.4f} Z-{deep} R{up} F{feed}"
# Foreign lines, and what each says to this machine. All end with the bit free, in G0.
HABITS = {
    "G53": ([FREE, "G53 G0 Z-{up}"], [FREE, FREE]),
    "G28": ([FREE, "G28 G91 Z0", "G90"], [FREE, FREE, "G90"]),
    "G80": (
        [FREE, HOLE, "G80", "X{beside:.4f}", "X{x:.4f}"],
        [FREE, HOLE, "G80", "G0 X{beside:.4f}", "X{x:.4f}"],
    ),
}
MILLIMETRES = {"up": 9, "deep": 2, "feed": 200}
INCHES = {"up": 0.36, "deep": 0.08, "feed": 8}
CODED = re.compile(r"(?:N\d+ *)?G0?[01](?!\d)", re.IGNORECASE)


def with_lines_put_in(lines, put_in):
    """The program with some lines put in wherever the bit is free and the next line, with a code of
    its own, moves freely or straight down; and at how many places.
    """
    moves = run_dry(lines).moves
    in_inches = any("G20" in line for line in lines)
    numbers, unit = (INCHES, 25.4) if in_inches else (MILLIMETRES, 1.0)
    result, count = [], 0
    for number, line in enumerate(lines, start=1):
        before, here = moves.only(moves["line"] < number), moves.only(moves["line"] == number)
        slanting = here.cut & (here["length"] > 0)
        if len(before) and before["z_to"][-1] > 0 and CODED.match(line) and not slanting.any():
            place = {axis: before[f"to_{axis}"][-1] / unit for axis in "xy"}
            x_beside = place["x"] + 1
            result += [each.format(**numbers, **place, beside=x_beside) for each in put_in]
            count += 1
        result.append(line)
    return result, count


def piece_of(lines):
    """The wood that the dry run cuts, and the deepest cut [mm]."""
    checked = check_job(MAKER, lines, tools=Tools.of(lines))
    assert checked.done.halted_at is None
    return checked.piece


@pytest.mark.parametrize("habit", HABITS)
@pytest.mark.parametrize("name", NAMES)
def test_a_fixed_program_cuts_the_same_wood(name, habit):
    foreign, plain = HABITS[habit]
    lines = lines_of(name)
    spoilt, count = with_lines_put_in(lines, foreign)
    meant, _ = with_lines_put_in(lines, plain)
    findings = check_job(MAKER, spoilt, tools=Tools.of(spoilt)).findings
    mended = fixed(JobMachine(MAKER, (0.0, 0.0, 0.0), {}), spoilt, findings, source=name)
    assert count and len(mended.changes) == count
    after, wanted = piece_of(mended.lines), piece_of(meant)
    np.testing.assert_allclose(after.heights, wanted.heights, atol=1e-6)
    assert after.removed == pytest.approx(wanted.removed) and after.removed > 0
    if habit != "G80":
        assert after.removed == pytest.approx(piece_of(lines).removed)
