"""The line to a machine by the lab's routes, and the live line to the page."""

import json
import time
import tomllib
from threading import Event

import pytest
from folder import got
from plumb.lab import machine_line
from plumb.line import worker
from plumb.line.port import LostError
from plumb.line.sender import STOP
from served_lab import serve
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect

PATIENCE = 120  # [s] of a busy computer


@pytest.fixture(scope="module")
def lab(tmp_path_factory):
    """A lab for all of these tests; each begins without a machine."""
    served = serve(tmp_path_factory.mktemp("lab"))
    yield served
    served.end()


@pytest.fixture
def ask(lab):
    """Asks a route of the lab as its page does: the answer, whose status must be this."""
    with lab.client() as client:

        def asking(method, path, status=200, **body):
            return got(client.request(method, f"/api/{path}", json=body or None), status)

        asking("POST", "machine/disconnect")
        yield asking


def until(ask, true):
    """Wait for a state of the machine."""
    end = time.monotonic() + PATIENCE
    while not true(state := ask("GET", "machine")):
        assert time.monotonic() < end, state
        time.sleep(0.05)
    return state


def wait_for(line, phase):
    """Wait for a state of a line that is here."""
    end = time.monotonic() + PATIENCE
    while line.state.phase != phase:
        assert line.state.phase != "lost" and time.monotonic() < end, line.state
        time.sleep(0.002)


def live(lab, token=None, **more):
    address = lab.site.replace("http", "ws") + "api/live"
    return connect(address, subprotocols=["plumb", token or lab.token], **more)


def test_without_a_machine_there_is_a_clear_line(ask):
    assert ask("GET", "machine")["kind"] == "none"
    for way in ("hold", "go-on", "stop", "settings"):
        assert "connect it first" in ask("POST", f"machine/{way}", 422)["error"]


@pytest.mark.parametrize("port", ["/etc/passwd", "lab.json", "/dev/../etc/passwd", "/dev/sda", ""])
def test_only_a_serial_port_is_opened(ask, port):
    assert "is no serial port" in ask("POST", "machine/board", 422, port=port)["error"]
    assert ask("GET", "machine")["kind"] == "none"


def test_a_link_leads_to_its_port_and_to_nothing_else(ask, cable, tmp_path):
    port, _ = cable
    link, other = tmp_path / "maslow", tmp_path / "other"
    link.symlink_to(port)
    other.symlink_to("/etc/passwd")
    ask("POST", "machine/board", port=str(link))
    state = until(ask, lambda state: state["phase"] == "ready")
    assert state["name"] == str(link)
    assert "is no serial port" in ask("POST", "machine/board", 422, port=str(other))["error"]


def test_a_port_that_is_not_there_is_said(ask):
    ask("POST", "machine/board", port="/dev/ttyNOWHERE")
    state = until(ask, lambda state: state["phase"] == "lost")
    assert "/dev/ttyNOWHERE: cannot be opened; check the cable" in state["trouble"]


def test_a_virtual_machine_gives_its_settings_takes_others_and_gets_its_own_back(lab, ask):
    ask("POST", "machine/virtual", seed=4)
    until(ask, lambda state: state["phase"] == "ready")
    project = ask("POST", "machine/settings")
    assert project["machine"]["file"] == "machine.toml"
    assert project["machine"]["frame"]["motor_gap"] == 2978.4
    text = (lab.folder / "machine.toml").read_text()
    assert tomllib.loads(text)["frame"]["motor_gap"] == 2978.4
    (lab.folder / "machine.toml").write_text(text.replace("2978.4", "2980.5"))
    written = ask("POST", "machine/numbers", file="machine.toml")
    change = next(each for each in written["changed"] if each["number"] == 2)
    assert (change["before"], change["after"]) == (2978.4, 2980.5)
    assert (lab.folder / written["kept"]).read_text().count("$2=2978.4") == 1
    back = ask("POST", "machine/undo", file="machine.toml")
    change = next(each for each in back["changed"] if each["number"] == 2)
    assert (change["before"], change["after"]) == (2980.5, 2978.4)
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
    until(ask, lambda state: state["phase"] == "ready")
    assert any("1651" in line for line in ask("POST", "machine/line", text="B06 L1651 R1651"))
    assert (
        "no plain file name" in ask("POST", "machine/numbers", 422, file="../machine.toml")["error"]
    )


def test_the_live_line_says_that_the_sled_moves_holds_and_stops(lab, ask):
    with live(lab) as line:
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
        ask("POST", "machine/program", title="job.nc", text="G21\nG1 X800 F700\nG1 X0\n")
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
        assert 5 < stopped["place"][0] < 790 and stopped["knows_place"]


def test_the_live_line_is_for_our_page_alone(lab):
    for token, more in (
        ("wrong", {}),
        (lab.token, {"additional_headers": {"Origin": "http://evil.example"}}),
    ):
        with pytest.raises(InvalidStatus), live(lab, token, **more):
            pass


@pytest.mark.parametrize("port", ["/dev/ttyACM0", "/dev/ttyACM1"])
def test_a_line_that_was_lost_in_mid_cut_does_not_know_the_place_when_it_is_back(monkeypatch, port):
    class Gone:
        def __init__(self, path):
            self.left, self.said, self.cuts = 200, b"", False

        def read(self):
            self.left -= self.cuts
            time.sleep(0.001)
            if not self.left:
                raise LostError("lost")
            said, self.said = self.said, b""
            return said + b"<Idle,MPos:%d.00,0.00,0.00,WPos:0,0,0>\r\n" % self.left

        def write(self, characters):
            if characters == b"$$\n":
                self.said = b"ok\r\n"
            self.cuts = self.cuts or characters.startswith(b"G1")

        def seconds(self):
            return time.monotonic()

        def close(self):
            pass

    monkeypatch.setattr(machine_line, "SerialPort", Gone)
    line = machine_line.MachineLine()
    line.connect_board("/dev/ttyACM0")
    wait_for(line, "ready")
    line.worker.send("job.nc", ["G1 X1"] * 100)
    wait_for(line, "lost")
    line.connect_board(port)
    wait_for(line, "ready")
    assert not line.state.knows_place
    line.connect_board("/dev/ttyACM7")
    wait_for(line, "ready")
    assert line.state.knows_place
    line.disconnect()
    assert line.state.phase == "none"


def test_a_port_is_opened_again_when_the_machine_that_moved_has_stopped(monkeypatch):
    moves, stands, openings = Event(), Event(), []

    class Moving:
        """A board that says nothing from its stop until it stands."""

        def __init__(self, path):
            assert path not in openings, "the port is busy"
            openings.append(path)
            self.time, self.path, self.is_stopped = 0.0, path, False
            self.said = b""

        def read(self):
            if self.is_stopped:
                stands.wait(30)
            time.sleep(0.001)
            self.time += 0.2
            said, self.said = self.said, b""
            return said + b"<Idle,MPos:0.00,0.00,0.00,WPos:0,0,0>\r\n"

        def write(self, characters):
            if characters == b"$$\n":
                self.said = b"ok\r\n"
                return
            moves.set()
            self.is_stopped = characters == STOP

        def seconds(self):
            return self.time

        def close(self):
            openings.remove(self.path)

    monkeypatch.setattr(machine_line, "SerialPort", Moving)
    monkeypatch.setattr(worker, "LEAVES", 0.01)
    line = machine_line.MachineLine()
    line.connect_board("/dev/ttyACM0")
    wait_for(line, "ready")
    line.worker.send("job.nc", ["G1 X1"])
    assert moves.wait(PATIENCE)
    line.disconnect()
    line.connect_board("/dev/ttyACM0")
    assert line.state.phase == "connecting"
    stands.set()
    wait_for(line, "ready")
    line.disconnect()


def test_a_cable_pulled_in_mid_cut_is_said(ask, cable):
    path, pulled = cable
    ask("POST", "machine/board", port=path)
    until(ask, lambda state: state["phase"] == "ready")
    lines = "".join(f"G1 X{x} F700\n" for x in range(5, 900, 5))
    ask("POST", "machine/program", title="job.nc", text=lines)
    until(ask, lambda state: state["program"]["done"] > 20)
    pulled.set()
    state = until(ask, lambda state: state["phase"] == "lost")
    assert state["program"]["outcome"] == "lost" and not state["knows_place"]
    assert "the line was lost" in state["trouble"] and "of 179 lines of job.nc" in state["trouble"]
    assert "connect it again" in ask("POST", "machine/line", 422, text="B15")["error"]
