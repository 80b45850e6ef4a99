"""Tests of the fits in a diary, and of their history."""

from dataclasses import replace
from datetime import UTC, datetime

import numpy as np
import pytest
from plumb.cure.add import add
from plumb.diary.file import (
    FIT,
    NAME,
    Entry,
    append,
    fit_entry,
    history_of,
    keep,
    noted,
    program_entry,
    read_diary,
)
from plumb.fit.inputs import Inputs
from plumb.marks.read import Measurements
from plumb.settings.machine import machine_toml, read_machine_toml
from plumb.text.values import MM
from synthetic import BELIEVED, TRUE, grid, marks_on

FIRST, SECOND = (datetime(2026, month, 1, tzinfo=UTC) for month in (5, 6))


def fitted(gap_mm=0.0, seed=1):
    true = replace(TRUE, motor_gap=TRUE.motor_gap + gap_mm)
    board = Measurements(marks_on(true, BELIEVED, grid(5, 3), noise=0.3, seed=seed))
    inputs = Inputs(BELIEVED, board)
    return add(inputs, effects=["chain_pitch"]), inputs


def entry_of(result, inputs):
    text = machine_toml(result.settings)
    return fit_entry(result, inputs, machine="machine.toml", settings=text)


@pytest.fixture(scope="module")
def first():
    return fitted()


def test_an_entry_holds_settings_marks_and_errors(first, tmp_path):
    result, inputs = first
    append(tmp_path, FIT, entry_of(result, inputs))
    content = read_diary(tmp_path).entries[0].content
    (tmp_path / "machine.toml").write_text(content["settings"])
    assert read_machine_toml(tmp_path / "machine.toml") == result.settings
    assert content["firmware"] == "plumb" and content["machine"] == "machine.toml"
    assert content["rms_mm"] == result.after.fit_rms
    assert content["left_out_mm"] == result.after.left_out_rms
    for mark, (known, measured) in zip(content["marks"], inputs.measurements.readings, strict=True):
        assert mark["name"] == known.name and mark["target"] == list(known.target)
        assert np.subtract(measured, mark["predicted"]) == pytest.approx(mark["error"])


def test_an_entry_holds_how_well_the_numbers_are_known_together(first):
    result, inputs = first
    content = entry_of(result, inputs)
    deviations = dict(
        zip(content["unknowns"], np.sqrt(np.diag(content["covariance"])), strict=True)
    )
    half = {each.name: (each.high - each.low) / 2 for each in result.parameters}
    wider = {name: half[name] / deviations[name] for name in half}
    # All are as many deviations wide; Student's factor for these few marks.
    assert len(wider) >= 5 and min(wider.values()) == pytest.approx(max(wider.values()))
    assert 1.95 < wider["motor_gap"] < 2.2
    # Gap and pitch draw nearly the same: what is known of them is known together.
    names = content["unknowns"]
    pair = names.index("motor_gap"), names.index("chain_pitch.left")
    apart = content["covariance"][pair[0]][pair[1]]
    assert abs(apart) > 0.3 * deviations["motor_gap"] * deviations["chain_pitch.left"]


def test_the_history_shows_errors_and_numbers_over_time(first, tmp_path):
    append(tmp_path, FIT, entry_of(*first), at=FIRST)
    append(tmp_path, "program", program_entry("grid.nc", ["G0 X0"], whole=True))
    append(tmp_path, FIT, entry_of(*fitted(gap_mm=6.0, seed=2)), at=SECOND)
    fits, courses = history_of(read_diary(tmp_path), MM)
    assert [fit.at for fit in fits] == [FIRST, SECOND]
    assert [fit.count for fit in fits] == [15, 15]
    assert fits[0].rms == first[0].after.fit_rms
    assert fits[0].before == first[0].raw.rms
    assert fits[1].effects == ("chain_pitch",)
    gap = {course.name: course for course in courses}["motor_gap"]
    assert gap.unit == "mm" and len(gap.points) == 2
    assert gap.points[0].low < gap.points[0].value < gap.points[0].high


def points(*ends):
    return [
        {"name": "motor_gap", "value": (low + high) / 2, "low": low, "high": high, "unit": "mm"}
        for low, high in ends
    ]


@pytest.mark.parametrize(
    ("ends", "moved"),
    [
        ([(1, 3)], False),
        ([(1, 3), (2.9, 4)], False),
        ([(1, 3), (3.1, 4)], True),
        ([(1, 3), (0, 0.9)], True),
        ([(1, 3), (0, 1.1)], False),
        ([(1, 3), (0, 1)], False),
        ([(1, 3), (3, 4)], False),
        ([(1, 3), (5, 6), (5.5, 7)], False),
    ],
)
def test_a_number_has_moved_if_its_intervals_have_nothing_in_common(ends, moved, tmp_path):
    for number in points(*ends):
        append(tmp_path, FIT, entry_with(numbers=[number]))
    _, (course,) = history_of(read_diary(tmp_path), MM)
    assert course.has_moved is moved


def entry_with(**content):
    errors = dict.fromkeys(("before_mm", "rms_mm", "left_out_mm"))
    empty = {"machine": "m", "marks": [], "distances": [], "effects": [], "numbers": []}
    return {**empty, **errors, **content}


@pytest.mark.parametrize(
    ("kind", "content", "said"),
    [
        ("program", {"program": "a.nc", "whole": True}, "sent a.nc"),
        ("program", {"program": "a.nc", "whole": False}, "sent a.nc, not to its end"),
        ("numbers", {"changed": {"$2": [1, 2]}, "machine": "m"}, "1 number changed by m"),
        ("home", {"mark": "left", "kept": True}, "home mark left kept"),
        ("home", {"mark": "left", "kept": False}, "home mark left used"),
        ("slip", {"sentence": "No chain slipped."}, "No chain slipped."),
    ],
)
def test_each_kind_of_entry_has_its_words(kind, content, said):
    assert noted(Entry(kind, FIRST, content)) == said


def test_programs_keep_what_was_sent():
    left, right = (program_entry("a.nc", [line], whole=False) for line in ("G0 X1", "G0 X2"))
    assert left["sha256"] != right["sha256"] and left["lines"] == 1 and not left["whole"]


def test_an_entry_is_kept_next_to_the_file_of_a_machine(tmp_path):
    machine = tmp_path / "machine.toml"
    machine.write_text("")
    assert keep(str(machine), "home", {}, begin=False) == "" and not (tmp_path / NAME).exists()
    assert keep(str(machine), "home", {}) == ""
    assert keep(str(machine), "home", {}, begin=False) == ""
    assert len(read_diary(tmp_path).entries) == 2


def test_a_diary_that_cannot_be_written_is_a_warning(tmp_path):
    machine = tmp_path / "machine.toml"
    machine.write_text("")
    (tmp_path / NAME).mkdir()
    assert "nothing was added to the diary" in keep(str(machine), "home", {})
