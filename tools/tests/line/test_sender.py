"""The sender: ahead of the answers, never beyond the machine's buffer, and stopped by a refusal."""

import pytest
from plumb.line.sender import (
    AHEAD,
    GO_ON,
    HOLD,
    STOP,
    RefusedError,
    Sender,
    Status,
    StoppedError,
    cleaned,
)
from plumb.text.errors import InputError

REPORT = "<Idle,MPos:1.00,-2.50,0.00,WPos:0.000,0.000,0.000>\r\n[PE:0.00,0.00,127]\r\n"


class Board:
    """A machine that answers a line each time it is heard, and reports meanwhile."""

    def __init__(self, answers=lambda line: "ok", *, deaf=False):
        self.answers, self.deaf = answers, deaf
        self.waiting: list[str] = []
        self.most = 0
        self.time = 0.0
        self.written = b""

    def write(self, characters: bytes) -> None:
        self.written += characters
        if characters.endswith(b"\n"):
            self.waiting.append(characters.decode().rstrip("\n"))
        self.most = max(self.most, sum(len(line) + 1 for line in self.waiting))

    def read(self) -> bytes:
        self.time += 0.2
        if self.deaf:
            return b""
        said = REPORT
        if self.waiting:
            said = self.answers(self.waiting.pop(0)) + "\r\n" + said
        return said.encode()

    def seconds(self) -> float:
        return self.time

    def close(self) -> None:
        pass


def test_lines_go_ahead_of_the_answers_up_to_the_buffer():
    board = Board()
    counted = []
    lines = [f"G1 X{i}.125 Y{i}.250" for i in range(40)]
    assert Sender(board).stream(lines, answered=counted.append) == 40
    assert counted == list(range(1, 41))
    assert board.written.decode().splitlines() == lines
    assert AHEAD - 20 < board.most <= AHEAD


def test_nothing_more_is_sent_after_a_refusal():
    board = Board(lambda line: "error: no such word" if "X3" in line else "ok")
    sender = Sender(board)
    lines = [
        f"G1 X{i} (a comment so that only a few lines fit) Y1.23456789 Z1.2345678" for i in range(9)
    ]
    with pytest.raises(RefusedError, match=r"'G1 X3 .*': the machine says: error: no such word"):
        sender.stream(lines)
    assert b"X8" not in board.written
    assert sender.stream(["G0 X0"]) == 1


def test_an_alarm_stops_the_stream_too():
    board = Board(lambda line: "ALARM: the sled was not keeping up")
    with pytest.raises(RefusedError, match="ALARM: the sled"):
        Sender(board).stream(["G0 X1"])


def test_what_is_said_besides_answers_is_heard_in_order():
    said = []
    board = Board(lambda line: "Left: 1651.00mm\r\nRight: 1651.00mm\r\nok")
    sender = Sender(board, said.append)
    sender.stream(["B06 L1651 R1651"])
    assert said == ["Left: 1651.00mm", "Right: 1651.00mm"]
    assert sender.ask("B10 L") == said
    assert len(said) == 2
    assert sender.status == Status("Idle", (1.0, -2.5, 0.0))


def test_a_silent_machine_is_named():
    with pytest.raises(InputError, match="does not answer: check the cable"):
        Sender(Board(deaf=True)).await_start()
    with pytest.raises(InputError, match="silent for 5 s"):
        Sender(Board(deaf=True)).stream(["G0 X1"])


def test_a_greeting_counts_for_no_line():
    said = []
    board = Board()
    board.read = iter([b"Grbl v1.00\r\nready\r\nok\r\n", REPORT.encode()]).__next__
    sender = Sender(board, said.append)
    sender.await_start()
    assert said == []


def test_what_is_wrong_with_a_machine_is_heard_from_its_greeting():
    said = []
    board = Board()
    board.read = iter([b"ready\r\nok\r\nALARM: Position Lost.\r\n" + REPORT.encode()]).__next__
    Sender(board, said.append).await_start()
    assert said == ["ALARM: Position Lost."]


def test_at_the_end_the_machine_must_have_kept_its_position():
    places = [0.0, 0.0, 1.0, 2.0, 3.0] + [3.0] * 100
    board = Board()
    reports = (f"<Idle,MPos:{x},0.00,0.00,WPos:0,0,0>\r\n".encode() for x in places)

    def read():
        board.time += 0.2
        return next(reports)

    board.read = read
    sender = Sender(board)
    sender.await_start()
    sender.await_rest()
    assert board.time == pytest.approx(5 * 0.2 + 4.0, abs=0.21)


def test_a_machine_that_stands_is_not_waited_for():
    board = Board()
    sender = Sender(board)
    sender.await_start()
    sender.await_rest()
    assert board.time < 1.1


def test_a_line_may_come_in_pieces():
    board = Board()
    pieces = [b"<Idle,MPos:3.0", b"0,4.00,5.00,WPos:0,0,0>\r", b"\no", b"k\r\n"]
    board.read = iter(pieces).__next__
    sender = Sender(board)
    assert sender.stream(["G0 X3"]) == 1
    assert sender.status == Status("Idle", (3.0, 4.0, 5.0))


def test_a_hold_is_a_single_character_and_going_on_answers_no_line():
    board = Board()
    sender = Sender(board)
    pressed = [True]

    def attend(_):
        if pressed and board.time > 0.5:
            pressed.clear()
            sender.hold()
            sender.go_on()

    sender.attend = attend
    assert sender.stream([f"G0 X{i}" for i in range(20)]) == 20
    assert HOLD + GO_ON in board.written
    assert HOLD == b"\x84"
    assert sender.stream(["G0 X1"]) == 1


def test_whoever_stops_sends_nothing_more():
    board = Board()
    sender = Sender(board, attend=lambda sender: board.time > 1 and sender.stop())
    with pytest.raises(StoppedError):
        sender.stream([f"G1 X{i}.123456789 Y{i}.123456789" for i in range(40)])
    assert board.written.endswith(STOP)
    assert b"X39" not in board.written


def test_comments_and_blanks_are_left_out():
    text = ["(a grid)", "", "  G0 X1 (there) Y2 ; and more", "G21"]
    assert list(cleaned(text)) == ["G0 X1  Y2", "G21"]


@pytest.mark.parametrize(
    ("line", "why"),
    [("G0 X1 é", "line 2 is no plain text"), ("G1 " + "X1 " * 50, "line 2 is longer")],
)
def test_a_line_that_the_machine_cannot_take_is_refused(line, why):
    with pytest.raises(InputError, match=why):
        list(cleaned(["G21", line]))
