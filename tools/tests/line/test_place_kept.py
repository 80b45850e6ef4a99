"""The machine's place is in its memory before the line is let go of, whatever was sent last."""

import pytest
from line_board import Board
from plumb.line.sender import RefusedError, Sender, StoppedError


def standing(board, state="Idle"):
    """A machine that stands at 0, whatever is sent."""
    report = f"<{state},MPos:0.00,0.00,0.00,WPos:0,0,0>\r\n".encode()

    def read():
        board.time += 0.2
        said = board.answers(board.waiting.pop(0)).encode() + b"\r\n" if board.waiting else b""
        return said + report

    board.read = read
    return Sender(board)


def rested(sender, board):
    """How long the machine is waited for [s]."""
    begin = board.time
    sender.await_rest()
    return board.time - begin


def test_a_machine_is_waited_for_after_any_line_though_it_stands():
    board = Board()
    sender = standing(board)
    sender.await_start()
    sender.stream(["G21", "G4 P500", "M2"])
    assert rested(sender, board) == pytest.approx(4.0, abs=0.41)
    # From then on its place is kept.
    assert rested(sender, board) == pytest.approx(0.6, abs=0.21)
    for _ in range(40):
        sender.listen()
    sender.ask("$$")
    assert rested(sender, board) == pytest.approx(0.6, abs=0.21)


def test_time_in_which_the_machine_stood_counts():
    board = Board()
    sender = standing(board)
    sender.stream(["G21"])
    for _ in range(15):
        sender.listen()
    assert rested(sender, board) == pytest.approx(1.0, abs=0.41)


@pytest.mark.parametrize("how", ["listed", "sent"])
def test_a_machine_whose_motors_hold_longer_is_waited_for_longer(how):
    board = Board(lambda line: "$8=139.1\r\n$9=7000\r\n$71=300\r\nok" if line == "$$" else "ok")
    sender = standing(board)
    if how == "listed":
        sender.ask("$$")
        assert sender.ahead == 0.3
    sender.stream(["$9=7000" if how == "sent" else "G21"])
    assert rested(sender, board) == pytest.approx(9.0, abs=0.41)


@pytest.mark.parametrize("press", [Sender.go_on, Sender.hold])
def test_a_hold_and_going_on_power_the_motors(press):
    board = Board()
    sender = standing(board, "Pause" if press is Sender.hold else "Idle")
    sender.await_start()
    press(sender)
    sender.listen()
    board.read = standing(board).port.read
    assert rested(sender, board) == pytest.approx(4.0, abs=0.41)


def test_a_machine_is_waited_for_after_a_refused_line_too():
    board = Board(lambda line: "error: no")
    sender = standing(board)
    with pytest.raises(RefusedError):
        sender.stream(["G1 X5"])
    assert rested(sender, board) == pytest.approx(4.0, abs=0.41)


def test_a_stop_waits_until_the_place_is_kept():
    board = Board()
    sender = standing(board)
    begin = board.time
    sender.attend = lambda sender: board.time > 1 and sender.stop()
    board.answers = lambda line: "" if line == "G4 P99999" else "ok"
    with pytest.raises(StoppedError):
        sender.stream(["G4 P99999"])
    assert board.time - begin > 4.5
