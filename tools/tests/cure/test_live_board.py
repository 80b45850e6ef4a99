"""A board kept at hand gives the numbers of `plumb add`, also for sizes held by hand."""

import numpy as np
import pytest
from plumb import api
from plumb.cli.main import main
from plumb.cure.add import add
from plumb.cure.live_board import MOST_KEPT, Chosen, LiveBoard
from plumb.cure.machine_file import MARKS, SETTINGS
from plumb.text.errors import InputError


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


@pytest.mark.parametrize("effect", ["chain_pitch", "tape_scale", "sheet_skew"])
def test_a_size_held_where_the_fit_put_it_leaves_the_same_errors(inputs, effect):
    free = LiveBoard(inputs).fit(Chosen((effect,)))
    mine = {name: size for name, size in sizes(free).items() if name.startswith(effect)}
    held = LiveBoard(inputs).fit(Chosen((effect,), mine))
    np.testing.assert_allclose(held.errors, free.errors, atol=1e-4)
    assert not any(name.startswith(effect) for name in sizes(held))
    assert held.spent < free.spent - 0.5


def test_a_size_held_by_hand_stays_and_the_rest_makes_the_best_of_it(inputs):
    held = {"chain_pitch.left": 0.002}
    result = add(inputs, effects=["chain_pitch"], held=held)
    assert result.settings.effects["chain_pitch"]["left"] == 0.002
    assert "chain_pitch.right" in sizes(result.after_fit)
    assert result.after.fit_rms > add(inputs, effects=["chain_pitch"]).after.fit_rms


def test_a_size_that_no_setting_holds_can_be_held_too(inputs):
    result = add(inputs, effects=["tape_scale"], held={"tape_scale.strain": 0.003})
    assert result.after_fit.lab_effects == {"tape_scale": {"strain": 0.003}}


def test_what_is_held_must_belong_to_an_effect_that_was_chosen(inputs):
    with pytest.raises(InputError, match=r"--hold .*chain_sag\.weight_ratio_squared"):
        add(inputs, effects=["chain_pitch"], held={"chain_sag.weight_ratio_squared": 0.1})


def test_a_held_size_asks_for_no_mark(inputs):
    effects = ["chain_pitch", "sprocket_runout", "frame_flex", "sled_swing", "motor_level"]
    effects += ["chain_plane", "chain_sag", "chain_stretch", "sheet_skew"]
    with pytest.raises(InputError, match="cannot settle"):
        add(inputs, effects=effects)
    add(inputs, effects=effects, held={"chain_sag.weight_ratio_squared": 0.0})


def test_fits_are_kept_but_not_for_ever(inputs):
    board = LiveBoard(inputs)
    first = board.fit(Chosen())
    assert board.fit(Chosen()) is first
    for i in range(MOST_KEPT):
        board.fit(Chosen(("tape_scale",), {"tape_scale.strain": i * 1e-5}))
    assert board.fit(Chosen()) is not first


def test_the_command_holds_a_size_and_names_it_in_the_next_step(capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    words = ["add", str(SETTINGS), str(MARKS), "--effect", "chain_pitch"]
    main([*words, "--hold", "chain_pitch.left=0.002"])
    assert "--hold chain_pitch.left=0.002" in " ".join(capsys.readouterr().out.split())
    assert main([*words, "--hold", "chain_pitch.left=2%"]) == 2
    assert "NAME=SIZE" in capsys.readouterr().err
    assert main([*words[:3], "--effect", "auto", "--hold", "chain_pitch.left=0.002"]) == 2
    assert "hold none" in capsys.readouterr().err
