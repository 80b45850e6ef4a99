"""compare with several files: the error of each by itself."""

import pytest
from plumb.fit.compare import compare
from plumb.fit.inputs import Inputs
from plumb.marks.read import Measurements, Round, join_measurements
from synthetic import BELIEVED, TRUE, distances_between, grid, marks_on

TARGETS = grid(3, 2)


def marks_alone(name, machine=TRUE):
    marks = marks_on(machine, BELIEVED, TARGETS, noise=0.3, seed=ord(name))
    return Measurements(marks, source=f"{name}.toml", rounds=(Round(date=f"2026-05-0{len(name)}"),))


def both_of(name, machine=TRUE):
    """Marks, and the distances between them."""
    marks = marks_alone(name, machine).marks
    spans = distances_between(marks).distances
    return Measurements(marks, spans, source=f"{name}.toml")


def distances_alone(name):
    marks = marks_on(TRUE, BELIEVED, TARGETS[:3], noise=0.3, seed=ord(name))
    return Measurements(
        distances_between(marks).marks, distances_between(marks).distances, source=f"{name}.toml"
    )


def test_each_file_has_the_errors_of_its_readings_alone():
    parts = [marks_alone("a", BELIEVED), both_of("b"), distances_alone("c")]
    rounds = compare(Inputs(BELIEVED, join_measurements(parts))).rounds
    assert [each.name for each in rounds] == ["a", "b", "c"]
    assert [each.count for each in rounds] == [6, 6, 3]
    assert rounds[0].date == "2026-05-01"
    for part, said in zip(parts, rounds, strict=True):
        alone = compare(Inputs(BELIEVED, part))
        assert said.distance_rms == pytest.approx(alone.distance_rms)
        assert said.rms == (pytest.approx(alone.rms) if alone.marks else None)
    assert rounds[0].distance_rms is None and rounds[2].rms is None
