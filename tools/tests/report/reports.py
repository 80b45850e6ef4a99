"""Boards of each kind and their reports, for the tests of the report."""

from __future__ import annotations

import io
import json
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path

from plumb.cli.main import main
from plumb.settings.toml import write_machine_toml
from synthetic import BELIEVED, TRUE, distances_between, grid, marks_on

EXAMPLE = Path(__file__).resolve().parents[3] / "docs/example"


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


def board(folder: Path, marks, *, name="marks.toml", settings=BELIEVED, **head) -> tuple[Path, ...]:
    """Settings and marks as files."""
    machine = folder / "machine.toml"
    write_machine_toml(machine, settings)
    lines = ['frame = "machine"', *(f"{key} = {value}" for key, value in head.items())]
    for mark in marks:
        lines += [
            "\n[[mark]]",
            f"name = {json.dumps(mark.name)}",
            f"target = {list(map(float, mark.target))}",
        ]
        if mark.measured is not None:
            lines.append(f"measured = {[round(float(x), 3) for x in mark.measured]}")
        if mark.sled_weight:
            lines.append(f"sled_weight_n = {mark.sled_weight}")
        if mark.approach:
            lines.append(f"approach = {list(mark.approach)}")
    path = folder / name
    path.write_text("\n".join(lines) + "\n")
    return machine, path


def nine(**how):
    """Nine marks of a machine that sags and stretches more than its settings know."""
    return marks_on(TRUE, BELIEVED, grid(3, 3), **{"noise": 0.3, **how})


def spans(folder: Path) -> tuple[Path, Path]:
    """A board of distances alone."""
    machine = folder / "machine.toml"
    write_machine_toml(machine, BELIEVED)
    marks = marks_on(TRUE, BELIEVED, grid(4, 3), noise=0.3)
    lines = ['frame = "machine"']
    for mark in marks:
        lines += ["[[mark]]", f'name = "{mark.name}"', f"target = {list(map(float, mark.target))}"]
    for each in distances_between(marks).distances:
        lines += [
            "[[distance]]",
            f"between = {json.dumps(each.between)}",
            f"mm = {each.length:.2f}",
        ]
    path = folder / "spans.toml"
    path.write_text("\n".join(lines) + "\n")
    return machine, path
