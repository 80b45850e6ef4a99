"""Each kind of option: its marks, weights, sides and minutes; and what proposals say of them."""

from types import SimpleNamespace

import numpy as np
import pytest
from plan_cases import MACHINE, case_on, nine
from plumb.fit.fit import Checked
from plumb.model.plain import noun_of
from plumb.plan.planned_visits import nowhere
from plumb.plan.proposal import (
    CONFIRM,
    EXPLORE,
    FEW,
    FIND,
    FRAME_CHECKS,
    HANGING,
    MARK,
    READ_AGAIN,
    READING,
    REREAD,
    ROOM_FOR_A_SECOND,
    ROUND,
    SETTLE,
    SHARPER,
    Option,
    RoomThen,
    checks_for,
    effect_checks,
    options,
    spots,
    worth,
)
from plumb.settings.machine import GRAVITY
from plumb.text.values import MM
from plumb.words.proposals import ProposalInWords, other_ways, percent
from synthetic import grid

USUAL = MACHINE.sled_weight


@pytest.fixture(scope="module")
def case():
    return case_on(nine(), "sled_friction", "chain_pitch")


@pytest.fixture(scope="module")
def by_kind(case):
    kinds = {}
    for option in options(case):
        kinds.setdefault(option.kind, []).append(option)
    return kinds


def test_minutes_count_the_round_its_marks_and_the_preparation(by_kind):
    (marks,), (again,) = (by_kind[kind] for kind in ("marks", "repeats"))
    assert marks.minutes == ROUND + FEW * MARK
    assert again.minutes == ROUND + READ_AGAIN * 9 * READING
    for heavier in by_kind["weight"]:
        assert heavier.minutes == ROUND + len(heavier.visits) * MARK + HANGING
    # Reading again is quicker than cutting.
    assert READING < MARK < ROUND < HANGING


def test_extra_weight_counts_for_its_marks(by_kind):
    hung = [(option.visits.sled_weights.max() - USUAL) / GRAVITY for option in by_kind["weight"]]
    # Four marks with each weight that does not double the sled, and all nine with 5 kg.
    assert hung == pytest.approx([2.5, 5.0, 5.0, 10.0])
    for option, kilograms in zip(by_kind["weight"], hung, strict=True):
        assert np.ptp(option.visits.sled_weights) == 0
        assert f"Hang {kilograms:g} kg more" in option.do[0]
        assert option.title.endswith(f"with {kilograms:g} kg more")
    near = by_kind["weight"][2].visits
    gaps = np.abs(near.targets - grid(3, 3))
    assert gaps == pytest.approx(np.full((9, 2), ROOM_FOR_A_SECOND))
    assert (np.abs(near.targets) <= np.abs(grid(3, 3)) + ROOM_FOR_A_SECOND).all()


def test_two_marks_close_together_are_touched_from_opposite_sides(by_kind):
    (sides,) = by_kind["approach"]
    visits = sides.visits
    assert len(visits) == FEW and sides.minutes == ROUND + FEW * MARK
    assert np.hypot(*visits.approaches.T) == pytest.approx(np.ones(FEW))
    ways = {tuple(map(abs, side)) for side in visits.approaches.tolist()}
    assert ways <= {(1.0, 0.0), (0.0, 1.0)}
    for first, second in ((0, 1), (2, 3)):
        assert visits.approaches[first] == pytest.approx(-visits.approaches[second])
        gap = np.abs(visits.targets[first] - visits.targets[second])
        assert gap == pytest.approx((ROOM_FOR_A_SECOND, ROOM_FOR_A_SECOND))
    apart = np.linalg.norm(visits.targets[0] - visits.targets[2])
    assert apart > 2 * ROOM_FOR_A_SECOND
    assert "opposite sides" in sides.do[0] and spots(visits, MM) in sides.do[0]


def test_every_mark_is_read_again_as_it_was_made(by_kind, case):
    (again,) = by_kind["repeats"]
    assert not again.is_cut and by_kind["marks"][0].is_cut
    assert not by_kind["check"][0].is_cut
    assert again.visits.names == case.board.rows.names * READ_AGAIN
    assert again.visits.chains == pytest.approx(np.tile(case.board.rows.chains, (READ_AGAIN, 1)))
    assert again.do == ("Read each of the 9 marks 3 more times with a newly laid tape.",)


def test_a_number_is_checked_only_if_the_check_is_better_than_what_is_known():
    sigma = FRAME_CHECKS["motor_gap"].sigmas["motor_gap"]
    for known, is_offered in ((1.01 * SHARPER * sigma, True), (0.99 * SHARPER * sigma, False)):
        made = [Checked("motor_gap", MACHINE.motor_gap, known)]
        offered = checks_for(case_on(nine(), "chain_pitch", checked=made))
        names = [check.name for option in offered for check in option.checks]
        assert ("motor_gap" in names) == is_offered and "motor_height" in names
        # The radius is a solid part that no fit moves.
        assert "rotation_radius" not in names


def test_checks_of_suspects_have_their_numbers_and_words():
    (check,) = [each for each in checks_for(case_on(nine(), "chain_pitch")) if each.kind == "check"]
    direct = effect_checks()["chain_pitch"]
    assert {each.name: each.sigma for each in check.checks} == {
        f"chain_pitch.{side}": sigma for side, sigma in direct.sigmas.items()
    }
    assert (check.title, check.minutes) == (direct.title, direct.minutes)
    assert check.do == (direct.steps,)


CUT = Option("marks", "4 more marks", ("Cut four.",), 9.4, nowhere())
ROOMS = (RoomThen("chain_sag", 5.0, 1.24), RoomThen("chain_pitch", 2.0, 1.9))


def proposal(question=SETTLE, chance=0.42, **how):
    return ProposalInWords(CUT, MM, question, chance, None, **how)


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
    assert worth(proposal(question)) == worth(proposal(question, None)) == "helps"
    assert worth(proposal(question, 0.5)) == "settles" and worth(None) == "nothing_would"


@pytest.mark.parametrize(("question", "columns"), [(SETTLE, 4), (EXPLORE, 3)])
def test_a_look_around_has_no_column_of_promises(question, columns):
    (rows,) = other_ways(SimpleNamespace(proposals=[proposal(question, None)] * 2))
    assert len(rows.header) == len(rows.rows[0]) == columns and all(rows.header[1:])


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
    said = f"It shows which of these act: {sag}, {lean}, {pitch}, {tape}."
    assert proposal(parts=pairs).steps == ["Cut four.", said]
    assert proposal(parts=pairs[2:3]).steps[1:] == [f"It shows whether {lean} acts."]
    assert proposal(parts=pairs[3:]).steps[1:] == [f"It shows whether {sag} acts."]
    assert proposal(parts=(("chain_sag", "chain_sag"),)).steps[1:] == []
