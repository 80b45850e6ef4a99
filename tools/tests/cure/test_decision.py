"""add --effect auto adds what boards prove and nothing else; a board at hand gives its numbers."""

from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from example_machine import EXAMPLE
from hidden_boards import HIDDEN, board, size_for
from plumb import api
from plumb.bench.boards import BARE, MAKER, PUBLISHED, plan
from plumb.cure.add import Chosen, LiveBoard, add
from plumb.cure.decision import decide
from plumb.diagnosis import diagnose
from plumb.fit.inputs import Inputs
from plumb.marks.read import read_marks, without_marks
from plumb.model.catalogue import parameter_words
from plumb.model.plain import noun_of
from plumb.settings.files import read_settings
from plumb.words.decision import headline, reason, settled_by
from published_marks import MARKS, SETTINGS
from synthetic import read_elsewhere

WIDE = plan(5, 5)
NEGATIVE_STRETCH = Path(__file__).with_name("negative_stretch.toml")


def test_one_hidden_effect_is_added_and_the_error_falls_to_the_noise():
    size = size_for("chain_plane", WIDE, 3.0)
    result = decide(Inputs(MAKER, board({"chain_plane": size}, WIDE, seed=4)))
    assert result.chosen == ("chain_plane",) and result.done
    addition = result.addition
    gap_squared = addition.settings.effect("chain_plane", "gap_squared")
    assert gap_squared == pytest.approx(1600 * size, rel=0.2)
    assert addition.before.left_out_rms > 1.2 * addition.after.left_out_rms
    assert (
        addition.after.fit_rms < 0.85
    )  # 0.5 mm in each of two coordinates, less what the fit took


def test_two_hidden_effects_are_added_step_by_step():
    sizes = {name: size_for(name, WIDE, 6.0) for name in ("chain_pitch", "chain_plane")}
    result = decide(Inputs(MAKER, board(sizes, WIDE, seed=5)))
    assert set(result.chosen) == set(sizes)
    steps = [result.addition.before, *result.addition.by_effect]
    assert [step.effect for step in result.addition.by_effect] == list(result.chosen)
    for earlier, later in pairwise(steps):
        assert later.left_out_rms < earlier.left_out_rms
        assert later.corrected_rms < earlier.corrected_rms


def test_the_new_machine_leaves_nothing_to_prove_and_a_second_round_changes_nothing():
    sizes = {name: size_for(name, WIDE, 6.0) for name in ("chain_pitch", "chain_plane")}
    measured = board(sizes, WIDE, seed=5)
    first = decide(Inputs(MAKER, measured))
    assert (
        diagnose(Inputs(first.addition.settings, measured, cut_with=MAKER)).verdict
        == "nothing_provable"
    )
    again = decide(Inputs(first.addition.settings, measured, cut_with=MAKER))
    assert again.state == "good" and again.done and again.addition is None


def test_a_choice_between_effects_is_named_with_a_measurement_that_settles_it():
    # On nine marks several effects draw nearly the same arrows.
    few = plan(3, 3)
    size = size_for("frame_flex", few, 3.0)
    result = decide(Inputs(MAKER, board({"frame_flex": size}, few, seed=2)))
    assert result.diagnosis.verdict == "cannot_tell" and result.rivals and result.done
    assert "the likeliest of several" in reason(result) and "plumb next" in reason(result)
    open_ones = {noun_of(name) for name in {*result.chosen}.union(*result.rivals)}
    checks = [line.partition(":")[0] for line in settled_by(result)]
    assert checks and {*checks} <= open_ones and len(checks) == len({*checks})


@pytest.mark.parametrize("seed", [1, 2, 7])
def test_adding_ends_with_a_reason_on_any_board(seed):
    source = np.random.default_rng(seed)
    layout = plan(*[(2, 2), (3, 3), (5, 3), (4, 4)][seed % 4], repeats=bool(seed % 3 == 0))
    names = source.choice(sorted(HIDDEN), int(source.integers(0, 4)), replace=False)
    sizes = {name: min(float(source.uniform(-1, 4)), 1.5) for name in names}
    settings = [MAKER, PUBLISHED, BARE][seed % 3]
    measured = board(
        {name: max(size, 0.0) for name, size in sizes.items()},  # below zero there is nothing
        layout,
        seed=seed,
        noise=float(source.uniform(0.1, 1.5)),
        tape_sigma=[None, 0.3, 1.0][int(source.integers(3))],
        bump=float(source.choice([0.0, 0.0, 2.0])),
    )
    result = decide(Inputs(settings, measured), patch=bool(seed % 2))
    assert reason(result) and headline(result)
    assert {*result.chosen} not in [{*rival} for rival in result.rivals]
    if result.addition:
        for effect, parameters in result.addition.settings.effects.items():
            for parameter, size in parameters.items():
                words = parameter_words()[f"{effect}.{parameter}"]
                assert words["low"] < 0 or size > -0.02 * abs(words["typical"])


def test_nothing_is_fitted_to_a_slip_until_it_is_left_out():
    clean = board({}, WIDE, seed=7)
    slipped = read_elsewhere(clean, 11, (0.0, 7.0))
    result = decide(Inputs(MAKER, slipped))
    assert result.addition is None and not result.done
    assert clean.marks[11].name in reason(result) and "--without" in reason(result)
    assert set(result.slips) == {clean.marks[11].name}
    again = decide(Inputs(MAKER, without_marks(slipped, [clean.marks[11].name])))
    assert again.done and len(again.addition.after_fit.errors) == 24


def test_a_known_effect_is_not_left_out_because_another_is_unknown():
    size = size_for("chain_plane", WIDE, 6.0)
    result = decide(Inputs(MAKER, board({"chain_plane": size}, WIDE, seed=12, bump=2.0)))
    assert result.diagnosis.verdict == "not_in_library" and result.done
    assert "chain_plane" in result.chosen
    assert result.addition.after.left_out_rms < 0.7 * result.addition.before.left_out_rms


def test_a_tape_that_reads_long_is_fitted_and_its_remedy_named():
    measured = board({"tape_scale": 8.0}, WIDE, seed=9, noise=0.2, tape_sigma=0.2)
    result = decide(Inputs(MAKER, measured))
    assert "tape_scale" in {*result.chosen, *(name for rival in result.rivals for name in rival)}
    if "tape_scale" in result.chosen:
        assert "tape_scale" not in result.addition.settings.effects
        assert any("no firmware can cure" in cure for cure in result.addition.cures)


def test_published_marks_that_no_machine_explains_ask_for_no_size_that_none_has():
    stock = read_settings(SETTINGS)
    result = decide(Inputs(stock, read_marks(MARKS, sheet=stock.sheet)))
    assert result.diagnosis.verdict == "not_in_library"
    assert result.addition.after.left_out_rms < 0.7 * result.addition.before.left_out_rms
    assert all(parameter.possible for parameter in result.addition.parameters)


def test_a_stretch_below_nothing_is_added_as_nothing():
    stock = read_settings(EXAMPLE / "groundcontrol.ini")
    result = decide(Inputs(stock, read_marks(NEGATIVE_STRETCH, sheet=stock.sheet)))
    assert "chain_pitch" in result.chosen
    assert all(parameter.possible for parameter in result.addition.parameters)
    stretch = result.addition.settings.effect("chain_stretch", "compliance")
    assert stretch == pytest.approx(0.0, abs=1e-8)


@pytest.fixture(scope="module")
def inputs():
    return api.read(SETTINGS, MARKS)


def sizes(fitted):
    return {estimate.name: estimate.value for estimate in fitted.estimates}


def test_refits_one_after_the_other_end_where_add_begins_afresh(inputs):
    board = LiveBoard(inputs)
    way = [("chain_pitch",), ("tape_scale", "chain_pitch"), ("chain_sag", "chain_stretch"), ()]
    for effects in [*way, ("chain_pitch", "sheet_skew")]:
        live, added = board.fit(Chosen(effects)), add(inputs, effects=effects).after_fit
        assert sizes(live) == pytest.approx(sizes(added), rel=1e-4, abs=1e-7)
        np.testing.assert_allclose(live.errors, added.errors, atol=2e-5)
        assert live.left_out_rms == pytest.approx(added.left_out_rms, rel=2e-5)
        assert live.corrected_rms == pytest.approx(added.corrected_rms, rel=2e-5)
