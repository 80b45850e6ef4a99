"""Every dialogue, played on the virtual machine by both builds of the firmware.

Here motors, chains and sled are the world's: they have inertia and friction, and weigh.
"""

import sys
from pathlib import Path

import dialogue_player
import pytest
from dialogue_player import DIALOGUES, SLED_WEIGHT, DialogueError, Player, matches
from kept import Done, kept, run
from plumb import _judge, _vm

MACHINES = {
    # At the top edge the usual sled pulls usual motors round when they have no power: it sinks.
    "beyond_sheet.nc": {"sled_weight": 80.0},  # [N]
    "driver_error.nc": {"shield": 3},  # the drivers of v1.2 have no pin to complain
}
NAMES = sorted(path.name for path in DIALOGUES.glob("*.nc"))
# What the simulated Mega plays whenever anything changed: motion, a halt, the memory, the probe.
ALWAYS = {"arcs.nc", "halts.nc", "power_cut.nc", "probe.nc"}


@pytest.mark.parametrize("name", NAMES)
def test_the_firmware_answers_as_written(name):
    assert Player(name, **MACHINES.get(name, {})).play() > 0


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=() if name in ALWAYS else pytest.mark.slow) for name in NAMES]
)
def test_the_flashed_program_answers_as_written(elf, name):
    done = played(elf, name, **MACHINES.get(name, {}))
    assert done.returncode == 0, done.stderr


@pytest.mark.slow
@pytest.mark.parametrize("name", ["halts.nc", "probe.nc", "power_cut_anywhere.nc"])
def test_the_flashed_program_answers_so_on_another_shield(elf, name):
    """Motors, spindle and probe hang on other pins there, and other drivers drive."""
    done = played(elf, name, shield=3)
    assert done.returncode == 0, done.stderr


def played(elf: str, name: str, *, sled_weight: float = SLED_WEIGHT, shield: int = 2) -> Done:
    """What the player says of the flashed program; a play that went well is not played again."""
    parts = [dialogue_player.__file__, _vm.__file__, _judge.__file__]
    # Any dialogue may include any of these.
    files = [Path(elf), *map(Path, parts), DIALOGUES / name, *sorted(DIALOGUES.glob("*.inc"))]
    return kept(command(elf, name, sled_weight, shield), files, f"{name}.{shield}")


def command(elf: str, name: str, *machine: float) -> list[str]:
    return [sys.executable, dialogue_player.__file__, name, elf, *map(str, machine)]


def test_what_the_player_cannot_play_fails(elf):
    done = run(command(elf, "absent.nc", SLED_WEIGHT, 2))
    assert done.returncode and "absent.nc" in done.stderr


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
