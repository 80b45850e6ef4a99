"""GroundControl's and WebControl's ways with a serial port: how each opens it, what it asks first,
how it streams a job, stops, pauses, and measures chains.

The clock is the machine's: its time passes while a client listens or waits. What clients do was
watched on their code at this port; none of that code is here. How they use DTR and parity is in
test_serial_port.py.
"""

import re
import sys
from pathlib import Path

import pytest
import serial
from plumb.vm.garage import InProcessPort, VirtualOwner, hide, random_garage, set_up
from plumb.vm.pseudo_terminal import PseudoTerminal

AHEAD = 126  # characters that a client sends without an answer
READ_FOR = 250  # [ms] after which a client takes what came for a line
SPACING = 50  # [ms] between two lines of a client
LOOK_EVERY = 5  # [ms] a client looks for what came
JOB = ["G21 ", "G90 ", "G0 X30 Y20 ", "G1 X40 Y20 F1000 ", "G2 X40 Y30 I0 J5 ", "", "(a comment) "]
JOB += [f"G1 X{40 - 2 * step} Y{30 - step} " for step in range(9)] + ["G4 P200 ", "G0 X20 Y10 "]
# What both send to calibrate: chains measured, a motor driven, single axes moved, chains declared.
CALIBRATION = ["$42=2000 ", "B11 S100 T1 R ", "$42=2.0 ", "G91 ", "B09 L5 ", "B09 R-5 ", "G90 "]
PER_SECOND = 5  # reports of the machine
# What the machine sent in these sessions before it knew the dialect of Grbl. Changed by hand since:
# `Grbl v1.00` is gone, because bCNC stops at it, the version is 1.0.0, and $78 is new. Where these
# bytes are meant to change, `python tools/tests/vm/test_clients.py` writes them again.
RECORDED = Path(__file__).resolve().parents[1] / "data/sessions"
REPORTS = ("<", "[PE:")
NUMBER = re.compile(r"-?\d+(\.\d+)?")
STOPPED_WITHIN = 0.2  # [mm] a stop comes somewhere between two ticks
PLACE = re.compile(r"MPos:([-\d.]+),([-\d.]+),([-\d.]+),WPos:")


class Client:
    """A client at the port: it counts answers as both clients do, and keeps what it heard."""

    def __init__(self, terminal: PseudoTerminal, openings: int, silence: float):
        """silence [s] after which the client gives up."""
        self.terminal, self.silence = terminal, silence
        self.now = 0  # [ms] since the client began
        self.line = self.opened()
        for _ in range(openings - 1):
            self.line.close()
            self.line = self.opened()
        self.came = b""  # and is no whole line yet
        self.waiting: list[int] = []  # lengths of the lines that are not answered
        self.answers = 0
        self.heard: list[str] = []
        self.last_line = self.now

    def opened(self) -> serial.Serial:
        line = serial.Serial(self.terminal.path, 57600, timeout=0)
        self.wait(SPACING)
        return line

    def wait(self, milliseconds: int) -> None:
        """Let time pass."""
        self.terminal.pass_time(milliseconds)
        self.now += milliseconds

    def read_line(self) -> bytes:
        """The characters until a line is whole or the client no longer waits for its end."""
        end = self.now + READ_FOR
        while b"\n" not in self.came and self.now < end:
            self.wait(LOOK_EVERY)
            self.came += self.line.read(4096)
        line, newline, self.came = self.came.partition(b"\n")
        return line + newline

    def hear(self) -> str:
        """The next line, or nothing; it must be whole and come before the client gives up."""
        raw = self.read_line()
        if not raw:
            assert self.now - self.last_line < 1000 * self.silence, self.heard[-5:]
            return ""
        self.last_line = self.now
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
        self.wait(SPACING)
        self.line.write(raw)

    def press(self, character: str) -> None:
        """A button: its character goes at once, and the next answer is for it."""
        self.waiting.insert(0, len(character) + 1)
        self.line.write(f"{character}\n".encode())

    def ask(self, text: str) -> list[str]:
        """The machine's lines until the line is answered."""
        first = len(self.heard)
        self.say(text)
        self.settle()
        return self.heard[first:]

    def settle(self) -> None:
        """Hears until every line is answered."""
        while self.waiting:
            self.hear()

    def hear_until(self, start: str) -> str:
        """The next line that begins so."""
        while not (text := self.hear()).startswith(start):
            pass
        return text

    def hear_for(self, seconds: float) -> None:
        """Hears so long a time of the machine."""
        for _ in range(round(seconds * PER_SECOND)):
            self.hear_until("<")

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


def greet_as_groundcontrol(terminal: PseudoTerminal) -> Client:
    """It opens twice and drops DTR, sends ctrl-X at once, and asks when an answer came."""
    client = Client(terminal, openings=3, silence=2)
    client.line.write(b"\x18\n")
    while client.answers == 0:
        client.hear()
    assert len([text for text in client.ask("$$") if text.startswith("$")]) > 40
    client.ask("B05 ")
    client.ask("G21 ")
    return client


def greet_as_webcontrol(terminal: PseudoTerminal) -> Client:
    """It opens with and without parity and says nothing until the machine said ok."""
    client = Client(terminal, openings=4, silence=5)
    while client.answers == 0:
        client.hear()
    client.ask("B05 ")
    client.ask("G20 ")
    assert len([text for text in client.ask("$$") if text.startswith("$")]) > 40
    return client


GREETINGS = {"groundcontrol": greet_as_groundcontrol, "webcontrol": greet_as_webcontrol}


def opened_terminal() -> PseudoTerminal:
    """The port of a machine whose time the client lets pass."""
    owner = VirtualOwner(random_garage(hide([], millimetres=3, seed=1), 1))
    set_up(InProcessPort(owner.machine), owner.settings)
    return PseudoTerminal(owner.machine)


def session(client: Client) -> str:
    """Whatever the machine sends to a client at work: a line for each of its lines."""
    for text in [*JOB, "M0 "]:
        client.say(text)
    client.hear_until("Maslow Paused")
    client.press("~")
    client.settle()
    client.rest()
    client.say("G1 X400 Y10 F600 ")
    client.hear_for(1.5)
    client.line.write(b"!")
    client.waiting.clear()
    client.rest()
    for text in ["G0 X0 Y0 ", "B10 L ", *CALIBRATION, "B15 ", "B08 ", "$15=900 ", "M3 ", "M5 "]:
        client.ask(text)
    client.say("G1 X10 Y nonsense ")
    client.hear_until("ALARM")
    client.waiting.clear()
    client.line.write(b"!")
    client.rest()
    return "".join(f"{text}\n" for text in client.heard)


@pytest.fixture
def terminal():
    terminal = opened_terminal()
    yield terminal
    terminal.close()


def shape(line: str) -> str:
    """The line with its numbers of a machine in motion left open, but for their decimals."""
    if line.startswith("$"):
        return line
    return NUMBER.sub(lambda number: "#" + "0" * len(number[1] or ""), line)


def numbers(lines: list[str]) -> list[float]:
    """All numbers in the order in which they were sent."""
    return [float(number[0]) for line in lines for number in NUMBER.finditer(line)]


@pytest.mark.parametrize("name", GREETINGS)
def test_a_client_gets_the_lines_that_were_recorded(name, terminal):
    client = GREETINGS[name](terminal)
    came = session(client).splitlines()
    client.line.close()
    recorded = (RECORDED / f"{name}.txt").read_text(encoding="ascii").splitlines()
    answers, old_answers = (
        [line for line in lines if not line.startswith(REPORTS)] for lines in (came, recorded)
    )
    assert [*map(shape, answers)] == [*map(shape, old_answers)]
    assert numbers(answers) == pytest.approx(numbers(old_answers), abs=STOPPED_WITHIN)
    reports, old_reports = (
        [line for line in lines if line.startswith(REPORTS)] for lines in (came, recorded)
    )
    assert {*map(shape, reports)} == {*map(shape, old_reports)}
    assert len(reports) == pytest.approx(len(old_reports), abs=4)


def record() -> None:
    """Write what the machine sends today."""
    for name, greet in GREETINGS.items():
        terminal = opened_terminal()
        client = greet(terminal)
        (RECORDED / f"{name}.txt").write_text(session(client), encoding="ascii")
        client.line.close()
        terminal.close()


if __name__ == "__main__":
    sys.exit(record())
