"""Rounds of marks that do not go together: another sheet, chains that were hung again."""

from dataclasses import replace

import pytest
from plumb.diagnosis import diagnose
from plumb.fit.inputs import Inputs
from plumb.marks.form import marks_toml
from plumb.marks.read import Measurements, Round, join_measurements
from plumb.settings.toml import machine_toml
from synthetic import BELIEVED, grid, marks_on

PITCH = replace(BELIEVED, effects={"chain_pitch": {"left": 0.002, "right": 0.0005}})
SKIPPED = replace(PITCH, effects={**PITCH.effects, "chain_zero": {"left": 6.35, "right": 0.0}})


def rounds(second, seed=1, **how):
    """Nine marks of PITCH, then the same nine of another machine in a second file."""
    parts = [
        Measurements(
            marks_on(machine, BELIEVED, grid(3, 3), noise=0.5, seed=seed + i),
            source=f"{'ab'[i]}.toml",
            rounds=(Round(**(how if i else {})),),
        )
        for i, machine in enumerate((PITCH, second))
    ]
    return join_measurements(parts)


CHANGED = pytest.mark.parametrize(
    ("second", "flag"),
    [(SKIPPED, "chains_rezeroed"), (replace(PITCH, motor_center_x=4.0), "new_sheet")],
)


@CHANGED
def test_rounds_that_do_not_go_together_are_named_with_the_way_out(second, flag):
    diagnosis = diagnose(Inputs(BELIEVED, rounds(second), sigma=0.5))
    assert diagnosis.verdict == "not_in_library"
    assert len(diagnosis.disagreements) == 1
    assert diagnosis.disagreements[0].startswith("b does not go with the other rounds")
    assert "do not pool them" in diagnosis.disagreements[0]
    assert f"{flag} = true in b" in diagnosis.disagreements[0]


@CHANGED
def test_a_round_that_says_what_changed_goes_with_the_others(second, flag):
    diagnosis = diagnose(Inputs(BELIEVED, rounds(second, **{flag: True}), sigma=0.5))
    assert diagnosis.disagreements == ()
    assert (
        diagnosis.verdict in ("one_suspect", "cannot_tell") and "chain_pitch" in diagnosis.suspects
    )


def test_alike_rounds_raise_no_doubt():
    said = [
        diagnose(Inputs(BELIEVED, rounds(PITCH, seed), sigma=0.5)).disagreements
        for seed in range(9)
    ]
    assert said == [()] * 9


def test_the_doubt_about_a_round_is_printed(run, file):
    paths = [file("machine.toml", machine_toml(BELIEVED))]
    for i, machine in enumerate((PITCH, SKIPPED)):
        marks = marks_on(machine, BELIEVED, grid(3, 3), noise=0.5, seed=i)
        paths.append(file(f"{'ab'[i]}.toml", marks_toml(Measurements(marks, tape_sigma=0.5))))
    code, said, _ = run("diagnose", *paths)
    assert code == 1 and "b does not go with the other rounds" in said
