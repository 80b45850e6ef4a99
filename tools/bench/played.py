"""Dialogues on the simulated Mega, and the programs that play them."""

from collections.abc import Sequence
from pathlib import Path

from board import FIRMWARE, SIMAVR, SIMULATED_BOARD, built_firmware
from commands import ROOT, compiled
from kept import Done, kept, run

BUILD = ROOT / ".build/vm"
STRICT = ("-O2", "-Wall", "-Wextra", "-Werror", "-Itools/vm")


def player() -> Path:
    """Return the program that plays dialogues and measures the firmware, which is built too."""
    built_firmware()
    return player_program("play_dialogue", "test/vm/play_dialogue.cpp")


def player_program(name: str, *sources: str) -> Path:
    """Return a program around the player of dialogues, the world and the simulated Mega."""
    player = [
        "test/vm/mega_player.cpp",
        "test/test_dialogues/player.cpp",
        "test/test_dialogues/player_questions.cpp",
        "tools/vm/brain/mega_brain.cpp",
        "tools/vm/world/world.cpp",
        SIMULATED_BOARD,
        *(_from_root(path) for path in sorted(ROOT.glob("tools/judge/reference/*.cpp"))),
    ]
    folders = ["src", "test", "tools/vm/host_avr", "tools/judge", *libraries()]
    includes = [f"-I{folder}" for folder in folders]
    return _built(name, [*sources, *player], [*includes, "-isystem", "/usr/include/eigen3"])


def libraries() -> list[str]:
    """Return the folders of lib/ that hold headers."""
    return [_from_root(path) for path in sorted(ROOT.glob("lib/*/src"))]


def check_board() -> Path:
    """Return the program that runs an ELF file for a while and prints what it says."""
    return _built("check_board", ["test/vm/check_board.cpp", SIMULATED_BOARD])


def play(program: Path, folder: Path, name: str) -> Done:
    """Return what the player of a dialogue says of the flashed program."""
    return run([program, FIRMWARE, folder, name])


def played(program: Path, folder: Path, name: str) -> Done:
    """Return the same; a play that went well is not played again."""
    # Any dialogue may include any of these.
    files = [FIRMWARE, folder / name, *sorted(folder.glob("*.inc"))]
    return kept([program, FIRMWARE, folder, name], files, name)


def ran(program: Path, elf: Path, *arguments: str) -> Done:
    """Return what a program of ours, flashed in place of the firmware, says; kept likewise."""
    return kept([program, elf, *arguments], [elf], elf.name)


def _built(name: str, sources: list[str], options: Sequence[str] = ()) -> Path:
    return compiled(BUILD / name, sources, options=[*STRICT, *options], libraries=SIMAVR)


def _from_root(path: Path) -> str:
    return str(path.relative_to(ROOT))
