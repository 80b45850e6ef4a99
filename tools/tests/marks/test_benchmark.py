"""The Calibration Benchmark Test: its pattern, its form, and its score before and after."""

import re
from dataclasses import replace

import numpy as np
import plumb.grid as grids
import pytest
from plumb.grid import pattern
from plumb.marks.benchmark import score_as_cut
from plumb.marks.read import read_marks
from plumb.model.predict import lengths, places
from plumb.settings.toml import machine_toml
from plumb.text.errors import InputError
from synthetic import BELIEVED, SHEET

GRID = grids.PRESETS["benchmark"]
PITCH = replace(
    BELIEVED, motor_gap=2981.0, effects={"chain_pitch": {"left": 0.002, "right": 0.001}}
)
# The example in the text of GroundControl's pull request 576: it says 0.50 for the long distances.
PUBLISHED = """frame = "machine"
[benchmark]
across = [1905, 1905, 1906]
upwards = [899, 901, 900]
"""


def measured_on(machine):
    """The form as it would be filled in for a machine that believes BELIEVED."""
    where = {}
    for name, target in pattern.benchmark_targets().items():
        chains, _ = lengths(BELIEVED, np.array([target]))
        where[name] = places(machine, chains)[0][0]
    lines = ['frame = "machine"', "[benchmark]"]
    for name, spans in pattern.SPANS.items():
        measurements = [float(np.hypot(*(where[a] - where[b]))) for a, b in spans]
        lines.append(f"{name} = {[round(length, 2) for length in measurements]}")
    return "\n".join(lines)


def test_the_pattern_is_the_published_one():
    places_of = pattern.benchmark_targets()
    spans = [
        np.subtract(places_of[b], places_of[a])
        for spans_of in (pattern.ACROSS_SPANS, pattern.UPWARDS_SPANS)
        for a, b in spans_of
    ]
    assert [abs(span[0]) for span in spans] == [1905] * 3 + [0] * 3
    assert [abs(span[1]) for span in spans] == [0] * 3 + [900] * 3
    # Corners of the published G-code's squares and ticks.
    for corner in [
        (-952.5, -350),
        (-852.5, 450),
        (852.5, -450),
        (952.5, 350),
        (0, -450),
        (-50, 50),
    ]:
        assert corner in places_of.values()
    for name in pattern.CORNERS:
        for end in "xy":
            assert np.ptp([places_of[name], places_of[name + end]], axis=0).sum() == 100


def test_the_program_touches_every_mark_once_in_the_usual_way():
    text = grids.program(GRID, grids.PlainMachine())
    assert text.count("G1 Z-0.5") == 19
    for x, y in pattern.benchmark_targets().values():
        assert f"at x {x:.1f} y {y:.1f})" in text
    with pytest.raises(grids.GridError, match="outside the sheet: choose another --preset"):
        grids.program(GRID, grids.PlainMachine(sheet_width=1800.0))


def test_the_form_it_writes_can_be_read_once_filled_in(file, tmp_path):
    form = tmp_path / "form.toml"
    assert grids.main(["--preset", "benchmark", "--marks", str(form)]) == 0
    with pytest.raises(InputError, match="has no reading"):
        read_marks(form, sheet=SHEET)
    text = form.read_text()
    for name, spans in pattern.SPANS.items():
        line = re.search(rf"^# {name} =.*$", text, re.MULTILINE)[0]
        numbers = [100.0 if len(spans) == 2 else 1905.0 if name == "across" else 900.0] * len(spans)
        text = text.replace(line, f"{name} = {numbers}")
    measurements = read_marks(file("filled.toml", text), sheet=SHEET)
    assert len(measurements.distances) == 16 and len(measurements.marks) == 19
    assert all(mark.approach == (0.0, 40.0) for mark in measurements.marks)
    assert str(score_as_cut(measurements)) == "0.00-0.00"


def test_the_score_is_that_of_the_published_example(file):
    measurements = score_as_cut(read_marks(file("b.toml", PUBLISHED), sheet=SHEET))
    assert str(measurements) == "0.50-?" and not measurements.complete


@pytest.mark.parametrize(
    ("line", "complaint"),
    [
        ("across = [1905, 1905]", "3 numbers are needed"),
        ("top_left = [100, 100, 100]", "2 numbers are needed"),
        ("top_left = [100, -1]", "a distance is above zero"),
        ("across = [75, 75, 75]", "looks like inches"),
        ("topleft = [100, 100]", "did you mean top_left"),
        ("", "has no reading"),
    ],
)
def test_a_form_that_cannot_be_meant_is_refused(file, line, complaint):
    path = file("b.toml", f'frame = "machine"\n[benchmark]\n{line}\n')
    with pytest.raises(InputError, match=complaint):
        read_marks(path, sheet=SHEET)


def test_the_score_falls_when_the_effect_is_added(ask, run, file):
    machine, marks = file("m.toml", machine_toml(BELIEVED)), file("b.toml", measured_on(PITCH))
    code, compared = ask("compare", machine, marks)
    score = compared["benchmark"]
    assert code == 0 and score["long_count"] == 6 and score["small_count"] == 10
    assert score["long_mm"] > 1.5 and compared["benchmark_left"] == pytest.approx(score, abs=1e-6)
    code, added = ask("add", machine, marks, "--effect", "chain_pitch")
    assert added["benchmark"]["before"] == score
    assert added["benchmark"]["after"]["long_mm"] < 0.1
    assert "Calibration Benchmark Score" in run("compare", machine, marks)[1]
    said = run("add", machine, marks, "--effect", "chain_pitch", "--details")[1]
    assert "to expect when it is cut again" in " ".join(said.split())
