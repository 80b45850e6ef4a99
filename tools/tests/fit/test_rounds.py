"""Rounds: several files of marks with the frame in common and everything else different."""

from dataclasses import replace

import numpy as np
import pytest
from plumb.diagnosis import diagnose
from plumb.fit.fit import fit
from plumb.fit.inputs import Inputs
from plumb.fit.observations import model_and_observations, observe, round_priors
from plumb.marks.form import marks_toml
from plumb.marks.read import Mark, Measurements, Round, join_measurements, read_marks
from plumb.model.predict import lengths
from plumb.settings.machine import machine_toml
from plumb.text.errors import InputError
from synthetic import BELIEVED, SHEET, TRUE, distances_between, grid, marks_on

MARKS = 'frame = "machine"\n{}\n[[mark]]\nname = "1"\ntarget = [100, 200]\nmeasured = [101, 199]\n'
OTHER = replace(BELIEVED, motor_gap=2990.0)


def board(marks, **how):
    return Measurements(tuple(marks), source=how.pop("source", "a.toml"), rounds=(Round(**how),))


def zeroed(machine, left, right):
    """The machine after its chains were zeroed again."""
    effects = {**machine.effects, "chain_zero": {"left": left, "right": right}}
    return replace(machine, effects=effects)


def moved(marks, shift, turn):
    """The same marks, read on a sheet that lies elsewhere."""
    cosine, sine = np.cos(turn), np.sin(turn)
    spin = np.array([[cosine, -sine], [sine, cosine]])
    return [replace(mark, measured=tuple(spin @ mark.measured + np.array(shift))) for mark in marks]


def test_a_file_names_the_settings_it_was_cut_with(file):
    path = file("in_force.toml", machine_toml(OTHER))
    marks = read_marks(file("m.toml", MARKS.format(f'cut_with = "{path.name}"')), sheet=SHEET)
    assert marks.rounds[0].cut_with == OTHER
    assert observe(BELIEVED, marks).chains == pytest.approx(lengths(OTHER, [[100, 200]])[0])


def test_the_sheet_of_those_settings_is_the_one_that_edges_are_counted_from(file):
    file("small.toml", machine_toml(replace(OTHER, sheet_width=2000.0, sheet_height=1000.0)))
    text = MARKS.format('cut_with = "small.toml"').replace("machine", "sheet-top-left")
    marks = read_marks(file("m.toml", text), sheet=SHEET)
    assert marks.targets.tolist() == [[-900, 300]]


@pytest.mark.parametrize(
    ("line", "complaint"),
    [
        ('cut_with = "missing.ini"', "missing.ini: there is no such file"),
        ("cut_with = 3", "cut_with: text in quotes is needed"),
        ("new_sheet = 1", "new_sheet: '1' is neither true nor false"),
        ("newsheet = true", "did you mean new_sheet"),
    ],
)
def test_a_contradictory_round_is_refused(file, line, complaint):
    with pytest.raises(InputError, match=complaint):
        read_marks(file("m.toml", MARKS.format(line)), sheet=SHEET)


def test_each_round_has_the_chains_of_its_own_settings():
    targets = grid(3, 3)
    first = board(marks_on(TRUE, BELIEVED, targets), cut_with=BELIEVED, source="a.toml")
    two = board(marks_on(TRUE, OTHER, targets), cut_with=OTHER, source="b.toml")
    both = join_measurements([first, two])
    assert both.marks[9].name == "b:0" and both.repeats == {}
    _, rows = model_and_observations(BELIEVED, both)
    fitted = fit(BELIEVED, rows, effects=("chain_sag", "chain_stretch", "chain_pitch"), sigma=0.1)
    # Without its settings the second round would be millimetres off.
    assert fitted.rms < 0.05
    wrong = replace(both, rounds=(both.rounds[0], replace(both.rounds[1], cut_with=None)))
    _, rows = model_and_observations(BELIEVED, wrong)
    assert fit(BELIEVED, rows, effects=("chain_pitch",), sigma=0.1).rms > 0.5


def test_distances_of_a_later_round_join_its_own_holes():
    targets = grid(3, 2)
    parts = [
        replace(
            distances_between(marks_on(TRUE, settings, targets)), source=name, rounds=(Round(),)
        )
        for name, settings in (("a.toml", BELIEVED), ("b.toml", OTHER))
    ]
    parts = [
        replace(part, rounds=(Round(cut_with=settings),))
        for part, settings in zip(parts, (BELIEVED, OTHER), strict=True)
    ]
    both = join_measurements(parts)
    rows = observe(BELIEVED, both)
    assert rows.distance_rows[15:].min() == 6
    model, rows = model_and_observations(TRUE, both)
    assert fit(model, rows, priors={}).rms < 1e-6


def test_a_moved_frame_is_refused_with_advice():
    first, two = (board([Mark("A", (0.0, 0.0), (1.0, 1.0))]) for _ in range(2))
    two = replace(two, rounds=(Round(frame_moved=True),), source="b.toml")
    assert join_measurements([two]) is two
    with pytest.raises(InputError, match=r"b\.toml: frame_moved .* give it alone"):
        join_measurements([first, two])


def two_rounds(second, **how):
    first = board(marks_on(TRUE, BELIEVED, grid(3, 3)), source="a.toml")
    return join_measurements([first, board(second, source="b.toml", **how)])


def test_chains_zeroed_anew_get_zeros_of_their_own():
    later = marks_on(zeroed(TRUE, 6.0, -3.0), BELIEVED, grid(3, 3))
    both = two_rounds(later, chains_rezeroed=True)
    model, rows = model_and_observations(TRUE, both, cut_with=BELIEVED)
    assert set(round_priors(rows)) == {"zero2.left", "zero2.right"}
    fitted = fit(model, rows, sigma=0.05)
    values = {estimate.name: estimate.value for estimate in fitted.estimates}
    assert fitted.rms < 0.01
    assert values["zero2.left"] == pytest.approx(6.0, abs=0.1)
    assert values["zero2.right"] == pytest.approx(-3.0, abs=0.1)
    _, rows = model_and_observations(TRUE, two_rounds(later), cut_with=BELIEVED)
    assert fit(model, rows, sigma=0.05).rms > 1.0


def test_another_sheet_has_its_own_place():
    later = moved(marks_on(TRUE, BELIEVED, grid(3, 3)), (4.0, -7.0), 0.003)
    both = two_rounds(later, new_sheet=True)
    model, rows = model_and_observations(TRUE, both, cut_with=BELIEVED)
    fitted = fit(model, rows, sigma=0.05)
    values = {estimate.name: estimate.value for estimate in fitted.estimates}
    assert fitted.rms < 0.01
    assert values["sheet2.x"] == pytest.approx(4.0, abs=0.1)
    assert values["sheet2.y"] == pytest.approx(-7.0, abs=0.1)
    assert values["sheet2.rotation"] == pytest.approx(0.003, abs=1e-4)


def test_a_round_of_its_own_zeros_does_not_hide_the_effect():
    pitch = replace(BELIEVED, effects={"chain_pitch": {"left": 0.002, "right": 0.0005}})
    later = marks_on(zeroed(pitch, 6.35, 0.0), BELIEVED, grid(5, 3), noise=0.3, seed=7)
    first = board(marks_on(pitch, BELIEVED, grid(5, 3), noise=0.3, seed=6), source="a.toml")
    both = join_measurements([first, board(later, source="b.toml", chains_rezeroed=True)])
    diagnosis = diagnose(Inputs(BELIEVED, both, sigma=0.3))
    assert "chain_pitch" in diagnosis.suspects
    assert diagnosis.verdict in ("one_suspect", "cannot_tell")
    assert diagnosis.explanations[0].rms_after < 0.6


def test_add_explains_the_numbers_of_a_round(run, file):
    paths = [file("machine.toml", machine_toml(BELIEVED))]
    for name, machine, line in (
        ("may", TRUE, ""),
        ("june", zeroed(TRUE, 6.0, -3.0), "chains_rezeroed = true\nnew_sheet = true"),
    ):
        marks = marks_on(machine, BELIEVED, grid(3, 3), noise=0.1, seed=len(paths))
        paths.append(file(f"{name}.toml", f"{line}\n{marks_toml(Measurements(marks))}"))
    _, said, _ = run("add", *paths, "--effect", "chain_pitch", "--details")
    assert "zero2.left" in said and "sheet2.rotation" in said
    assert "- zero2: how much more chain is out" in said and "- sheet2: how the new" in said
