"""What the kinematics costs on the Mega: cycles and stack, by simulation."""

import json
import re
import shutil
from pathlib import Path

import registry
from commands import ROOT, ToolError, compiled, output
from kept import kept

BENCH = ROOT / "tools/bench"
BUILD = ROOT / ".build/bench"
FIRMWARE = ROOT / ".pio/build/megaatmega2560/firmware.elf"
KINEMATICS = ROOT / "lib/Kinematics/src"
FLOAT = ROOT / "src/board/float.S"  # the firmware's sum, product and quotient
# As PlatformIO builds the firmware.
AVR_FLAGS = [
    "-mmcu=atmega2560",
    "-Os",
    "-flto",
    "-mrelax",
    "-fno-split-wide-types",
    "-fno-move-loop-invariants",
    "-fno-tree-ter",
    "-std=gnu++11",
    "-fno-exceptions",
    "-ffunction-sections",
    "-fdata-sections",
    "-Wl,--gc-sections",
]
# With all effects listed a machine without them pays for each; these are in every machine.
CASE, KEPT = "inverse, sag, stretch and pitch", ("chain_sag", "chain_stretch", "chain_pitch")

Figures = dict[str, tuple[float, ...]]


def measure() -> Figures:
    """Return the median and most cycles of each case, and the deepest stack of each part."""
    BUILD.mkdir(parents=True, exist_ok=True)
    (BUILD / "effect_cases.h").write_text(registry.cases(), encoding="utf-8")
    elf = linked()
    symbols, stack = output("avr-nm", "-C", elf), {}
    for part in ("inverse", "forward"):
        # A function dissolved into its caller would have no stack to measure.
        if not re.search(rf"kinematics::{part}<float>", symbols):
            raise ToolError(f"board_program.cpp: the compiler dissolved {part}() into its caller")
    cases = counted(elf)
    figures: Figures = {name: tuple(case["cycles"][1:]) for name, case in cases.items()}
    short, left_out = registry.only(KEPT)
    few = counted(linked(short))[CASE]["cycles"][1:]
    # Where the compiler happens to do better with the longer list, it costs nothing.
    both = zip(figures[CASE], few, strict=True)
    figures["each absent effect"] = tuple(max(0, round((a - b) / left_out)) for a, b in both)
    for name, case in cases.items():
        part = name.partition(",")[0]
        stack[part] = max(stack.get(part, 0), case["stack"])
    return figures | {f"{part}, stack": (most,) for part, most in stack.items()}


def linked(effects: str = "") -> Path:
    """Return the program of the cases for the Mega; `effects`: another list of effects."""
    elf, kinematics = BUILD / "board_program.elf", KINEMATICS
    if effects:
        elf, kinematics = BUILD / "board_program_other.elf", BUILD / "other_effects"
        shutil.rmtree(kinematics, ignore_errors=True)
        shutil.copytree(KINEMATICS, kinematics)
        (kinematics / "effects.h").write_text(effects, encoding="utf-8")
    includes = [f"-I{folder}" for folder in (kinematics, BENCH, BUILD)]
    names = ("Kinematics", "quadrilateral")
    sources = [BENCH / "board_program.cpp", *(kinematics / f"{name}.cpp" for name in names), FLOAT]
    output("avr-g++", *AVR_FLAGS, *includes, *sources, "-o", elf)
    return elf


def counted(elf: Path) -> dict:
    """Return what the simulator says of the cases of a program."""
    simulator, options = BUILD / "count_cycles", ["-O2", f"-I{BENCH}", f"-I{BUILD}"]
    libraries = ["-lsimavr", "-lelf"]
    compiled(simulator, ["tools/bench/count_cycles.cpp"], options=options, libraries=libraries)
    done = kept([simulator, elf], [elf], elf.name)
    if done.returncode:
        raise ToolError(f"{elf.name}: {done.stderr.strip()}")
    return json.loads(done.stdout.splitlines()[-1])


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
