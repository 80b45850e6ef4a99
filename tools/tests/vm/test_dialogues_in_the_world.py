"""Every dialogue, played on the virtual machine by both builds of the firmware.

Here motors, chains and sled are the world's: they have inertia and friction, and weigh.
"""

import subprocess

import pytest
from dialogue_player import DIALOGUES, ROOT, DialogueError, Player, matches

ELF = ROOT / ".pio/build/megaatmega2560/firmware.elf"
MACHINES = {
    # At the top edge the usual sled pulls usual motors round when they have no power: it sinks.
    "beyond_sheet.nc": {"sled_weight": 80.0},  # [N]
    "driver_error.nc": {"shield": 3},  # the drivers of v1.2 have no pin to complain
}
NAMES = sorted(path.name for path in DIALOGUES.glob("*.nc"))


@pytest.mark.parametrize("name", NAMES)
def test_the_firmware_answers_as_written(name):
    assert Player(name, **MACHINES.get(name, {})).play() > 0


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_the_flashed_program_answers_as_written(name):
    pio = ["flock", ROOT / ".pio", ROOT / ".venv/bin/pio"]
    subprocess.run([*pio, "run", "-s", "-d", ROOT, "-e", "megaatmega2560"], check=True)
    assert Player(name, elf=str(ELF), **MACHINES.get(name, {})).play() > 0


@pytest.mark.slow
@pytest.mark.parametrize("name", ["halts.nc", "probe.nc", "power_cut_anywhere.nc"])
def test_the_flashed_program_answers_so_on_another_shield(name):
    """Motors, spindle and probe hang on other pins there, and other drivers drive."""
    assert Player(name, elf=str(ELF), shield=3).play() > 0


@pytest.mark.parametrize(
    "text", ["<- PCB v1.3 Detected", "<* ok\n~~ on left", "<* ok\n~~ sled X0 Y0 within 0.1"]
)
def test_the_player_notices_what_is_wrong(text, tmp_path, monkeypatch):
    (tmp_path / "wrong.nc").write_text(text)
    monkeypatch.setattr("dialogue_player.DIALOGUES", tmp_path)
    with pytest.raises(DialogueError):
        Player("wrong.nc").play()


def test_a_line_matches_as_on_the_stage():
    assert matches("a 1.25, b", "a 1.20, b within 0.06") and not matches("a 1.3", "a 1 within 0.2")
    assert matches("left 5 of 6", "left #*") and not matches("left", "left #")
    assert matches("whole", "whole") and not matches("whole line", "whole")
