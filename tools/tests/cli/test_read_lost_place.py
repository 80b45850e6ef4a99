"""`plumb read` from a machine that does not know where its sled is: no place, and the way back."""

import json

import plumb.cli.read as read_command
import pytest
from numbers_machine import NumbersMachine
from plumb.cli.main import main

CUT_OFF = (
    "ALARM: Position Lost. Power was lost before the position was kept. Last known chain lengths: "
    "1650.12, 1651.98 mm. Set them (B06 L R), or set the chains to their marks (B08)."
)
UNSET = "Chain lengths are not known yet: send your settings, then set the chains."
NOWHERE = "Message: Unable to find valid machine position for chain lengths 0.00, 0.00 . Please set"
FOUND = ["Plumb v1.0.0", "position loaded at:", "0.00", "0.00"]


class Greeting(NumbersMachine):
    """A machine that says something at its start, and has no telemetry."""

    def __init__(self, *said):
        super().__init__()
        self.begins = "".join(line + "\r\n" for line in said).encode()

    def read(self):
        said, self.begins = self.begins + super().read(), b""
        return said

    def answer(self, line):
        return [] if line == "B30" else super().answer(line)


@pytest.fixture
def asked(monkeypatch, capsys):
    """The output of `plumb read` for a machine with a greeting."""

    def ask(*greeting, options=()):
        monkeypatch.setattr(read_command, "port_for", str)
        monkeypatch.setattr(read_command, "SerialPort", lambda path: Greeting(*greeting))
        assert main(["read", *options]) == 0
        return capsys.readouterr().out

    return ask


@pytest.mark.parametrize("lost", [CUT_OFF, UNSET, NOWHERE])
def test_a_lost_place_is_reported_in_the_machines_words(asked, lost):
    said = " ".join(asked("Plumb v1.0.0", lost, "ready").split())
    assert f"The machine does not know where its sled is. It says: {lost}" in said
    assert "plumb recover --at" in said and "B06 or B08" in said and "G10 Z0" in said
    assert "The sled is at" not in said
    answer = json.loads(asked("Plumb v1.0.0", lost, options=["--json"]))
    assert answer["place"] is None and answer["lost"] == lost


def test_a_machine_that_knows_its_place_shows_it(asked):
    said = asked(*FOUND)
    assert "The sled is at x 0.00, y 0.00, the bit at z 0.00 mm." in said
    assert "does not know" not in said
    answer = json.loads(asked(*FOUND, options=["--json"]))
    assert answer["place"] == [0, 0, 0] and answer["lost"] is None
