"""What the whole firmware costs: flash, RAM, stack, control tick, lines a second, by simulation."""

import re
from pathlib import Path

import board
from commands import ToolError, output
from played import played, player

BEGIN = "<!-- firmware: begin; written by tools/bench/run --write -->"
END = "<!-- firmware: end -->"
VM = board.ROOT / "test/vm"
# Row: what it must not exceed (or, for lines, fall below), and how it is shown.
RAM = 8192
BUDGETS = {
    # docs/decisions/0010-budgets-of-the-firmware.md says why so much.
    "flash": board.budget("maximum_size"),
    "static RAM": board.budget("maximum_ram_size"),
    "static RAM, deepest stack and a quarter of it": RAM,
    "control tick, share of the time at 100 Hz": 0.12,
    "the same, three axes with sag, stretch and pitch": 0.12,
    "short G1 lines a second": 230,
    "the same, three axes with sag, stretch and pitch, lines": 180,
    "the same with a `?` ten times a second": 210,
    "longest wait for the answer to a `?`, ms": 100,
    "first line after power-on, ms": 500,
}
AT_LEAST = {
    "short G1 lines a second",
    "the same, three axes with sag, stretch and pitch, lines",
    "the same with a `?` ten times a second",
}
CLOCK = 16e6  # [Hz]


def measure() -> dict[str, float]:
    """Return the figures of the firmware as built by PlatformIO, by playing dialogues on simavr."""
    sizes = output("avr-size", "-A", board.FIRMWARE)
    size = {name: int(value) for name, value in re.findall(r"^(\.\w+)\s+(\d+)", sizes, re.M)}
    program = player()
    dialogues = ("stream.nc", "fast_loop.nc", "hard.nc")
    slow, fast, hard = (figures_of(program, name) for name in dialogues)
    asked = figures_of(program, "asked.nc")
    ram = size[".data"] + size[".bss"]
    stack = figures_of(program, "deepest.nc")["stack"]
    return {
        "flash": size[".text"] + size[".data"],
        "static RAM": ram,
        "deepest stack": stack,
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
        "a `?` while short lines run, cycles": cycles_of_a_question(asked),
        "longest wait for the answer to a `?`, ms": asked["longest_answer_ms"],
        "first line after power-on, ms": slow["first_line_ms"],
    }


def cycles_of_a_question(figures: dict[str, float]) -> float:
    """Return what a `?` takes from the lines: the time that they lose, by the clock of the Mega."""
    lost = 1 - figures["lines_per_second_asked"] / figures["lines_per_second"]
    return lost * CLOCK / figures["questions_per_second"]


def most(figures: dict[str, float], name: str) -> float:
    """Return the worse of one long move and short moves."""
    return max(figures[f"{name}_moving"], figures[f"{name}_streaming"])


def figures_of(program: Path, dialogue: str) -> dict[str, float]:
    """Return what the player measures in a dialogue."""
    done = played(program, VM / "dialogues", dialogue)
    if done.returncode:
        raise ToolError(f"{dialogue}: {done.stderr.strip()}")
    pairs = [line.split() for line in done.stdout.splitlines() if len(line.split()) == 2]
    return {name: float(value) for name, value in pairs}


def table(figures: dict[str, float]) -> str:
    """Return the figures next to their budgets."""
    rows = [
        f"| {name} | {shown(value)} | {shown(BUDGETS[name]) if name in BUDGETS else '–'} |"
        for name, value in figures.items()
    ]
    note = (
        "Short moves streamed with 126 characters ahead, all three motors on; with three axes the\n"
        "worse of this and one long move, where all three turn. Interrupts of the serial line and\n"
        "the encoders that fall into a tick count as its own."
    )
    return "\n".join(["| the firmware | measured | budget |", "|---|---|---|", *rows, "", note])


def shown(value: float) -> str:
    return f"{value:.1%}" if value < 1 else f"{value:,.0f}"


def over_budget(figures: dict[str, float]) -> list[str]:
    """Return one line for each budget that is not kept."""
    refused = []
    for name, budget in BUDGETS.items():
        value = figures[name]
        if value < budget if name in AT_LEAST else value > budget:
            refused.append(f"{name}: {shown(value)}, the budget is {shown(budget)}")
    return refused


def replaced(text: str, written: str) -> str:
    """Return the text of CHANGELOG.md with the table renewed."""
    before, _, rest = text.partition(BEGIN)
    _, end, after = rest.partition(END)
    if not end:
        raise ToolError(f"CHANGELOG.md lacks the marks {BEGIN} and {END}")
    return f"{before}{BEGIN}\n{written}\n{END}{after}"
