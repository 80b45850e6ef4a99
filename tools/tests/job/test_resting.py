"""plumb check names the places where the sled may sink when its motors let go."""

import pytest
from plumb.bench.causes import MAKER
from plumb.cli.main import main
from plumb.job.check import check_job
from plumb.job.findings import SINKS
from plumb.settings.toml import machine_toml
from plumb.vm.garage import hide, random_garage
from usual_machine import switched_on

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
    assert "Nothing is wrong with job.nc." in said
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
