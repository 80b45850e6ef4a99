"""Pauses of a program, and which of its lines are surely done."""

import pytest
from line_board import SlowBoard, until
from plumb.line.sender import LATE, PAUSED, PER_SECOND, Progress, Sender, SureLines, Wait, waits_in
from plumb.line.worker import LineState, LineWorker


@pytest.mark.parametrize(
    ("program", "waits"),
    [
        ("G21\n(hang 5 kg)\nM0\nG0 X1", [Wait(1, "hang 5 kg")]),
        ("(a title)\nG21\nM0", [Wait(1, "")]),  # a comment belongs to the line that it is before
        ("G21 (first)\nM00 (now)\nM1\n; M0\n(M0)\nG0 X0", [Wait(1, "now"), Wait(2, "")]),
        ("(once)\n\n(twice)\nm0", [Wait(0, "twice")]),
        ("M10\nM0 P1\nM30\nG0 M0", []),
    ],
)
def test_pauses_are_found_with_their_instructions(program, waits):
    assert list(waits_in(program.splitlines())) == waits


def state_of(done, paused_at, *, holds=True, outcome="running"):
    waits = (Wait(3, "hang it"), Wait(7, "take it off"))
    program = Progress("more.nc", done, 9, outcome, waits=waits, paused_at=paused_at)
    return LineState("busy", holds=holds, program=program).waits_for


def test_a_program_waits_for_the_operator_only_in_a_pause():
    assert state_of(3, 3) == "hang it"
    assert state_of(7, 7) == "take it off"
    assert state_of(3, -1) == ""  # held by hand, before the pause began
    assert state_of(3, 3, holds=False) == ""
    assert state_of(5, 3) == ""  # held by hand, after the pause
    assert state_of(3, 3, outcome="stopped") == ""


LINES = ["(a job)", "G21", "", "G0 X1", "G1 X2 F100 (cut)", "; end", "G0 X3"]


class Reports:
    """A machine that only reports."""

    def __init__(self):
        self.state = "Idle"
        self.sender = Sender(self)

    def read(self):
        return f"<{self.state},MPos:0.00,0.00,0.00,WPos:0,0,0>\r\n".encode()

    def seconds(self):
        return 0.0

    def pass_on(self, seconds):
        for _ in range(round(seconds * PER_SECOND)):
            self.sender.listen()


@pytest.fixture
def machine():
    return Reports()


def test_an_answer_counts_when_its_motion_is_over(machine):
    reached = SureLines(machine.sender, LINES)
    assert reached.line == 2
    reached.note(1)
    machine.pass_on(1.0)
    reached.note(2)
    machine.pass_on(0.8 + LATE - 1.0)
    assert reached.line == 2
    machine.pass_on(0.2)
    assert reached.line == 4
    machine.pass_on(0.8)
    assert reached.line == 4
    machine.pass_on(0.2)
    assert reached.line == 5
    reached.note(4)
    assert reached.line == 5
    machine.pass_on(60)
    assert reached.line == 7, "the last line, as nothing says that it is done"


def test_after_a_stop_no_more_lines_are_done(machine):
    reached = SureLines(machine.sender, LINES)
    reached.note(2)
    machine.pass_on(0.8 + LATE)
    reached.end()
    machine.pass_on(60)
    assert reached.line == 2


def test_a_hold_makes_no_line_done(machine):
    reached = SureLines(machine.sender, LINES)
    reached.note(2)
    machine.state = PAUSED
    machine.pass_on(600)
    assert reached.line == 2


def test_a_machine_that_answers_farther_ahead_has_done_less(machine):
    machine.sender.ahead = 10.0
    reached = SureLines(machine.sender, LINES)
    reached.note(3)
    machine.pass_on(9.8 + LATE)
    assert reached.line == 2
    machine.pass_on(0.2)
    assert reached.line == 7


@pytest.fixture
def slow():
    """A slow board, and what sends to it."""
    board = SlowBoard()
    worker = LineWorker(lambda: board)
    until(lambda state: state.phase == "ready", worker)
    yield board, worker
    worker.close()


def test_each_line_is_noted_before_it_leaves_and_is_surely_done_a_while_after_its_answer(slow):
    board, worker = slow
    heard, lines = [], [f"G1 X{i}" for i in range(1, 100)]

    def came(done, begun):
        heard.append((done, begun))
        assert begun >= board.written.count(b"G1")

    worker.send("grid.nc", lines, came=came, before=7)
    until(lambda state: state.phase == "ready", worker)
    assert heard[0] == (7, 8) and heard == sorted(heard)
    done, begun = heard[-1]
    assert begun == 7 + len(lines) and begun - 20 < done < begun - 10  # 3 s, a line each 0.2 s


def test_of_a_stopped_program_only_the_line_under_way_is_perhaps_done(slow):
    board, worker = slow
    heard = []
    board.at[40] = worker.stop
    lines = [f"G1 X{i}" for i in range(1, 400)]
    worker.send("grid.nc", lines, came=lambda *lines: heard.append(lines))
    until(lambda state: state.phase == "ready", worker)
    answered = worker.state.program.done
    surely, perhaps = heard[-1]
    assert perhaps == answered + 2 < heard[-2][1]
    assert answered - 20 < surely < answered - 10
