"""Clients that send too much, too slowly or too often: the owner's page is served meanwhile."""

import socket
import sys
import time
from contextlib import ExitStack

import pytest
from attacks import Try, answered, status
from served_lab import serve
from websockets.exceptions import ConnectionClosed, InvalidStatus

# The same server with deadlines that a test can wait for.
HASTE = """
import sys
import plumb.lab.server as connections, plumb.lab.guard as guard
connections.HEADERS_S, guard.BODY_S = 1.0, 1.0
from plumb.cli.main import main
sys.exit(main(sys.argv[1:]))
"""
BUSY_S = 120  # of a busy computer
LARGE = 1_000_000_000  # bytes
ASKING = Try("GET", "/api/project", body=b"")


@pytest.fixture(scope="module")
def lab(tmp_path_factory):
    served = serve(tmp_path_factory.mktemp("machine"), command=[sys.executable, "-c", HASTE])
    yield served
    served.end()


def line_to(lab):
    return socket.create_connection(("127.0.0.1", lab.port), BUSY_S)


def is_closed(line):
    """Whether the lab closes this connection within its timeout."""
    try:
        return line.recv(65_536) == b"" or line.recv(65_536) == b""
    except (ConnectionResetError, BrokenPipeError):
        return True


def memory(lab):
    """The largest memory that the server has had [kB]."""
    with open(f"/proc/{lab.process.pid}/status") as status:
        return next(int(line.split()[1]) for line in status if line.startswith("VmHWM"))


def poured(line, block):
    """How many bytes the lab takes of a gigabyte before it ends the connection."""
    taken = 0
    try:
        while taken < LARGE:
            line.sendall(block)
            taken += len(block)
    except OSError:
        pass
    return taken


def test_a_declared_gigabyte_is_refused_at_its_header(lab):
    sent = Try(headers=(("Content-Length", str(LARGE)),)).bytes(lab)
    assert status(answered(lab, sent)) == 413


@pytest.mark.slow
@pytest.mark.parametrize("target", ["/api/choices", "/api/settings"])
def test_a_gigabyte_without_a_length_is_cut_off_early(lab, target):
    kind = "multipart/form-data; boundary=x" if target == "/api/settings" else "application/json"
    headers = (("Content-Length", None), ("Transfer-Encoding", "chunked"), ("Content-Type", kind))
    before = memory(lab)
    start = Try("POST" if "settings" in target else "PUT", target, headers, b"")
    with line_to(lab) as line:
        line.sendall(start.bytes(lab))
        taken = poured(line, b"10000\r\n" + b"x" * 65_536 + b"\r\n")
    assert taken < 30_000_000, taken
    assert memory(lab) - before < 60_000
    assert status(answered(lab, ASKING.bytes(lab))) == 200


def test_a_header_that_comes_byte_by_byte_is_cut_off(lab):
    asked = ASKING.bytes(lab)
    with line_to(lab) as line:
        sent = 0
        try:
            for byte in asked:
                line.sendall(bytes([byte]))
                sent += 1
                time.sleep(0.1)
        except OSError:
            pass
        assert sent < len(asked)


def test_a_connection_that_asked_once_must_ask_again_in_time(lab):
    with line_to(lab) as line:
        line.sendall(ASKING.bytes(lab))
        assert line.recv(65_536).startswith(b"HTTP/1.1 200")
        line.sendall(b"GET /api/pro")
        assert is_closed(line)


def test_a_body_that_never_comes_is_refused(lab):
    with line_to(lab) as line:
        line.sendall(Try(headers=(("Content-Length", "100"),), body=b"{").bytes(lab))
        answer = line.recv(65_536)
        assert status(answer) == 408, answer
        assert is_closed(line)


def test_the_page_and_a_silent_connection_do_not_disturb_each_other(lab):
    """A browser opens connections before it needs them: those are ended late, and quietly."""
    with line_to(lab) as early:
        assert status(answered(lab, ASKING.bytes(lab))) == 200
        early.sendall(ASKING.bytes(lab))
        assert early.recv(65_536).startswith(b"HTTP/1.1 200")


def test_a_live_line_is_opened_by_the_page_and_closed_at_an_oversized_message(lab):
    with lab.live(origin=lab.site.rstrip("/")) as line:
        assert line.recv(timeout=BUSY_S)
        line.send("x" * 60_000)  # taken, and ignored
        line.send("x" * 70_000)
        with pytest.raises(ConnectionClosed) as closed:
            while True:
                line.recv(timeout=BUSY_S)
    assert closed.value.rcvd.code == 1009


@pytest.mark.slow
def test_a_hundred_live_lines_do_not_keep_the_owner_out(lab):
    refused = 0
    with ExitStack() as lines:
        for _ in range(100):
            try:
                lines.enter_context(lab.live())
            except InvalidStatus:
                refused += 1
        assert refused > 80
        assert status(answered(lab, ASKING.bytes(lab))) == 200
    with lab.live() as line:
        assert line.recv(timeout=BUSY_S)
