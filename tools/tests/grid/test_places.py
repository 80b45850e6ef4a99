"""`plumb grid`: marks at given places, and forms that wait for distances."""

import re
import tomllib

import numpy as np
import pytest


def test_only_the_given_places_are_cut_in_their_order(run):
    code, said, _ = run("grid", "--places=-900.5,400 900,420 0,-400")
    assert code == 0 and "(pattern: places, 3 marks with repeats)" in said
    cut = [line for line in said.splitlines() if line.startswith("G1 X")]
    assert cut == ["G1 X-900.5 Y400 F700", "G1 X900 Y420 F700", "G1 X0 Y-400 F700"]


@pytest.mark.parametrize(
    ("words", "hint"),
    [
        (["--places=0,0 0,700"], "mark 2 at x 0.0 y 660.0 is outside the sheet"),
        (["--places=0,0", "--margin", "3"], "--margin is of marks in columns and rows"),
    ],
)
def test_impossible_places_are_refused(words, hint, run):
    code, said, complaint = run("grid", *words)
    assert code == 2 and said == "" and hint in complaint


def test_a_form_waits_for_sides_diagonals_and_halves(tmp_path, run):
    form, cut = tmp_path / "form.toml", tmp_path / "cut.nc"
    words = ["--preset", "distances", "--marks", str(form), "--output", str(cut)]
    code, _, complaint = run("grid", *words)
    assert code == 0, complaint
    listed = tomllib.loads(re.sub(r"^# (?=\[\[dist|between)", "", form.read_text(), flags=re.M))
    place = {mark["name"]: np.array(mark["target"]) for mark in listed["mark"]}
    middles = [
        np.add(*(place[name] for name in span["between"])) / 2 for span in listed["distance"]
    ]
    assert len({tuple(sorted(span["between"])) for span in listed["distance"]}) == 12
    # Sides, diagonals and halves lie evenly: left and right, above and below.
    assert np.allclose(np.mean(middles[:8], axis=0), place["5"])
    lengths = [
        np.ptp([place[name] for name in span["between"]], axis=0) for span in listed["distance"]
    ]
    width, height = place["9"] - place["1"]
    assert np.allclose(lengths[:4], [(width, 0), (0, height)] * 2)
    assert np.allclose(lengths[4:8], [(width, height)] * 2 + [(0, height), (width, 0)])
    assert np.allclose(lengths[8:], [(width / 2, 0)] * 3 + [(0, height / 2)])
