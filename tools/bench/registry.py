"""The registry of effects as its header has it: numbers and names, and the cases that time each."""

import re
from pathlib import Path

HEADER = Path(__file__).resolve().parents[2] / "lib/Kinematics/src/effects.h"
ENTRY = re.compile(r"At<(\d+), (\w+)>")
# Timed one upon the other, as every machine has them: cases.h names these by hand.
STEPS = ("chain_sag", "chain_stretch", "chain_pitch")


def numbers() -> dict[str, int]:
    """Return the first setting of every effect, by the name that files use."""
    text = HEADER.read_text(encoding="utf-8")
    return {
        re.sub(r"(?<!^)(?=[A-Z])", "_", name).lower(): int(number)
        for number, name in ENTRY.findall(text)
    }


def cases() -> str:
    """Return lines of a table of cases (see cases.h): each effect that no step times."""
    lines = [
        f'{{"inverse, the same and {name}", kInverse, kSagStretchPitch, kUsual, {number}}},\n'
        for name, number in numbers().items()
        if name not in STEPS
    ]
    return "// Written by registry.py.\n" + "".join(lines)
