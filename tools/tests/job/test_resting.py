"""plumb check names the places where the sled may sink when its motors let go."""

import numpy as np
import pytest
from plumb.bench.boards import MAKER
from plumb.cli.main import main
from plumb.firmware.settings import values_of
from plumb.job.check import check_job
from plumb.job.dry_run import SINKS, TimeLeft, Timetable, timetable
from plumb.settings.machine import machine_toml
from plumb.vm.garage import hide, random_garage
from usual_machine import switched_on
from workshop import lines_of, run_dry

WEAK = 2  # the seed of a machine whose gears hold little
LOW, HIGH = 200, 500  # [mm] y of rests that hold, and that may not


def rests(lines, settings=MAKER):
    """Lines at which the sled may sink."""
    checked = check_job(settings, lines)
    assert checked.is_good
    return [each.line for each in checked.findings if each.kind == SINKS]


@pytest.mark.parametrize(("y", "lines"), [(LOW, []), (HIGH, [3])])
def test_the_end_of_a_program_is_checked(y, lines):
    assert rests(["G21", "G0 Z5", f"G0 X0 Y{y}"]) == lines
    assert rests(["G0 Z5", f"G0 X0 Y{y}", "G0 Y0"]) == []


def test_a_caution_is_not_an_error(tmp_path, capsys):
    (tmp_path / "machine.toml").write_text(machine_toml(MAKER))
    job = ["M0", f"G0 X9 Y{HIGH}", "G0 X5"]
    (tmp_path / "job.nc").write_text("\n".join(["G0 Z5", *job, ""]))
    assert main(["check", str(tmp_path / "job.nc"), str(tmp_path / "machine.toml")]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "Nothing is wrong with job.nc, but look at line 4." in said
    assert "line 4: the program ends at X5.00 Y500.00, where the sled may sink" in said
    assert "a chain pulls with 137 N, and some gears hold no more than 104 N" in said


def test_a_machine_with_weak_gears_slides_only_where_the_check_says_so():
    garage = random_garage(hide([], millimetres=3, seed=WEAK), WEAK, feed="top")
    machine = garage.machine(elf=None)
    said: list[str] = []
    sender = switched_on(machine, garage.settings, said=said.append)
    slid = {}
    for y in (LOW, 300):
        sender.stream([f"G0 X0 Y{y}", "G4 P0"])
        machine.advance(500)
        sender.listen()
        machine.advance(6000)
        sender.listen()
        # The machine watches motors that it let go, and holds the sled again.
        slid[y] = any(line.startswith("The sled slid with its motors off") for line in said)
        assert sender.status.place[1] == pytest.approx(y, abs=1.5)
        assert slid[y] == bool(rests(["G0 Z5", f"G0 X0 Y{y}"], garage.settings))
    # In a pause the motors keep their power.
    machine.send(b"G0 X0 Y300\nM0\n")
    machine.advance(5000)
    sender.listen()
    before = sender.status.place[1]
    machine.advance(20_000)
    sender.listen()
    assert sender.status.state == "Pause" and before == pytest.approx(300, abs=0.1)
    assert sender.status.place[1] == pytest.approx(before, abs=0.1)
    machine.stop()
    assert slid == {LOW: False, 300: True}


LINES = lines_of("fusion_pocket.nc")


def test_the_timetable_is_that_of_the_check():
    table = timetable(values_of(MAKER), LINES, (0.0, 0.0, 0.0))
    done = run_dry(LINES)
    assert table.whole == pytest.approx(done.seconds, abs=0.1)
    assert len(table.done_at) == len(LINES) + 1 and table.done_at[0] == 0
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
