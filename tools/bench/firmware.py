"""The cost of the firmware: flash, RAM, stack, control tick, lines a second, by simulation."""

from pathlib import Path

from board import FIRMWARE, Figures, sizes
from commands import ROOT, ToolError
from played import played, player

FLASH, RAM, STACK = "the firmware, flash", "the firmware, static RAM", "the firmware, deepest stack"


def measure() -> Figures:
    """Return the bytes of the firmware as built by PlatformIO, and how it keeps time, by playing
    dialogues on simavr.
    """
    program = player()
    dialogues = ("stream.nc", "fast_loop.nc", "hard.nc", "asked.nc", "deepest.nc")
    slow, fast, hard, asked, deepest = (figures_of(program, name) for name in dialogues)
    flash, ram = sizes(FIRMWARE)
    stack = deepest["stack"]
    figures = {
        FLASH: flash,
        RAM: ram,
        STACK: stack,
        "static RAM, deepest stack and a quarter of it": ram + 1.25 * stack,
        "control tick, share of the time at 100 Hz": slow["tick_share_streaming"],
        "the same, three axes with sag, stretch and pitch": most(hard, "tick_share"),
        "the same at 200 Hz": fast["tick_share_streaming"],
        "longest control tick, cycles": slow["longest_tick_streaming"],
        "the same, three axes": most(hard, "longest_tick"),
        "short G1 lines a second": slow["lines_per_second"],
        "the same, three axes with sag, stretch and pitch, lines": hard["lines_per_second"],
        "short G1 lines a second for a sender of Grbl": asked["lines_per_second"],
        "the same with a `?` ten times a second": asked["lines_per_second_asked"],
        "longest wait for the answer to a `?`, ms": asked["longest_answer_ms"],
        "first line after power-on, ms": slow["first_line_ms"],
    }
    return {name: (value,) for name, value in figures.items()}


def most(figures: dict[str, float], name: str) -> float:
    """Return the worse of one long move and short moves."""
    return max(figures[f"{name}_moving"], figures[f"{name}_streaming"])


def figures_of(program: Path, dialogue: str) -> dict[str, float]:
    """Return what the player measures in a dialogue."""
    done = played(program, ROOT / "test/vm/dialogues", dialogue)
    if done.returncode:
        raise ToolError(f"{dialogue}: {done.stderr.strip()}")
    pairs = [line.split() for line in done.stdout.splitlines() if len(line.split()) == 2]
    return {name: float(value) for name, value in pairs}
