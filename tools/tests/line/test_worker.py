"""The thread that owns a line: programs, pauses, hold, stop, what is surely done, a lost line."""

from threading import Event

import pytest
from line_board import SlowBoard, until
from plumb.line.sender import (
    GO_ON,
    LATE,
    PAUSED,
    PER_SECOND,
    STOP,
    Progress,
    Sender,
    StoppedError,
    SureLines,
    Wait,
    waits_in,
)
from plumb.line.worker import LineState, LineWorker
from plumb.text.errors import InputError


@pytest.fixture
def board():
    return SlowBoard()


@pytest.fixture
def worker(board):
    working = LineWorker(lambda: board)
    until(lambda state: state.phase == "ready", working)
    yield working
    working.close()


def look_on(worker, board, seconds=10):
    """Let the board's time pass."""
    end = board.time + seconds
    until(lambda state: board.time > end, worker)


JOB = [f"G1 X{i} Y{i * i} F1000" for i in range(1, 400)]


def test_a_program_is_sent_and_counted_and_then_something_is_done(worker, board):
    then = []
    worker.send("grid.nc", ["(a comment)", *JOB[:20]], lambda sender: then.append(sender.status))
    with pytest.raises(InputError, match="busy"):
        worker.send("other.nc", ["G1 X1"])
    until(lambda state: state.phase == "ready", worker)
    program = worker.state.program
    assert (program.title, program.done, program.total) == ("grid.nc", 20, 20)
    assert program.outcome == "done"
    assert then[0].place[0] == board.x == 20
    assert b"other" not in board.written and not worker.state.moves


def test_the_line_of_a_holding_machine_is_released_at_once(worker, board):
    worker.hold()
    until(lambda state: state.holds, worker)
    board.seconds = lambda: 0.0  # so that a wait would have no end
    worker.close()
    assert board.is_closed


def test_stop_gives_the_program_up_even_in_a_hold(worker, board):
    board.at[20] = worker.hold
    worker.send("grid.nc", JOB)
    until(lambda state: state.holds, worker)
    worker.stop()
    until(lambda state: state.phase == "ready", worker)
    assert worker.state.program.outcome == "stopped"
    assert 0 < worker.state.program.done < len(JOB)
    assert board.written.endswith(STOP)
    assert worker.state.knows_place
    worker.send("again", ["G1 X1"])
    until(lambda state: state.phase == "ready" and state.program.outcome == "done", worker)


def test_after_a_stop_in_a_hold_the_line_is_free_at_once(worker, board):
    holds = []
    board.at[20] = worker.hold
    future = worker.do(lambda sender: sender.stream(JOB))
    future.add_done_callback(lambda _: holds.append(worker.state.holds))
    until(lambda state: state.holds, worker)
    worker.stop()
    with pytest.raises(StoppedError):
        future.result(10)
    until(lambda _: holds, worker)
    assert holds == [False]


@pytest.mark.parametrize("is_at_work", [True, False])
def test_after_go_on_and_stop_together_the_next_program_comes_to_its_end(worker, board, is_at_work):
    if is_at_work:
        board.at[20] = worker.hold
        worker.send("grid.nc", JOB)
        until(lambda state: state.holds and not state.moves, worker)
    board.at[board.x] = lambda: (worker.stop(), worker.go_on())
    until(lambda state: STOP in board.written, worker)
    until(lambda state: state.phase == "ready" and not board.waiting, worker)
    look_on(worker, board)
    assert not is_at_work or GO_ON not in board.written
    worker.send("again", JOB[:50])
    until(lambda state: state.program.outcome == "done", worker)
    assert worker.state.program.done == 50


def test_stop_is_passed_on_when_nothing_is_sent(worker, board):
    worker.stop()
    until(lambda state: board.written.endswith(STOP), worker)
    assert worker.state.phase == "ready"


def test_a_machine_that_holds_takes_no_work_because_no_line_would_be_answered(worker, board):
    worker.hold()
    until(lambda state: state.holds, worker)
    for begin in (lambda: worker.do(lambda sender: sender.ask("B10 L")), lambda: send(worker)):
        with pytest.raises(InputError, match="the machine holds: press Go on, or Stop"):
            begin()
    assert worker.state.phase == "ready" and b"B10" not in board.written
    worker.go_on()
    until(lambda state: not state.holds, worker)
    assert worker.do(lambda sender: sender.ask("B05")).result(10) == []


class LateBoard(SlowBoard):
    """A board whose next report still says what was before a hold."""

    late = 0

    def read(self):
        if self.holds and self.late == 0:
            self.late, self.holds = 1, False
            try:
                return super().read()
            finally:
                self.holds = True
        return super().read()


def test_a_hold_counts_from_the_press_not_from_the_next_report():
    board = LateBoard()
    worker = LineWorker(lambda: board)
    until(lambda state: state.phase == "ready", worker)
    worker.hold()
    until(lambda state: board.late == 1, worker)
    with pytest.raises(InputError, match="the machine holds"):
        worker.do(lambda sender: sender.ask("B05"))
    worker.close()


def test_work_that_comes_with_a_hold_is_refused(worker):
    for _ in range(20):
        worker.hold()
        with pytest.raises(InputError, match="the machine holds"):
            worker.do(lambda sender: sender.ask("B05"))
        worker.go_on()
        until(lambda state: not state.holds, worker)


def test_a_hold_that_the_machine_ignores_is_forgotten(worker, board, monkeypatch):
    monkeypatch.setattr("plumb.line.worker.SURE", 1e9)
    board.write = lambda characters: None  # as in an alarm
    worker.hold()
    until(lambda state: state.holds, worker)
    monkeypatch.undo()
    until(lambda state: not state.holds, worker)


def send(worker):
    """A program of a line."""
    worker.send("one.nc", ["G1 X1"])


def test_a_machine_that_falls_silent_is_lost_also_at_rest(worker, board):
    board.is_silent = True
    until(lambda state: state.phase == "lost", worker)
    assert "silent for 5 s" in worker.state.trouble


def test_a_missing_machine_is_reported(board):
    def opened():
        raise InputError("COM9: cannot be opened; check the cable and the name")

    worker = LineWorker(opened)
    until(lambda state: state.phase == "lost", worker)
    assert worker.state.trouble.startswith("COM9: cannot be opened")


def test_a_refused_line_ends_the_program(worker, board):
    board.says["G1 X3"] = b"error: no such word"
    worker.send("bad.nc", ["G1 X1", "G1 X2", "G1 X3"])
    until(lambda state: state.phase == "ready", worker)
    assert worker.state.program.outcome == "refused"
    assert worker.state.trouble == "'G1 X3': the machine says: error: no such word"


def test_a_place_is_known_as_the_machine_says(board):
    board.greeting = b"ALARM: Position Lost. Power was lost before the position was kept.\r\n"
    worker = LineWorker(lambda: board)
    until(lambda state: state.phase == "ready", worker)
    assert not worker.state.knows_place
    assert worker.state.trouble.startswith("ALARM: Position Lost")
    board.says["B06 L1651 R1651"] = b"position loaded at:\r\nok"
    worker.send("chains", ["B06 L1651 R1651"])
    until(lambda state: state.phase == "ready", worker)
    assert worker.state.knows_place and worker.state.trouble == ""
    worker.close()


def test_work_that_fails_passes_its_error_on(worker):
    def work(sender):
        raise InputError("no")

    with pytest.raises(InputError, match=r"^no$"):
        worker.do(work).result(10)
    until(lambda state: state.phase == "ready", worker)
    assert worker.do(lambda sender: sender.ask("$$")).result(10) == []


def test_closing_in_mid_cut_stops_the_machine(worker, board):
    worker.send("grid.nc", JOB * 50)
    until(lambda state: state.moves, worker)
    worker.close()
    worker.await_end()
    assert board.written.endswith(STOP) and board.is_closed
    assert worker.state.phase == "none"


class CoastingBoard(SlowBoard):
    """A board whose sled still moves when its line is answered, and is heard in bursts only."""

    def __init__(self):
        super().__init__()
        self.bursts = [(1, 2, 3), (4, 5, 6), (7, 8, 9)]

    def read(self):
        if self.x and self.bursts:
            self.time += 2.0
            said = b"<Idle,MPos:%d.00,0.00,0.00,WPos:0,0,0>\r\n"
            return b"".join(said % x for x in self.bursts.pop(0))
        if not self.bursts:
            self.x = 9.0
        return super().read()


def test_a_program_is_not_done_while_the_sled_moves_though_this_program_stood_still():
    places = []
    worker = LineWorker(CoastingBoard)
    until(lambda state: state.phase == "ready", worker)
    worker.send("job.nc", ["G1 X9"], lambda sender: places.append(sender.status.place[0]))
    until(lambda state: state.phase == "ready", worker)
    assert worker.state.program.outcome == "done" and places == [9.0]
    worker.close()


def test_a_program_is_done_just_when_the_line_takes_other_work(board):
    outcomes = []

    def note(works):
        outcomes.append(worker.state.program.outcome)

    worker = LineWorker(lambda: board, working=note)
    until(lambda state: state.phase == "ready", worker)
    worker.send("job.nc", ["G1 X1"])
    until(lambda state: state.program.outcome == "done", worker)
    assert outcomes == ["running", "running"] and worker.state.phase == "ready"
    worker.close()


def test_work_has_ended_when_the_line_takes_other_work(board):
    line_is_free = Event()
    worker = LineWorker(lambda: board, working=lambda works: works or line_is_free.wait(10))
    until(lambda state: state.phase == "ready", worker)
    done = Event()
    future = worker.do(lambda sender: done.set())
    assert done.wait(10) and not future.done() and worker.state.phase == "busy"
    line_is_free.set()
    assert future.result(10) is None
    assert worker.do(lambda sender: "next").result(10) == "next"
    worker.close()


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
