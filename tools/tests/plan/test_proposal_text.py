"""Proposals in sentences: what to hope of them, and what they cost."""

import pytest
from plumb.model.plain import noun_of
from plumb.plan.options import Option
from plumb.plan.planned_visits import nowhere
from plumb.plan.proposal import (
    CONFIRM,
    EXPLORE,
    FIND,
    REREAD,
    SETTLE,
    Proposal,
    RoomThen,
    percent,
)
from plumb.text.values import MM

CUT = Option("marks", "4 more marks", ("Cut four.",), 9.4, nowhere())
ROOMS = (RoomThen("chain_sag", 5.0, 1.24), RoomThen("chain_pitch", 2.0, 1.9))


def proposal(question=SETTLE, chance=0.42, **how):
    return Proposal(CUT, MM, question, chance, None, **how)


@pytest.mark.parametrize(
    ("chance", "said"),
    [
        (None, "-"),
        (0.0, "below 5 %"),
        (0.02, "below 5 %"),
        (0.03, "5 %"),
        (0.42, "40 %"),
        (0.43, "45 %"),
        (0.97, "95 %"),
        (0.98, "above 95 %"),
        (1.0, "above 95 %"),
    ],
)
def test_a_chance_is_shown_in_steps_of_five(chance, said):
    assert percent(chance) == said


@pytest.mark.parametrize(
    ("question", "hope"),
    [
        (SETTLE, ", chance to settle it 40 %"),
        (CONFIRM, ", chance to confirm it 40 %"),
        (REREAD, ", chance to show it 40 %"),
        (EXPLORE, ""),
    ],
)
def test_the_headline_states_minutes_and_chance(question, hope):
    assert proposal(question).headline == f"4 more marks; about 9 minutes{hope}"
    assert proposal(question, None).headline == "4 more marks; about 9 minutes"


def test_without_a_proved_effect_the_headline_states_how_much_less_could_hide():
    noun = noun_of("chain_sag")
    said = proposal(FIND, rooms=ROOMS).headline
    hope = f"{noun[0].upper()}{noun[1:]} may act unseen by 5.0 mm now, by 1.2 mm then"
    assert said == f"4 more marks; about 9 minutes. {hope}"
    # Only what becomes clearly less is worth a word.
    assert proposal(FIND, rooms=ROOMS).promise == f"{noun} 5.0 -> 1.2 mm"
    assert proposal(FIND, rooms=ROOMS[1:]).promise == "no change"
    third = RoomThen("motor_level", 9.0, 1.0)
    both = proposal(FIND, rooms=(third, *ROOMS)).promise
    assert both == f"{noun_of('motor_level')} 9.0 -> 1.0 mm, {noun} 5.0 -> 1.2 mm"


def test_a_step_names_each_cause_that_it_tries_once_in_one_sentence():
    assert proposal().steps == ["Cut four."]
    pairs = (
        ("chain_sag + motor_level", "frame_lean + motor_level"),
        ("chain_pitch + tape_scale", "chain_sag"),
        ("chain_sag", "frame_lean + chain_sag"),
        ("", "chain_sag"),
    )
    sag, lean, pitch, tape = map(noun_of, ("chain_sag", "frame_lean", "chain_pitch", "tape_scale"))
    assert proposal(parts=pairs).steps == [
        "Cut four.",
        f"It shows which of these act: {sag}, {lean}, {pitch}, {tape}.",
    ]
    assert proposal(parts=pairs[2:3]).steps[1:] == [f"It shows whether {lean} acts."]
    assert proposal(parts=pairs[3:]).steps[1:] == [f"It shows whether {sag} acts."]
    assert proposal(parts=(("chain_sag", "chain_sag"),)).steps[1:] == []
