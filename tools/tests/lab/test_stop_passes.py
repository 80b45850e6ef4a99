"""Stop and Hold come through whatever else is asked of the lab."""

import json
import socket
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from threading import Event
from types import SimpleNamespace

import pytest
from attacks import Try, answered, status
from folder import asked
from plumb.lab.machine_line import MachineLine
from served_lab import serve
from websockets.sync.client import connect

BUSY_S = 120  # of a busy computer
PRESSES = ("hold", "stop")
THREADS = 40  # in which the server answers


@pytest.fixture(scope="module")
def lab(tmp_path_factory):
    served = serve(tmp_path_factory.mktemp("lab"))
    yield served
    served.end()


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
            line = lines.enter_context(socket.create_connection(("127.0.0.1", lab.port), BUSY_S))
            line.sendall(ask)
            if target == "/":
                assert line.recv(65_536).startswith(b"HTTP/1.1 200")
        for way in PRESSES:
            pressed(lab, way)


@pytest.mark.parametrize("way", PRESSES)
def test_no_thread_of_the_server_has_to_be_free(tmp_path, monkeypatch, way):
    released, pressed = Event(), Event()
    monkeypatch.setattr(MachineLine, "worker", SimpleNamespace(**{way: pressed.set}))
    monkeypatch.setattr(MachineLine, "disconnect", lambda line: released.wait(BUSY_S))
    with asked(tmp_path) as client, ThreadPoolExecutor(THREADS + 1) as others:
        busy = [others.submit(client.post, "/api/machine/disconnect") for _ in range(THREADS)]
        try:
            answer = others.submit(client.post, f"/api/machine/{way}").result(BUSY_S)
            assert answer.status_code == 200 and pressed.is_set()
            assert not any(each.done() for each in busy)
        finally:
            released.set()


@pytest.mark.parametrize("way", PRESSES)
def test_the_live_line_takes_presses_and_answers_each(lab, way):
    address = f"ws://127.0.0.1:{lab.port}/api/live"
    with connect(address, subprotocols=["plumb", lab.token]) as line:
        line.send("x" * 50_000)
        line.send(f"start 6 {way} 6")
        line.send(f"{way} 7")
        said = {}
        while "press" not in said:
            said = json.loads(line.recv(timeout=BUSY_S))
        assert said["press"] == 7 and "connect it first" in said["error"]


def test_the_live_line_speaks_though_nothing_changes(lab):
    address = f"ws://127.0.0.1:{lab.port}/api/live"
    with connect(address, subprotocols=["plumb", lab.token]) as line:
        said = [json.loads(line.recv(timeout=BUSY_S)) for _ in range(4)]
        states = [each for each in said if "kind" in each]
        assert len(states) >= 3 and states[0] == states[1] == states[2]
