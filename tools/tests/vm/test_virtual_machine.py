"""The virtual machine: motors, chains and sled under the firmware, on the host and on a Mega."""

import re

import numpy as np
import pytest
from plumb import _judge, _vm
from plumb.hidden import MAKER, Hidden
from plumb.line.memory import read_numbers, write_numbers
from plumb.line.sender import Sender
from plumb.model.predict import judged
from plumb.vm import garage as garage_room
from plumb.vm.garage import Garage, InProcessPort, VirtualMachine
from usual_machine import declaration, switched_on, usual_machine

NUMBERS = judged(MAKER)
COUNT = 63.5 / 8113.73  # [mm] of chain
# What the client sends: the model's numbers are those of the judge, and z moves at all.
SETTINGS = "$29=1300\n$7=2\n$8=139.1\n$62=97.9\n$63=0.00137293\n$160=8.2e-12\n$170=5.17e-6\n"


def said_by(machine, line: str, milliseconds: int) -> list[str]:
    """The machine's lines after a line was sent, status reports left out."""
    machine.send(line.encode() + b"\n")
    machine.advance(milliseconds)
    lines = machine.take_said().decode().splitlines()
    return [line for line in lines if not line.startswith(("<", "[PE"))]


def started(*, lines: str = SETTINGS, **options) -> _vm.VirtualMachine:
    """A machine that knows its settings and its chains."""
    machine = _vm.VirtualMachine(NUMBERS, **options)
    machine.start()
    machine.advance(3000)
    assert "ready" in machine.take_said().decode()
    assert said_by(machine, lines.strip(), 3000) == ["ok"] * lines.count("\n")
    assert "ok" in said_by(machine, "B06 L1651 R1651", 1000)
    return machine


@pytest.fixture
def machine():
    return started()


def test_the_sled_is_where_the_judge_says(machine):
    said_by(machine, "G0 X300 Y-200", 40_000)
    chains = np.array([machine.chains])
    rest = _judge.places(NUMBERS, chains, pushes=0 * chains, weights=np.array([97.9]))
    assert machine.sled == pytest.approx(tuple(rest[0]), abs=1e-6)
    assert machine.sled == pytest.approx((300, -200), abs=0.05)


def test_chains_off_the_bottom_bring_the_sled_where_the_judge_says():
    machine = started(over_top=False, lines=SETTINGS + "$38=2\n")
    for x, y in ((300, -200), (-700, 350)):
        said_by(machine, f"G0 X{x} Y{y}", 90_000)
        chains = np.array([machine.chains])
        weights = np.array([97.9])
        rest = _judge.places(NUMBERS, chains, pushes=0 * chains, weights=weights, over_top=False)
        assert machine.sled == pytest.approx(tuple(rest[0]), abs=1e-6)
        assert machine.sled == pytest.approx((x, y), abs=0.05)
        over = _judge.places(NUMBERS, chains, pushes=0 * chains, weights=weights)
        assert np.hypot(*(over - rest)[0]) > 20
    # A chain off the bottom is paid out as the count falls.
    count, paid = machine.count("left"), machine.chains[0]
    said_by(machine, "G0 X-600", 30_000)
    turned = (machine.count("left") - count) * COUNT
    assert turned == pytest.approx(paid - machine.chains[0], abs=2 * COUNT)
    assert machine.chains[0] - paid > 50


@pytest.mark.parametrize(("over_top", "feed"), [(True, 2), (False, 1)])
def test_a_feed_that_the_settings_have_wrong_winds_in_what_should_be_paid_out(over_top, feed):
    """Motor and encoder are both taken the wrong way, so the machine itself cannot notice."""
    machine = started(over_top=over_top, lines=f"{SETTINGS}$38={feed}\n")
    left, _ = machine.chains
    said_by(machine, "G0 X100", 20_000)
    assert machine.chains[0] < left - 20


def test_friction_leaves_the_sled_behind_on_the_side_it_came_from():
    places = []
    for first in (-100, 300):
        machine = started(friction=8.0)
        said_by(machine, f"G0 X{first}", 30_000)
        said_by(machine, "G0 X100", 30_000)
        places.append(machine.sled[0])
    assert 0.02 < places[1] - places[0] < 1
    free = started()
    said_by(free, "G0 X100", 30_000)
    assert places[0] < free.sled[0] < places[1]


def test_a_sled_of_twenty_kilograms_travels_without_an_alarm():
    machine = started(lines=SETTINGS.replace("$62=97.9", "$62=196.1"))
    machine.set("sled_weight", 196.1)
    for place in ((-370, -290), (1100, -290), (-1100, -540), (0, -40)):
        machine.send(b"G0 X%d Y%d\n" % place)
        since = machine.seconds
        while machine.sled != pytest.approx(place, abs=5):
            machine.advance(200)
            assert machine.seconds - since < 240
        assert "ALARM" not in machine.take_said().decode()


def test_impossible_values_are_refused():
    with pytest.raises(ValueError, match="no number color"):
        _vm.VirtualMachine({"color": 1.0})
    with pytest.raises(ValueError, match="no sled can hang"):
        _vm.VirtualMachine(NUMBERS, paid_out=100.0)
    with pytest.raises(RuntimeError, match=r"cannot read absent\.elf|no simulated Mega here"):
        _vm.VirtualMachine(NUMBERS, elf="absent.elf")
    machine = _vm.VirtualMachine(NUMBERS)
    with pytest.raises(ValueError, match="left, right or z"):
        machine.count("x")
    with pytest.raises(ValueError, match="no wire has the fault rust"):
        machine.set_wire("z", "rust", True)
    with pytest.raises(ValueError, match="4096"):
        machine.eeprom = b""


def test_what_the_simulated_mega_cannot_run_is_refused(run, monkeypatch):
    monkeypatch.setattr(garage_room, "VirtualMachine", without_simavr)
    code, _, said = run("vm", "--mega", "firmware.elf")
    assert code == 2
    assert said.splitlines()[-1] == "plumb: the lab was built without the simulated Mega"


def without_simavr(*_, **__):
    raise RuntimeError("the lab was built without the simulated Mega")


MOVES = ("G0 X20 Y10", "G1 X16 Y6 Z1 F600")
# [counts] Between two rests. The loop lets a chain rest within 1.5 counts of its set-point, and
# the host's program itself differs by as much if a line comes to it a millisecond later.
WITHIN = 2


def rests(elf: str | None) -> list[list[int]]:
    """The counts of all axes after each move."""
    garage = Garage(Hidden(), friction=0.0)
    machine = garage.machine(elf=elf)
    sender = switched_on(machine, garage.settings)
    counts = []
    for move in MOVES:
        sender.stream([move, "G4 P1"])
        sender.await_rest()
        counts.append([machine.count(axis) for axis in ("left", "right", "z")])
    return counts


def test_both_rest_at_the_same_counts(elf):
    flashed, host = rests(elf), rests(None)
    for move, mega, computer in zip(MOVES, flashed, host, strict=True):
        apart = [abs(a - b) for a, b in zip(mega, computer, strict=True)]
        assert max(apart) <= WITHIN, f"{move}: {mega} and {computer}"
    assert max(map(abs, host[0])) > 1000


# [steps of 255] Most by which a motor's drive changes from tick to tick at an even speed. An edge
# that comes early or late moves it by 15.
EVEN = 21


def test_no_tick_of_the_simulated_mega_loses_time(elf):
    garage = Garage(Hidden(), friction=0.0)
    machine = garage.machine(elf=elf)
    switched_on(machine, garage.settings).stream(["G0 X-300 Y0", "G4 P1"])
    machine.send(b"G1 X300 Y0 F800\n")
    machine.advance(5000)
    drives = []
    for _ in range(3500):
        machine.advance(10)
        drives.append([machine.duty("left"), machine.duty("right")])
    changes = abs(np.diff(drives, axis=0))
    assert changes.max() <= EVEN
    assert min(np.ptp(drives, axis=0)) > 10  # it went all the time


def test_numbers_that_are_said_to_be_held_outlive_a_reset():
    """Whoever opens the line next resets the board, and a new board stores for three seconds."""
    machine = _vm.VirtualMachine(NUMBERS)
    machine.start()
    sender = Sender(InProcessPort(machine))
    sender.await_start()
    write_numbers(sender, ["$62=101"])
    machine.stop()
    machine.start()
    again = Sender(InProcessPort(machine))
    again.await_start()
    assert read_numbers(again)[62] == 101


STAYS = "The motors stay on: so high on the sheet the sled would slide ($77). Park it lower."
SLIDES = "The sled slid with its motors off: they hold it until after its next move."
MOST = 1.5  # [mm] the chain gives 0.4 mm, and some more until its motor holds
CREEP = 0.5  # [mm] at most, of what was let go
HELD = 0.05  # [mm] at most, of what has power
USUAL = "$77=1.4"  # [N m]
TRUSTED = "$77=10"  # [N m] the machine believes that its gears hold any sled


@pytest.mark.parametrize(
    ("brain", "height", "setting", "warned", "most"),
    [
        ("host", 605.0, USUAL, STAYS, HELD),
        ("host", 450.0, USUAL, "", CREEP),
        ("host", 605.0, TRUSTED, SLIDES, MOST),
        pytest.param("mega", 605.0, TRUSTED, SLIDES, MOST, marks=pytest.mark.slow),
    ],
)
def test_a_sled_stays_where_it_was(brain, height, setting, warned, most, elf):
    machine = usual_machine(elf=elf if brain == "mega" else None)
    said: list[str] = []
    sender = switched_on(machine, MAKER, said=said.append)
    sender.stream([setting, declaration(machine), f"G0 X0 Y{height}", "G4 P0"])
    lowest = farthest_in(30, machine)
    sender.stream(["G1 X200 F600", "G4 P0"])
    x, y = machine.sled
    assert lowest < most
    assert (x, y) == pytest.approx((200, height), abs=CREEP)
    farthest_in(10, machine)
    sender.stream(["G1 X150", "G4 P0"])
    heard = [line for line in said if line in (STAYS, SLIDES)]
    # That they stay on is said once; each time that it slides is news.
    assert heard == ([STAYS] if warned == STAYS else [SLIDES] * len(heard))
    assert bool(heard) == bool(warned)
    assert (lowest > CREEP) == (warned == SLIDES)


def farthest_in(seconds: int, machine: VirtualMachine) -> float:
    """How far the sled goes [mm] from where it stands."""
    stood, farthest = machine.sled, 0.0
    for _ in range(10 * seconds):
        machine.advance(100)
        farthest = max(farthest, float(np.hypot(*np.subtract(machine.sled, stood))))
    return farthest


MOST_BEYOND = 3.0  # [mm] of a chain, beyond what a power cut lets it run
ALARM = b"ALARM: The sled is not keeping up"


def farthest_run(elf: str | None, shield: int, *, is_cut: bool) -> float:
    """How far the left chain runs [mm] until it stands: after its encoder is lost on the way, or
    after a power cut.
    """
    machine = usual_machine(elf=elf, seed=3, shield=shield)
    sender = switched_on(machine, MAKER)
    # To and fro: the machine learns which duty the motors need either way.
    ways = [f"G1 X{x} F800" for x in (-140, -60, -100)]
    sender.stream([declaration(machine), *ways, "G4 P0"])
    machine.send(b"G1 X200 F200\n")
    machine.advance(2000)
    begin = farthest = machine.chains[0]
    if is_cut:
        machine.cut_power()
    else:
        machine.set_wire("left", "encoder_unplugged", True)
    said = b""
    for _ in range(400):
        machine.advance(20)
        said += machine.take_said()
        farthest = max(farthest, machine.chains[0], key=lambda length: abs(length - begin))
    assert (ALARM in said) != is_cut
    machine.advance(500)
    assert machine.chains[0] == pytest.approx(farthest, abs=0.01), "it has to stand"
    return abs(farthest - begin)


@pytest.mark.parametrize("shield", [2, 3])
def test_the_flashed_program_brakes_a_chain_without_encoder_on_either_driver(elf, shield):
    ran = farthest_run(elf, shield, is_cut=False)
    assert 0.3 < ran < farthest_run(None, shield, is_cut=True) + MOST_BEYOND


LOOSE = {**judged(MAKER), "left.inward": 0.004, "right.inward": 0.006}
GAP, BEYOND = LOOSE["motor_gap"], 12.7  # [mm]
SAID = re.compile(r"Motor gap ([\d.]+) mm .* spread ([\d.]+) mm, (\d) pulls? with about (\d+) N\.")
DEAD = "The left motor hardly turns: check its supply, its cables and its encoder."
SLACK = "The chain is not tight yet: hook it on the other sprocket, send B11 again."


class Pulled:
    """A machine, its left chain hooked across, after a B11: what was said and what truly pulled."""

    def __init__(self, line: str, *, slack: float = 5.0, volts: float = 12.0, **options) -> None:
        self.machine = _vm.VirtualMachine(options.pop("numbers", LOOSE), **options)
        self.machine.hook_across("left", slack, BEYOND)
        self.machine.set_motor_supply(volts)
        self.machine.start()
        self.machine.advance(3000)
        left, right = self.machine.chains
        self.machine.send(f"B06 L{left:.3f} R{right:.3f}\n".encode())
        self.machine.advance(1000)
        self.machine.take_said()
        self.machine.send(line.encode() + b"\n")
        self.lines: list[str] = []
        self.most_pull = self.seconds = 0.0

    def go_on(self, seconds: float) -> None:
        """Until the line is answered, or so long."""
        for _ in range(int(seconds * 100)):
            self.machine.advance(10)
            self.seconds += 0.01
            self.most_pull = max(self.most_pull, self.machine.across)
            heard = self.machine.take_said().decode().splitlines()
            self.lines += [each for each in heard if not each.startswith(("<", "[PE"))]
            if "ok" in self.lines:
                return

    def answered(self) -> list[str]:
        self.go_on(30)
        return self.lines[1:]


def numbers_of(lines: list[str]) -> tuple[float, float, int, int]:
    """Gap, spread, pulls and force of the line of B11."""
    match = SAID.match(lines[0])
    assert match and lines[1:] == ["ok"], lines
    gap, spread, pulls, force = match.groups()
    return float(gap), float(spread), int(pulls), int(force)


@pytest.mark.parametrize("volts", [13.0, 9.0])
def test_three_pulls_with_the_stated_force_whatever_the_supply(volts):
    pulled = Pulled("B11 S255 T15 L", volts=volts)
    gap, spread, pulls, force = numbers_of(pulled.answered())
    assert pulls == 3
    assert spread < 0.15
    assert force == pytest.approx(80, abs=3)
    assert pulled.machine.across == pytest.approx(force, rel=0.1)
    assert pulled.most_pull < 100
    assert gap == pytest.approx(pulled.machine.chains[0] - BEYOND, abs=spread + 0.02)


@pytest.mark.parametrize("seed", range(1, 5))
def test_motors_that_are_off_by_30_percent_pull_as_hard_as_stated(seed):
    pulled = Pulled("B11 S255 T15 L", seed=seed)
    _, spread, pulls, _ = numbers_of(pulled.answered())
    assert (pulls, spread < 0.5) == (3, True)
    assert 60 <= pulled.most_pull <= 106


def test_the_machine_stays_below_the_pull_of_a_sled_when_the_chain_is_tight_before():
    pulled = Pulled("B11 S255 T3 L", slack=-1.0)
    _, _, pulls, _ = numbers_of(pulled.answered())
    assert pulls >= 1
    assert pulled.most_pull < 145


@pytest.mark.parametrize("slack", [9.0, 40.0])
def test_it_never_takes_longer_than_the_seconds_of_its_line(slack):
    pulled = Pulled("B11 S255 T3 L", slack=slack)
    lines = pulled.answered()
    assert pulled.seconds < 3.3  # the line itself takes its time to come and to go
    assert (lines == [SLACK, "ok"]) == (slack > 20)


@pytest.mark.parametrize(
    ("wire", "at"), [("encoder_unplugged", 1.5), ("motor_unplugged", 3.0), ("channel_lost", 4.5)]
)
def test_a_lost_wire_stops_it(wire, at):
    pulled = Pulled("B11 S255 T15 L")
    pulled.go_on(at)
    pulled.machine.set_wire("left", wire, True)
    assert pulled.answered()[-2:] == [DEAD, "ok"]
    assert pulled.machine.duty("left") == 0
    assert pulled.most_pull < 110


@pytest.mark.parametrize("at", [2.5, 4.4])
def test_a_chain_that_comes_off_in_a_pull_is_wound_in_until_the_time_is_over(at):
    pulled = Pulled("B11 S255 T6 L")
    pulled.go_on(at)
    pulled.machine.hook_across("left", 200.0, BEYOND)
    lines = pulled.answered()
    assert lines[-1] == "ok" and 5 < pulled.seconds < 6.3
    assert pulled.machine.duty("left") == 0


@pytest.mark.parametrize(("volts", "at"), [(11.0, 1.2), (9.0, 4.0)])
def test_a_supply_that_sags_in_the_middle_stops_it(volts, at):
    pulled = Pulled("B11 S255 T15 L")
    pulled.go_on(at)
    pulled.machine.set_motor_supply(volts)
    assert pulled.answered() == [DEAD, "ok"]


def test_pulls_that_differ_are_reported():
    pulled = Pulled("B11 S255 T15 L")
    while pulled.machine.across < 75:
        pulled.go_on(0.02)
    pulled.machine.set("left.inward", 0.03)  # the bracket comes loose
    lines = pulled.answered()
    assert lines[1] == "The pulls differ: look after chain, hook and supply, send B11 again."
    assert numbers_of([lines[0], "ok"])[1] > 0.5


def test_the_flashed_program_pulls_as_the_host_does(elf):
    host, mega = (Pulled("B11 S255 T6 L", elf=each) for each in (None, elf))
    ours, theirs = (numbers_of(each.answered()) for each in (host, mega))
    np.testing.assert_allclose(theirs[0], ours[0], atol=0.15)
    assert theirs[2] == ours[2]
    assert mega.most_pull == pytest.approx(host.most_pull, rel=0.1)
