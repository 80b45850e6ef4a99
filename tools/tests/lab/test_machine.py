"""The line to a machine by the lab's routes, and the live line to the page; Stop and Hold pass."""

import json
import socket
import time
import tomllib
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from functools import partial
from threading import Event
from types import SimpleNamespace

import folder
import pytest
from attacks import Try, answered, status
from folder import PATIENCE, asked, got
from line.line_board import SlowBoard, until
from plumb.lab import machine_line
from plumb.lab.machine_line import MachineLine
from plumb.line import worker
from plumb.line.sender import STOP
from plumb.line.worker import LineWorker
from plumb.text.errors import InputError
from systems import ON_POSIX


@pytest.fixture
def ask(lab):
    """Asks a route of the lab as its page does: the answer, whose status must be this."""
    with lab.client() as client:

        def asking(method, path, status=200, **body):
            return got(client.request(method, f"/api/{path}", json=body or None), status)

        asking.until = partial(folder.until, client)
        yield asking


def test_without_a_machine_there_is_a_clear_line(ask):
    assert ask("GET", "machine")["kind"] == "none"
    for way in ("hold", "go-on", "stop", "settings", "firmware"):
        assert "connect it first" in ask("POST", f"machine/{way}", 422)["error"]


@pytest.mark.parametrize("port", ["/etc/passwd", "lab.json", "/dev/../etc/passwd", "/dev/sda", ""])
def test_only_a_serial_port_is_opened(ask, port):
    assert "is not a serial port" in ask("POST", "machine/board", 422, port=port)["error"]
    assert ask("GET", "machine")["kind"] == "none"


@ON_POSIX
def test_a_link_leads_to_its_port_and_to_nothing_else(ask, cable, tmp_path):
    port = cable.path
    link, other = tmp_path / "maslow", tmp_path / "other"
    link.symlink_to(port)
    other.symlink_to("/etc/passwd")
    ask("POST", "machine/board", port=str(link))
    state = ask.until(lambda state: state["phase"] == "ready")
    assert state["name"] == str(link)
    assert "is not a serial port" in ask("POST", "machine/board", 422, port=str(other))["error"]


def test_a_virtual_machines_settings_are_read_replaced_and_restored(lab, ask):
    ask("POST", "machine/virtual", seed=4)
    ask.until(lambda state: state["phase"] == "ready")
    project = ask("POST", "machine/settings")
    assert project["machine"]["file"] == "machine.toml"
    assert project["machine"]["frame"]["motor_gap"] == 2978.4
    text = (lab.folder / "machine.toml").read_text()
    assert tomllib.loads(text)["frame"]["motor_gap"] == 2978.4
    (lab.folder / "machine.toml").write_text(text.replace("2978.4", "2980.5"))
    written = ask("POST", "machine/numbers", file="machine.toml")
    assert "$2 = 2980.5 mm, was 2978.4" in [said for _, said in written["changed"]]
    assert (lab.folder / written["kept"]).read_text().count("$2=2978.4") == 1
    back = ask("POST", "machine/undo", file="machine.toml")
    assert "$2 = 2978.4 mm, was 2980.5" in [said for _, said in back["changed"]]
    count = len(back["changed"])
    said = [each["said"] for each in ask("GET", "diary")["others"]]
    assert said[0] == f"took machine.toml back: {count} number{'s'[: count - 1]} as before it"
    assert said[1].endswith(" changed by machine.toml")
    # Who presses it twice does not get the new numbers again.
    assert ask("POST", "machine/undo", file="machine.toml")["changed"] == []
    # What was cut with the changed file can still be read with it.
    changed = (lab.folder / "machine.toml").read_text()
    assert ask("POST", "machine/settings")["machine"]["file"] == "machine-2.toml"
    assert "2978.4" in (lab.folder / "machine-2.toml").read_text()
    assert (lab.folder / "machine.toml").read_text() == changed


def test_a_line_is_answered_and_a_bad_path_refused(ask):
    ask("POST", "machine/virtual", hides="nothing")
    ask.until(lambda state: state["phase"] == "ready")
    assert any("1651" in line for line in ask("POST", "machine/line", text="B06 L1651 R1651"))
    refused = ask("POST", "machine/numbers", 422, file="../machine.toml")["error"]
    assert "not a plain file name" in refused


def test_the_live_line_says_that_the_sled_moves_holds_and_stops(lab, ask):
    with lab.live() as line:
        seen = []

        def next_state(true):
            for _ in range(400):
                seen.append(json.loads(line.recv(timeout=60)))
                if "kind" in seen[-1] and true(seen[-1]):
                    return seen[-1]
            raise AssertionError(seen[-1])

        assert next_state(lambda state: True)["kind"] == "none"
        ask("POST", "machine/virtual", speed=10)
        next_state(lambda state: state["phase"] == "ready")
        ask("POST", "machine/settings")
        ask("POST", "rounds/marks/cut")
        next_state(lambda state: state["moves"])
        ask("POST", "machine/hold")
        held = next_state(lambda state: state["holds"] and not state["moves"])
        for _ in range(20):
            assert ask("GET", "machine")["place"] == pytest.approx(held["place"], abs=0.5)
        ask("POST", "machine/go-on")
        next_state(lambda state: state["moves"])
        ask("POST", "machine/stop")
        stopped = next_state(lambda state: state["phase"] == "ready")
        assert stopped["program"]["outcome"] == "stopped"
        assert stopped["place"][:2] != [0, 0] and stopped["knows_place"]


@pytest.mark.parametrize("port", ["/dev/ttyACM0", "/dev/ttyACM1"])
def test_after_a_line_lost_in_mid_cut_the_place_is_unknown(monkeypatch, port):
    def board(path):
        board = SlowBoard()
        board.at[60] = lambda: setattr(board, "is_pulled", True)
        return board

    monkeypatch.setattr(machine_line, "SerialPort", board)
    line = machine_line.MachineLine()
    line.connect_board("/dev/ttyACM0")
    until(lambda state: state.phase == "ready", line)
    line.worker.send("job.nc", ["G1 X1"] * 100)
    until(lambda state: state.phase == "lost", line)
    assert line.state.program.outcome == "lost"
    assert (
        "the line was lost" in line.state.trouble and "of 100 lines of job.nc" in line.state.trouble
    )
    with pytest.raises(InputError, match="connect it again"):
        line.worker.do(lambda sender: sender.ask("B15"))
    line.connect_board(port)
    until(lambda state: state.phase == "ready", line)
    assert not line.state.knows_place
    line.connect_board("/dev/ttyACM7")
    until(lambda state: state.phase == "ready", line)
    assert line.state.knows_place
    line.disconnect()
    assert line.state.phase == "none"


def test_a_port_is_opened_again_when_the_machine_that_moved_has_stopped(monkeypatch):
    moves, stands, openings = Event(), Event(), []

    class Moving(SlowBoard):
        """A board that says nothing from its stop until it stands."""

        def __init__(self, path):
            assert path not in openings, "the port is busy"
            openings.append(path)
            super().__init__()
            self.path, self.at[1] = path, moves.set

        def read(self):
            if self.written.endswith(STOP):
                stands.wait(30)
            return super().read()

        def close(self):
            openings.remove(self.path)

    monkeypatch.setattr(machine_line, "SerialPort", Moving)
    monkeypatch.setattr(worker, "LEAVES", 0.01)
    line = machine_line.MachineLine()
    line.connect_board("/dev/ttyACM0")
    until(lambda state: state.phase == "ready", line)
    line.worker.send("job.nc", ["G1 X1"] * 100)
    assert moves.wait(PATIENCE)
    line.disconnect()
    line.connect_board("/dev/ttyACM0")
    assert line.state.phase == "connecting"
    stands.set()
    until(lambda state: state.phase == "ready", line)
    line.disconnect()


def test_another_firmware_is_named_and_ours_is_written_over_it(client, monkeypatch):
    on_board, shares = ["Firmware Version 1.29"], []

    def board(path):
        board = SlowBoard()
        board.greeting = f"{on_board[-1]}\r\nready\r\n".encode()
        board.says["B05"] = b"Firmware Version 1.29\r\nok"
        return board

    def write(port, file, progress):
        progress(0.4)
        state = got(client.get("/api/machine"))
        shares.append(state["written"])
        on_board.append(f"{state['brought']}, firmware for the Maslow CNC")

    def ready():
        return folder.until(client, lambda state: state["phase"] == "ready")

    monkeypatch.setattr(machine_line, "SerialPort", board)
    monkeypatch.setattr(machine_line, "write_program", write)
    got(client.post("/api/machine/board", json={"port": "/dev/ttyACM0"}))
    before = ready()
    assert before["firmware"] == "Firmware Version 1.29" != before["brought"]
    assert got(client.post("/api/machine/firmware"))["phase"] == "connecting"
    after = ready()
    assert after["firmware"] == after["brought"] and after["written"] is None and shares == [0.4]
    got(client.post("/api/machine/disconnect"))


def test_the_age_of_a_silent_boards_report_grows(monkeypatch):
    board, ahead = SlowBoard(), SimpleNamespace(seconds=0.0)
    line = LineWorker(lambda: board)
    until(lambda state: state.phase == "ready", line)
    clock, board.seconds = board.seconds, lambda: 0.0
    monkeypatch.setattr(worker, "monotonic", lambda: time.monotonic() + ahead.seconds)
    until(lambda state: line.silence < 1.0, line)
    board.is_silent, ahead.seconds = True, 4.0
    assert 4.0 <= line.silence < PATIENCE
    board.is_silent, board.seconds = False, clock
    line.close()  # once the machine has kept its place
    until(lambda state: line.silence == 0.0, line)  # no report is due


PRESSES = ("hold", "stop")
THREADS = 40  # in which the server answers


def pressed(lab, way):
    """The answer to a press: no machine is connected, and the route itself says so."""
    answer = answered(lab, Try("POST", f"/api/machine/{way}", body=b"").bytes(lab))
    assert status(answer) == 422 and b"connect it first" in answer, answer


@pytest.mark.parametrize("target", ["/", "/lab.js"])
def test_connections_without_a_token_do_not_keep_stop_out(lab, target):
    """They were answered and rest, or do not read the answer."""
    ask = Try("GET", target, (("X-Plumb-Token", None),), b"").bytes(lab)
    with ExitStack() as lines:
        for _ in range(150):
            line = lines.enter_context(socket.create_connection(("127.0.0.1", lab.port), PATIENCE))
            line.sendall(ask)
            if target == "/":
                assert line.recv(65_536).startswith(b"HTTP/1.1 200")
        for way in PRESSES:
            pressed(lab, way)


@pytest.mark.parametrize("way", PRESSES)
def test_stop_works_while_all_threads_of_the_server_are_busy(tmp_path, monkeypatch, way):
    released, pressed = Event(), Event()
    monkeypatch.setattr(MachineLine, "worker", SimpleNamespace(**{way: pressed.set}))
    monkeypatch.setattr(MachineLine, "disconnect", lambda line: released.wait(PATIENCE))
    with asked(tmp_path) as client, ThreadPoolExecutor(THREADS + 1) as others:
        busy = [others.submit(client.post, "/api/machine/disconnect") for _ in range(THREADS)]
        try:
            answer = others.submit(client.post, f"/api/machine/{way}").result(PATIENCE)
            assert answer.status_code == 200 and pressed.is_set()
            assert not any(each.done() for each in busy)
        finally:
            released.set()


@pytest.mark.parametrize("way", PRESSES)
def test_the_live_line_takes_presses_and_answers_each(lab, way):
    with lab.live() as line:
        line.send("x" * 50_000)
        line.send(f"start 6 {way} 6")
        line.send(f"{way} 7")
        said = {}
        while "press" not in said:
            said = json.loads(line.recv(timeout=PATIENCE))
        assert said["press"] == 7 and "connect it first" in said["error"]


def test_the_live_line_speaks_though_nothing_changes(lab):
    with lab.live() as line:
        said = [json.loads(line.recv(timeout=PATIENCE)) for _ in range(4)]
        states = [each for each in said if "kind" in each]
        assert len(states) >= 3 and states[0] == states[1] == states[2]
