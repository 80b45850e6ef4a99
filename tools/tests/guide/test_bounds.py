"""Tests of the answers that the guide accepts, keeps and calls normal."""

import pytest
from plumb.fit.expected import expected_anywhere, expected_priors, expected_sentence
from plumb.guide.steps import GuideVisit, _judge_mark, show_reach
from plumb.guide.talk import GuideProgress, progress_in
from plumb.settings.toml import machine_toml
from plumb.text.errors import InputError
from plumb.text.values import MM
from prepared_owner import PreparedOwner
from synthetic import BELIEVED


def owner_of(*answers):
    left = list(answers)
    return PreparedOwner(lambda question: left.pop(0))


def test_a_damaged_file_is_refused(tmp_path):
    (tmp_path / "guide.json").write_text('{"done": 3}')
    with pytest.raises(InputError, match="damaged"):
        progress_in(tmp_path)


# How well a careful owner knows the frame [mm]: little but the height is open.
SIGMAS = {"motor_height": 10.0, "motor_center_x": 0.1, "motor_gap": 0.1, "rotation_radius": 0.1}


@pytest.mark.parametrize(("off", "is_normal"), [(19.0, True), (21.0, False)])
def test_a_first_mark_twice_as_far_as_expected_is_still_normal(tmp_path, off, is_normal):
    width, height = BELIEVED.sheet
    owner = owner_of(str(width / 2), str(height / 2 + off))
    visit = GuideVisit(None, owner, GuideProgress(tmp_path, [], SIGMAS))
    assert _judge_mark(visit, BELIEVED) is is_normal
    assert ("is normal" in owner.said[-1]) is is_normal


def test_the_guide_calls_normal_what_plumb_reach_does(tmp_path):
    owner = owner_of()
    (tmp_path / "machine.toml").write_text(machine_toml(BELIEVED))
    assert show_reach(GuideVisit(None, owner, GuideProgress(tmp_path, [], SIGMAS)))
    expected = expected_anywhere(BELIEVED, expected_priors(SIGMAS))
    assert owner.said[-1].endswith(expected_sentence(expected, MM))
