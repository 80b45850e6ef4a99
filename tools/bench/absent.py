"""What an effect costs a machine that does not have it: the inverse with it listed and without."""

import re
import shutil

import board
from commands import ToolError, output
from costs import Cycles

ROW = "each absent effect"
CASE = "inverse, sag, stretch and pitch"
KEPT = ("ChainSag", "ChainStretch", "ChainPitch")


def cost(full: Cycles) -> Cycles:
    """Cycles that each absent effect adds to CASE, whose cost with all effects listed is `full`."""
    text = (board.KINEMATICS / "effects.h").read_text(encoding="utf-8")
    short, left_out = shortened(text)
    few = built(short)
    each = ((more - less) / left_out for more, less in zip(full, few, strict=True))
    # Where the compiler happens to do better with the longer list, it costs nothing.
    return Cycles(*(max(0, round(cycles)) for cycles in each))


def shortened(text: str) -> tuple[str, int]:
    """Return the registry with only the effects of CASE, and how many were left out."""
    entries = re.findall(r"At<\d+, \w+>", text)
    kept = [entry for entry in entries if any(f" {name}>" in entry for name in KEPT)]
    if len(kept) != len(KEPT) or len(entries) == len(kept):
        raise ToolError("effects.h: its list of effects is not as absent.py expects it")
    listed = re.compile(r"(?<=Registry<).*?(?=>;)", re.DOTALL)
    return listed.sub(lambda _: ", ".join(kept), text, count=1), len(entries) - len(kept)


def built(effects: str) -> Cycles:
    """CASE measured with another registry."""
    copy = board.BUILD / "few_effects"
    shutil.rmtree(copy, ignore_errors=True)
    shutil.copytree(board.KINEMATICS, copy)
    (copy / "effects.h").write_text(effects, encoding="utf-8")
    elf = board.BUILD / "few_effects.elf"
    sources = [
        board.BENCH / "board_program.cpp",
        copy / "Kinematics.cpp",
        copy / "reach.cpp",
        board.FLOAT,
    ]
    includes = [f"-I{copy}", f"-I{board.BENCH}", f"-I{board.BUILD}"]
    output("avr-g++", *board.AVR_FLAGS, *includes, *sources, "-o", elf)
    cases = board.counted(elf, board.BUILD / "count_cycles")
    return Cycles(*cases[CASE]["cycles"])
