"""Tests of the limits of settings."""

from dataclasses import fields, replace

import pytest
from plumb.settings.machine import (
    FRAME_LIMITS,
    PUBLISHED_LIMITS,
    MachineSettings,
    PublishedSettings,
    find_fault,
)

GOOD = MachineSettings(2978.4, 1072.6, 139.1, 2438.4, 1219.2, "top")


def test_every_number_has_a_limit():
    numbers = {field.name for field in fields(MachineSettings)} - {
        "motor_height",
        "feed",
        "controller",
        "effects",
        "published",
        "file",
        "fitted",
    }
    assert set(FRAME_LIMITS) == numbers | {"motor_offset"}
    assert set(PUBLISHED_LIMITS) == {field.name for field in fields(PublishedSettings)}


@pytest.mark.parametrize("gap", [2978.4, 3719.6])
@pytest.mark.parametrize("offset", [422, 463, 1063.2])
@pytest.mark.parametrize("radius", [0, 100, 250])
def test_machines_that_exist_are_accepted(gap, offset, radius):
    real = replace(GOOD, motor_gap=gap, motor_height=609.6 + offset, rotation_radius=radius)
    assert find_fault(real) is None


@pytest.mark.parametrize("name", sorted(set(FRAME_LIMITS) - {"motor_offset"}))
@pytest.mark.parametrize("value", [float("nan"), float("inf"), -1e9])
def test_impossible_numbers_are_named(name, value):
    faulty, sentence = find_fault(replace(GOOD, **{name: value}))
    assert faulty == name or name == "sheet_height"
    assert sentence
