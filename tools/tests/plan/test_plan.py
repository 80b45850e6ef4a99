"""Proposals for the next measurement, carried out on machines of the judge."""

from dataclasses import replace

import numpy as np
import pytest
from hidden_boards import board, board_cut, size_for
from plumb.diagnosis import Checked, diagnose
from plumb.fit.compare import compare
from plumb.fit.inputs import Inputs
from plumb.hidden import MAKER, plan
from plumb.marks.read import Mark, Measurements
from plumb.model.catalogue import effect_names
from plumb.model.predict import FOUND, lengths
from plumb.plan import propose
from plumb.plan.case import case_of
from plumb.plan.planned_visits import usable
from plumb.plan.proposal import ENOUGH, ROOM_FOR_A_SECOND, Chooser, many_marks, options
from plumb.text.values import MM
from plumb.words.comparison import conclusion
from synthetic import BELIEVED, grid

NINE = plan(3, 3)
NOISE = 0.5


def nine(effect, seed=101):
    """The nine marks of a machine with an effect that moves them by 3 mm, and their diagnosis."""
    cut = board_cut({effect: size_for(effect, NINE, 3.0)}, NINE, seed=seed, noise=NOISE)
    return cut, diagnose(Inputs(MAKER, cut.measurements))


@pytest.fixture(scope="module")
def pitch():
    """A board on which pitch cannot be distinguished from its look-alikes."""
    cut, diagnosis = nine("chain_pitch")
    assert diagnosis.verdict == "cannot_tell"
    marks = cut.measurements
    return cut, marks, diagnosis, case_of(diagnosis, Inputs(MAKER, marks))


@pytest.fixture(scope="module")
def proposed(pitch):
    """The proposals for it."""
    _, marks, diagnosis, _ = pitch
    return propose(diagnosis, Inputs(MAKER, marks))


@pytest.fixture(scope="module")
def clean():
    """A board on which nothing is hidden."""
    marks = board({}, NINE, seed=7)
    diagnosis = diagnose(Inputs(MAKER, marks))
    assert diagnosis.verdict == "nothing_provable"
    return marks, diagnosis, case_of(diagnosis, Inputs(MAKER, marks))


def kinds(answer):
    """The kinds of all proposals, best first."""
    return [proposal.option.kind for proposal in answer.proposals]


def test_every_intervention_is_among_the_options(proposed):
    assert set(kinds(proposed)) >= {"marks", "repeats", "weight", "check", "frame"}
    assert proposed.blind is not None and len(proposed.blind.option.visits) == 28
    rates = [proposal.rate for proposal in proposed.proposals]
    assert rates == sorted(rates, reverse=True)
    for proposal in proposed.proposals:
        assert 0 <= proposal.chance <= 1 and proposal.option.minutes > 0 and proposal.option.do
        assert 1 <= proposal.left <= len(effect_names())


def test_new_marks_lie_where_the_sled_can_go_and_not_in_old_holes(pitch):
    *_, case = pitch
    for option in options(case):
        visits = option.visits
        if option.kind == "repeats" or not len(visits):
            continue
        gaps = np.linalg.norm(visits.targets[:, np.newaxis] - NINE.targets, axis=2)
        assert gaps.min() >= ROOM_FOR_A_SECOND
        assert (np.abs(visits.targets) <= np.array(MAKER.sheet) / 2).all()
        for weight in np.unique(visits.sled_weights):
            alike = visits.sled_weights == weight
            assert usable(MAKER, visits.targets[alike], weight).all()
        chains, outcome = lengths(MAKER, visits.targets)
        assert (outcome == FOUND).all() and visits.chains == pytest.approx(chains)


def test_more_rows_never_lower_lambda_and_chosen_ones_beat_random_ones(pitch):
    *_, case = pitch
    pool = many_marks(case).visits
    chooser = Chooser(case, pool)
    best = chooser.best(range(len(pool)), 4)
    assert len(set(best)) == 4
    source = np.random.default_rng(1)
    others = [chooser.worth(source.choice(len(pool), 4, replace=False)) for _ in range(30)]
    assert chooser.worth(best) > max(others) - 1e-9 and chooser.worth(best) > chooser.worth([])
    assert chooser.worth(range(len(pool))) <= ENOUGH * sum(
        a.weight + b.weight for a in case.hypotheses for b in case.hypotheses if a is not b
    )


def test_look_alikes_are_told_apart_only_by_the_right_measurement(pitch, proposed):
    # A tape and chains that are long draw nearly the same arrows; a steel rule parts them.
    cut, marks, diagnosis, _ = pitch
    assert {"tape_scale", "chain_pitch"} <= set(diagnosis.suspects)
    proposals = proposed.proposals
    best = max(proposals, key=lambda each: each.chance)
    assert best.option.kind == "check" and best.chance > 0.3
    heavier = [each for each in proposals if each.option.kind == "weight"]
    assert max(each.chance for each in heavier) < best.chance - 0.2
    true = cut.machine.hidden.parameters
    checked = [
        Checked(each.name, true.get(each.name, 0.0), each.sigma) for each in best.option.checks
    ]
    done = diagnose(Inputs(MAKER, marks, checked=checked))
    assert done.verdict == "one_suspect" and done.suspects == ("chain_pitch",)


def test_where_nothing_is_provable_doubt_is_removed_first(clean):
    marks, diagnosis, _ = clean
    answer = propose(diagnosis, Inputs(MAKER, marks))
    best = answer.proposals[0]
    rooms = [hidden for hidden in diagnosis.could_hide if hidden.mm]
    largest = max(rooms, key=lambda hidden: hidden.mm)
    assert best.question == "find" and best.rooms[0].effect == largest.effect
    assert best.rooms[0].then < 0.5 * best.rooms[0].now
    for proposal in answer.proposals:
        assert all(room.then <= room.now * (1 + 1e-6) for room in proposal.rooms)


def test_one_suspect_is_confirmed_by_measuring_the_cause():
    cut, diagnosis = nine("chain_plane")
    marks = cut.measurements
    assert diagnosis.verdict == "one_suspect"
    answer = propose(diagnosis, Inputs(MAKER, marks))
    assert answer.proposals[0].option.kind == "check"
    assert answer.proposals[0].option.checks[0].name == "chain_plane.gap_squared"
    assert "repeats" not in kinds(answer)


def test_a_slip_is_read_again_and_nothing_else():
    marks = board({}, plan(5, 5), seed=3)
    slipped = list(marks.marks)
    slipped[7] = replace(slipped[7], measured=tuple(np.add(slipped[7].measured, (5.0, 0.0))))
    changed = replace(marks, marks=tuple(slipped))
    diagnosis = diagnose(Inputs(MAKER, changed))
    assert diagnosis.verdict == "slip"
    answer = propose(diagnosis, Inputs(MAKER, changed))
    assert kinds(answer) == ["reread"] and answer.proposals[0].chance > 0.9
    option = answer.proposals[0].option
    assert option.visits.names == (slipped[7].name,)
    assert option.do[0].startswith(f"Read {slipped[7].name} again")


def mirrored_board(seed):
    """Marks whose errors mirror each other, left and right: what is of one chain ties with what is
    of the other, and so do marks of both halves."""
    targets = grid(3, 3)
    x = targets[:, 0]
    read = targets * 1.0015 + np.stack([0.0 * x, 2.0 - 1e-7 * x**2], axis=1)
    read *= 1 + 1e-12 * np.random.default_rng(seed).standard_normal(read.shape)
    marks = zip(targets.tolist(), read.tolist(), strict=True)
    return Measurements(
        tuple(Mark(str(i), tuple(there), tuple(seen)) for i, (there, seen) in enumerate(marks))
    )


def answers(seed):
    """The ranked answers that a user gets."""
    measurements = mirrored_board(seed)
    inputs = Inputs(BELIEVED, measurements, sigma=0.5)
    diagnosis = diagnose(inputs)
    proposals = propose(diagnosis, inputs).proposals
    return {
        "ranking": [each.effect for each in diagnosis.ranking],
        "explanations": [each.effects for each in diagnosis.explanations],
        "proposals": [(each.option.title, each.option.do) for each in proposals],
        "worst mark": conclusion(compare(Inputs(BELIEVED, measurements)), MM),
    }


def test_rounding_changes_no_answer():
    usual, otherwise = answers(0), answers(1)
    for what, order in usual.items():
        assert otherwise[what] == order, what
    assert len(usual["proposals"]) > 3
