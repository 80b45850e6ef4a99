"""plumb settings: what is fitted is what is flashed."""

import json
from dataclasses import replace

import numpy as np
import pytest
from plumb.cli.main import main
from plumb.firmware.settings import firmware_numbers, machine_of
from plumb.model.predict import lengths, library
from plumb.settings.toml import machine_toml
from plumb.text.errors import InputError
from published_marks import SETTINGS
from synthetic import TRUE, grid

FULL = replace(
    TRUE,
    effects={
        effect["name"]: {each["name"]: each["typical"] for each in effect["parameters"]}
        for effect in library()
    },
)


@pytest.mark.parametrize("machine", [TRUE, FULL], ids=["three effects", "every effect"])
def test_the_firmware_reads_the_lines_as_the_machine_that_was_fitted(machine):
    numbers = {row.number: float(row.text) for row in firmware_numbers(machine)}
    theirs = machine_of(numbers, sheet=machine.sheet)
    places = grid(7, 5)
    ours, _ = lengths(machine, places)
    paid_out, outcome = lengths(theirs, places)
    assert not outcome.any() and np.abs(ours - paid_out).max() < 0.003


def test_a_size_that_the_firmware_does_not_take_is_refused():
    wild = replace(TRUE, effects={"chain_pitch": {"left": 5.0, "right": 0.0}})
    with pytest.raises(InputError, match="firmware"):
        firmware_numbers(wild)


def test_published_settings_are_left_to_their_own_program(capsys):
    assert main(["settings", str(SETTINGS)]) == 2
    assert "machine.toml" in capsys.readouterr().err


def test_lines_can_be_sent_as_they_are(tmp_path, capsys):
    machine = tmp_path / "machine.toml"
    machine.write_text(machine_toml(TRUE))
    assert main(["settings", str(machine), "--client", "none", "-o", "-"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert all(line.startswith("$") and " " not in line for line in lines)
    assert main(["settings", str(machine), "--json"]) == 0
    assert len(json.loads(capsys.readouterr().out)["settings"]) == len(lines)
