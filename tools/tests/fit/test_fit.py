"""fit: it finds what was hidden and is honest about the rest; known numbers; lab effects."""

import tomllib
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import pytest
from plumb.cli.screen import in_text
from plumb.cure.add import add
from plumb.cure.decision import toml_of
from plumb.fit.compare import refuse_absurd
from plumb.fit.fit import PRIORS, Checked, Linearized, Problem, fit, solve
from plumb.fit.inputs import Inputs
from plumb.fit.observations import SHEET_ROTATION, model_and_observations, observe, sighted
from plumb.hidden import MAKER
from plumb.marks.read import Measurements, Round, join_measurements
from plumb.model.predict import FOUND, known_effects, values_of
from plumb.settings import read_settings, write_machine_toml
from plumb.text.answers import json_of
from plumb.text.errors import InputError
from plumb.words.decision import everything
from scipy.optimize import least_squares
from synthetic import BELIEVED, EFFECTS, TRUE, distances_between, grid, marks_on

WIDE = {**PRIORS, "motor_gap": 1e4, "motor_height": 1e4, "motor_center_x": 1e4}
WIDE[SHEET_ROTATION] = 10.0


def fitted_to(measurements: Measurements, effects, **how):
    return fit(BELIEVED, observe(BELIEVED, measurements), effects=effects, **how)


def without(measurements: Measurements, name: str) -> Measurements:
    return replace(
        measurements, marks=tuple(mark for mark in measurements.marks if mark.name != name)
    )


def test_hidden_parameters_are_found_again():
    board = Measurements(marks_on(TRUE, BELIEVED, grid(7, 5), rotation=0.002))
    fitted = fitted_to(board, EFFECTS, priors=WIDE)
    assert fitted.settled and fitted.rms < 1e-5
    for effect, parameters in EFFECTS.items():
        for name, value in parameters.items():
            assert fitted.settings.effect(effect, name) == pytest.approx(value, rel=1e-3)
    assert fitted.settings.motor_gap == pytest.approx(TRUE.motor_gap, abs=0.01)
    assert fitted.settings.motor_center_x == pytest.approx(TRUE.motor_center_x, abs=0.01)
    assert fitted.sheet_rotation == pytest.approx(0.002, abs=1e-6)


def test_two_sleds_tell_stretch_from_everything_that_looks_like_it():
    light = marks_on(TRUE, BELIEVED, grid(5, 3))
    heavy = marks_on(TRUE, BELIEVED, grid(5, 3), sled_weight=150.0, prefix="heavy ")
    widths = []
    for marks in (light, light + heavy):
        fitted = fitted_to(Measurements(marks), EFFECTS, priors=WIDE, sigma=0.5)
        assert fitted.rms < 1e-4
        (stretch,) = [each for each in fitted.estimates if each.name == "chain_stretch.compliance"]
        assert stretch.low < 5.2e-6 < stretch.high
        widths.append(stretch.high - stretch.low)
    assert widths[1] < 0.6 * widths[0]


def test_marks_and_distances_are_fitted_together():
    marks = marks_on(TRUE, BELIEVED, grid(5, 3), noise=0.2)
    spans = distances_between(marks_on(TRUE, BELIEVED, grid(5, 3))).distances
    both, alone = (
        fitted_to(Measurements(marks, taped), ["chain_pitch"], sigma=0.2) for taped in (spans, ())
    )
    assert len(both.distance_errors) == len(spans)
    assert both.estimates[-1].high - both.estimates[-1].low < (
        alone.estimates[-1].high - alone.estimates[-1].low
    )


def test_the_left_out_error_is_that_of_a_fit_without_the_mark():
    board = Measurements(marks_on(TRUE, BELIEVED, grid(4, 3), noise=0.5))
    whole = fitted_to(board, ["chain_pitch", "chain_sag"], sigma=0.5)
    rows = observe(BELIEVED, board)
    for i, name in enumerate(rows.names):
        part = fitted_to(without(board, name), ["chain_pitch", "chain_sag"], sigma=0.5)
        left = measured_minus_predicted(part, board, i)
        assert whole.left_out_errors[i] == pytest.approx(left, abs=0.01)
        assert np.hypot(*left) > np.hypot(*whole.errors[i])


def test_repeats_of_a_mark_are_left_out_together():
    once = marks_on(TRUE, BELIEVED, grid(4, 3), noise=0.5)
    again = marks_on(TRUE, BELIEVED, grid(4, 3)[:2], noise=0.5, seed=2)
    board = Measurements(once + again)
    whole = fitted_to(board, ["chain_pitch"], sigma=0.5)
    part = fitted_to(without(board, "0"), ["chain_pitch"], sigma=0.5)
    for i in (0, len(once)):
        left = measured_minus_predicted(part, board, i)
        assert whole.left_out_errors[i] == pytest.approx(left, abs=0.01)


def measured_minus_predicted(fitted, board: Measurements, i: int) -> np.ndarray:
    """The error of one mark against a fit that did not see it: fitted again with no freedom."""
    held = dict.fromkeys(PRIORS, 0.0) | {SHEET_ROTATION: 0.0}
    rows = observe(BELIEVED, board)
    fixed = fit(fitted.settings, rows, priors=held, sigma=0.5)
    where = rows.measured - fixed.errors
    cosine, sine = np.cos(fitted.sheet_rotation), np.sin(fitted.sheet_rotation)
    return rows.measured[i] - where[i] @ np.array([[cosine, sine], [-sine, cosine]])


def test_intervals_hold_the_truth_about_as_often_as_stated():
    inside = []
    for seed in range(40):
        marks = marks_on(TRUE, BELIEVED, grid(5, 3), noise=0.5, seed=seed)
        fitted = fitted_to(Measurements(marks), EFFECTS)
        truth = {f"chain_pitch.{side}": EFFECTS["chain_pitch"][side] for side in ("left", "right")}
        inside += [e.low < truth[e.name] < e.high for e in fitted.estimates if e.name in truth]
    assert 0.86 < np.mean(inside) <= 1.0


def test_a_wider_prior_does_not_narrow_an_interval():
    quiet, loud = (
        fitted_to(Measurements(marks_on(TRUE, BELIEVED, grid(5, 3), noise=noise)), EFFECTS)
        for noise in (0.1, 2.0)
    )
    widths = [
        next(e.high - e.low for e in fitted.estimates if e.name == "motor_height")
        for fitted in (quiet, loud)
    ]
    assert widths[1] > 5 * widths[0]


def test_the_slopes_of_all_residuals_are_those_of_finite_differences():
    light = marks_on(TRUE, BELIEVED, grid(3, 2))
    heavy = marks_on(TRUE, BELIEVED, grid(3, 2), sled_weight=150.0, prefix="heavy ")
    board = Measurements(light + heavy, distances_between(light).distances)
    priors = {**PRIORS, "sled_weight": 5.0}
    problem = Problem.of(TRUE, observe(BELIEVED, board), tuple(EFFECTS), priors, 0.5)
    # The sheet is turned by a fifth of a radian, so that nothing about turning is small.
    place = np.where(np.array(problem.names) == SHEET_ROTATION, 10.0, 0.3)
    slopes = problem.at(place).slopes
    for i in range(len(place)):
        step = 1e-2 * np.eye(len(place))[i]
        ends = [problem.at(place + side * step).residual for side in (1, -1)]
        difference = (ends[1] - ends[0]) / 0.02
        size = np.abs(difference).max()
        assert slopes[:, i] == pytest.approx(difference, abs=0.003 * size + 1e-4)


SIGMA = 0.5


def sheet(turn, name, **how):
    """A file of marks with hardly any noise, read on a sheet that is turned [rad]."""
    seed = ord(name)
    marks = marks_on(BELIEVED, BELIEVED, grid(3, 3), rotation=turn, noise=1e-4, seed=seed)
    return Measurements(marks, source=f"{name}.toml", rounds=(Round(**how),))


def fit_of(*parts):
    _, rows = model_and_observations(BELIEVED, join_measurements(parts))
    return fit(BELIEVED, rows, sigma=SIGMA)


def two_sheets(first, last):
    return fit_of(sheet(first, "a"), sheet(last, "b", new_sheet=True))


def test_of_two_sheets_the_last_counts():
    turned = two_sheets(0.004, -0.003)
    assert turned.sheet_rotation == pytest.approx(0.004, rel=0.01)
    assert turned.last_sheet_rotation == pytest.approx(-0.003, rel=0.01)
    assert turned.proves_sheet_rotation and turned.shows_sheet_rotation
    assert not two_sheets(0.004, 0.0).proves_sheet_rotation
    assert two_sheets(0.0, 0.004).proves_sheet_rotation


def test_where_the_first_sheet_is_held_the_last_is_judged_by_itself():
    for turn, is_proved in ((0.004, True), (0.0, False)):
        parts = sheet(0.0, "a"), sheet(turn, "b", new_sheet=True)
        _, rows = model_and_observations(BELIEVED, join_measurements(parts))
        fitted = fit(BELIEVED, rows, priors={**PRIORS, SHEET_ROTATION: 0.0}, sigma=SIGMA)
        assert fitted.last_sheet_rotation == pytest.approx(turn, abs=1e-5)
        assert fitted.proves_sheet_rotation == is_proved


ROWS = observe(BELIEVED, Measurements(marks_on(TRUE, BELIEVED, grid(4, 3), noise=0.3)))


def fitted(**how):
    return fit(BELIEVED, ROWS, sigma=0.3, **how)


def estimate(of_fit, name):
    (only,) = [each for each in of_fit.estimates if each.name == name]
    return only


def test_a_sharp_check_holds_its_number():
    check = Checked("motor_gap", 2985.0, 0.001)
    gap = estimate(fitted(checked=[check]), "motor_gap")
    assert gap.value == pytest.approx(2985.0, abs=0.01)
    assert gap.high - gap.low == pytest.approx(2 * 1.96 * 0.001, rel=0.01)
    # A blunt check says nothing.
    blunt = estimate(fitted(checked=[replace(check, sigma=1e4)]), "motor_gap")
    assert blunt.value == pytest.approx(estimate(fitted(), "motor_gap").value, abs=1e-3)


@pytest.mark.parametrize("side", [-1, 1])
def test_a_check_pulls_from_either_side(side):
    free = estimate(fitted(effects=["chain_pitch"]), "chain_pitch.left").value
    check = Checked("chain_pitch.left", free + side * 0.001, 0.0002)
    pulled = estimate(fitted(effects=["chain_pitch"], checked=[check]), check.name).value
    assert 0 < side * (pulled - free) < 0.001


def test_checks_of_what_is_not_fitted_do_not_count():
    checks = [Checked("chain_pitch.left", 0.005, 1e-5), Checked("motor_gap", 2990.0, 0.01)]
    priors = {**PRIORS, "motor_gap": 0.0}
    with_checks, without = (fitted(priors=priors, checked=each) for each in (checks, ()))
    assert with_checks.settings == without.settings
    assert with_checks.settings.motor_gap == BELIEVED.motor_gap
    held = {"chain_pitch.left": 0.001}
    one_held = fitted(effects=["chain_pitch"], checked=checks[:1], held=held)
    assert one_held.settings.effect("chain_pitch", "left") == 0.001
    assert "chain_pitch.left" not in [each.name for each in one_held.estimates]
    assert "chain_pitch.right" in [each.name for each in one_held.estimates]


def test_sizes_without_a_setting_can_be_held_too():
    free = fitted(effects=["tape_scale"])
    held = fitted(held={"tape_scale.strain": 0.002})
    assert held.lab_effects == {"tape_scale": {"strain": 0.002}}
    assert free.lab_effects.keys() == {"tape_scale"}
    assert held.rms != pytest.approx(fitted().rms, rel=0.05)


def test_a_search_from_another_fit_finds_the_same_minimum():
    moved = observe(BELIEVED, Measurements(marks_on(TRUE, BELIEVED, grid(4, 3), noise=0.3, seed=9)))
    elsewhere = fit(BELIEVED, moved, sigma=0.3)
    cold = fitted(effects=["chain_pitch"])
    warm = fitted(effects=["chain_pitch"], near=elsewhere)
    for known, again in zip(cold.estimates, warm.estimates, strict=True):
        assert again.value == pytest.approx(known.value, abs=1e-3 * (known.high - known.low))
    # Where the sled of the other fit cannot hang, the search begins as ever.
    gone = tuple(replace(each, value=1e5) for each in elsewhere.estimates)
    lost = fitted(effects=["chain_pitch"], near=replace(elsewhere, estimates=gone))
    assert lost.settings.motor_gap == pytest.approx(cold.settings.motor_gap, abs=1e-4)


MACHINE = replace(MAKER, motor_gap=3000.0, motor_center_x=0.0, sled_weight=110.0)
POSSIBLE = [
    ("tape_scale.strain", 0.0089, 1e-5),
    ("tape_scale.strain", -0.0089, 1e-5),
    ("tape_scale.strain", 0.1, 0.05),  # says hardly anything
    ("frame_flex.inward", -0.01, 0.001),  # noise
    ("motor_gap", 3290.0, 1.0),
    ("motor_gap", 2710.0, 1.0),
    ("motor_gap", 3500.0, 100.0),
    ("motor_center_x", -190.0, 1.0),
    ("sled_weight", 38.0, 1.0),  # of 110 N
    ("sled_weight", 255.0, 1.0),
    ("sled_weight", 9.8, 14.0),
]
ABSURD = [
    ("tape_scale.strain", 0.0091, 1e-5),
    ("tape_scale.strain", -0.0091, 1e-5),
    ("tape_scale.strain", 0.1, 0.045),
    ("motor_gap", 3310.0, 1.0),
    ("motor_gap", 2690.0, 1.0),
    ("motor_gap", 3500.0, 95.0),
    ("motor_center_x", -210.0, 1.0),
    ("sled_weight", 9.8, 2.0),  # a kilogram
    ("sled_weight", 32.0, 1.0),
    ("sled_weight", 265.0, 1.0),
]


@pytest.mark.parametrize("check", POSSIBLE)
def test_odd_but_possible_values_are_accepted(check):
    refuse_absurd([Checked(*check)], MACHINE)


@pytest.mark.parametrize("check", ABSURD)
def test_values_that_no_machine_has_are_refused(check):
    with pytest.raises(InputError, match=f"--checked {check[0]}="):
        refuse_absurd([Checked(*POSSIBLE[0]), Checked(*check)], MACHINE)


STARTED_AT = 3.0


@dataclass
class Curve:
    """A problem of one unknown: what is left of it, and its slope, at each place."""

    left: Callable[[float], float]
    slope: Callable[[float], float]
    hangs: Callable[[float], bool] = lambda place: True
    names: tuple[str, ...] = ("place",)
    asked: int = 0

    def at(self, unknowns):
        self.asked += 1
        place = float(unknowns[0])
        if not self.hangs(place):
            return None
        left, slope = self.left(place), self.slope(place)
        return Linearized(unknowns, np.array([left]), np.array([[slope]]), np.zeros((0, 2)))


def board(effects, checked=()):
    rows = observe(BELIEVED, Measurements(marks_on(TRUE, BELIEVED, grid(5, 3), noise=0.5, seed=4)))
    return Problem.of(BELIEVED, rows, effects, PRIORS, 0.5, checked)


def settled_at(curve):
    solution = solve(curve, start=np.array([STARTED_AT]))
    return solution.settled, float(solution.at.unknowns[0])


@pytest.mark.parametrize("effects", [(), ("chain_pitch",), ("chain_sag", "frame_flex")])
def test_it_rests_where_another_solver_does(effects):
    problem = board(effects, [Checked("motor_gap", 2980.0, 1.0)])
    judge = least_squares(
        lambda unknowns: problem.at(unknowns).residual, np.zeros(len(problem.names)), xtol=1e-14
    )
    solution = solve(problem)
    assert solution.settled
    assert solution.at.cost == pytest.approx(2 * judge.cost, rel=1e-9)
    assert solution.at.unknowns == pytest.approx(judge.x, abs=1e-4)


def test_only_free_columns_move():
    problem = board(("chain_pitch",))
    start = np.full(len(problem.names), 0.2)
    free = np.array([0, 2])
    solution = solve(problem, free=free, start=start)
    moved = np.flatnonzero(solution.at.unknowns != start)
    assert moved.tolist() == free.tolist()
    assert start.tolist() == [0.2] * len(start)


def test_a_step_that_overshoots_is_halved():
    # Newton's steps on an arc tangent grow without end from there.
    settled, place = settled_at(Curve(lambda x: -np.arctan(x), lambda x: 1 / (1 + x * x)))
    assert settled and place == pytest.approx(0.0, abs=1e-5)


def test_a_start_where_the_sled_cannot_hang_is_refused():
    with pytest.raises(InputError, match="cannot hang"):
        settled_at(Curve(lambda x: -x, lambda x: 1.0, hangs=lambda x: False))


def test_it_reports_that_no_step_helps():
    wrong_way = Curve(lambda x: -x, lambda x: -1.0)
    assert settled_at(wrong_way) == (False, STARTED_AT)


def test_it_stops_once_a_step_promises_too_little():
    slow = Curve(lambda x: -x, lambda x: 10.0)
    solution = solve(slow, start=np.array([STARTED_AT]), close_enough=1.0)
    # A step promises all of chi-square there, so the rest is below the limit.
    assert solution.settled and 0.8 < solution.at.cost < 1.0


HIDDEN = {"sled_friction": {"drag": 7.0}, "tape_scale": {"strain": 0.0004}}
HIDDEN["sheet_skew"] = {"angle": -0.0012}
LOOSE = {"motor_gap": 1e3, "motor_height": 1e3, "motor_center_x": 1e3, "sheet_rotation": 1.0}
SIDES = ((40.0, 0.0), (-40.0, 0.0), (0.0, 40.0), (0.0, -40.0))


def marks(hidden, *, noise=0.0, columns=7, approaches=SIDES):
    """Marks of the true machine as a maker with these lab effects would measure them."""
    sent = tuple(
        replace(mark, approach=approaches[i % len(approaches)])
        for i, mark in enumerate(marks_on(TRUE, BELIEVED, grid(columns, 5)))
    )
    rows = observe(BELIEVED, Measurements(sent))
    outside = {f"{e}.{name}": value for e, sizes in hidden.items() for name, value in sizes.items()}
    sighting = sighted(
        values_of(TRUE), outside, rows, over_top=True, usual_weight=TRUE.sled_weight, names=()
    )
    assert (sighting.outcome == FOUND).all()
    where = sighting.read.where
    where = where + noise * np.random.default_rng(3).standard_normal(where.shape)
    read = zip(sent, where.tolist(), strict=True)
    return tuple(replace(mark, measured=tuple(place)) for mark, place in read)


def test_all_are_found_at_once_beside_those_of_the_machine():
    board = Measurements(marks(HIDDEN, columns=9))
    rows = observe(BELIEVED, board)
    fitted = fit(BELIEVED, rows, effects=[*EFFECTS, *HIDDEN], priors=LOOSE, sigma=0.01)
    assert fitted.settled and fitted.rms < 1e-4
    for name, parameters in HIDDEN.items():
        for parameter, value in parameters.items():
            assert fitted.lab_effects[name][parameter] == pytest.approx(value, rel=0.01)
    assert fitted.settings.effect("chain_pitch", "left") == pytest.approx(0.0021, rel=0.02)


def test_a_lab_effect_is_named_with_its_cure_and_pays():
    board = Measurements(marks({"tape_scale": {"strain": 0.001}}, noise=0.1), source="marks.toml")
    result = add(Inputs(BELIEVED, board), effects=[*EFFECTS, "tape_scale"])
    assert result.pays and result.effects_added == (*EFFECTS, "tape_scale")
    assert len(result.cures) == 1
    for said in (
        result.cures[0],
        "\n".join(in_text(everything(result, result.notes))),
        toml_of(result, source="marks.toml").decode(),
    ):
        said = " ".join(said.replace("#", " ").split())
        assert "% too long: " in said and "no firmware can cure this" in said
        assert "a length that you trust" in said
    answer = json_of(result)
    assert set(answer["lab_effects"]) == {"tape_scale"} and "tape_scale" not in answer["effects"]
    (strain,) = [each for each in result.parameters if each.name == "tape_scale.strain"]
    assert strain.low < 0.001 < strain.high and strain.unit == "1" and strain.plausible


def test_no_settings_ever_hold_a_lab_effect(tmp_path):
    board = Measurements(marks(HIDDEN, noise=0.1), source="marks.toml")
    result = add(Inputs(BELIEVED, board), effects=["chain_pitch", *HIDDEN])
    assert set(result.after_fit.lab_effects) == set(HIDDEN)
    assert set(result.settings.effects) == {"chain_pitch"}
    written = tomllib.loads(toml_of(result, source="marks.toml").decode())
    assert set(written["effects"]) == {"chain_pitch"}
    path = tmp_path / "machine.toml"
    write_machine_toml(path, result.settings)
    assert read_settings(path, known=known_effects()) == result.settings


def test_one_side_only_hides_friction_behind_sag_and_two_sides_show_it():
    widths = []
    for approaches in (((40.0, 0.0),), ((40.0, 0.0), (-40.0, 0.0))):
        rows = observe(BELIEVED, Measurements(marks({}, approaches=approaches)))
        fitted = fit(BELIEVED, rows, effects=[*EFFECTS, "sled_friction"], sigma=0.5)
        (drag,) = [each for each in fitted.estimates if each.name == "sled_friction.drag"]
        widths.append(drag.high - drag.low)
    assert widths[1] < widths[0]
