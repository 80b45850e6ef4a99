"""What the kinematics costs on the Mega: cycles and stack by simulation, bytes by the linker."""

import json
import re
from pathlib import Path

import registry
from commands import ROOT, ToolError, compiled, output
from costs import Bytes, Costs, Cycles
from kept import kept

BENCH = ROOT / "tools/bench"
BUILD = ROOT / ".build/bench"
FIRMWARE = ROOT / ".pio/build/megaatmega2560/firmware.elf"
KINEMATICS = ROOT / "lib/Kinematics/src"
MOTION = ROOT / "lib/Motion/src"
FLOAT = ROOT / "src/board/float.S"  # the firmware's sum, product and quotient
INCLUDES = [f"-I{KINEMATICS}", f"-I{BENCH}", f"-I{BUILD}"]
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
# Rows of the table and the sum of parts that part_program.cpp knows them by.
PARTS = {
    "prepare": 1,
    "inverse": 2,
    "forward": 4,
    "reach": 16,
    "all three": 7,
    "constants of one machine": 8,
}


def budget(name: str) -> int:
    """Return a limit of the board in platformio.ini [bytes]."""
    written = (ROOT / "platformio.ini").read_text(encoding="utf-8")
    return int(re.findall(rf"^board_upload\.{name} = (\d+)$", written, re.MULTILINE)[0])


def measure() -> Costs:
    """Build every program and measures it."""
    BUILD.mkdir(parents=True, exist_ok=True)
    compiler = output("avr-gcc", "-dumpversion")
    cycles, stack = simulated()
    cycles.update(two_brackets())
    cycles.update(motion())
    return Costs(f"avr-gcc {compiler}", cycles, {**parts(stack), **firmware(compiler)})


def simulated() -> tuple[dict[str, Cycles], dict[str, int]]:
    """Cycles of every case, and the deepest stack of inverse, of forward and of reach."""
    elf, simulator = BUILD / "board_program.elf", BUILD / "count_cycles"
    (BUILD / "effect_cases.h").write_text(registry.cases(), encoding="utf-8")
    output("avr-g++", *AVR_FLAGS, *INCLUDES, *sources("board_program.cpp"), FLOAT, "-o", elf)
    symbols = output("avr-nm", "-C", elf)
    stack = {}
    for part in ("inverse", "forward", "reach"):
        # A function dissolved into its caller would have no stack to measure.
        if not re.search(rf"kinematics::{part}<float>", symbols):
            raise ToolError(f"board_program.cpp: the compiler dissolved {part}() into its caller")
    cases = counted(elf, simulator)
    for name, cost in cases.items():
        part = name.partition(",")[0]
        stack[part] = max(stack.get(part, 0), cost["stack"])
    return {name: Cycles(*cost["cycles"]) for name, cost in cases.items()}, stack


def two_brackets() -> dict[str, Cycles]:
    """Cycles of every case of quadrilateral_cases.h."""
    elf = BUILD / "quadrilateral_program.elf"
    source = [BENCH / "quadrilateral_program.cpp", KINEMATICS / "quadrilateral.cpp", FLOAT]
    output("avr-g++", *AVR_FLAGS, *INCLUDES, *source, "-o", elf)
    cases = counted(elf, BUILD / "count_quadrilateral", '-DCASES="quadrilateral_cases.h"')
    return {name: Cycles(*cost["cycles"]) for name, cost in cases.items()}


def motion() -> dict[str, Cycles]:
    """Cycles of every case of motion_cases.h."""
    elf = BUILD / "motion_program.elf"
    source = [*sources("motion_program.cpp"), FLOAT]
    output("avr-g++", *AVR_FLAGS, *INCLUDES, f"-I{MOTION}", *source, "-o", elf)
    cases = counted(elf, BUILD / "count_motion_cycles", '-DCASES="motion_cases.h"')
    return {name: Cycles(*cost["cycles"]) for name, cost in cases.items()}


def counted(elf: Path, simulator: Path, *cases: str) -> dict:
    """Return what the simulator, built for these cases, says of a program."""
    options, libraries = ["-O2", *INCLUDES, *cases], ["-lsimavr", "-lelf"]
    compiled(simulator, ["tools/bench/count_cycles.cpp"], options=options, libraries=libraries)
    done = kept([simulator, elf], [elf], elf.name)
    if done.returncode:
        raise ToolError(f"{elf.name}: {done.stderr.strip()}")
    return json.loads(done.stdout.splitlines()[-1])


def parts(stack: dict[str, int]) -> dict[str, Bytes]:
    """Return what each part adds to a program that already has the four operations and the root."""
    base = linked(0)
    sections = {}
    for name, number in PARTS.items():
        flash, ram = (more - less for more, less in zip(linked(number), base, strict=True))
        sections[name] = Bytes(flash, ram, stack.get(name))
    # The harness's way of naming its storage; a machine's constants lie in RAM alone.
    constants = sections["constants of one machine"].ram
    sections["constants of one machine"] = Bytes(None, constants, None)
    return sections


def linked(number: int) -> tuple[int, int]:
    """Flash and static RAM of part_program.cpp with these parts."""
    elf = BUILD / f"part_program_{number}.elf"
    source = [*sources("part_program.cpp"), FLOAT]
    output("avr-g++", *AVR_FLAGS, *INCLUDES, f"-DPARTS={number}", *source, "-o", elf)
    return sizes(elf)


def firmware(compiler: str) -> dict[str, Bytes]:
    """Return the whole firmware as it is flashed; left out if another compiler built it."""
    built_firmware()
    if compiler not in output("avr-readelf", "-p", ".comment", FIRMWARE):
        return {}
    return {"whole firmware": Bytes(*sizes(FIRMWARE), None)}


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


def sources(program: str) -> list[Path]:
    """Return one program of this folder and the kinematics, for any computer."""
    return [BENCH / program, KINEMATICS / "Kinematics.cpp", KINEMATICS / "reach.cpp"]
