"""`plumb grid`: the G-code for calibration marks; the same code as tools/calibration_grid.py."""

from __future__ import annotations

import argparse
import contextlib
import importlib.util
import io
from pathlib import Path
from types import ModuleType

from plumb.cli_text import print_json

HELP = "the G-code for a grid of calibration marks"
EXIT = "Exit: 0 done; 2 the grid cannot be made, and nothing was written."


def _load() -> ModuleType:
    """The tool beside this package; it is a script of its own and no part of the package."""
    path = Path(__file__).resolve().parents[1] / "calibration_grid.py"
    specification = importlib.util.spec_from_file_location("calibration_grid", path)
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    return module


grids = _load()


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb grid`: those of the tool, and --json."""
    grids.add_arguments(parser)
    parser.add_argument("--json", action="store_true", help="print one JSON object and no more")


def run(arguments: argparse.Namespace) -> int:
    """Make the grid as the tool does."""
    if not arguments.json:
        return grids.run(arguments, "plumb")
    said = io.StringIO()
    with contextlib.redirect_stdout(said):
        code = grids.run(arguments, "plumb")
    if code:
        return code
    grid, machine = grids.from_arguments(arguments)
    print_json(
        {
            "program": None if arguments.output else grids.program(grid, machine),
            "marks": [
                {"name": mark.name, "target": [mark.x, mark.y], "visit": mark.visit}
                for mark in grids.marks(grid, machine)
            ],
            "approach": list(grid.approach),
            "written": [path for path in (arguments.output, arguments.marks) if path],
        }
    )
    return 0
