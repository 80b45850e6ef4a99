"""What a planned measurement is worth: information and chances, against boards drawn otherwise."""

from dataclasses import replace

import numpy as np
import pytest
from plan_cases import MACHINE, SIGMA, case_on, nine
from plumb.diagnosis.evidence import Noises, accounts_of, fitted
from plumb.diagnosis.linear import LinearBoard, Metric
from plumb.diagnosis.posterior import Account, asked_for, clean_of, listing
from plumb.diagnosis.verdict import NOTHING
from plumb.marks.read import Measurements
from plumb.plan.case import Check, Planned
from plumb.plan.options import many_marks
from plumb.plan.outlook import BACKGROUND, Outlooks, _is_right, _named
from plumb.plan.planned_visits import nowhere
from synthetic import grid, marks_on

NOISES = Noises(np.array([SIGMA]), np.zeros(1))
PITCH = ("chain_pitch.left", "chain_pitch.right")


@pytest.fixture(scope="module")
def case():
    """Nine marks of a machine whose left chain is longer than its settings say."""
    effects = {**MACHINE.effects, "chain_pitch": {"left": 0.0042, "right": 0.0008}}
    machine = replace(MACHINE, effects=effects)
    marks = marks_on(machine, MACHINE, grid(3, 3), noise=SIGMA, seed=2)
    return case_on(Measurements(marks), "chain_pitch", "tape_scale")


def checks(*names, sigma):
    return Planned(nowhere(), [Check(name, sigma) for name in names])


def test_what_tells_nothing_is_worth_nothing(case):
    outlooks = Outlooks(case)
    nothing, blunt = outlooks.of(Planned(nowhere())), outlooks.of(checks(*PITCH, sigma=10.0))
    assert nothing.bits < 0.02 and blunt.bits == pytest.approx(nothing.bits, abs=1e-3)
    assert blunt.chance == pytest.approx(nothing.chance, abs=0.02)


def test_measuring_the_cause_itself_settles_what_marks_leave_open(case):
    outlooks = Outlooks(case)
    before = outlooks.of(Planned(nowhere()))
    sharp, less = (outlooks.of(checks(*PITCH, sigma=sigma)) for sigma in (5e-5, 1e-3))
    assert sharp.chance > before.chance + 0.3 and sharp.bits > less.bits > before.bits
    assert 1 <= sharp.left < less.left <= before.left


def test_the_same_is_promised_twice(case):
    planned = Planned(many_marks(case).visits)
    assert Outlooks(case).of(planned) == Outlooks(case).of(planned)


def drawn_machines(board, accounts, count, source):
    """Sets of effects and unknowns of machines, as often as the marks so far make them likely.

    The frame, then the effects: by the textbook's covariance, and drawn again until all signs are
    possible.
    """
    metric = Metric.of(board, NOISES.sigmas)
    evidence = [fitted(part, board.sizes, metric).evidence[0] for part in accounts.parts]
    chances = np.exp(np.concatenate(evidence) - np.logaddexp.reduce(np.concatenate(evidence)))
    variants = [(part, a) for part in accounts.parts for a in range(len(part.sets))]
    frame, least = board.frame.shape[1], board.sizes.least - board.sizes.mean
    noise = np.r_[
        np.full(board.measured, SIGMA), np.ones(len(board.frame) - board.measured)
    ]
    for i in source.choice(len(variants), count, p=chances):
        part, a = variants[i]
        index = part.index[a]
        slopes = np.hstack([board.frame, board.effects[:, index]]) / noise[:, np.newaxis]
        prior = np.r_[np.ones(frame), 1 / part.variance[a]]
        covariance = np.linalg.inv(slopes.T @ slopes + np.diag(prior))
        mean = covariance @ slopes.T @ (board.read[:, 0] / noise)
        unknowns = source.multivariate_normal(mean, covariance, size=200, method="cholesky")
        possible = np.all(unknowns[:, frame:] >= least[index], axis=1)
        where = np.argmax(possible) if possible.any() else 0
        sizes = np.zeros(board.effects.shape[1])
        sizes[index] = unknowns[where, frame:]
        yield int(part.sets[a]), unknowns[where, :frame], sizes


def test_what_is_promised_comes_true_on_machines_drawn_from_the_posterior(case):
    planned = Planned(many_marks(case).visits.taken(range(0, 28, 3)))
    rows, board = planned.ahead(case.frame), case.board
    known = LinearBoard.of(case.frame, case.posterior.felt)
    accounts = accounts_of(known)
    source, count = np.random.default_rng(7), 250
    new = rows.slopes[rows.so_far :] * SIGMA
    frame, effects = new[:, board.frame], new[:, board.columns(known.columns)]
    truths, read = [], []
    for truth, of_frame, sizes in drawn_machines(known, accounts, count, source):
        truths.append(truth)
        noise = SIGMA * source.standard_normal(len(new))
        read.append(np.r_[known.read[:, 0], frame @ of_frame + effects @ sizes + noise])
    then = replace(
        known,
        measured=len(known.read) + len(new),
        frame=np.vstack([known.frame, frame]),
        effects=np.vstack([known.effects, effects]),
        read=np.array(read).T,
    )
    assert known.measured == len(known.read)
    before = clean_of(known, accounts, NOISES).total[:, 0]
    clean = clean_of(then, accounts, NOISES)
    settled, bits = [], []
    for i, truth in enumerate(truths):
        total = clean.total[:, i]
        bits.append((log_share(total)[truth] - log_share(before)[truth]) / np.log(2))
        settled.append(is_settled(then, accounts, clean.on(i), accounts.effects[truth]))
    promised = Outlooks(case, draws=400).of(planned)
    assert promised.chance == pytest.approx(np.mean(settled), abs=0.08)
    assert promised.bits == pytest.approx(np.mean(bits), abs=3 * np.std(bits) / np.sqrt(count))
    assert promised.bits > 0.3


def log_share(total):
    return total - np.logaddexp.reduce(total)


def is_settled(board, accounts, clean, truth):
    """Whether all accounts of a board, looked at one by one, name the truth alone."""
    together = {}
    asked = asked_for(board, accounts, clean, range(len(accounts.effects)))
    for effects, weight in zip(asked, clean.total, strict=True):
        together[effects] = np.logaddexp(together.get(effects, -np.inf), weight)
    weights = np.array([*together.values()])
    if np.exp(together.get((), -np.inf) - np.logaddexp.reduce(weights)) > NOTHING:
        return not truth
    named = listing([Account(effects, effects, 0.0, 0.0) for effects in together], weights)
    return len(named) == 1 and {*named[0].account.effects} - {*BACKGROUND} <= {*truth}


@pytest.mark.parametrize(
    ("named", "truth", "right"),
    [
        ([("chain_zero",)], ("chain_zero",), True),
        ([("chain_zero", "chain_stretch")], ("chain_zero",), True),
        ([("chain_zero", "frame_lean")], ("chain_zero",), False),
        ([("chain_zero",), ("frame_lean",)], ("chain_zero",), False),
        ([], (), True),
        ([], ("chain_zero",), False),
        ([("chain_zero",)], (), False),
    ],
)
def test_a_verdict_is_right_that_names_nothing_that_is_not_there(named, truth, right):
    assert _is_right(named, truth) is right


def test_a_verdict_names_nothing_where_nothing_is_too_likely():
    sets = [(), ("chain_zero",), ("frame_lean",)]
    assert _named(sets, np.log([0.26, 0.74, 1e-9])) == []
    assert _named(sets, np.log([0.24, 0.76, 1e-9])) == [("chain_zero",), ()]
    assert _named(sets, np.log([1e-9, 0.6, 0.4])) == [("chain_zero",), ("frame_lean",)]
    # Sets that ask for the same effects count together.
    assert _named([(), ("frame_lean",), ("frame_lean",)], np.log([0.3, 0.5, 0.5])) == [
        ("frame_lean",),
        (),
    ]


def test_where_nothing_is_proved_each_effect_is_looked_for():
    hidden = case_on(nine())
    expected = Outlooks(hidden).of(Planned(many_marks(hidden).visits))
    assert expected.left is None and 0 <= expected.chance <= 1 and expected.bits > 0.1
    less = Outlooks(hidden).of(Planned(nowhere()))
    assert less.chance < expected.chance and less.bits < expected.bits
