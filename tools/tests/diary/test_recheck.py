"""Rechecks: an unchanged machine holds its interval, to its limits; changes have their sizes."""

import math
from dataclasses import replace

import numpy as np
import pytest
from plumb.bench.boards import MAKER
from plumb.cure.add import add
from plumb.cure.decision import record_of
from plumb.diary.file import FIT, append, fit_entry, read_diary
from plumb.diary.recheck import LEFT, RIGHT, SHEET_Y, fit_of, recheck
from plumb.fit.inputs import Inputs
from plumb.job.home import HomeTouch
from plumb.marks.read import Measurements
from plumb.model.predict import lengths, places
from plumb.settings.machine import machine_toml
from synthetic import BELIEVED, TRUE, grid, marks_on

AT = np.array([(-900.0, 250.0), (900.0, -250.0)])
NOISE = 0.5  # [mm] of a coordinate, as the board was read


def fitted_to(seed, folder, *, turn=0.0):
    """The settings fitted to a board of the true machine, with their diary in a folder.

    `turn` [rad] of the sheet.
    """
    marks = marks_on(TRUE, BELIEVED, grid(5, 3), noise=NOISE, seed=seed, rotation=turn)
    board = Measurements(marks)
    inputs = Inputs(BELIEVED, board, sigma=NOISE)
    result = add(inputs, effects=["chain_pitch", "chain_sag"])
    text = machine_toml(result.settings)
    record = record_of(result, inputs)
    append(folder, FIT, fit_entry(result, inputs, machine="machine.toml", settings=text))
    return replace(result.settings, fitted=record)


def touched(settings, *, longer=(0.0, 0.0), true=TRUE, noise=(0, 0), turn=0.0):
    """Marks made by the settings on the true machine, with chains that became longer, on a sheet
    that is turned [rad]."""
    where = places(true, lengths(settings, AT)[0] + np.array(longer))[0] + noise
    where = where @ np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    return [
        HomeTouch(str(i), tuple(hole), tuple(target))
        for i, (hole, target) in enumerate(zip(where.tolist(), AT.tolist(), strict=True))
    ]


@pytest.fixture(scope="module")
def machine(tmp_path_factory):
    folder = tmp_path_factory.mktemp("machine")
    settings = fitted_to(1, folder)
    return settings, fit_of(read_diary(folder), settings)


@pytest.mark.parametrize("turn", [0.004, -0.004])
def test_a_turned_sheet_is_no_change_of_the_machine(tmp_path, turn):
    settings = fitted_to(1, tmp_path, turn=turn)
    fit = fit_of(read_diary(tmp_path), settings)
    still = recheck(fit, settings, touched(settings, turn=turn))
    assert still.holds and still.turn == pytest.approx(turn, abs=0.001)
    # The lab says how far to raise its right end; somebody did.
    straight = recheck(fit, settings, touched(settings))
    assert straight.holds and straight.turn == 0
    for now in (turn, 0.0):
        slipped = recheck(fit, settings, touched(settings, turn=now, longer=(4.0, 0)))
        assert not slipped.holds and slipped.changes[0].name == LEFT
    # Turned the other way it is another sheet.
    assert not recheck(fit, settings, touched(settings, turn=-turn)).holds


@pytest.mark.parametrize(("longer", "name"), [((4.0, 0), LEFT), ((0, -4.0), RIGHT)])
def test_a_chain_that_became_longer_is_named_with_its_size(machine, longer, name):
    settings, fit = machine
    checked = recheck(fit, settings, touched(settings, longer=longer))
    assert checked.state == "changed"
    best = checked.changes[0]
    assert best.name == name and best.explains
    assert best.size == pytest.approx(sum(longer), abs=2.5 * best.sigma)


def test_a_motor_that_moved_is_among_what_explains_it(machine):
    settings, fit = machine
    moved = replace(TRUE, motor_gap=TRUE.motor_gap + 8.0)
    checked = recheck(fit, settings, touched(settings, true=moved))
    assert not checked.holds
    gap = next(change for change in checked.changes if change.name == "motor_gap")
    assert gap.explains and gap.size == pytest.approx(8.0, abs=3 * gap.sigma)


def test_less_certain_numbers_allow_larger_errors(machine):
    settings, fit = machine
    checked = recheck(fit, settings, touched(settings))
    assert all(3.03 * 0.5 < mark.expected_mm < 6 for mark in checked.marks)


SIGMA = 0.1  # [mm] of a coordinate
SURE_OF = {2: 9.210, 3: 11.345, 4: 13.277}  # chi-square, 99 %, by degrees of freedom


@pytest.fixture
def checked(tmp_path):
    def check(errors, *, known=None, sigma=SIGMA):
        """A recheck with these errors (n, 2) [mm]; known: sigmas of what the fit did not know."""
        names = list(known or {})
        covariance = np.diag([known[name] ** 2 for name in names]).tolist() if names else [[0.0]]
        entry = {"unknowns": names or ["motor_gap"], "covariance": covariance}
        entry["settings"] = machine_toml(MAKER)
        fit = append(tmp_path, FIT, entry)
        touches = [
            HomeTouch(str(i), tuple(hole), tuple(at))
            for i, (hole, at) in enumerate(zip((AT + errors).tolist(), AT.tolist(), strict=True))
        ]
        return recheck(fit, MAKER, touches, sigma=sigma)

    return check


def expected(checked):
    return [mark.expected_mm for mark in checked.marks]


@pytest.mark.parametrize(("share", "holds"), [(0.99, True), (1.01, False)])
def test_marks_hold_up_to_the_99_percent_of_chi_square(checked, share, holds):
    size = SIGMA * math.sqrt(share * SURE_OF[4] / 4)
    assert checked(np.full((2, 2), size) * [[1, -1], [-1, 1]]).holds is holds


def test_a_mark_is_expected_as_far_off_as_touch_and_fit_allow(checked):
    plain = checked(np.zeros((2, 2)))
    assert expected(plain) == pytest.approx([SIGMA * math.sqrt(SURE_OF[2])] * 2, rel=1e-3)
    turned = checked(np.zeros((2, 2)), known={"sheet_rotation": 0.002})
    far = 0.002 * np.hypot(*AT[0])
    wide = math.sqrt(SURE_OF[2] * (SIGMA**2 + far**2))
    assert expected(turned) == pytest.approx([wide] * 2, rel=1e-3)


@pytest.mark.parametrize(("share", "explains"), [(0.99, True), (1.01, False)])
def test_a_change_explains_what_it_leaves_within_the_99_percent(checked, share, explains):
    # One of four numbers is spent on the change; what is left is across it.
    across = np.array([[1.0, 0.0], [-1.0, 0.0]]) * SIGMA * math.sqrt(share * SURE_OF[3] / 2)
    again = checked(np.array([[0.0, 3.0], [0.0, 3.0]]) + across)
    change = next(each for each in again.changes if each.name == SHEET_Y)
    assert again.state == ("sheet_moved" if explains else "beyond_these_marks")
    assert change.explains is explains and change.size == pytest.approx(3.0)
    assert change.chi_square == pytest.approx(share * SURE_OF[3], rel=1e-3)
