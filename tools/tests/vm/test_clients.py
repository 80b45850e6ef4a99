"""GroundControl's and WebControl's ways with a serial port, in real time: how each opens it, what
it asks first, how it streams a job and how it stops.

What they do was watched on the clients' code; none of that code is here. A pseudo terminal has no
DTR and no parity, so each opening stands for the reset that the client asks for with either.
"""

import re
import time
from pathlib import Path

import pytest
import serial

AHEAD = 126  # characters that a client sends without an answer
READ_FOR = 0.25  # [s] after which a client takes what came for a line
JOB = ["G21 ", "G90 ", "G0 X30 Y20 ", "G1 X40 Y20 F1000 ", "G2 X40 Y30 I0 J5 ", "", "(a comment) "]
JOB += [f"G1 X{40 - 2 * step} Y{30 - step} " for step in range(9)] + ["G4 P200 ", "G0 X20 Y10 "]
LASTS = 90  # [s] at most, on a busy computer
PLACE = re.compile(r"MPos:([-\d.]+),([-\d.]+),([-\d.]+),WPos:")


class Client:
    """A client at the port: it counts answers as both clients do, and keeps what it heard."""

    def __init__(self, path: Path, openings: int, silence: float):
        self.path, self.silence = str(path), silence
        self.line = self.opened()
        for _ in range(openings - 1):
            self.line.close()
            self.line = self.opened()
        self.waiting: list[int] = []  # lengths of the lines that are not answered
        self.answers = 0
        self.heard: list[str] = []
        self.last_line = time.monotonic()
        self.end = self.last_line + LASTS

    def opened(self) -> serial.Serial:
        return serial.Serial(self.path, 57600, timeout=READ_FOR)

    def hear(self) -> str:
        """The next line, or nothing; it must be whole and come before the client gives up."""
        raw = self.line.readline()
        assert time.monotonic() < self.end, f"no answer: {self.heard[-5:]}"
        assert time.monotonic() - self.last_line < self.silence
        if not raw:
            return ""
        self.last_line = time.monotonic()
        assert raw.endswith(b"\r\n"), raw
        text = raw.decode("ascii").strip()
        self.heard.append(text)
        if raw == b"ok\r\n" or text.startswith("error:"):
            self.answers += 1
            if self.waiting:
                self.waiting.pop(0)
        return text

    def say(self, text: str) -> None:
        """A line, as soon as there is room for it in the machine's buffer."""
        raw = f"{text} \n".encode()
        while sum(self.waiting) + len(raw) > AHEAD:
            self.hear()
        self.waiting.append(len(raw))
        self.line.write(raw)

    def ask(self, text: str) -> list[str]:
        """What the machine says until the line is answered."""
        first = len(self.heard)
        self.say(text)
        self.settle()
        return self.heard[first:]

    def settle(self) -> None:
        """Hears until every line is answered."""
        while self.waiting:
            self.hear()

    def hear_for(self, seconds: float) -> None:
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            self.hear()

    def rest(self) -> tuple[float, float]:
        """[mm] The place, when the reports of a second no longer change it."""
        self.hear_for(1)
        before, now = None, self.place()
        while now != before:
            self.hear_for(1)
            before, now = now, self.place()
        return now

    def place(self) -> tuple[float, float]:
        """[mm] What the newest report says."""
        places = [PLACE.search(text) for text in self.heard if text.startswith("<")]
        newest = places[-1]
        assert newest is not None
        return float(newest[1]), float(newest[2])


def greet_as_groundcontrol(path: Path) -> Client:
    """It opens twice and drops DTR, sends ctrl-X at once, and asks when an answer came."""
    client = Client(path, openings=3, silence=2)
    client.line.write(b"\x18\n")
    while client.answers == 0:
        client.hear()
    assert len([text for text in client.ask("$$") if text.startswith("$")]) > 40
    client.ask("B05 ")
    client.ask("G21 ")
    return client


def greet_as_webcontrol(path: Path) -> Client:
    """It opens with and without parity and says nothing until the machine said ok."""
    client = Client(path, openings=4, silence=5)
    while client.answers == 0:
        client.hear()
    client.ask("B05 ")
    client.ask("G20 ")
    assert len([text for text in client.ask("$$") if text.startswith("$")]) > 40
    return client


@pytest.fixture(params=[greet_as_groundcontrol, greet_as_webcontrol])
def client(request, served, tmp_path):
    served("--speed", "1")
    client = request.param(tmp_path / "maslow")
    yield client
    client.line.close()


def test_a_client_connects_streams_a_job_and_stops_it(client):
    versions = [text for text in client.heard if text.startswith("Firmware Version")]
    assert [float(text.split()[-1]) for text in versions] == [1.28]
    answered = client.answers
    for text in JOB:
        client.say(text)
    client.settle()
    place = client.rest()
    assert client.answers - answered == len(JOB)
    assert place == pytest.approx((20, 10), abs=0.05)
    # Stop in a move: a single answer, what was sent is forgotten, and the place is known.
    client.say("G1 X400 Y10 F600 ")
    client.hear_for(1.5)
    answered = client.answers
    client.line.write(b"!")
    client.waiting.clear()
    x, y = client.rest()
    assert client.answers - answered == 1
    assert 22 < x < 80
    assert y == pytest.approx(10, abs=0.1)
    client.ask("G0 X20 Y10 ")
    assert client.rest() == pytest.approx((20, 10), abs=0.05)
    assert not any(text.startswith(("ALARM", "error")) for text in client.heard)
