"""Dialogues on the simulated Mega, and the programs that play them."""

import re
import struct
from collections.abc import Sequence
from pathlib import Path

from board import FIRMWARE, built_firmware
from commands import ROOT, compiled, output
from kept import Done, kept, run

BUILD = ROOT / ".build/vm"
STRICT = ("-O2", "-Wall", "-Wextra", "-Werror", "-Itools/vm")
# Linked into the program, the simulator is a part of what a kept answer is known by.
LIBRARIES = ("-l:libsimavr.a", "-lelf")
BOARD = "tools/vm/mega/virtual_board.cpp"


def player() -> Path:
    """Return the program that plays dialogues and measures the firmware, which is built too."""
    built_firmware()
    return _player_program("play_dialogue", "test/vm/play_dialogue.cpp")


def pair_player() -> Path:
    """Return the program that plays any two events at once with the flashed program.

    It looks at the machine in the Mega's RAM: see ram_places().
    """
    built_firmware()
    parts = ("axes", "axes_lengths", "axes_power", "course", "ticked_axis")
    machine = [f"src/machine/{part}.cpp" for part in parts]
    law = "test/test_dialogues/two_events.cpp"
    return _player_program("play_two_events", "test/vm/play_two_events.cpp", law, *machine)


def ram_places() -> list[int]:
    """Addresses in the RAM of the firmware as built, in the order that the pair player asks for."""
    made, dump = BUILD / "ram_places.o", BUILD / "ram_places.bin"
    BUILD.mkdir(parents=True, exist_ok=True)
    includes = ["-Isrc", *(f"-I{folder}" for folder in _libraries())]
    options = ["-mmcu=atmega2560", "-Os", "-std=gnu++11", "-fno-access-control"]
    quiet = "-Wno-invalid-offsetof"
    output("avr-g++", *options, quiet, *includes, "-c", "test/vm/ram_places.cpp", "-o", made)
    output("avr-objcopy", "-O", "binary", "-j", ".places", made, dump)
    state, lost, size, *of_axis = struct.unpack("<7H", dump.read_bytes())
    symbols = output("avr-nm", FIRMWARE)
    built, machine = (
        int(re.findall(rf"^(\w+) \w _Z{name}5setupE7machine", symbols, re.M)[0], 16) & 0xFFFF
        for name in ("GVZ", "Z")
    )
    return [built, machine + state, machine + lost, size, *(machine + place for place in of_axis)]


def _player_program(name: str, *sources: str) -> Path:
    """Return a program around the player of dialogues, the world and the simulated Mega."""
    player = [
        "test/vm/mega_player.cpp",
        "test/test_dialogues/player.cpp",
        "test/test_dialogues/player_questions.cpp",
        "tools/vm/brain/mega_brain.cpp",
        "tools/vm/world/world.cpp",
        BOARD,
        *(_from_root(path) for path in sorted(ROOT.glob("tools/judge/reference/*.cpp"))),
    ]
    folders = ["src", "test", "tools/vm/host_avr", "tools/judge", *_libraries()]
    includes = [f"-I{folder}" for folder in folders]
    return _built(name, [*sources, *player], [*includes, "-isystem", "/usr/include/eigen3"])


def _libraries() -> list[str]:
    return [_from_root(path) for path in sorted(ROOT.glob("lib/*/src"))]


def check_board() -> Path:
    """Return the program that runs an ELF file for a while and prints what it says."""
    return _built("check_board", ["test/vm/check_board.cpp", BOARD])


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
    return compiled(BUILD / name, sources, options=[*STRICT, *options], libraries=LIBRARIES)


def _from_root(path: Path) -> str:
    return str(path.relative_to(ROOT))
