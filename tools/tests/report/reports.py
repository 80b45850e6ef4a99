"""Boards of each kind and their reports, for the tests of the report."""

from __future__ import annotations

import io
import json
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path

from plumb.cli.main import main
from plumb.marks.form import marks_toml
from plumb.marks.read import Measurements
from plumb.settings.machine import write_machine_toml
from synthetic import BELIEVED, TRUE, distances_between, grid, marks_on


def asked(*words) -> dict:
    """The object that a command prints with --json."""
    said = io.StringIO()
    with redirect_stdout(said), redirect_stderr(io.StringIO()):
        main([*map(str, words), "--json"])
    return json.loads(said.getvalue())


def reported(*words, folder: Path) -> tuple[dict, Path]:
    """The object of a report, and its page."""
    path = folder / "report.html"
    answer = asked("report", *words, "-o", path, "--force")
    assert answer.get("written") == [str(path)], answer
    return answer, path


def board(folder: Path, marks, distances=(), *, name="marks.toml", settings=BELIEVED):
    """Settings and marks as files."""
    machine, path = folder / "machine.toml", folder / name
    write_machine_toml(machine, settings)
    path.write_text(marks_toml(Measurements(tuple(marks), tuple(distances))))
    return machine, path


def nine(**how):
    """Nine marks of a machine that sags and stretches more than its settings know."""
    return marks_on(TRUE, BELIEVED, grid(3, 3), **{"noise": 0.3, **how})


def spans(folder: Path) -> tuple[Path, Path]:
    """A board of distances alone."""
    measured = distances_between(marks_on(TRUE, BELIEVED, grid(4, 3), noise=0.3))
    return board(folder, measured.marks, measured.distances, name="spans.toml")
