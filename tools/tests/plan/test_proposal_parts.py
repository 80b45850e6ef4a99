"""What a proposal promises apart from its chance: pairs that are parted, and rooms."""

from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest
from plan_cases import MACHINE, case_on, nine
from plumb.diagnosis.sizes import Room
from plumb.marks.read import Measurements
from plumb.plan.case import Check, Planned
from plumb.plan.options import many_marks
from plumb.plan.planned_visits import nowhere
from plumb.plan.proposal import DISTINGUISHED, _parted, _rooms, _smallest
from plumb.plan.separation import ENOUGH, Chooser, apart, drawn_by, pairs_of
from synthetic import grid, marks_on


def pitch_board(left=0.006):
    """Nine marks of a machine whose left chain is longer than the settings say."""
    effects = {**MACHINE.effects, "chain_pitch": {"left": left, "right": 0.0}}
    machine = replace(MACHINE, effects=effects)
    return Measurements(marks_on(machine, MACHINE, grid(3, 3), noise=0.2))


def test_rooms_shrink_as_the_least_visible_direction_grows():
    case = case_on(nine())
    rooms = [Room("chain_sag", (), 5.0), Room("frame_lean", (), 2.0), Room("chain_zero", (), None)]
    checks = (Check("chain_sag.weight_ratio_squared", 1e-14),)
    then = _rooms(case, Planned(nowhere(), checks), rooms)
    assert [room.effect for room in then] == ["chain_sag", "frame_lean"]
    assert then[0].now == 5.0 and then[0].then < 0.1
    assert (then[1].now, then[1].then) == (2.0, pytest.approx(2.0))
    nothing = _rooms(case, Planned(nowhere()), rooms)
    assert [room.then for room in nothing] == pytest.approx([5.0, 2.0])
    more = _rooms(case, Planned(many_marks(case).visits), rooms[:1])
    assert 0.1 * 5.0 < more[0].then < 0.9 * 5.0


def test_the_least_visible_direction_is_what_the_frame_leaves_of_it():
    slopes = np.array([[1.0, 1.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 2.0]])
    frame, columns = np.array([0]), np.array([1, 2])
    assert _smallest(slopes, columns, frame) == pytest.approx(2.0)
    assert _smallest(slopes, columns[:1], frame) == pytest.approx(3.0)
    assert _smallest(slopes, columns, np.array([], dtype=int)) == pytest.approx(2.0)


def test_pairs_are_parted_that_were_not_before():
    case = case_on(pitch_board(0.0045), "frame_lean", "chain_pitch", "tape_scale")
    names = [hypothesis.effects[0] for hypothesis in case.hypotheses]
    planned = Planned(many_marks(case).visits)

    def least(first, second, slopes_of):
        return min(
            apart(
                slopes_of(truth),
                drawn_by(truth),
                np.concatenate([case.board.frame, case.board.columns(rival.effects)]),
            )
            for truth, rival in ((first, second), (second, first))
        )

    expected = []
    for first, second in combinations(case.hypotheses, 2):
        now = least(first, second, lambda each: each.at.slopes)
        then = least(first, second, lambda each: planned.ahead(each.at).slopes)
        if then >= DISTINGUISHED > now:
            expected.append((first.effects[0], second.effects[0]))
    pairs = _parted(case, planned)
    assert pairs == tuple(expected) and len(pairs) == 2
    assert all(names.index(first) < names.index(second) for first, second in pairs)
    assert _parted(case, Planned(nowhere())) == ()


def test_a_pair_counts_as_parted_below_what_is_enough():
    assert 0.5 * ENOUGH < DISTINGUISHED < ENOUGH


def test_two_effects_are_apart_by_what_a_fit_of_the_other_leaves():
    source = np.random.default_rng(4)
    slopes = source.standard_normal((12, 5))
    drawn, fitted = np.zeros((5, 2)), np.array([0, 1, 2])
    drawn[3, 0], drawn[4, 1] = 2.0, 3.0
    both = slopes @ drawn
    left = both - slopes[:, fitted] @ np.linalg.lstsq(slopes[:, fitted], both, rcond=None)[0]
    assert apart(slopes, drawn, fitted) == pytest.approx(np.sum(left**2))
    # In microns or in metres: the scale of what is fitted does not matter, and unfelt ones neither.
    for scale in (1e-3, 1e3):
        scaled = slopes * np.array([scale, scale, scale, 1.0, 1.0])
        assert apart(scaled, drawn, fitted) == pytest.approx(np.sum(left**2), rel=1e-5)
    unfelt = slopes * np.array([1.0, 1.0, 0.0, 1.0, 1.0])
    rest = both - slopes[:, :2] @ np.linalg.lstsq(slopes[:, :2], both, rcond=None)[0]
    assert apart(unfelt, drawn, fitted) == pytest.approx(np.sum(rest**2))
    # What is fitted itself is not apart from the fit.
    same = np.zeros((5, 1))
    same[1, 0] = 1.0
    assert apart(slopes, same, fitted) == pytest.approx(0.0, abs=1e-6)


def test_every_suspect_is_held_against_every_other():
    case = case_on(pitch_board(), "chain_pitch", "tape_scale", "frame_lean")
    pairs = pairs_of(case)
    assert len(pairs) == 6 and all(pair.weight == pytest.approx(2 / 3) for pair in pairs)
    alone = case_on(pitch_board(), "chain_pitch", verdict="one_suspect")
    assert len(pairs_of(alone)) == len(alone.posterior.felt) - 1
    hidden = case_on(nine())
    assert len(pairs_of(hidden)) == len(hidden.hypotheses)
    for pair in pairs_of(hidden):
        assert pair.fitted.tolist() == hidden.board.frame.tolist()


def test_visits_are_chosen_without_repeating_any_and_exchanged_for_better():
    case = case_on(nine(), "chain_pitch", "frame_lean")
    pool = many_marks(case).visits
    chooser = Chooser(case, pool)
    allowed = [3, 5, 8, 13, 21]
    best = chooser.best(allowed, 3)
    assert len(set(best)) == 3 and set(best) <= set(allowed)
    greedy = []
    for _ in range(3):
        left = [i for i in allowed if i not in greedy]
        greedy.append(max(left, key=lambda i: chooser.worth([*greedy, i])))
    assert chooser.worth(best) >= chooser.worth(greedy)
    assert chooser.worth([]) == pytest.approx(
        sum(
            pair.weight * min(ENOUGH, apart(pair.at.slopes, pair.drawn, pair.fitted))
            for pair in pairs_of(case)
        )
    )
