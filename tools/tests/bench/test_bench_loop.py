"""The owner of a board of the bench, and the loop: proposals carried out on the same machine."""

import numpy as np
import pytest
from plumb.bench.boards import cut, plan
from plumb.bench.causes import MAKER, SLED, Hidden, causes_of
from plumb.bench.judged_board import BoardOwner, followed
from plumb.plan.case import Check
from plumb.plan.planned_visits import sent

PITCH = causes_of("chain_pitch")[1]  # the left chain more than the right


def board_and_owner(*, noise=0.0):
    """A board with unlike chains, and its owner."""
    board = cut(Hidden(((PITCH, 4.0),), backlash=0.2), plan(3, 3), seed=5, noise=noise)
    return board, BoardOwner(np.random.default_rng(1), noise)


def visits_of(layout, **more):
    """The marks of a plan once more."""
    return sent(
        MAKER,
        layout.targets,
        controller="plumb",
        sled_weight=SLED,
        approaches=layout.approaches,
        **more,
    )


def test_swapped_chains_take_their_pitch_along():
    board, owner = board_and_owner()
    marks = owner.with_marks(board, visits_of(plan(3, 3), swapped=True)).measurements.marks
    assert all(mark.chains_swapped for mark in marks[9:])
    first, swapped = (np.array([mark.measured for mark in part]) for part in (marks[:9], marks[9:]))
    # The longer chain lets the sled down on its side.
    assert np.ptp(swapped[:, 0] - first[:, 0]) + abs((swapped - first)[:, 0].mean()) > 2.0


def test_a_direct_check_finds_what_is_there():
    board, owner = board_and_owner()
    names = {"chain_pitch.left": 0.004, "chain_pitch.right": 0.0012, "tape_scale.strain": 0.0}
    names |= {"motor_gap": board.machine.motor_gap, "rotation_radius": MAKER.rotation_radius}
    names["chain_stretch.compliance"] = MAKER.effect("chain_stretch", "compliance")
    for check in owner.checked(board, [Check(name, 1e-9) for name in names]):
        assert check.value == pytest.approx(names[check.name], abs=1e-8)


def test_what_is_proposed_is_measured_once_each_round():
    board, owner = board_and_owner(noise=0.5)
    loop = followed(board, MAKER, owner, rounds=2)
    assert len(loop.done) == len(set(loop.done)) == 2
    assert loop.readings == len(loop.board.measurements.marks) - 9
    assert loop.readings or loop.checked
    assert followed(board, MAKER, owner, rounds=0).done == ()
