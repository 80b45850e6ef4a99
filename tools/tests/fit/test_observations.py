"""Marks as they are compared: rows of rounds, errors on the sheet and in chain, expected errors."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from chain_views import chain_view
from plumb.fit.compare import (
    COLUMNS,
    MARGIN,
    ROWS,
    WIDE,
    best_pose,
    compare,
    covariates,
    expected_anywhere,
    expected_error,
    expected_priors,
    places_over,
)
from plumb.fit.fit import PRIORS, fit
from plumb.fit.inputs import Inputs
from plumb.fit.observations import model_and_observations, observe, rms, round_priors
from plumb.marks.form import marks_toml
from plumb.marks.read import Distance, Mark, Measurements, Round, join_measurements, read_marks
from plumb.model.catalogue import parameter_words
from plumb.model.predict import FOUND, NAMES, lengths, places, values_of
from plumb.settings import PublishedSettings, machine_toml, read_settings
from plumb.text.errors import InputError
from published_marks import MARKS, SETTINGS
from synthetic import BELIEVED, SHEET, TRUE, distances_between, grid, marks_on

A = Mark("A", (0.0, 0.0), (1.0, 2.0))
B = Mark("B", (500.0, 100.0))
C = Mark("C", (-500.0, 100.0), (-501.0, 99.0), sled_weight=120.0, chains=(1500.0, 1600.0))
BOARD = Measurements((A, B, C), (Distance(("C", "A"), 510.0), Distance(("A", "B"), 509.0)))
PUBLISHED = replace(BELIEVED, controller="stock", published=PublishedSettings(8.2, 0.1, 0.2))


def test_rows_are_visits_and_distances_join_them():
    rows = observe(BELIEVED, BOARD)
    assert rows.names == ("A", "C")
    assert rows.mark_rows.tolist() == [0, 2]
    assert rows.measured.tolist() == [[1.0, 2.0], [-501.0, 99.0]]
    assert rows.targets.tolist() == [[0.0, 0.0], [-500.0, 100.0]]
    assert rows.distance_rows.tolist() == [[2, 0], [0, 1]]
    assert rows.count == 2 * 2 + 2


def test_a_mark_without_a_weight_has_that_of_the_file_then_of_the_model_then_of_the_settings():
    assert observe(BELIEVED, BOARD).sled_weights.tolist() == [97.9, 97.9, 120.0]
    assert observe(BELIEVED, BOARD, sled_weight=99.0).sled_weights.tolist() == [99.0, 99.0, 120.0]
    said = replace(BOARD, sled_weight=111.0)
    assert observe(BELIEVED, said, sled_weight=99.0).sled_weights[0] == 111.0


def test_the_option_outweighs_the_marks_and_they_the_settings():
    target = np.array([[900.0, -500.0]])
    marks = Measurements((Mark("1", (900.0, -500.0), (900.0, -500.0)),), controller="stock")
    plumb = observe(PUBLISHED, replace(marks, controller="plumb")).chains
    stock = observe(PUBLISHED, replace(marks, controller=None)).chains
    assert plumb == pytest.approx(lengths(PUBLISHED.as_plumb_model(), target)[0], abs=1e-9)
    assert np.abs(stock - plumb).max() > 0.01
    assert observe(PUBLISHED, marks, controller="plumb").chains.tolist() == plumb.tolist()


def test_published_settings_mean_what_their_controller_made_of_them():
    published = PublishedSettings(8.2, chain_elasticity=5e-6, holey_sled_weight=110.0)
    holey = replace(PUBLISHED, published=published)
    model, rows = model_and_observations(holey, BOARD, controller="holey")
    assert model.effect("chain_stretch", "compliance") == 5e-6
    assert rows.sled_weights[0] == model.sled_weight == 110.0
    model, _ = model_and_observations(holey, BOARD)
    assert "chain_stretch" not in model.effects


def test_chains_come_from_the_settings_in_force_and_the_model_from_the_others():
    heavy = replace(TRUE, sled_weight=130.0)
    model, rows = model_and_observations(heavy, BOARD, cut_with=PUBLISHED)
    assert model == heavy
    assert rows.chains[0] == pytest.approx(observe(PUBLISHED, BOARD).chains[0])
    assert rows.sled_weights.tolist() == [130.0, 130.0, 120.0]


def test_an_rms_counts_marks_as_vectors_and_distances_only_where_no_mark_is():
    rows = observe(BELIEVED, BOARD)
    errors = np.array([3.0, 4.0, 0.0, 0.0, 100.0, 100.0])  # two marks, then two distances
    assert rows.rms_of(errors) == pytest.approx(np.sqrt(25 / 2))
    assert rows.rms_of_noise(np.array([0.5, 0.5, 0.0, 1.2, 0.0, 0.0])) == pytest.approx(1.0)
    spans = replace(rows, measured=np.zeros((0, 2)), targets=np.zeros((0, 2)), names=())
    assert spans.rms_of(np.array([6.0, 8.0])) == pytest.approx(np.sqrt(50))


def seen(true, **how):
    """The chain view of marks that a true machine made, by the machine that sent it."""
    rows = observe(BELIEVED, Measurements(marks_on(true, BELIEVED, grid(5, 3), **how)))
    return chain_view(values_of(BELIEVED), {}, rows, BELIEVED)


def known(rows, model=BELIEVED):
    return {each.name: each for each in covariates(model, rows)}


def rows_at(*marks):
    return observe(BELIEVED, Measurements(marks))


@pytest.mark.parametrize("zero", [(2.0, 0.0), (0.0, -1.5)])
def test_a_chain_zeroed_wrong_is_the_same_error_of_that_chain_everywhere(zero):
    effects = {"chain_zero": {"left": zero[0], "right": zero[1]}}
    view = seen(replace(BELIEVED, effects=effects))
    assert view.chains == pytest.approx(np.tile(zero, (15, 1)), abs=0.01)
    assert np.ptp(np.hypot(*view.errors.T)) > 0.3  # on the sheet it looks different everywhere


def test_a_longer_chain_errs_with_its_length():
    view = seen(replace(BELIEVED, effects={"chain_pitch": {"left": 0.001, "right": 0.0}}))
    paid = lengths(BELIEVED, grid(5, 3))[0]
    share = view.chains[:, 0] / paid[:, 0]
    assert np.corrcoef(view.chains[:, 0], paid[:, 0])[0, 1] > 0.9999
    assert share == pytest.approx(np.full(15, 0.001), rel=0.15)  # less the chain on the sprocket
    assert np.abs(view.chains[:, 1]).max() < 0.01


def test_chain_errors_are_those_of_compare():
    marks = Measurements(marks_on(TRUE, BELIEVED, grid(5, 3), rotation=0.001, noise=0.5))
    compared = compare(Inputs(BELIEVED, marks)).marks
    said = [(mark.left_chain_residual, mark.right_chain_residual) for mark in compared]
    view = chain_view(values_of(BELIEVED), {}, observe(BELIEVED, marks), BELIEVED)
    assert view.chains == pytest.approx(np.array(said))
    assert view.errors == pytest.approx(np.array([mark.error for mark in compared]))


def test_a_straight_chain_closes_the_triangle():
    place = np.array([300.0, -100.0])
    seen_there = known(rows_at(Mark("1", tuple(place), tuple(place))))
    length, angle = (seen_there[name].values[0, 0] for name in ("length", "angle"))
    sprocket = np.array([-BELIEVED.motor_gap / 2, BELIEVED.motor_height])
    straight = np.hypot(*(place - sprocket))
    # Without the arm, and but for the sprocket's radius.
    assert length + BELIEVED.rotation_radius == pytest.approx(straight, abs=1.0)
    down = np.arctan2(sprocket[1] - place[1], place[0] - sprocket[0])
    assert angle == pytest.approx(down, abs=1.1 * BELIEVED.sprocket_radius / straight)


@pytest.mark.parametrize("pitch", [0.0, 0.004])  # of both chains: 8 mm in two metres
def test_an_eccentric_sprocket_is_a_sine_against_the_phase(pitch):
    runout = {"left_sine": 0.4, "left_cosine": 0.0, "right_sine": 0.0, "right_cosine": -0.3}
    effects = {"chain_pitch": {"left": pitch, "right": pitch}}
    model = replace(BELIEVED, effects=effects)
    true = replace(model, effects={**effects, "sprocket_runout": runout})
    rows = observe(model, Measurements(marks_on(true, model, grid(7, 5))))
    chains = chain_view(values_of(model), {}, rows, model).chains
    phase = known(rows, model)["phase"].values
    assert chains[:, 0] == pytest.approx(-0.4 * np.sin(phase[:, 0]), abs=0.03)
    assert chains[:, 1] == pytest.approx(0.3 * np.cos(phase[:, 1]), abs=0.03)
    assert phase.min() >= 0 and phase.max() < 2 * np.pi


def test_order_and_approach_are_those_of_the_visits():
    marks = (
        Mark("1", (0.0, 0.0), (0.0, 0.0), approach=(0.0, -40.0)),
        Mark("2", (0.0, 100.0), (0.0, 100.0)),
        Mark("3", (0.0, 200.0), (0.0, 200.0), approach=(-3.0, 0.0)),
    )
    seen_there = known(rows_at(*marks))
    assert seen_there["order"].values[:, 0].tolist() == [1, 2, 3]
    approach = seen_there["approach"].values
    assert approach[[0, 2], 0] == pytest.approx([-np.pi / 2, np.pi])
    assert np.isnan(approach[1]).all()
    assert seen_there["y"].values[:, 1] == pytest.approx([0, 100, 200], abs=1e-3)


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


ONE_MARK = (
    'frame = "machine"\n{}\n[[mark]]\nname = "1"\ntarget = [100, 200]\nmeasured = [101, 199]\n'
)
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
    marks = read_marks(file("m.toml", ONE_MARK.format(f'cut_with = "{path.name}"')), sheet=SHEET)
    assert marks.rounds[0].cut_with == OTHER
    assert observe(BELIEVED, marks).chains == pytest.approx(lengths(OTHER, [[100, 200]])[0])


def test_the_sheet_of_those_settings_is_the_one_that_edges_are_counted_from(file):
    file("small.toml", machine_toml(replace(OTHER, sheet_width=2000.0, sheet_height=1000.0)))
    text = ONE_MARK.format('cut_with = "small.toml"').replace("machine", "sheet-top-left")
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
        read_marks(file("m.toml", ONE_MARK.format(line)), sheet=SHEET)


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


AT = grid(4, 3)
TYPICAL = {name: words["typical"] for name, words in parameter_words().items() if name in NAMES}


def moved_by(**wrong):
    """The error of a machine with these numbers at each place (n, 2) [mm]."""
    chains, outcome = lengths(BELIEVED, AT)
    where, reached = places(replace(BELIEVED, **wrong), chains)
    assert (outcome == FOUND).all() and (reached == FOUND).all()
    return where - AT


def with_effect(name, size):
    effect, _, parameter = name.partition(".")
    return {effect: {parameter: size}}


@pytest.mark.parametrize("number", ["motor_gap", "motor_height", "rotation_radius"])
def test_a_number_of_the_frame_counts_as_far_as_it_may_be_off(number):
    moved = moved_by(**{number: getattr(BELIEVED, number) + 0.5})
    expected = expected_error(BELIEVED, {number: 0.5}, at=AT)
    assert expected.frame == pytest.approx(rms(moved), rel=0.01)
    assert expected.shape == pytest.approx(
        rms(best_pose(AT, AT + moved).errors), rel=0.01, abs=1e-9
    )
    assert expected_error(BELIEVED, {number: 0.0}, at=AT).frame == 0.0


def test_effects_count_by_their_typical_sizes_until_the_settings_have_them():
    whole = expected_error(BELIEVED, {}, at=AT).effects
    for name, size in TYPICAL.items():
        moved = moved_by(effects=with_effect(name, size / 10))
        shape = 10 * rms(best_pose(AT, AT + moved).errors)
        known = replace(BELIEVED, effects=with_effect(name, 1e-9 * size))
        left = expected_error(known, {}, at=AT).effects
        assert whole**2 - left**2 == pytest.approx(shape**2, rel=0.2, abs=1e-3 * whole**2), name


def test_places_reach_all_over_the_sheet():
    looked_at = places_over((2000.0, 1000.0))
    assert looked_at.shape == (COLUMNS * ROWS, 2)
    assert looked_at.max(axis=0).tolist() == [1000 - MARGIN, 500 - MARGIN]
    assert looked_at.min(axis=0).tolist() == [MARGIN - 1000, MARGIN - 500]
    by_places = expected_error(BELIEVED, PRIORS, at=places_over(BELIEVED.sheet))
    assert expected_error(BELIEVED, PRIORS) == by_places
    assert expected_anywhere(BELIEVED, PRIORS) == by_places


def test_known_numbers_replace_the_usual_ones():
    usual = expected_priors({})
    assert usual == {**PRIORS, **WIDE}
    known = expected_priors({"motor_gap": 0.5, "sled_weight": 1.0, "chain_pitch.left": 1e-4})
    assert known == {**usual, "motor_gap": 0.5, "sled_weight": 1.0}
