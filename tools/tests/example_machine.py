"""The example's machine, its files and measurements; docs/example/README.md describes it."""

from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
EXAMPLE = ROOT / "docs/example"
INI, MARKS, TOML, POCKET = (
    EXAMPLE / name for name in ("groundcontrol.ini", "marks.toml", "machine.toml", "pocket.nc")
)

TRUE_NUMBERS = {"tape_scale.strain": 0.0, "motor_gap": 2980.4, "motor_height": 1069.6}
SIGMAS = {"tape_scale.strain": 0.0001, "motor_gap": 1, "motor_height": 1}


def checked(*names: str) -> list[str]:
    """Words of a command that state these numbers; all of them if none is named."""
    return [
        word
        for name in names or TRUE_NUMBERS
        for word in ("--checked", f"{name}={TRUE_NUMBERS[name]:g}+-{SIGMAS[name]:g}")
    ]
