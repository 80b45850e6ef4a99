"""Chances where the diagnosis weighs accounts: machines whose settings leave out the stretch."""

import numpy as np
import pytest
from plumb.bench.boards import cut, plan
from plumb.bench.causes import PUBLISHED, Hidden, causes_of
from plumb.bench.judged_board import BoardOwner
from plumb.diagnosis import diagnose
from plumb.diagnosis.clean import felt_effects
from plumb.diagnosis.judgement import listing
from plumb.diagnosis.weighing import weigh
from plumb.fit.inputs import Inputs
from plumb.plan import propose
from plumb.plan.case import LIKELY, MOST_TRUTHS, Planned, accounts_then, case_of
from plumb.plan.options import many_marks
from plumb.plan.outlook import Rediagnosis
from plumb.plan.planned_visits import nowhere

NOISE = 0.5


def hidden_in(seed, effect, size):
    """A machine that stretches as usual, and also has an effect of some typical sizes."""
    hidden = Hidden(((causes_of("chain_stretch")[0], 0.2), (causes_of(effect)[0], size)))
    return cut(hidden, plan(5, 3), seed=seed, noise=NOISE, settings=PUBLISHED)


@pytest.fixture(scope="module")
def tape():
    """A board with a wrong tape, and its case."""
    board = hidden_in(3, "tape_scale", 4.0)
    inputs = Inputs(PUBLISHED, board.measurements)
    diagnosis = diagnose(inputs)
    assert diagnosis.verdict == "cannot_tell" and diagnosis.explanations[0].share is not None
    return board, diagnosis, case_of(diagnosis, inputs)


def drawn(case, planned, count=60):
    """Each truth with boards drawn from it."""
    source = np.random.default_rng(1)
    return [
        (
            truth,
            Rediagnosis(case, planned.ahead(truth.at), case.noise, None).boards(
                truth, source, count
            ),
        )
        for truth in case.truths
    ]


def test_without_anything_new_the_diagnosis_lists_what_it_lists(tape):
    _, diagnosis, case = tape
    planned = Planned(nowhere())
    listed = accounts_then(case, planned, case.noise, drawn(case, planned, 3))
    accounts = {board for boards in listed for board in boards}
    assert len(accounts) == 1
    assert {each.effects for each in diagnosis.explanations} <= {*accounts.pop()}


def test_what_is_true_is_listed_once_it_is_measured_well(tape):
    *_, case = tape
    planned = Planned(many_marks(case).visits)
    for (truth, _), boards in zip(
        trials := drawn(case, planned),
        accounts_then(case, planned, case.noise, trials),
        strict=True,
    ):
        inside = [
            any({*truth.counts_with} <= {*account} <= {*truth.effects} for account in accounts)
            for accounts in boards
        ]
        assert np.mean(inside) > 0.75, truth.effects


def test_truths_hold_their_accounts_and_all_weight(tape):
    *_, case = tape
    assert sum(truth.weight for truth in case.truths) == pytest.approx(1.0)
    accounts = {hypothesis.effects for hypothesis in case.hypotheses}
    for truth in case.truths:
        assert truth.counts_with in accounts and {*truth.counts_with} <= {*truth.effects}
    assert len(case.truths) > len(case.hypotheses)


def test_truths_are_the_likeliest_that_hold_nine_tenths(tape):
    *_, case = tape
    weighed = weigh(case.frame, felt_effects(case.frame), case.noise, with_outliers=False)
    listed = {hypothesis.effects for hypothesis in case.hypotheses}
    members = [
        weighed.clean[member]
        for each in listing(weighed.effects, weighed.clean)
        if each.effects in listed
        for member in each.members
    ]
    shares = np.sort(np.exp(np.array(members) - np.logaddexp.reduce(members)))[::-1]
    count = len(case.truths)
    assert shares[: count - 1].sum() < LIKELY <= shares[:count].sum() and count < MOST_TRUTHS
    kept = [truth.weight for truth in case.truths]
    assert kept == pytest.approx(list(shares[:count] / shares[:count].sum()))


@pytest.mark.parametrize(("seed", "settles"), [(3, False), (6, True)])
def test_a_check_of_the_tape_brings_what_is_promised(seed, settles):
    # Where the tape alone is an account too, knowing the tape parts nothing.
    board = hidden_in(seed, "tape_scale", 4.0)
    inputs = Inputs(PUBLISHED, board.measurements)
    diagnosis = diagnose(inputs)
    check = next(
        proposal
        for proposal in propose(diagnosis, inputs).proposals
        if proposal.option.checks and proposal.option.checks[0].name == "tape_scale.strain"
    )
    assert check.chance > 0.75 if settles else check.chance < 0.1
    owner = BoardOwner(np.random.default_rng(seed), NOISE)
    checked = owner.checked(board, check.option.checks)
    after = diagnose(Inputs(PUBLISHED, board.measurements, checked=checked))
    assert (after.verdict == "one_suspect") == settles
    assert {*after.suspects} == {"chain_stretch", "tape_scale"}
