"""The cost of the kinematics on the Mega: cycles, by simulation."""

import json
import re
from pathlib import Path

from commands import ROOT, ToolError, compiled, output
from kept import kept

BENCH = ROOT / "tools/bench"
BUILD = ROOT / ".build/bench"
FIRMWARE = ROOT / ".pio/build/megaatmega2560/firmware.elf"
KINEMATICS = ROOT / "lib/Kinematics/src"
FLOAT = ROOT / "src/board/float.S"  # the firmware's sum, product and quotient
# An effect in the registry: the number of its first setting, and its type.
ENTRY = re.compile(r"At<(\d+), (\w+)>")
# Timed one upon the other, as every machine has them: cases.h names these by hand.
STEPS = ("ChainSag", "ChainStretch", "ChainPitch")
SIMULATED_BOARD = "tools/vm/mega/virtual_board.cpp"
# Linked into a program, the simulator is a part of what a kept answer is known by.
SIMAVR = ("-l:libsimavr.a", "-lelf")
# As PlatformIO builds the firmware, with what its build_flags say.
AVR_FLAGS = [
    "-mmcu=atmega2560",
    "-Os",
    "-flto",
    "-std=gnu++11",
    "-fno-exceptions",
    "-ffunction-sections",
    "-fdata-sections",
    "-Wl,--gc-sections",
]
BUILD_FLAGS = re.compile(r"^build_flags = (-\w.*)$", re.MULTILINE)

Figures = dict[str, tuple[float, ...]]


def measure() -> Figures:
    """Return the median and most cycles of each case."""
    BUILD.mkdir(parents=True, exist_ok=True)
    (BUILD / "effect_cases.h").write_text(effect_cases(), encoding="utf-8")
    return counted(linked())


def effect_cases() -> str:
    """Return lines of a table of cases (see cases.h): each effect that no step times."""
    entries = ENTRY.findall((KINEMATICS / "effects.h").read_text(encoding="utf-8"))
    lines = [
        f'{{"inverse, the same and {_file_name(effect)}", kInverse, kSagStretchPitch, kUsual, '
        f"{number}}},\n"
        for number, effect in entries
        if effect not in STEPS
    ]
    return "// Written by board.py.\n" + "".join(lines)


def _file_name(effect: str) -> str:
    return re.sub(r"(?<!^)(?=[A-Z])", "_", effect).lower()


def linked() -> Path:
    """Return the program of the cases for the Mega."""
    elf = BUILD / "board_program.elf"
    includes = [f"-I{folder}" for folder in (KINEMATICS, BENCH, BUILD)]
    names = ("Kinematics", "quadrilateral")
    sources = [BENCH / "board_program.cpp", *(KINEMATICS / f"{name}.cpp" for name in names), FLOAT]
    flags = BUILD_FLAGS.findall((ROOT / "platformio.ini").read_text(encoding="utf-8"))[0].split()
    output("avr-g++", *AVR_FLAGS, *flags, *includes, *sources, "-o", elf)
    return elf


def counted(elf: Path) -> Figures:
    """Return what the simulator says of the cases of a program."""
    simulator, sources = BUILD / "count_cycles", ["tools/bench/count_cycles.cpp", SIMULATED_BOARD]
    options = ["-O2", "-Itools/vm", f"-I{BENCH}", f"-I{BUILD}"]
    compiled(simulator, sources, options=options, libraries=SIMAVR)
    done = kept([simulator, elf], [elf], elf.name)
    if done.returncode:
        raise ToolError(f"{elf.name}: {done.stderr.strip()}")
    cases = json.loads(done.stdout.splitlines()[-1])
    return {name: tuple(cycles) for name, cycles in cases.items()}


def built_firmware() -> Path:
    """Return the firmware, built by PlatformIO."""
    pio = ROOT / ".venv/bin/pio"
    # The tests, which may run at the same time, build it too.
    alone = ["flock", ROOT / ".pio"]
    output(*alone, pio, "run", "--silent", "--project-dir", ROOT, "--environment", "megaatmega2560")
    return FIRMWARE


def sizes(elf: Path) -> tuple[int, int]:
    """Flash and static RAM of a linked program."""
    text, data, bss = map(int, output("avr-size", elf).splitlines()[-1].split()[:3])
    return text + data, data + bss
