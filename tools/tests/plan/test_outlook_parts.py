"""The diagnosis of boards to come: its noise, what stands and what falls, and by how much."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from plan_cases import SIGMA, case_on, nine
from plumb.diagnosis.explanation import Spread
from plumb.diagnosis.noise import FEW_REPEATS, STATEMENT, Noise
from plumb.marks.read import Measurements
from plumb.plan.case import ahead
from plumb.plan.options import _Shop, many_marks
from plumb.plan.outlook import Rediagnosis, _drop, noise_after
from plumb.plan.planned_visits import joined, nowhere


def test_new_marks_tell_nothing_of_the_noise():
    case = case_on(nine(), "chain_pitch")
    assert noise_after(case, many_marks(case).visits) is case.noise
    assert noise_after(case, nowhere()) is case.noise


def test_what_is_read_again_makes_a_stated_noise_surer():
    case = case_on(nine(), "chain_pitch")
    old = _Shop(case).old()
    again = noise_after(case, old)
    assert again.source == "stated and repeats" and again.sigma == SIGMA
    assert again.degrees == STATEMENT + 2 * 9 and again.within == Spread(18 * SIGMA**2, 18)
    twice = noise_after(case, joined(old, old.taken([0])))
    assert twice.degrees == STATEMENT + 2 * 10
    # Under another weight, or with swapped chains, it is another reading.
    assert noise_after(case, replace(old, sled_weights=old.sled_weights + 1)) is case.noise
    assert noise_after(case, replace(old, swapped=~old.swapped)) is case.noise


def test_a_guessed_noise_gives_way_to_enough_repeats():
    usual = replace(case_on(nine(), "chain_pitch"), noise=Noise(SIGMA, 4.0, "default"))
    old = _Shop(usual).old()
    few = FEW_REPEATS // 2 - 1
    assert noise_after(usual, old.taken(range(few))) is usual.noise
    enough = noise_after(usual, old.taken(range(few + 1)))
    assert (enough.source, enough.degrees) == ("repeats", FEW_REPEATS)
    assert enough.sigma == SIGMA and enough.within.sigma == pytest.approx(SIGMA)


def test_repeats_that_there_are_count_too():
    marks = nine().marks + nine(seed=2).marks[:4]
    case = case_on(Measurements(marks), "chain_pitch")
    old = _Shop(case).old().taken([0])
    assert noise_after(case, old).degrees == STATEMENT + 2 * 4 + 2
    within = Noise(SIGMA, 20.0, "stated and repeats", within=Spread(12 * SIGMA**2, 12))
    assert noise_after(replace(case, noise=within), old).degrees == STATEMENT + 12 + 2


def rediagnosis(case, visits=None):
    planned = visits if visits is not None else many_marks(case).visits
    return Rediagnosis(case, ahead(case.hypotheses[0].at, planned), case.noise, None)


def test_effects_are_sorted_by_how_many_numbers_they_have():
    case = case_on(nine(), "chain_pitch", "chain_sag")
    test = rediagnosis(case)
    assert {"chain_sag", "sheet_skew", "tape_scale"} <= {*test.single}
    assert {"chain_pitch", "sprocket_runout", "frame_flex"} <= {*test.several}
    assert {*test.single} | {*test.several} == {*test.felt}
    for name, column in test.single.items():
        assert case.board.columns([name]).tolist() == [column]
    assert len(test.names) == len(set(test.names)) == len(test.felt)
    pair = replace(case.hypotheses[0], effects=("chain_pitch", "chain_sag"))
    both = Rediagnosis(
        replace(case, hypotheses=(*case.hypotheses, pair)),
        ahead(pair.at, many_marks(case).visits),
        case.noise,
        None,
    )
    assert [*test.names, pair.effects] == [*both.names]


def test_the_gain_of_an_effect_is_what_its_fit_takes_off():
    case = case_on(nine(), "chain_pitch")
    test = rediagnosis(case)
    readings = np.random.default_rng(3).standard_normal((len(test.slopes), 5)) * 2
    best, left = test._gains(test.frame, (), readings)
    assert left == pytest.approx(readings - test.frame @ (test.frame.T @ readings))
    cost = np.sum(left**2, axis=0)
    for name in test.felt:
        columns = np.concatenate([case.board.frame, case.board.columns([name])])
        slopes = test.slopes[:, columns]
        rest = readings - slopes @ np.linalg.lstsq(slopes, readings, rcond=1e-10)[0]
        drop = cost - np.sum(rest**2, axis=0)
        if name in test.single:
            along = test._single_drop(*_gram(test, readings), ())
            assert (along >= drop * (1 - 1e-6)).all(), name
        else:
            gram, along = _gram(test, readings)
            mine = case.board.columns([name])
            seen, by_block = _drop(gram[np.ix_(mine, mine)], along[mine], test.lengths[mine])
            assert seen == len(mine) and by_block == pytest.approx(drop, rel=1e-4), name
    # Without the best of them the next best is left.
    less = np.min([test._gains(test.frame, (name,), readings)[0] for name in test.felt], axis=0)
    assert (less <= best + 1e-9).all() and (less < best - 1e-6).any()


def _gram(test, readings):
    left = readings - test.frame @ (test.frame.T @ readings)
    beyond = test.slopes - test.frame @ (test.frame.T @ test.slopes)
    return beyond.T @ beyond, beyond.T @ left


def test_what_is_turned_keeps_all_squares():
    case = case_on(nine(), "chain_pitch")
    test = rediagnosis(case)
    drawn = test.boards(case.hypotheses[0], np.random.default_rng(2), 7)
    turned = test._turned(drawn)
    assert np.sum(turned.few**2, axis=0) + turned.beyond == pytest.approx(np.sum(drawn**2, axis=0))
    assert turned.few.shape == (len(test.slopes), 7) and (turned.beyond >= 0).all()


def test_a_misfit_is_as_likely_as_chance_says():
    case = case_on(nine(), "chain_pitch")
    test = rediagnosis(case)
    source = np.random.default_rng(5)
    boards = test._turned(source.standard_normal((len(test.rows.slopes), 800)))
    left = boards.few - test.frame @ (test.frame.T @ boards.few)
    chances = test._misfit(left, boards.beyond, test._spare(test.frame))
    for level in (0.1, 0.5, 0.9):
        assert np.mean(chances < level) == pytest.approx(level, abs=0.05)
    unknown = replace(case, noise=Noise(SIGMA, 5.0, "scatter"))
    assert (rediagnosis(unknown)._misfit(left, boards.beyond, 3.0) == np.ones(800)).all()
    assert (test._misfit(100 * left, boards.beyond, 0.4) == np.ones(800)).all()
    assert (test._misfit(100 * left, boards.beyond, 0.6) < 0.01).all()


PITCH, SAG, TAPE = "chain_pitch", "chain_sag", "tape_scale"
NONE = 99  # explanations that are left where nothing is proved
# Each board: whether anything is proved, the accounts listed, those that fit, and the single
# effects that explain all alone. Then whether it is settled, and how many explanations are left.
WEIGHED = [
    ((True, [(PITCH,)], [(PITCH,)], []), (1, 1)),
    ((True, [(PITCH, SAG)], [(PITCH, SAG)], []), (1, 1)),
    ((True, [(PITCH,), (TAPE,)], [(PITCH,), (TAPE,)], []), (0, 2)),
    ((True, [(PITCH,), (TAPE,)], [(PITCH,)], []), (1, 1)),
    ((True, [(PITCH,)], [], []), (0, 1)),
    ((False, [(PITCH,)], [(PITCH,)], []), (0, NONE)),
    ((True, [(SAG,)], [(SAG,)], []), (0, 1)),
    ((True, [(PITCH, TAPE)], [(PITCH, TAPE)], []), (0, 1)),
    ((True, [], [(PITCH,)], []), (0, 1)),
]
ALONE = [
    ((True, [(PITCH,)], [(PITCH,)], [TAPE]), (0, 1)),
    ((True, [(PITCH,)], [(PITCH,)], [TAPE, PITCH]), (0, 2)),
    ((True, [(PITCH,), (TAPE,)], [(PITCH,), (TAPE,)], [PITCH]), (0, 1)),
]


class _Said(Rediagnosis):
    """A diagnosis of boards of which it is said what they prove."""

    def __init__(self, boards, *, is_left_out):
        self.boards_said, self.is_left_out = boards, is_left_out
        self.felt, self.frame, self.threshold, self.nothing = [PITCH, SAG, TAPE], None, 5.0, NONE

    def _turned(self, drawn):
        return SimpleNamespace(few=drawn)

    def _asked(self, drawn, answer):
        return np.array([answer(self.boards_said[each]) for each in drawn])

    def _gains(self, fitted, effects, readings):
        return self._asked(readings, lambda board: 5.1 if board[0] else 5.0), readings

    def _fits(self, effects, boards):
        return self._asked(boards.few, lambda board: effects in board[2])

    def _stands(self, effects, boards):
        return self._asked(boards.few, lambda board: effects[0] in board[3])


@pytest.mark.parametrize("is_left_out", [False, True])
def test_an_account_settles_only_what_no_single_effect_explains(is_left_out):
    # Where the settings leave out an effect on purpose, single effects are weighed like all else.
    alone = [(board, (1, 1) if len(board[1]) == 1 else (0, 2)) for board, _ in ALONE]
    cases = [*WEIGHED, *(alone if is_left_out else ALONE)]
    test = _Said([board for board, _ in cases], is_left_out=is_left_out)
    truth = SimpleNamespace(effects=(PITCH, SAG), counts_with=(PITCH,))
    listed = [board[1] for board, _ in cases]
    for number, (board, expected) in enumerate(cases):
        assert test.weighed(truth, np.array([number]), [board[1]]) == expected, board
    together = test.weighed(truth, np.arange(len(cases)), listed)
    assert together == pytest.approx(np.mean([expected for _, expected in cases], axis=0))
