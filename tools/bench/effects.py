"""What each effect costs the board, and how near the judge's mechanics it comes."""

import json
import re
import shutil

import board
import registry
from commands import ToolError, compiled, output
from costs import Costs

BEGIN, END = "<!-- effects: begin; written by tools/bench/run --write -->", "<!-- effects: end -->"
BASE = registry.STEPS["chain_pitch"][0]
EIGEN = board.ROOT / ".pio/libdeps/native/ArduinoEigen/ArduinoEigen"


def table(costs: Costs) -> str:
    """Return the table of all effects, in the registry's order."""
    errors = judge_errors()
    head = (
        "| effect | cycles when present | flash | chain error against the judge | without it "
        "| at the bit, all frames |\n"
        "|---|---|---|---|---|---|"
    )
    rows = [row(name, costs, errors) for name in registry.numbers()]
    note = (
        "Every machine here sags and stretches; the other effects are hidden beside these two.\n"
        "Worst of all examples of an effect over the sheet, in mm.\n"
        "All frames: motors 2.9 to 3.7 m apart and 400 to 760 mm above the sheet.\n"
        "Cycles are the medians' difference. Flash is what a board saves without the effect in\n"
        "the list; it may be negative where the compiler then chooses to inline more."
    )
    return "\n".join([head, *rows, "", note])


def row(name: str, costs: Costs, errors: dict[str, list[float]]) -> str:
    present, absent = registry.STEPS.get(name, (registry.case_of(name), BASE))
    cycles = costs.cycles[present].median - costs.cycles[absent].median
    of_effect = [value for key, value in errors.items() if key.startswith(f"{name}_")]
    if not of_effect:  # the residual patch: the judge has no cause for it
        with_it = without = at_the_bit = "–"
    else:
        with_it = f"{max(value[0] for value in of_effect):.4f}"
        without = f"{max(value[1] for value in of_effect):.2f}"
        at_the_bit = f"{max(value[2] for value in of_effect):.4f}"
    return f"| {name} | {cycles:,} | {flash(name):,} B | {with_it} | {without} | {at_the_bit} |"


def flash(name: str) -> int:
    """Bytes of flash that a board saves without that effect in the list."""
    return built(registry.text()) - built(without(registry.text(), name))


def without(text: str, name: str) -> str:
    """Return the registry without one effect."""
    camel = "".join(word.capitalize() for word in name.split("_"))
    text = re.sub(rf"\s*At<\d+, {camel}>(,|(?=>;))", "", text)
    return text.replace(",>;", ">;")


def built(text: str) -> int:
    """Flash of prepare, inverse and forward with that registry."""
    copy = board.BUILD / "other_effects"
    shutil.rmtree(copy, ignore_errors=True)
    shutil.copytree(board.KINEMATICS, copy)
    (copy / "effects.h").write_text(text, encoding="utf-8")
    elf = board.BUILD / "other_effects.elf"
    includes = [f"-I{copy}", f"-I{board.BENCH}", f"-I{board.BUILD}"]
    sources = [
        board.BENCH / "part_program.cpp",
        copy / "Kinematics.cpp",
        copy / "reach.cpp",
        board.FLOAT,
    ]
    output("avr-g++", *board.AVR_FLAGS, *includes, "-DPARTS=7", *sources, "-o", elf)
    return board.sizes(elf)[0]


def judge_errors() -> dict[str, list[float]]:
    program = board.BUILD / "judge_errors"
    folders = [board.KINEMATICS, board.ROOT / "test/test_effects", board.ROOT / "tools/judge"]
    includes = [f"-I{folder}" for folder in folders]
    judge = sorted((board.ROOT / "tools/judge/reference").glob("*.cpp"))
    sources = [board.BENCH / "judge_errors.cpp", board.KINEMATICS / "Kinematics.cpp", *judge]
    compiled(program, sources, options=["-O2", *includes, "-isystem", EIGEN])
    return json.loads(output(program))


def replaced(text: str, shown: str) -> str:
    """CHANGELOG.md with this table between its marks."""
    before, _, rest = text.partition(BEGIN)
    _, end, after = rest.partition(END)
    if not end:
        raise ToolError(f"CHANGELOG.md: the marks of the effects' table are missing: {BEGIN}")
    return f"{before}{BEGIN}\n{shown}\n{END}{after}"
