"""Features of Grbl senders, tried with each sender and each brain: one test per feature."""

import math
import re
from itertools import pairwise

import pytest
from grbl_board import STANDS, until

pytestmark = pytest.mark.slow

AT_PLACE = 0.15  # [mm] between what a sender shows at rest and where the judge sees the sled
RADIUS, MIDDLE, FEED = 40.0, (55.0, 150.0), 1000.0  # [mm, mm, mm/min] of the program's circle
TURNS, CHORD = 2.0, 0.5  # [mm] of a line
LEAST_AHEAD = 15_000  # characters
BUFFER = 128  # characters of the machine


def circle() -> list[str]:
    """Short lines of 15 characters: eight of them fill a buffer of 128 to the last place."""
    count = round(TURNS * 2 * math.pi * RADIUS / CHORD)
    x, y = MIDDLE
    lines = ["G21", "G90", f"G0X{x + RADIUS:05.2f}Y{y:06.2f}", f"G1F{FEED:g}"]
    for step in range(1, count + 1):
        angle = 2 * math.pi * TURNS * step / count
        place = x + RADIUS * math.cos(angle), y + RADIUS * math.sin(angle)
        lines.append(f"G1X{place[0]:05.2f}Y{place[1]:06.2f}")
    return lines


def await_state(sender, *states: str) -> None:
    until(lambda: sender.shown().state in states, f"{sender.name} shows {states}")


def await_place(sender, board) -> None:
    """Wait until the sender shows the place where the sled stands."""
    x, y = board.rest()

    def is_there() -> bool:
        shown = sender.shown().place
        return abs(shown[0] - x) < AT_PLACE and abs(shown[1] - y) < AT_PLACE

    until(is_there, f"{sender.name} shows {x:.2f}, {y:.2f}, it shows {sender.shown()}")


def complaints(sender) -> list[str]:
    """The errors that its user would see."""
    wrong = ("error", "ALARM", "UGS:")
    return [line for line in sender.heard() if line.startswith(wrong)]


def test_connect(connected, board):
    await_state(connected, "Idle")
    await_place(connected, board)
    assert complaints(connected) == []


def test_status(connected, board):
    connected.say("G1 X60 F800")
    await_state(connected, "Run")
    seen = set()
    until(lambda: seen.add(connected.shown().place[0]) or len(seen) > 4, "places on the way")
    assert connected.shown().feed == pytest.approx(800, abs=40)
    await_state(connected, "Idle")
    await_place(connected, board)
    assert board.sled == pytest.approx((60, 0), abs=AT_PLACE)
    assert connected.shown().work == pytest.approx((60, 0, 0), abs=0.02)


def test_jog(connected, board):
    connected.jog("X20", 800)
    await_state(connected, "Jog")
    await_state(connected, "Idle")
    await_place(connected, board)
    assert board.sled == pytest.approx((20, 0), abs=AT_PLACE)
    connected.jog("Y-10", 800)
    until(lambda: board.sled[1] < -9.8, "a second jog")
    assert complaints(connected) == []


def test_cancel_a_jog(connected, board):
    connected.jog("X400", 800)
    await_state(connected, "Jog")
    until(lambda: board.sled[0] > 15, "the sled is on its way")
    connected.cancel_jog()
    await_state(connected, "Idle")
    await_place(connected, board)
    assert 15 < board.sled[0] < 200
    connected.say("G90 G1 X10 F800")
    until(lambda: abs(board.sled[0] - 10) < AT_PLACE, "the machine goes on after the jog")
    assert complaints(connected) == []


def test_a_program_to_its_end(connected, board):
    lines = circle()
    assert sum(len(line) + 1 for line in lines) >= LEAST_AHEAD
    start = MIDDLE[0] + RADIUS, MIDDLE[1]
    connected.run(lines)
    until(lambda: abs(math.dist(board.sled, MIDDLE) - RADIUS) < 1, "the sled on the circle")
    board.wait(1)
    began, way = board.seconds, TURNS * 2 * math.pi * RADIUS
    until(connected.ended, f"{connected.name} takes the program for done")
    ended = board.seconds
    await_state(connected, "Idle")
    assert board.rest() == pytest.approx(start, abs=AT_PLACE)
    await_place(connected, board)
    # On a busy computer a sender is late, and the machine has nothing to do. Stops at each line
    # double the rest.
    course = [each for each in board.tap.ahead() if began < each[0] < ended]
    idle = sum(later - at for (at, ahead), (later, _) in pairwise(course) if not ahead)
    took = ended - began - idle
    assert max(ahead for _, ahead in course) > BUFFER / 2
    assert took < 1.3 * 60 * way / FEED + 2, f"{took:.1f} s for {way:.0f} mm"
    assert complaints(connected) == []


def test_hold_and_go_on(connected, board):
    connected.run(["G21 G90", "G1 X60 F800", "G1 X100 F800", "G1 X100 Y20 F800", "G1 X90 F800"])
    until(lambda: board.sled[0] > 15, "the sled is on its way")
    connected.hold()
    await_state(connected, "Hold")
    board.rest()
    assert board.moved(3) < STANDS and 15 < board.sled[0] < 60
    await_place(connected, board)
    connected.go_on()
    until(connected.ended, "the program is done")
    assert board.rest() == pytest.approx((90, 20), abs=AT_PLACE)
    assert complaints(connected) == []


def test_stop(connected, board):
    connected.run(["G21 G90", "G1 X300 F800", "G1 X300 Y200 F800", "G1 X0"])
    until(lambda: board.sled[0] > 15, "the sled is on its way")
    await_state(connected, "Run")
    connected.stop()
    await_state(connected, "Idle")
    assert board.rest()[0] < 150
    await_place(connected, board)
    connected.say("G90 G1 X10 F800")
    until(lambda: abs(board.sled[0] - 10) < AT_PLACE, "the machine goes on after Stop")
    assert complaints(connected) == []


def test_overrides(connected, board):
    connected.run(["G21 G90", "G1 X500 F600"])
    until(lambda: connected.shown().feed == pytest.approx(600, abs=30), "600 mm/min")
    connected.change("feed", 110)
    until(lambda: connected.shown().overrides[0] == 110, f"110 %: {connected.shown()}")
    until(lambda: connected.shown().feed == pytest.approx(660, abs=30), "660 mm/min")
    connected.change("feed", 100)
    connected.change("rapids", 50)
    connected.change("spindle", 110)
    until(lambda: connected.shown().overrides == (100, 50, 110), f"all: {connected.shown()}")
    connected.stop()
    await_state(connected, "Idle")
    assert complaints(connected) == []


def test_a_wrong_line(connected, board):
    # An arc that does not end on its circle; bCNC mends a number that is none.
    wrong = ["G21 G90", "G1 X20 F800", "G2 X60 Y60 I1 J0", "G1 X30"]
    connected.run([*wrong, *(f"G1 X{x}" for x in range(40, 500, 10))])
    until(lambda: complaints(connected), f"{connected.name} shows what is wrong")
    assert re.match(r"(error|ALARM):\d", complaints(connected)[0]), complaints(connected)
    assert any("MSG:" in line for line in connected.heard())
    connected.stop()
    board.rest()
    if connected.shown().state == "Alarm":
        connected.unlock()
    await_state(connected, "Idle")
    await_place(connected, board)
    connected.say("G90 G1 X10 F800")
    until(lambda: abs(board.sled[0] - 10) < AT_PLACE, "the machine goes on after the mistake")


def test_alarm_and_unlock(connected, board):
    connected.say("G0 X99999")
    await_state(connected, "Alarm")
    until(lambda: any("ALARM:" in line for line in connected.heard()), "the alarm is shown")
    connected.say("G1 X5 F800")
    assert board.moved(2) < STANDS
    connected.unlock()
    await_state(connected, "Idle")
    connected.say("G1 X10 F800")
    until(lambda: abs(board.sled[0] - 10) < AT_PLACE, "the machine goes on after the alarm")
    await_place(connected, board)


def test_reconnect_while_it_moves(connected, board):
    connected.say("G1 X300 F800")
    until(lambda: board.sled[0] > 15, "the sled is on its way")
    connected.disconnect()
    connected.connect(board.port)
    board.rest()
    await_state(connected, "Idle", "Alarm")
    if connected.shown().state == "Idle":
        # A sender that stops the machine before it closes the line.
        await_place(connected, board)
        return
    # The others reset the board in the move: the place is lost, and no move may start from there.
    until(lambda: any("Position Lost" in line for line in connected.heard()), "it says why")
    connected.say("G1 X10 F800")
    assert board.moved(2) < STANDS
