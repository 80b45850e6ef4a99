"""add --effect auto: what the judge's boards prove is added, and nothing else."""

import json
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from hidden_boards import board, size_for
from plumb.bench.boards import plan
from plumb.bench.causes import MAKER
from plumb.cli.main import main
from plumb.cure import auto
from plumb.cure.auto import add_auto
from plumb.cure.machine_file import MARKS, SETTINGS
from plumb.diagnosis import diagnose
from plumb.diagnosis.answer import Together
from plumb.fit.inputs import Inputs
from plumb.marks.read import Measurements, read_marks, without_marks
from plumb.model.catalogue import parameter_words
from plumb.model.plain import noun_of
from plumb.settings.files import read_settings
from plumb.text.errors import InputError
from synthetic import BELIEVED, csv_of, grid, marks_on

WIDE = plan(5, 5)
DATA = Path(__file__).resolve().parents[1] / "data"
EXAMPLE = Path(__file__).resolve().parents[3] / "docs/example"
NEGATIVE_STRETCH = Path(__file__).with_name("negative_stretch.toml")


def moved(measurements, index, by):
    """The board with one reading off by some millimetres."""
    marks = list(measurements.marks)
    marks[index] = replace(marks[index], measured=tuple(np.add(marks[index].measured, by)))
    return replace(measurements, marks=tuple(marks))


def test_one_hidden_effect_is_added_and_the_error_falls_to_the_noise():
    size = size_for("chain_plane", WIDE, 3.0)
    result = add_auto(Inputs(MAKER, board({"chain_plane": size}, WIDE, seed=4)))
    assert result.chosen == ("chain_plane",) and result.done
    addition = result.addition
    assert addition.settings.effect("chain_plane", "gap_squared") == pytest.approx(
        1600 * size, rel=0.2
    )
    assert addition.before.left_out_rms > 1.2 * addition.after.left_out_rms
    assert (
        addition.after.fit_rms < 0.85
    )  # 0.5 mm in each of two coordinates, less what the fit took


def test_two_hidden_effects_are_added_step_by_step():
    sizes = {name: size_for(name, WIDE, 6.0) for name in ("chain_pitch", "chain_plane")}
    result = add_auto(Inputs(MAKER, board(sizes, WIDE, seed=5)))
    assert set(result.chosen) == set(sizes)
    steps = [result.addition.before, *result.addition.by_effect]
    assert [step.effect for step in result.addition.by_effect] == list(result.chosen)
    for earlier, later in pairwise(steps):
        assert later.left_out_rms < earlier.left_out_rms
        assert later.corrected_rms < earlier.corrected_rms


def test_the_new_machine_leaves_nothing_to_prove_and_a_second_round_adds_nothing():
    sizes = {name: size_for(name, WIDE, 6.0) for name in ("chain_pitch", "chain_plane")}
    measured = board(sizes, WIDE, seed=5)
    first = add_auto(Inputs(MAKER, measured))
    assert (
        diagnose(Inputs(first.addition.settings, measured, cut_with=MAKER)).verdict
        == "nothing_provable"
    )
    again = add_auto(Inputs(first.addition.settings, measured, cut_with=MAKER))
    assert again.chosen == () and again.done
    assert again.addition.settings.effects == first.addition.settings.effects


def test_a_choice_is_said_to_be_one_with_what_would_settle_it():
    # On nine marks several effects draw nearly the same arrows.
    few = plan(3, 3)
    size = size_for("frame_flex", few, 3.0)
    result = add_auto(Inputs(MAKER, board({"frame_flex": size}, few, seed=2)))
    assert result.diagnosis.verdict == "cannot_tell" and result.rivals and result.done
    assert result.reason.startswith("a choice: ") and "plumb next" in result.reason
    open_ones = {noun_of(name) for name in {*result.chosen}.union(*result.rivals)}
    checks = [line.partition(":")[0] for line in result.settled_by]
    assert checks and {*checks} <= open_ones and len(checks) == len({*checks})


@pytest.mark.parametrize(
    ("marks", "chosen"),
    [
        ("frame_or_chain_zero.toml", {"chain_zero"}),
        ("frame_or_runout.toml", {"chain_stretch", "sprocket_runout"}),
    ],
)
def test_the_frame_alone_is_a_rival_and_no_choice_is_its_own(marks, chosen):
    stock = read_settings(DATA / "stock_bottom.ini")
    result = add_auto(Inputs(stock, read_marks(DATA / marks, sheet=stock.sheet)))
    assert {*result.chosen} == chosen and result.done
    assert () in result.rivals and chosen not in map(set, result.rivals)
    assert "the frame alone as well" in result.reason


def test_where_the_best_is_needless_the_frame_stands_against_the_others(monkeypatch):
    inputs = Inputs(MAKER, board({}, WIDE, seed=6))
    both = tuple(Together((name,), {name: ()}, 0.5) for name in ("chain_pitch", "chain_zero"))
    diagnosis = replace(diagnose(inputs), verdict="cannot_tell", explanations=both)
    diagnosis = replace(diagnosis, to_add=("chain_pitch",))
    monkeypatch.setattr(auto, "_is_needless", lambda name, addition: name == "chain_pitch")
    result = add_auto(inputs, diagnosis=diagnosis)
    assert result.chosen == () and result.rivals == (("chain_zero",),) and result.done
    assert "the frame alone explains the marks best, but they allow" in result.reason
    alone = add_auto(inputs, diagnosis=replace(diagnosis, explanations=both[:1]))
    assert alone.chosen == () and alone.rivals == () and not alone.done


def test_nothing_is_added_where_nothing_is_hidden():
    result = add_auto(Inputs(MAKER, board({}, WIDE, seed=6)))
    assert result.chosen == () and result.done
    assert result.addition.effects_added == () and result.addition.by_effect == ()


def test_nothing_is_fitted_to_a_slip_until_it_is_left_out():
    clean = board({}, WIDE, seed=7)
    slipped = moved(clean, 11, (0.0, 7.0))
    result = add_auto(Inputs(MAKER, slipped))
    assert result.addition is None and not result.done
    assert clean.marks[11].name in result.reason and "--without" in result.reason
    assert set(result.slips) == {clean.marks[11].name}
    again = add_auto(Inputs(MAKER, without_marks(slipped, [clean.marks[11].name])))
    assert again.done and len(again.addition.after_fit.errors) == 24


def test_a_mark_that_is_not_there_cannot_be_left_out():
    with pytest.raises(InputError, match="--without unknown name 'A9'"):
        without_marks(board({}, plan(3, 3), seed=1), ["A9"])


def test_what_is_not_in_the_library_is_left_alone():
    result = add_auto(Inputs(MAKER, board({}, WIDE, seed=8, bump=3.0)))
    assert result.diagnosis.verdict == "not_in_library"
    assert not result.done and "not all that the marks show is in the library" in result.reason
    addition = result.addition
    assert addition.effects_added == result.chosen
    assert not result.chosen or addition.after.left_out_rms < addition.before.left_out_rms


def test_a_known_effect_is_not_left_out_because_another_is_unknown():
    size = size_for("chain_plane", WIDE, 6.0)
    result = add_auto(Inputs(MAKER, board({"chain_plane": size}, WIDE, seed=12, bump=2.0)))
    assert result.diagnosis.verdict == "not_in_library" and not result.done
    assert "chain_plane" in result.chosen
    assert result.addition.after.left_out_rms < 0.7 * result.addition.before.left_out_rms


@pytest.mark.parametrize(("share", "is_added"), [(0.5, True), (3.0, False)])
def test_where_not_all_is_known_no_size_is_added_that_no_machine_has(share, is_added):
    # The effect pays in both: marks that are left out are predicted better with it.
    largest = parameter_words()["chain_pitch.left"]["high"]
    true = replace(BELIEVED, effects={"chain_pitch": {"left": share * largest}})
    marks = marks_on(true, BELIEVED, grid(5, 5), noise=0.5, seed=3)
    inputs = Inputs(BELIEVED, Measurements(marks, source="made up"), sigma=0.5)
    unknown = replace(diagnose(inputs), verdict="not_in_library", to_add=("chain_pitch",))
    result = add_auto(inputs, diagnosis=unknown)
    assert (result.chosen == ("chain_pitch",)) is is_added
    assert result.addition.effects_added == result.chosen


def test_a_tape_that_reads_long_is_fitted_along_and_its_remedy_told():
    result = add_auto(
        Inputs(MAKER, board({"tape_scale": 8.0}, WIDE, seed=9, noise=0.2, tape_sigma=0.2))
    )
    assert "tape_scale" in {*result.chosen, *(name for rival in result.rivals for name in rival)}
    if "tape_scale" in result.chosen:
        assert "tape_scale" not in result.addition.settings.effects
        assert any("no firmware can cure" in cure for cure in result.addition.cures)


def test_impossible_sizes_are_never_added_by_themselves():
    stock = read_settings(SETTINGS)
    result = add_auto(Inputs(stock, read_marks(MARKS, sheet=stock.sheet)))
    assert result.diagnosis.explanations and not any(
        explanation.possible for explanation in result.diagnosis.explanations
    )
    assert result.chosen == () and not result.done
    assert "no real machine has" in result.reason


def test_an_effect_of_impossible_size_that_may_be_zero_is_left_out():
    stock = read_settings(EXAMPLE / "groundcontrol.ini")
    measured = read_marks(NEGATIVE_STRETCH, sheet=stock.sheet)
    result = add_auto(Inputs(stock, measured))
    best = result.diagnosis.explanations[0].effects
    assert set(best) == {"chain_stretch", "chain_pitch"}  # the stretch below nothing
    assert result.chosen == ("chain_pitch",)
    assert all(parameter.plausible for parameter in result.addition.parameters)
    assert result.addition.settings.effect("chain_stretch", "compliance") >= 0


def test_the_command_writes_nothing_for_a_slip_and_says_so(tmp_path, capsys):
    stock = read_settings(SETTINGS)
    marks = read_marks(MARKS, sheet=stock.sheet)
    right = [replace(mark, measured=mark.target) for mark in marks.marks]
    right[4] = replace(right[4], measured=tuple(np.add(right[4].target, (0.0, 25.0))))
    path, out = tmp_path / "marks.csv", tmp_path / "machine.toml"
    path.write_text(csv_of(right))
    code = main(["add", str(SETTINGS), str(path), "--effect", "auto", "-o", str(out), "--json"])
    report = json.loads(capsys.readouterr().out)
    assert code == 1 and not out.exists()
    assert report["auto"]["verdict"] == "slip" and report["written"] == []


def test_auto_stands_alone():
    assert main(["add", str(SETTINGS), str(MARKS), "--effect", "auto", "chain_sag"]) == 2
