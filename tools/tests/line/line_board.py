"""Machines at the end of a line that answer and report; their clock goes on as they are read."""

import time

from plumb.line.port import LostError
from plumb.line.sender import GO_ON, HOLD, STOP

REPORT = "<Idle,MPos:1.00,-2.50,0.00,WPos:0.000,0.000,0.000>\r\n[PE:0.00,0.00,127]\r\n"


class Board:
    """A machine that answers a line each time it is heard, and reports meanwhile.

    deaf: it never speaks. left_by_grbl: a sender of Grbl was here, so it reports from B05 on.
    """

    def __init__(self, answers=lambda line: "ok", *, deaf=False, left_by_grbl=False):
        self.answers, self.deaf, self.reports = answers, deaf, not left_by_grbl
        self.waiting: list[str] = []
        self.most = 0
        self.time = 0.0
        self.written = b""
        self.holds = False

    def write(self, characters: bytes) -> None:
        self.written += characters
        if self.holds and characters == b"~\n":
            self.holds = False  # it has no `ok`
            return
        self.holds = self.holds or characters == b"\x84"
        if characters.endswith(b"\n"):
            self.waiting.append(characters.decode().rstrip("\n"))
        self.most = max(self.most, sum(len(line) + 1 for line in self.waiting))

    def read(self) -> bytes:
        self.time += 0.2
        if self.deaf:
            return b""
        said = ""
        if self.waiting:
            line = self.waiting.pop(0)
            self.reports = self.reports or line == "B05"
            said = self.answers(line) + "\r\n"
        return (said + REPORT * self.reports).encode()

    def seconds(self) -> float:
        return self.time

    def close(self) -> None:
        pass


class SlowBoard:
    """A board that moves a millimetre a line, answers each when it is there, and can be pulled.

    at: what somebody does when the sled is at an x. The line's thread does it, so that it comes
    at that line however busy the computer is.
    """

    def __init__(self):
        self.x, self.time = 0.0, 0.0
        self.at = {}
        self.waiting, self.written = [], b""
        self.holds = self.is_pulled = self.is_closed = self.is_silent = False
        self.greeting, self.state = b"ready\r\n", "Idle"
        self.says = {}

    def write(self, characters):
        if self.is_pulled:
            raise LostError("USB: the line was lost; check the cable")
        self.written += characters
        if characters == HOLD:
            self.holds = True
        elif characters == STOP:
            self.holds, self.waiting = False, ["!"]
        elif self.holds and characters == GO_ON:
            self.holds = False  # it has no `ok`
        else:
            self.waiting.append(characters.decode().strip())

    def read(self):
        time.sleep(0.001)
        if self.is_pulled:
            raise LostError("USB: the line was lost; check the cable")
        self.time += 0.2
        self.at.pop(self.x, lambda: None)()
        if self.is_silent:
            return b""
        said, self.greeting = self.greeting, b""
        if self.waiting and not self.holds:
            line = self.waiting.pop(0)
            self.x += line.startswith("G1")
            said += self.says.get(line, b"ok") + b"\r\n"
        state = "Pause" if self.holds else self.state
        return said + f"<{state},MPos:{self.x:.2f},0.00,0.00,WPos:0,0,0>\r\n".encode()

    def seconds(self):
        return self.time

    def close(self):
        self.is_closed = True


def until(true, worker):
    """Wait for a state; say what it was instead."""
    end = time.monotonic() + 120  # of a busy computer
    while not true(worker.state):
        assert time.monotonic() < end, worker.state
        time.sleep(0.002)
