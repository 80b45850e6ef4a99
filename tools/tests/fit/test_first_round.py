"""The first round of a new owner: the grid's form, filled in, is read and diagnosed."""

import json
import re

import numpy as np
from plumb.cli.main import main
from plumb.cure.machine_file import SETTINGS


def test_the_form_that_the_grid_writes_is_understood_when_filled_in(tmp_path, capsys):
    form, program = tmp_path / "marks.toml", tmp_path / "grid.nc"
    assert main(["grid", "--margin", "150", "--marks", str(form), "--output", str(program)]) == 0
    source, target, lines = np.random.default_rng(3), None, []
    for line in form.read_text().splitlines():
        if line_match := re.match(r"target = \[(\S+), (\S+)\]", line):
            target = np.array([float(line_match[1]), float(line_match[2])])
        if line.startswith("# measured"):
            line = "measured = [{:.1f}, {:.1f}]".format(*target + 0.4 * source.standard_normal(2))
        lines.append(line)
    form.write_text("\n".join(lines))
    capsys.readouterr()
    assert main(["compare", str(SETTINGS), str(form), "--json"]) == 0
    compared = json.loads(capsys.readouterr().out)
    assert 0.2 < compared["rms_mm"] < 2.0
    assert main(["diagnose", str(SETTINGS), str(form), "--json"]) in (0, 1)
    report = json.loads(capsys.readouterr().out)
    assert report["sigma_from"] == "marks" and 0.2 < report["sigma_mm"] < 0.6
