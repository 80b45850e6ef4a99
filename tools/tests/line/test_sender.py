"""The sender and the numbers over the line: stopped by a refusal, waiting for the rest."""

from types import SimpleNamespace

import pytest
from line_board import REPORT, Board
from numbers_machine import NumbersMachine
from plumb.line.memory import kept_before, read_numbers, refuse_while_moving, write_numbers
from plumb.line.port import LostError
from plumb.line.sender import AHEAD, RefusedError, Sender, StoppedError, Watch, cleaned
from plumb.text.errors import InputError


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


def test_answers_to_lines_behind_a_refused_line_are_for_no_later_line():
    board = Board(lambda line: "error: no such word" if line in ("$1", "$3") else "ok")
    said = []
    sender = Sender(board, said.append)
    with pytest.raises(RefusedError, match="'\\$1': the machine says"):
        sender.stream(["$0", "$1", "$2", "$3", "$4"])
    assert board.waiting == ["$2", "$3", "$4"]
    counted = []
    sender.stream(["G0 X1", "G0 X2"], answered=lambda done: counted.append(len(board.waiting)))
    assert counted == [1, 0]
    assert said == ["error: no such word"]


def test_an_alarm_forgets_the_lines_behind_it():
    def answer(line):
        if line != "G0 X1":
            return "ok"
        board.waiting.clear()
        return "ALARM: Halted"

    board = Board(answer)
    sender = Sender(board)
    with pytest.raises(RefusedError, match="ALARM"):
        sender.stream(["G0 X0", "G0 X1", "G0 X2", "G0 X3"])
    sender.attend = lambda sender: board.time < 30 or pytest.fail("an answer is missing")
    assert sender.stream(["$0", "$1"]) == 2


class HaltedBoard(Board):
    """A machine that halted before: it drops lines, and answers the questions of some."""

    state = "Stop"

    def __init__(self, questions=()):
        super().__init__()
        self.questions = questions

    def read(self):
        self.waiting = [line for line in self.waiting if line in self.questions]
        return super().read().replace(b"Idle", self.state.encode())


def test_a_machine_that_holds_is_waited_for_longer():
    board = HaltedBoard()
    board.state = "Pause"
    sender = Sender(board, attend=lambda sender: setattr(board, "deaf", board.time > 30))
    with pytest.raises(LostError):
        sender.stream(["G0 X5"])
    assert board.time > 30


def test_a_stop_forgets_the_lines_behind_a_refused_line():
    board = Board(lambda line: "error: no such word" if line == "$1" else "ok")
    sender = Sender(board)
    with pytest.raises(RefusedError):
        sender.stream(["$1", "$2", "$3"])
    sender.brake()
    board.waiting = ["!"]
    assert sender.stream(["G0 X1"]) == 1
    assert board.waiting == []


def test_a_machine_left_by_a_grbl_sender_reports_again():
    said, answers = [], {"B05": "Firmware Version 1.28\r\nok", "$$": "this is $$\r\nok"}
    board = Board(answers.get, left_by_grbl=True)
    sender = Sender(board, said.append)
    sender.await_start()
    assert board.written == b"B05\n"
    assert 1.5 < board.time < 3.1
    assert said == []
    assert sender.ask("$$") == ["this is $$"]


def test_a_report_from_before_a_reset_is_not_taken_for_a_machine_that_hears():
    board = Board(lambda line: f"this is {line}\r\nok")
    up, from_2_s = board.read, board.write

    def read():
        assert board.time < 20, "its answer does not come"
        if board.time >= 2:
            return up()
        board.time += 0.2
        return REPORT.encode() if board.time == 0.2 else b""

    board.read = read
    board.write = lambda characters: from_2_s(characters) if board.time >= 2 else None
    sender = Sender(board)
    sender.await_start()
    assert sender.ask("$$") == ["this is $$"]


@pytest.mark.parametrize("first", ["$$", "B05"])
def test_the_late_answer_of_a_machine_that_was_asked_to_report_belongs_to_no_line(first):
    said = {"B05": "Firmware Version 1.28\r\nok"}
    board = Board(lambda line: said.get(line, f"this is {line}\r\nok"), left_by_grbl=True)
    at_once, late = board.read, []

    def read():
        heard = at_once()
        if b"Version" in heard and board.time < 3:
            late.append(heard[: heard.index(b"<")])
            return heard[heard.index(b"<") :]
        return late.pop() + heard if late and board.time > 12 else heard

    board.read = read
    sender = Sender(board)
    sender.await_start()
    while board.time < 12:
        sender.listen()
    known = {"$$": "this is $$", "B05": "Firmware Version 1.28"}
    assert sender.ask(first) == [known[first]]
    for line in ("$$", "B05", "$$"):
        assert sender.ask(line) == [known[line]]


def test_a_greeting_counts_for_no_line():
    said = []
    board = Board()
    board.read = iter([b"Plumb v1.0.0\r\nready\r\nok\r\n", REPORT.encode()]).__next__
    sender = Sender(board, said.append)
    sender.await_start()
    assert said == []


def reported(x):
    return f"<Idle,MPos:{x:.2f},0.00,0.00,WPos:0,0,0>\r\n".encode()


def stalled_board():
    """A board whose computer stands still for two seconds while the sled moves."""
    board = Board()
    reads = [reported(0), b"", *[reported(x) for x in range(1, 5)], *[reported(5)] * 50]
    jumps = {1: 2.0}  # [s] by the number of the read

    def read():
        board.count += 1
        board.time += jumps.get(board.count - 1, 0.2)
        return reads[min(board.count, len(reads)) - 1]

    board.count, board.read = 0, read
    return board


def test_a_moving_machine_is_not_taken_for_standing_after_the_computer_slept():
    sender = Sender(stalled_board())
    sender.await_start()
    sender.await_rest()
    assert sender.status.place[0] == 5
    sender = Sender(stalled_board())
    with pytest.raises(InputError, match="the machine moves"):
        refuse_while_moving(sender)


def test_waiting_characters_are_read_before_the_machine_is_given_up():
    board = Board()
    usual, stood = board.read, []

    def read():
        if stood or board.time < 1:
            return usual()
        stood.append(board.time)
        board.time += 60  # and meanwhile the answers come
        return b""

    board.read = read
    assert Sender(board).stream([f"G0 X{i}" for i in range(20)]) == 20


def test_the_answer_of_a_line_that_is_slipped_in_is_for_no_line_of_the_program():
    board = Board(lambda line: "error: only z" if line == "G0 X5" else "ok")
    heard = list[str]()
    sender = Sender(board, said=heard.append)
    sender.slip_in("G0 X5 (there)")
    sender.slip_in("G10 Z0")
    assert sender.stream(["G1 X1", "G1 X2"]) == 2
    assert board.written == b"G0 X5\nG10 Z0\nG1 X1\nG1 X2\n" and heard == ["error: only z"]
    with pytest.raises(InputError, match="is not plain text"):
        sender.slip_in("G0 Z\u00bd")


@pytest.mark.parametrize("press", [Sender.go_on, Sender.brake])
def test_the_ok_of_a_pressed_key_answers_no_line(press):
    board = Board()
    board.answers = lambda line: "error: no" if line == "G1 Xtwo" else "ok"
    sender = Sender(board)
    press(sender)
    with pytest.raises(RefusedError, match=r"^'G1 Xtwo': the machine says: error: no$"):
        sender.stream(["G1 Xtwo"])


@pytest.mark.parametrize(
    ("line", "why"),
    [("G0 X1 é", "line 2 is not plain text"), ("G1 " + "X1 " * 50, "line 2 is longer")],
)
def test_a_line_that_the_machine_cannot_take_is_refused(line, why):
    with pytest.raises(InputError, match=why):
        list(cleaned(["G21", line]))


def test_a_watch_goes_by_the_machines_time_and_by_its_reports(monkeypatch):
    now = [0.0]
    sender = SimpleNamespace(port=SimpleNamespace(seconds=lambda: now[0]), reports=0)
    watch = Watch(sender)
    now[0], sender.reports = 3.9, 100
    assert not watch.has_lasted(4)
    now[0] = 4.0
    assert watch.has_lasted(4)
    monkeypatch.setattr(Watch, "speed", 10.0)
    watch, sender.reports = Watch(sender), 118
    now[0] += 0.4
    assert not Watch(sender).has_lasted(4) and not watch.has_lasted(4)
    sender.reports = 119
    assert watch.has_lasted(4)


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


def test_all_numbers_are_read():
    assert read_numbers(Sender(NumbersMachine())) == {12: 2978.4, 15: 8113.73, 38: 0.0}


def test_a_board_without_numbers_is_refused():
    machine = NumbersMachine()
    machine.numbers = {}
    with pytest.raises(InputError, match="is it a Maslow's firmware"):
        read_numbers(Sender(machine))


def test_a_changed_number_is_reported_with_its_old_value():
    machine = NumbersMachine()
    written = write_numbers(Sender(machine), ["$12=2978.41", "$15 = 8113.73", "$38=15.5"])
    assert written.before == {12: 2978.4, 15: 8113.73, 38: 0.0}
    assert written.changed == {38: (0.0, 15.5)}  # $12: the machine prints seven digits
    assert machine.numbers[12] == 2978.41


@pytest.mark.parametrize("line", ["B05", "$12", "G1 X5", "$12=5 $13=6"])
def test_a_line_that_sets_no_number_is_refused_before_any_is_sent(line):
    machine = NumbersMachine()
    with pytest.raises(InputError, match=r"is not a number for the machine: \$N=VALUE"):
        write_numbers(Sender(machine), ["$38=15.5", line])
    assert machine.written == []


@pytest.mark.parametrize(
    ("line", "held"), [("$38=15.5", "38=0.0"), ("$15=8114.73", "15=8113.73"), ("$99=1", "99=None")]
)
def test_a_number_that_the_machine_does_not_hold_is_named(line, held):
    machine = NumbersMachine(forgets=(15, 38, 99))
    with pytest.raises(InputError, match=rf"holds \${held} though .* was sent"):
        write_numbers(Sender(machine), [line])


def test_a_machine_that_moves_gets_no_numbers():
    machine = NumbersMachine(speed=0.1)
    with pytest.raises(InputError, match="the machine moves"):
        write_numbers(Sender(machine), ["$38=15.5"])
    assert machine.written == []


def test_the_newest_numbers_come_back(tmp_path):
    for day, gap in (("2026-01-02", 2), ("2026-01-10", 3), ("2025-12-31", 1)):
        (tmp_path / f"machine-before-{day}.nc").write_text(f"$2={gap}\n$3=5\n")
    (tmp_path / "other-before-2027-01-01.nc").write_text("$2=4\n")
    assert kept_before(tmp_path / "machine.toml") == ["$2=3", "$3=5"]


def test_without_kept_numbers_there_is_a_remedy(tmp_path):
    with pytest.raises(InputError, match="nothing was kept when it was sent; send it first"):
        kept_before(tmp_path / "machine.toml")
