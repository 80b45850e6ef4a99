"""Any two events at once on the flashed program: nothing moves that the table of states does not
say, and afterwards the place is true or unknown.

The host's build of the firmware is held to the same law in test/test_dialogues.
"""

import re
import struct
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from example_machine import ROOT

sys.path.insert(0, str(ROOT / "tools/bench"))
from board import FIRMWARE, built_firmware
from commands import output
from kept import kept
from played import BUILD, libraries, player_program

EVENTS = 12


def pair_player() -> Path:
    """Return the program that plays any two events at once with the flashed program.

    It looks at the machine in the Mega's RAM: see ram_places().
    """
    built_firmware()
    parts = ("axes", "axes_lengths", "axes_power", "course", "ticked_axis")
    machine = [f"src/machine/{part}.cpp" for part in parts]
    law = "test/test_dialogues/two_events.cpp"
    return player_program("play_two_events", "test/vm/play_two_events.cpp", law, *machine)


def ram_places() -> list[int]:
    """Addresses in the RAM of the firmware as built, in the order that the pair player asks for."""
    made, dump = BUILD / "ram_places.o", BUILD / "ram_places.bin"
    BUILD.mkdir(parents=True, exist_ok=True)
    includes = ["-Isrc", *(f"-I{folder}" for folder in libraries())]
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


@pytest.mark.slow
def test_two_events_move_nothing_that_the_table_does_not_say():
    player = pair_player()
    places = [str(place) for place in ram_places()]

    def play(first):
        command = [player, FIRMWARE, str(first), *places]
        return kept(command, [FIRMWARE], f"two_events_{first}")

    with ThreadPoolExecutor(2) as pool:
        ends = list(pool.map(play, range(EVENTS)))
    assert [end.stderr for end in ends if end.returncode] == []
    looks = [dict(line.split() for line in end.stdout.splitlines()) for end in ends]
    # The law was looked at: where all stands with power, and where the place is known at the end. A
    # power cut in motion leaves it unknown.
    assert min(int(each["still"]) for each in looks) > 1000, looks
    assert sum(int(each["place"]) > 0 for each in looks) >= EVENTS - 1, looks
