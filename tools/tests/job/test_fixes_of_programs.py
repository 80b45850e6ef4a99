"""`plumb check --fix` of real programs: with foreign lines put in, the wood that is cut stays."""

import re

import numpy as np
import pytest
from plumb.bench.causes import MAKER
from plumb.job.bits import Tools
from plumb.job.check import check_job
from plumb.job.fixes import fixed
from plumb.job.resume import JobMachine
from workshop import NAMES, lines_of, run_dry

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
