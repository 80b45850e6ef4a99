"""What a measurement promises, and what a plan could tell, against boards drawn otherwise."""

from dataclasses import replace

import numpy as np
import pytest
from plan_cases import MACHINE, SIGMA, case_on, nine
from plumb.diagnosis.diagnosis import NOTHING
from plumb.diagnosis.evidence import (
    LinearBoard,
    Metric,
    Noises,
    accounts_of,
    asked_for,
    clean_of,
    fitted,
)
from plumb.diagnosis.explanation import Board, explain
from plumb.diagnosis.posterior import listing
from plumb.diagnosis.priors import turned
from plumb.fit.observations import model_and_observations
from plumb.marks.read import Mark, Measurements
from plumb.model.catalogue import EVERY_MACHINE
from plumb.plan.case import Outlooks, PlannedCheck, PlannedMeasurement, _is_right, _shown
from plumb.plan.planned_visits import nowhere
from plumb.plan.preview import POWER, preview
from plumb.plan.proposal import many_marks
from synthetic import BELIEVED, grid, marks_on

NOISES = Noises(np.array([SIGMA]), np.zeros(1))
PITCH = ("chain_pitch.left", "chain_pitch.right")


@pytest.fixture(scope="module")
def case():
    """Nine marks of a machine with chains longer than its settings say: a tape draws that too."""
    effects = {**MACHINE.effects, "chain_pitch": {"left": 0.0032, "right": 0.0022}}
    machine = replace(MACHINE, effects=effects)
    marks = marks_on(machine, MACHINE, grid(3, 3), noise=SIGMA, seed=1)
    return case_on(Measurements(marks), "chain_pitch", "tape_scale")


@pytest.fixture(scope="module")
def stock():
    """The same of a machine whose settings know nothing of its chains."""
    effects = {**MACHINE.effects, "chain_pitch": {"left": 0.0016, "right": 0.0011}}
    stretched = replace(MACHINE, effects=effects)
    marks = marks_on(stretched, BELIEVED, grid(3, 3), noise=SIGMA, seed=1)
    return case_on(Measurements(marks), "chain_pitch", "tape_scale", machine=BELIEVED)


def checks(*names, sigma):
    return PlannedMeasurement(nowhere(), [PlannedCheck(name, sigma) for name in names])


def test_measuring_the_cause_itself_settles_what_marks_leave_open(case):
    outlooks = Outlooks(case)
    before = outlooks.of(PlannedMeasurement(nowhere()))
    sharp, less = (outlooks.of(checks(*PITCH, sigma=sigma)) for sigma in (5e-5, 1e-3))
    assert sharp.chance > before.chance + 0.3 and sharp.bits > less.bits > before.bits
    assert 1 <= sharp.left < less.left <= before.left + 0.1  # as far as draws tell


def drawn_machines(board, accounts, count, source):
    """Sets of effects and unknowns of machines, as often as the marks so far make them likely.

    The frame, then the effects: by the textbook's covariance, and drawn again until all signs are
    possible. Half of all chains are a little long or short.
    """
    variants, weights, pitch = [], [], board.sizes.pitch
    for drifts in {False, bool(pitch.any())}:
        metric = Metric.of(board, NOISES.sigmas, pitch=drifts)
        for part in accounts.parts:
            weights.append(fitted(part, metric).evidence[0])
            variants += [(part, a, pitch if drifts else 0 * pitch) for a in range(len(part.sets))]
    weights = np.concatenate(weights)
    frame, least = board.frame.shape[1], board.sizes.least - board.sizes.mean
    noise = np.r_[np.full(board.measured, SIGMA), np.ones(len(board.frame) - board.measured)]
    for i in source.choice(len(variants), count, p=np.exp(weights - np.logaddexp.reduce(weights))):
        part, a, drift = variants[i]
        index = part.index[a]
        slopes = np.hstack([board.frame, board.effects * drift, board.effects[:, index]])
        slopes /= noise[:, np.newaxis]
        prior = np.r_[np.ones(frame + len(drift)), 1 / part.variance[a]]
        covariance = np.linalg.inv(slopes.T @ slopes + np.diag(prior))
        mean = covariance @ slopes.T @ (board.read[:, 0] / noise)
        unknowns = source.multivariate_normal(mean, covariance, size=200, method="cholesky")
        of_frame, drifts, sizes = np.split(unknowns, [frame, frame + len(drift)], axis=1)
        possible = np.all(sizes >= least[index], axis=1)
        where = np.argmax(possible) if possible.any() else 0
        every = drift * drifts[where]
        every[index] += sizes[where]
        yield int(part.sets[a]), of_frame[where], every


@pytest.mark.parametrize("what", ["marks", "check"])
@pytest.mark.parametrize("machine", ["case", "stock"])
def test_promised_chances_come_true_on_machines_drawn_from_the_posterior(machine, what, request):
    case = request.getfixturevalue(machine)
    marks = PlannedMeasurement(many_marks(case).visits.taken(range(0, 28, 3)))
    planned = marks if what == "marks" else checks(*PITCH, sigma=5e-5)
    known = LinearBoard.of(case.frame, case.posterior.felt)
    accounts = accounts_of(known)
    truths, sizes, then = boards_then(case, known, planned.ahead(case.frame), accounts, 300)
    shown = _shown(then, SIGMA, sizes)
    clean = clean_of(then, accounts, NOISES)
    settled = [
        is_settled(then, accounts, clean.on(i), acting, [name for name in acting if shown[name][i]])
        for i, truth in enumerate(truths)
        for acting in [accounts.effects[truth]]
    ]
    promised = Outlooks(case, draws=600).of(planned)
    assert promised.chance == pytest.approx(np.mean(settled), abs=0.08)
    # Information is the entropy that goes.
    gone = entropy(clean_of(known, accounts, NOISES).total[:, 0]) - entropy(clean.total)
    assert promised.bits == pytest.approx(gone.mean(), abs=0.15) and promised.bits > 0.1


def boards_then(case, known, rows, accounts, count):
    """The sets behind some machines, and the boards of the marks so far with what is new."""
    source, board = np.random.default_rng(7), case.board
    is_read = rows.marks[rows.so_far :]
    noise = np.where(is_read, SIGMA, 1.0)
    new = rows.slopes[rows.so_far :] * noise[:, np.newaxis]
    columns = board.columns(known.columns)
    frame, effects = new[:, board.frame], turned(board, columns, new[:, columns])
    truths, read, of_acting = [], [], []
    for truth, of_frame, sizes in drawn_machines(known, accounts, count, source):
        truths.append(truth)
        moved = frame @ of_frame + effects @ sizes + noise * source.standard_normal(len(new))
        read.append(np.r_[known.read[:, 0], moved])
        acting = [known.columns[name] for name in accounts.effects[truth]]
        is_acting = np.isin(np.arange(len(sizes)), np.concatenate([[-1], *acting]))
        of_acting.append(np.where(is_acting, sizes, 0.0))
    then = replace(
        known,
        measured=known.measured + int(is_read.sum()),
        frame=np.vstack([known.frame, frame]),
        effects=np.vstack([known.effects, effects]),
        read=np.array(read).T,
    )
    return truths, np.array(of_acting).T, then


def entropy(total):
    """Of sets by their log weights [bits]."""
    chances = np.exp(total - np.logaddexp.reduce(total, axis=0))
    return -np.sum(chances * np.log2(np.maximum(chances, 1e-300)), axis=0)


def is_settled(board, accounts, clean, acting, shown):
    """Whether all accounts of a board, looked at one by one, name what is shown and acts."""
    together = {}
    asked = asked_for(board, accounts, clean, range(len(accounts.effects)))
    for effects, weight in zip(asked, clean.total, strict=True):
        together[effects] = np.logaddexp(together.get(effects, -np.inf), weight)
    weights = np.array([*together.values()])
    if np.exp(together.get((), -np.inf) - np.logaddexp.reduce(weights)) > NOTHING:
        return not acting
    several = [*together]
    named = listing(several, weights)
    return len(named) == 1 and _is_right([several[named[0][0]]], acting, shown)


def test_where_nothing_is_proved_each_effect_is_looked_for():
    hidden = case_on(nine())
    expected = Outlooks(hidden).of(PlannedMeasurement(many_marks(hidden).visits))
    assert expected.left is None and 0 <= expected.chance <= 1 and expected.bits > 0.1
    less = Outlooks(hidden).of(PlannedMeasurement(nowhere()))
    assert less.chance <= expected.chance and less.bits < expected.bits


def plan_of(columns, rows, **how):
    targets = grid(columns, rows)
    places = enumerate(map(tuple, targets.tolist()))
    return Measurements(tuple(Mark(str(i), at, at, **how) for i, at in places))


@pytest.fixture(scope="module")
def plan_of_nine():
    return preview(MACHINE, plan_of(3, 3, approach=(0.0, 1.0)), sigma=SIGMA)


def outline(seen, effect):
    (only,) = [each for each in seen.outlines if each.effect == effect]
    return only


@pytest.mark.parametrize("effect", ["sheet_skew", "chain_plane"])
def test_the_smallest_size_is_detected_at_the_stated_rate(effect):
    seen = preview(MACHINE, plan_of(5, 5), sigma=SIGMA)
    model, rows = model_and_observations(MACHINE, plan_of(5, 5))
    frame = explain(Board.of(model, rows, sigma=SIGMA))
    board = LinearBoard.of(frame, (*EVERY_MACHINE, effect))
    every = accounts_of(board)
    accounts = every.among(np.array([names in ((), (effect,)) for names in every.effects]))
    source, count = np.random.default_rng(1), 1500
    drawn = board.effects[:, board.columns[effect]] * outline(seen, effect).smallest
    read = drawn + SIGMA * source.standard_normal((len(drawn), count))
    read += board.frame @ source.standard_normal((board.frame.shape[1], count))
    noises = Noises(np.array([SIGMA]), np.zeros(1))
    total = clean_of(replace(board, read=read), accounts, noises).total
    nothing = np.exp(total[0] - np.logaddexp.reduce(total, axis=0))
    assert np.mean(nothing < NOTHING) == pytest.approx(POWER, abs=0.1)


def test_look_alikes_are_named_and_effects_that_show_are_counted(plan_of_nine):
    assert "frame_lean" in outline(plan_of_nine, "chain_sag").alike
    smallest = [each.smallest for each in plan_of_nine.outlines if each.smallest is not None]
    assert plan_of_nine.named <= plan_of_nine.seen == sum(size <= 1 for size in smallest)
    assert plan_of_nine.seen < sum(size <= 2 for size in smallest)
