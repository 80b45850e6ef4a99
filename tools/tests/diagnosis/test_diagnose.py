"""Diagnoses of boards that the judge cut: what is named, what is not, and how often it is right.

Each kind of verdict on a few seeded boards; test_bench_rates.py counts how often it is right.
"""

import numpy as np
import pytest
from hidden_boards import HIDDEN, board, size_for
from plumb.bench.boards import MAKER, plan
from plumb.diagnosis import diagnose
from plumb.fit.inputs import Inputs

WIDE, NINE = plan(5, 5), plan(3, 3)
# A tilt of both motors is a turned sheet, and chain zeros are a frame elsewhere: marks alone hardly
# feel them. Friction is felt in few places and has a separate test.
FELT = sorted(set(HIDDEN) - {"motor_level", "chain_zero", "sled_friction"})
HUGE = ("frame_lean", "sprocket_runout")  # need sizes that no real machine has to move marks so far


@pytest.fixture(scope="module")
def sizes():
    """Sizes that move the marks of 25 by 3 mm RMS, in typical sizes."""
    return {name: size_for(name, WIDE, 3.0) for name in FELT}


def explains(diagnosis, *effects):
    """Whether just these effects are one of the explanations."""
    return any(set(explanation.effects) == set(effects) for explanation in diagnosis.explanations)


def test_the_judge_and_the_laws_agree_where_nothing_is_hidden():
    diagnosis = diagnose(Inputs(MAKER, board({}, WIDE, seed=1, noise=0.0), sigma=0.02))
    assert diagnosis.verdict == "nothing_provable" and diagnosis.rms_before < 0.02


def test_a_hidden_effect_of_three_millimetres_is_found(sizes):
    diagnoses = {
        name: diagnose(Inputs(MAKER, board({name: sizes[name]}, WIDE, seed=100 * i)))
        for i, name in enumerate(FELT)
    }
    count = len(diagnoses)
    inside = sum(explains(diagnosis, name) for name, diagnosis in diagnoses.items())
    usual = {name: diagnosis for name, diagnosis in diagnoses.items() if name not in HUGE}
    first = sum(diagnosis.suspects[:1] == (name,) for name, diagnosis in usual.items())
    silent = sum(diagnosis.verdict == "nothing_provable" for diagnosis in diagnoses.values())
    assert silent == 0
    assert inside >= 0.88 * count
    assert first >= 0.88 * len(usual)
    assert np.mean([len(diagnosis.suspects) for diagnosis in usual.values()]) <= 2.0


def test_look_alikes_are_named_together():
    # A tape that reads long and chains that are long both draw marks farther apart.
    size = size_for("tape_scale", NINE, 2.0)
    several = 0
    for seed in range(1, 6):
        diagnosis = diagnose(Inputs(MAKER, board({"tape_scale": size}, NINE, seed=seed)))
        assert explains(diagnosis, "tape_scale")
        several += len(diagnosis.suspects) > 1
    assert several >= 2


def test_motors_out_of_level_are_not_told_from_a_turned_sheet():
    diagnosis = diagnose(Inputs(MAKER, board({"motor_level": 1.5}, WIDE, seed=2)))
    assert diagnosis.verdict == "nothing_provable"
    shares = {ranked.effect: ranked.hidden_share for ranked in diagnosis.ranking}
    assert shares["motor_level"] > 0.95
    room = next(hidden for hidden in diagnosis.could_hide if hidden.effect == "motor_level")
    assert room.mm > 2 and room.limits[0].largest >= 6.0


def test_friction_needs_approaches():
    layout = plan(5, 3)
    rubbing = board({"sled_friction": 1.0}, layout, seed=1, noise=0.2)
    diagnosis = diagnose(Inputs(MAKER, rubbing, sigma=0.3))
    assert diagnosis.suspects[:1] == ("sled_friction",)
    blind = diagnose(Inputs(MAKER, board({}, plan(5, 3, approached=False), seed=1)))
    room = next(hidden for hidden in blind.could_hide if hidden.effect == "sled_friction")
    assert room.mm is None
