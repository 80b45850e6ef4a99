"""The firmware as it is flashed, on a simulated Mega: what it answers over its serial port."""

import subprocess
from pathlib import Path

import numpy as np
import pytest
from plumb import _core

ROOT = Path(__file__).resolve().parents[2]
ELF = ROOT / ".pio/build/megaatmega2560/firmware.elf"
BUILD = ROOT / ".build/vm"
TOLERANCE = 0.002  # [mm] a quarter of an encoder count
USUAL_EFFECTS = {160, 170}  # settings that src/default_machine.h does not leave at zero
UNCLEAR = "error: ask L x y or P left right, in mm, below 100000"
TOO_LONG = "error: a line has at most 40 characters"
CORNERS = [(x, y) for x in (-1219.2, 1219.2) for y in (-609.6, 609.6)]
PLACES = [(0.0, 0.0), (100.0, -50.25), *CORNERS]


@pytest.fixture(scope="module")
def asker() -> Path:
    """The program that talks to the simulated board; the firmware is brought up to date too."""
    pio = [ROOT / ".venv/bin/pio", "run", "-s", "-d", ROOT, "-e", "megaatmega2560"]
    subprocess.run(pio, check=True)
    BUILD.mkdir(parents=True, exist_ok=True)
    program = BUILD / "ask_firmware"
    source = ROOT / "test/vm/ask_firmware.cpp"
    strict = ["-std=c++17", "-O2", "-Wall", "-Wextra", "-Werror"]
    command = ["g++", *strict, source, "-lsimavr", "-lelf", "-o", program]
    subprocess.run(command, check=True)
    return program


@pytest.fixture(scope="module")
def values() -> np.ndarray:
    """The default machine by the words of the library, which the firmware wrote down on its own."""
    numbers = [field["usual"] for field in _core.frame()]
    for effect in _core.effects():
        for one in effect["parameters"]:
            numbers.append(one["typical"] if one["setting"] in USUAL_EFFECTS else 0.0)
    return np.array(numbers)


def ask(program: Path, *pairs: str, tolerance: float = TOLERANCE) -> subprocess.CompletedProcess:
    command = [program, ELF, str(tolerance), *pairs]
    return subprocess.run(command, capture_output=True, text=True, timeout=60)


def told(word: str, pair: np.ndarray) -> str:
    return f"{word} {pair[0]:.6f} {pair[1]:.6f}"


def test_lengths_are_those_of_the_lab(asker, values):
    chains, found = _core.lengths(values, True, np.array(PLACES))
    assert not found.any()
    pairs = [(f"L {x} {y}", told("lengths", c)) for (x, y), c in zip(PLACES, chains, strict=True)]
    done = ask(asker, *(word for pair in pairs for word in pair))
    assert done.returncode == 0, done.stdout + done.stderr


def test_places_are_those_that_the_lengths_came_from(asker, values):
    chains, _ = _core.lengths(values, True, np.array(PLACES))
    pairs = [
        (f"P {c[0]:.4f} {c[1]:.4f}", told("place", place))
        for place, c in zip(PLACES, chains, strict=True)
    ]
    # Where the chains are flat a micrometre of chain is several of place.
    done = ask(asker, *(word for pair in pairs for word in pair), tolerance=0.01)
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.parametrize(
    ("question", "answer"),
    [
        ("L 0 2000", "out of reach"),
        ("L -3000 0", "out of reach"),
        ("P 100 100", "out of reach"),
        ("L 0", UNCLEAR),
        ("L 0 0 0", UNCLEAR),
        ("L 0,0 1", UNCLEAR),
        ("L 0 x", UNCLEAR),
        ("L nan 0", UNCLEAR),
        ("L 0 inf", UNCLEAR),
        ("P 1e9 1e9", UNCLEAR),
        ("l 0 0", UNCLEAR),
        ("Lx", UNCLEAR),
        ("x" * 40, UNCLEAR),
        ("x" * 41, TOO_LONG),
        ("L" + " " * 1000 + "0 0", TOO_LONG),
    ],
)
def test_what_cannot_be_answered_is_said_so_and_the_next_is_answered(
    asker, values, question, answer
):
    chains, _ = _core.lengths(values, True, np.zeros((1, 2)))
    done = ask(asker, question, answer, "\r\n\r\nL 0 0", told("lengths", chains[0]))
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_asker_notices_a_wrong_answer(asker, values):
    chains, _ = _core.lengths(values, True, np.zeros((1, 2)))
    for wrong in (told("lengths", chains[0] + [0, 0.01]), told("place", chains[0]), "lengths"):
        assert ask(asker, "L 0 0", wrong).returncode == 1
