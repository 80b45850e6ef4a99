"""The diagnosis on boards that the judge cut, and the arithmetic of the bench.

`plumb bench` counts how often the diagnosis is right. The boards here are a few of those, by their
numbers: on each set of them a method without one of its parts (search correction, refitted frame,
slips first, degrees of freedom) says something else.
"""

from dataclasses import replace

import numpy as np
import pytest
from plumb.bench import judge
from plumb.bench.boards import chains_for, cut, plan, raw_field, size_for
from plumb.bench.causes import CAUSES, MAKER, OUTSIDE, Hidden, causes_of
from plumb.bench.hiding import REAL, SLIP_MM, Slip, nothing, raw, several, slip
from plumb.bench.judged_board import judge_board, shape_error
from plumb.bench.outcome import Line, Outcome, Rate, look_alikes, rate_of
from plumb.bench.report import run as run_bench
from plumb.bench.scenarios import NAMES, SCENARIOS, Scenario
from plumb.cli.bench import as_text
from plumb.diagnosis import diagnose
from plumb.fit.inputs import Inputs
from plumb.model.catalogue import effect_names

SEED = 77
FEW = (5, 15, 19, 25)  # seeds


def outcomes(name, boards):
    """What came of these boards of a scenario."""
    scenario = next(scenario for scenario in SCENARIOS if scenario.name == name)
    return [judge_board(scenario, index, seed=SEED).outcome for index in boards]


def value(rate, of):
    return rate_of(rate, of).value


@pytest.mark.slow
def test_nothing_is_named_where_nothing_is_hidden():
    results = outcomes("none-9", (24, 28, 30)) + outcomes("none-25", (2, 3, 5, 6, 7))
    assert value("false naming", results) == 0
    assert value("silent", results) == 1


def test_noise_from_few_repeats_invents_nothing():
    # Two readings more give 6 degrees of freedom: as if sigma were known, each of these is named.
    few = Scenario("few", "nothing", nothing, stated=None, marks=9)
    layout = replace(few.plan, again=(0, 4, 8))
    boards = [cut(Hidden(), layout, seed=seed, tape_sigma=None).measurements for seed in FEW]
    diagnoses = [diagnose(Inputs(MAKER, measured)) for measured in boards]
    named = [each for each in diagnoses if each.verdict != "nothing_provable"]
    # On the worst board it is as likely as any cause, and stands first.
    assert len(named) <= 1 and all(each.explanations[0].effects == () for each in named)


@pytest.mark.slow
def test_an_effect_of_three_millimetres_is_named_first_and_with_few_others():
    results = outcomes("one-25", (3, 6, 7, 8, 15, 16, 19, 20))
    assert value("right class first", results) == 1
    assert value("suspects", results) <= 1.4
    assert value("truth inside", results) == 1


def test_nine_marks_still_name_most():
    results = outcomes("one-9", range(10))
    assert value("right class first", results) >= 0.7
    assert value("suspects", results) <= 3
    assert value("truth inside", results) >= 0.9


@pytest.mark.slow
def test_what_the_library_does_not_know_is_flagged():
    # A bump, a cubic field and a sled that tips.
    assert value("flagged", outcomes("unknown-25", range(3))) == 1
    assert value("flagged", outcomes("unknown-9", range(3))) == 1


@pytest.mark.slow
def test_a_slip_is_named_before_any_effect():
    for name in ("slip-9", "slip-one-25", "slip-digits"):
        results = outcomes(name, range(2))
        assert value("slip named", results) == 1
        assert value("effect named first", results) == 0


def test_two_effects_are_both_named():
    assert value("both", outcomes("pairs-25", (0, 1, 3))) == 1


@pytest.mark.slow
def test_what_is_added_brings_the_sled_near_to_the_known_truth():
    scenario = next(scenario for scenario in SCENARIOS if scenario.name == "one-25")
    # Pitch may take a look-alike along; the others are cured as if the truth were known.
    cures = [judge_board(scenario, index, seed=SEED).cure for index in (1, 2, 5)]
    before, frame, after, known = (
        np.mean([getattr(cure, part) for cure in cures])
        for part in ("before", "frame", "after", "known")
    )
    assert before > 1.2 and frame > 0.7
    assert known < 0.25 and after < 1.2 * known


def test_the_judge_answers_the_same_whoever_asked_before():
    chains = chains_for(plan(3, 3))
    still, weights = np.zeros_like(chains), np.full(len(chains), 97.9)
    first = judge.places({"motor_gap": 2978.4}, chains, pushes=still, weights=weights)
    judge.places({"lean": 0.3, "left.zero": 5.0}, chains, pushes=still, weights=weights)
    again = judge.places({"motor_gap": 2978.4}, chains, pushes=still, weights=weights)
    assert np.array_equal(first, again)


def test_the_judge_refuses_a_number_that_it_does_not_know():
    chains, weights = chains_for(plan(3, 3)), np.full(9, 97.9)
    with pytest.raises(KeyError, match="weigth"):
        judge.places({"left.weigth": 1.0}, chains, pushes=0 * chains, weights=weights)
    with pytest.raises(ValueError, match="same number of rows"):
        judge.places({}, chains, pushes=0 * chains[:4], weights=weights)


@pytest.mark.parametrize("effect", sorted({cause.effect for cause in REAL}))
def test_sizes_are_those_that_move_marks_by_so_much(effect):
    layout = plan(5, 5)
    for cause in causes_of(effect):
        moved = raw_field(cause, size_for(cause, layout, 3.0), layout)
        assert np.sqrt(np.mean(np.sum(moved**2, axis=1))) == pytest.approx(3.0, rel=0.02)


def test_every_effect_of_the_library_is_hidden_somewhere():
    assert {cause.effect for cause in CAUSES} == set(effect_names())


@pytest.mark.parametrize("kind", sorted(OUTSIDE))
def test_unknown_fields_have_the_size_that_they_should(kind):
    layout = plan(5, 5)
    with_it = cut(Hidden(outside=kind, outside_mm=2.0), layout, seed=3, noise=0.0).measurements
    without = cut(Hidden(), layout, seed=3, noise=0.0).measurements
    moved = with_it.measured - without.measured
    assert np.sqrt(np.mean(np.sum(moved**2, axis=1))) == pytest.approx(2.0)


def test_a_slip_moves_one_reading():
    clean = cut(Hidden(), plan(5, 5), seed=1)
    for kind in ("turned", "digits", "axes"):
        wrong, names = slip(clean, Slip(kind), np.random.default_rng(4))
        apart = np.hypot(*(wrong.measurements.measured - clean.measurements.measured).T)
        assert np.count_nonzero(apart) == 1 and len(names) == 1
    turned, _ = slip(clean, Slip("turned"), np.random.default_rng(4))
    apart = turned.measurements.measured - clean.measurements.measured
    assert np.linalg.norm(apart) == pytest.approx(SLIP_MM)


def test_a_slip_can_be_kept_to_marks_that_are_read_again():
    board = cut(Hidden(), plan(5, 5, repeats=True), seed=1)
    names = [mark.name for mark in board.measurements.marks]
    for where, is_repeated in (("once", False), ("repeated", True)):
        for seed in range(8):
            _, slipped = slip(board, Slip("turned", 9.0, where), np.random.default_rng(seed))
            assert (names.count(slipped[0]) > 1) == is_repeated


def test_several_effects_are_different_ones_of_usual_size():
    for index in range(12):
        hidden = several(2, 1.0, 2.0, REAL)(index, plan(5, 5))
        assert len(set(hidden.effects)) == 2
        assert all(1.0 <= size <= 2.0 for _, size in hidden.causes)


def test_tape_and_pitch_draw_the_same_arrows():
    cause, layout = causes_of("chain_pitch")[0], plan(5, 5)
    assert "tape_scale" in look_alikes(cause, size_for(cause, layout, 3.0), layout, 0.5)
    plane = causes_of("chain_plane")[0]
    assert look_alikes(plane, size_for(plane, layout, 3.0), layout, 0.5) == frozenset()


def test_a_right_machine_has_no_error_on_the_sheet():
    clean = cut(Hidden(), plan(3, 3), seed=1).machine
    right = replace(
        MAKER,
        motor_gap=clean.motor_gap,
        motor_height=clean.motor_height,
        motor_center_x=clean.motor_center_x,
    )
    assert shape_error(clean, right) < 0.01
    assert shape_error(clean, replace(right, motor_gap=right.motor_gap + 10)) > 1


def outcome(**changes):
    """An outcome of which only some parts matter."""
    usual = Outcome(
        cause="nothing",
        verdict="nothing_provable",
        suspects=(),
        named=False,
        right_first=False,
        exactly_first=False,
        inside=True,
        both=False,
        slip_named=False,
        covered=True,
        invented=False,
        false_slip=False,
        small_slip=False,
        intervals=(0, 0),
        limits=(12, 13),
    )
    return replace(usual, **changes)


def test_a_rate_and_its_error_are_those_of_the_binomial():
    results = [outcome(inside=index < 90) for index in range(100)]
    rate = rate_of("truth inside", results)
    assert rate.value == pytest.approx(0.9)
    assert rate.error == pytest.approx(np.sqrt(0.9 * 0.1 / 100))
    assert rate_of("interval holds", results).count == 0


def test_suspects_count_only_where_there_are_any():
    results = [outcome(suspects=("a", "b")), outcome(), outcome(suspects=("a",))]
    assert rate_of("suspects", results).value == pytest.approx(1.5)


@pytest.mark.parametrize(
    ("value", "error", "judged"),
    [(0.95, 0.01, "reached"), (0.89, 0.01, "open"), (0.85, 0.01, "missed")],
)
def test_a_line_is_missed_only_by_more_than_chance(value, error, judged):
    assert Line("both", least=0.9).judge(Rate("both", value, error, 100)) == judged


def test_the_command_prints_rates_and_names_its_scenarios(run, ask, tmp_path):
    code, answer = ask("bench", "--scenario", "none-9", "--boards", 3)
    assert code == 0 and answer["boards"] == 3
    assert {row["rate"] for row in answer["rates"]} == {"false naming", "silent"}
    code, said, complaint = run("bench", "--scenario", "none-9", "--boards", 2)
    assert code == 0 and "false naming" in said and complaint == ""
    code, _, complaint = run("bench", "--scenario", "everything")
    assert code == 2 and "everything" in complaint and "none-9" in complaint


@pytest.mark.slow
def test_the_same_seed_gives_the_same_rates_however_many_programs_run():
    scenarios = [scenario for scenario in SCENARIOS if scenario.name in ("none-9", "slip-9")]
    alone, together = (
        run_bench(scenarios, boards=2, seed=2, progress=lambda *_: None, jobs=jobs)
        for jobs in (1, 2)
    )
    assert [row.value for row in alone.rows] == [row.value for row in together.rows]
    assert as_text(alone) == as_text(together)


def test_a_missed_line_is_said_and_the_bench_still_ran(run, monkeypatch):
    strict = Scenario("strict", "an effect", raw(3.0, REAL), (Line("silent", least=1.0),), marks=9)
    monkeypatch.setattr("plumb.bench.report.SCENARIOS", (strict,))
    monkeypatch.setattr("plumb.cli.bench.chosen_of", lambda _: (strict,))
    code, said, _ = run("bench", "--boards", 2)
    assert code == 0 and "missed: strict, silent" in said


def test_an_interruption_keeps_the_boards_that_are_done(run, ask, monkeypatch):
    judged = []

    def interrupted(scenario, index, *, seed):
        if len(judged) == 8:
            raise KeyboardInterrupt
        judged.append(index)
        return judge_board(scenario, index, seed=seed)

    monkeypatch.setattr("plumb.bench.report.judge_board", interrupted)
    code, answer = ask("bench", "--scenario", "none-9", "--boards", 20)
    assert code == 130 and answer["interrupted"] and answer["counted"] == 8
    assert {rate["count"] for rate in answer["rates"]} == {8}
    # With nothing done there is nothing to show.
    assert run("bench", "--scenario", "none-9", "--boards", 20) == (130, "", "")


def test_names_of_scenarios_are_all_different():
    assert len(set(NAMES)) == len(NAMES)
