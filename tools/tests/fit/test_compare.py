"""compare and shape: how far marks lie from where settings predict them, file by file."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from plumb.fit.compare import best_pose, compare
from plumb.fit.inputs import Inputs
from plumb.marks.read import Mark, Measurements, Round, join_measurements, read_marks
from plumb.settings.files import changed_ini, groundcontrol_changes, read_settings
from plumb.text.errors import InputError
from published_marks import MARKS, SETTINGS
from synthetic import BELIEVED, TRUE, distances_between, grid, marks_on

DISTANCES = Path(__file__).parents[1] / "data" / "madgrizzle_2018-09-02.toml"
STOCK = read_settings(SETTINGS)
PUBLISHED_MARKS = read_marks(MARKS, sheet=STOCK.sheet)


def test_the_published_marks_are_as_far_off_as_published():
    comparison = compare(Inputs(STOCK, PUBLISHED_MARKS))
    assert comparison.rms == pytest.approx(7.29, abs=0.02)
    assert comparison.worst == pytest.approx(14.94, abs=0.02)
    assert comparison.shape_rms == pytest.approx(4.07, abs=0.02)
    assert comparison.distances == () and comparison.distance_rms is None


def test_the_true_settings_explain_marks_that_others_cut():
    marks = Measurements(marks_on(TRUE, BELIEVED, grid(5, 3)))
    off, near = compare(Inputs(BELIEVED, marks)), compare(Inputs(TRUE, marks, cut_with=BELIEVED))
    assert off.rms > 3 and off.state == "off"
    assert near.rms < 1e-4 and near.state == "near_noise"


def test_the_error_is_measured_less_predicted():
    comparison = compare(
        Inputs(BELIEVED, Measurements((Mark("1", (100.0, 200.0), (101.0, 198.0)),)))
    )
    (mark,) = comparison.marks
    assert mark.predicted == pytest.approx((100, 200), abs=1e-4)
    assert mark.error == pytest.approx((1, -2), abs=1e-4)
    assert mark.length == pytest.approx(np.sqrt(5), abs=1e-4)
    assert comparison.shape_rms is None and comparison.shift is None


def test_the_shape_forgets_shift_and_turn_and_nothing_else():
    places = grid(4, 3)
    cosine, sine = np.cos(0.1), np.sin(0.1)
    turned = places @ np.array([[cosine, sine], [-sine, cosine]]) + [30.0, -20.0]
    pose = best_pose(places, turned)
    assert pose.rotation == pytest.approx(0.1)
    assert pose.shift == pytest.approx((30.0, -20.0))
    assert np.abs(pose.errors).max() < 1e-9
    assert np.abs(best_pose(places, 1.001 * turned).errors).max() > 1


def test_distances_are_compared_as_published():
    comparison = compare(Inputs(STOCK, read_marks(DISTANCES, sheet=STOCK.sheet)))
    assert comparison.rms == comparison.distance_rms == pytest.approx(2.82, abs=0.005)
    assert comparison.worst == pytest.approx(6.6, abs=0.01)
    assert comparison.marks == () and comparison.shape_rms is None
    first = comparison.distances[0]
    assert first.between == ("0", "1") and first.measured == 1031.5
    assert first.error == pytest.approx(first.measured - first.predicted)


def test_beside_marks_distances_have_their_own_rms():
    marks = marks_on(TRUE, BELIEVED, grid(3, 2))
    both = Measurements(marks, distances_between(marks).distances)
    comparison = compare(Inputs(BELIEVED, both))
    assert comparison.rms == compare(Inputs(BELIEVED, Measurements(marks))).rms
    assert comparison.distance_rms == compare(Inputs(BELIEVED, distances_between(marks))).rms


def test_new_published_settings_are_compared_with_old_marks(tmp_path):
    path = tmp_path / "groundcontrol.ini"
    values = groundcontrol_changes(replace(BELIEVED, motor_gap=2985.0)).values
    path.write_bytes(changed_ini(SETTINGS, values))
    comparison = compare(Inputs(read_settings(path), PUBLISHED_MARKS, cut_with=STOCK))
    alone = compare(Inputs(STOCK, PUBLISHED_MARKS))
    assert comparison.rms < alone.rms - 2


def test_our_settings_with_marks_of_another_controller_are_warned_of():
    stock = replace(PUBLISHED_MARKS, controller="stock")
    assert "--cut-with" in compare(Inputs(BELIEVED, stock)).warnings[0]
    assert compare(Inputs(BELIEVED, stock, cut_with=STOCK)).warnings == ()
    assert compare(Inputs(STOCK, stock)).warnings == ()
    assert compare(Inputs(BELIEVED, stock, controller="plumb")).warnings == ()
    named = replace(stock, rounds=(Round(cut_with=BELIEVED),))
    assert compare(Inputs(BELIEVED, named)).warnings == ()


def test_chains_that_lead_nowhere_are_refused_with_the_mark():
    wide = replace(BELIEVED, motor_gap=5000.0)
    marks = Measurements((Mark("left", (-900.0, 0.0), (-900.0, 0.0)),), source="marks.csv")
    with pytest.raises(InputError, match=r"^marks\.csv, mark left: .*--cut-with"):
        compare(Inputs(wide, marks, cut_with=BELIEVED))


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
    return replace(distances_between(marks), source=f"{name}.toml")


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
