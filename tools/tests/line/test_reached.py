"""Tests of the lines that are surely done: answered long enough ago, on a machine that works."""

import pytest
from line_board import SlowBoard, until
from plumb.line.reached import LATE, SureLines
from plumb.line.sender import PAUSED, PER_SECOND, Sender
from plumb.line.worker import LineWorker

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
    worker.send(
        "grid.nc", [f"G1 X{i}" for i in range(1, 400)], came=lambda *lines: heard.append(lines)
    )
    until(lambda state: state.phase == "ready", worker)
    answered = worker.state.program.done
    surely, perhaps = heard[-1]
    assert perhaps == answered + 2 < heard[-2][1]
    assert answered - 20 < surely < answered - 10
