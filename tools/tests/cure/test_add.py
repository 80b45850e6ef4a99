"""add: effects that help are told from others; sizes that no machine has, as diagnose does."""

from dataclasses import replace

import pytest
from plumb.cure.add import add
from plumb.diagnosis.diagnosis import sizes_of
from plumb.diagnosis.evidence import KNOWN, Noise
from plumb.diagnosis.explanation import explain, measured_board
from plumb.fit.fit import PRIORS, priors_with
from plumb.fit.inputs import Inputs
from plumb.marks.read import Measurements
from plumb.model.catalogue import effect_names, parameter_words
from published_marks import SETTINGS
from synthetic import BELIEVED, EFFECTS, TRUE, grid, marks_on

BOARD = Measurements(marks_on(TRUE, BELIEVED, grid(5, 3), noise=0.3), source="marks.csv")
STRETCHED = replace(BELIEVED, motor_gap=2980.0, effects={"chain_stretch": EFFECTS["chain_stretch"]})


def warned(result, *words):
    return any(all(word in line for word in words) for line in result.warnings)


def test_the_new_settings_are_ours_and_hold_what_was_fitted():
    result = add(Inputs(BELIEVED, BOARD), effects=list(EFFECTS))
    assert result.settings.controller == "plumb"
    for estimate in result.parameters:
        effect, _, parameter = estimate.name.rpartition(".")
        if effect:
            assert result.settings.effect(effect, parameter) == estimate.value
    gap = next(estimate for estimate in result.parameters if estimate.name == "motor_gap")
    assert result.settings.motor_gap == gap.value
    assert (gap.before, gap.prior_sigma, gap.unit) == (2978.4, PRIORS["motor_gap"], "mm")


def test_a_true_effect_pays_and_is_plausible():
    result = add(Inputs(BELIEVED, BOARD), effects=["chain_pitch", "chain_sag"])
    assert result.pays and result.after.left_out_rms < 0.5 * result.before.left_out_rms
    assert all(
        parameter.plausible and parameter.low < parameter.value < parameter.high
        for parameter in result.parameters
    )
    assert not warned(result, "impossible")


def test_effects_that_the_machine_has_stay_unless_they_are_named():
    board = Measurements(marks_on(TRUE, STRETCHED, grid(5, 3)))
    kept = add(Inputs(STRETCHED, board), effects=["chain_sag"])
    assert kept.settings.effects["chain_stretch"] == EFFECTS["chain_stretch"]
    assert kept.effects_added == ("chain_sag",)
    refitted = add(Inputs(STRETCHED, board), effects=["chain_sag", "chain_stretch"])
    assert refitted.settings.effects["chain_stretch"] != EFFECTS["chain_stretch"]
    assert refitted.effects_added == ("chain_sag",)


def test_old_marks_are_fitted_with_the_settings_that_cut_them():
    board = Measurements(marks_on(TRUE, BELIEVED, grid(5, 3)))
    priors = priors_with([("motor_gap", 100.0)])
    result = add(Inputs(STRETCHED, board, cut_with=BELIEVED, priors=priors), effects=list(EFFECTS))
    assert result.after.fit_rms < 0.001
    assert result.settings.effect("chain_pitch", "left") == pytest.approx(0.0021, rel=1e-3)


def test_a_stated_reading_error_comes_from_the_option_then_from_the_file():
    stated = replace(BOARD, tape_sigma=0.4)
    by_marks, by_both, final = (
        add(given, effects=["chain_sag"])
        for given in (
            Inputs(BELIEVED, BOARD),
            Inputs(BELIEVED, stated),
            Inputs(BELIEVED, stated, sigma=0.7),
        )
    )
    assert by_marks.sigma_from == "marks" and by_both.sigma_from == "stated and marks"
    assert by_both.after_fit.sigma == pytest.approx(0.35, abs=0.05)  # 0.4 stated, 0.3 in truth
    assert final.sigma_from == "stated" and final.after_fit.sigma == 0.7


def test_the_sheet_is_to_be_turned_back():
    # On the sheet the marks climb to the right: its right end hangs too low.
    turned = Measurements(marks_on(BELIEVED, BELIEVED, grid(5, 3), rotation=0.002))
    result = add(Inputs(BELIEVED, turned), effects=["chain_sag"])
    assert result.sheet_rise == pytest.approx(0.002 * 2438.4, rel=0.01)
    (sentence,) = result.by_hand
    assert "raise the right end of the next sheet by 4.88 mm" in sentence


@pytest.mark.parametrize(("turn", "said"), [(0.0001, 0), (-0.0001, 0), (0.0006, 1), (-0.0006, 1)])
def test_a_rotation_that_may_be_zero_needs_no_action(turn, said):
    marks = marks_on(BELIEVED, BELIEVED, grid(5, 3), rotation=turn, noise=0.5)
    result = add(Inputs(BELIEVED, Measurements(marks)), effects=["chain_sag"])
    assert len(result.by_hand) == said


def test_distances_alone_say_nothing_of_where_the_sheet_lies(run, ask, tmp_path):
    """Neither its rotation nor the middle of the motors is printed, and both stay as they were."""
    folder = SETTINGS.parents[1] / "madgrizzle-2018-08-30"
    board = (folder / "groundcontrol.ini", folder / "marks.toml")
    machine = tmp_path / "machine.toml"
    options = ("--effect", "chain_pitch", "-o", machine)
    code, said, _ = run("add", *board, *options, "--details")
    assert code <= 1 and "right end" not in said and "turned by" not in said
    unfelt = "nothing that was measured tells these, so they stay as they were: motors above"
    assert unfelt in " ".join(said.split())
    assert "0.00 mm over" not in machine.read_text()
    assert "motor_center_x = 0.0 " in machine.read_text()
    assert "sheet_rotation = 0.0\n" in machine.read_text()
    _, answer = ask("add", *board, *options)
    assert answer["sheet_rotation"] is None and answer["sheet_rise_mm"] is None
    assert answer["frame"]["motor_center_x"] == 0
    names = [parameter["name"] for parameter in answer["parameters"]]
    assert names == ["motor_gap", "chain_pitch.left", "chain_pitch.right"]
    said = run("compare", machine, board[1], "--details")[1]
    assert "fitted to these marks" in said and "turned" not in said


SIGMA = 0.5
WIDE = grid(5, 5)
SIZED = ("chain_pitch.left", "chain_plane.gap_squared", "frame_flex.inward")


def board_with(name, share):
    """Marks of a machine on which a parameter has a share of the largest plausible size."""
    effect, _, parameter = name.partition(".")
    size = share * parameter_words()[name]["high"]
    true = replace(BELIEVED, effects={effect: {parameter: size}})
    return Measurements(marks_on(true, BELIEVED, WIDE, noise=SIGMA, seed=3), source="made up")


def judged(measurements, effect):
    """Of each parameter: whether it is plausible and possible by the diagnosis, and by the fit."""
    inputs = Inputs(BELIEVED, measurements, sigma=SIGMA)
    fitted = explain(measured_board(inputs), (effect,))
    sizes = sizes_of(fitted, effect, Noise(SIGMA, KNOWN, "stated"))
    estimates = {each.name: each for each in add(inputs, effects=(effect,)).parameters}
    return {
        size.name: (
            (size.plausible, estimates[f"{effect}.{size.name}"].plausible),
            (size.possible, estimates[f"{effect}.{size.name}"].possible),
        )
        for size in sizes
        if size.low is not None
    }


def test_the_fit_and_the_diagnosis_agree_on_every_effect():
    for number, name in enumerate(SIZED):
        measurements = board_with(name, 1.6)
        # Some of them: all on each board would take a minute.
        for effect in {name.partition(".")[0], *effect_names()[number::5]} - {"sled_friction"}:
            for by_both in judged(measurements, effect).values():
                assert all(ours == theirs for ours, theirs in by_both), (name, effect)


@pytest.mark.parametrize("name", SIZED)
def test_add_and_diagnose_both_doubt_a_size_far_beyond_plausible(name):
    effect, _, parameter = name.partition(".")
    doubted = judged(board_with(name, 3.0), effect)
    assert doubted[parameter] == ((False, False), (False, False))
