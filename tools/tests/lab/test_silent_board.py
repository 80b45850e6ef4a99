"""How long a board has said nothing, before its line is given up."""

import time
from types import SimpleNamespace

import pytest
from plumb.lab.machine_line import MachineLine
from plumb.lab.routes.machine import machine
from plumb.line import worker
from plumb.line.worker import LineState, LineWorker

BUSY_S = 120  # of a busy computer


class Reporting:
    """A board that reports until a test silences it, as long as that wants."""

    is_silent = False
    time = step = 0.0  # [s] of its clock, and what each look adds

    def read(self):
        time.sleep(0.001)
        return b"" if self.is_silent else b"ok\r\n<Idle,MPos:0.00,0.00,0.00,WPos:0,0,0>\r\n"

    def write(self, characters):
        pass

    def seconds(self):
        self.time += self.step
        return self.time

    def close(self):
        pass


def until(true):
    end = time.monotonic() + BUSY_S
    while not true():
        assert time.monotonic() < end
        time.sleep(0.002)


def test_a_silent_board_grows_older(monkeypatch):
    board, ahead = Reporting(), SimpleNamespace(seconds=0.0)
    line = LineWorker(lambda: board)
    until(lambda: line.state.phase == "ready")
    monkeypatch.setattr(worker, "monotonic", lambda: time.monotonic() + ahead.seconds)
    until(lambda: line.silence < 1.0)
    board.is_silent, ahead.seconds = True, 4.0
    assert 4.0 <= line.silence < BUSY_S
    board.is_silent, board.step = False, 0.1
    line.close()  # once the machine has kept its place
    until(lambda: line.silence == 0.0)  # no report is due


@pytest.mark.parametrize(("silence", "said"), [(0.3, 0), (1.9, 0), (2.0, 2), (4.7, 4)])
def test_the_page_hears_of_seconds_and_of_no_pause_between_two_reports(silence, said):
    line = MachineLine()
    line.name, line._worker = "USB", SimpleNamespace(silence=silence, state=LineState("busy"))
    assert machine(line).silent_s == said
    line.virtual = object()  # hangs on no cable
    assert machine(line).silent_s == 0
