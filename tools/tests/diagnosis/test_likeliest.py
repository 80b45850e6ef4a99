"""The likeliest accounts: machines as they are, whose published settings leave out the stretch."""

import numpy as np
import pytest
from plumb.bench.boards import cut, plan
from plumb.bench.causes import MAKER, PUBLISHED, Hidden
from plumb.bench.hiding import usual_machine
from plumb.cure.auto import add_auto
from plumb.diagnosis import diagnose, judgement
from plumb.diagnosis.answer import verdict_sentence
from plumb.diagnosis.clean import felt_effects
from plumb.diagnosis.explanation import KNOWN, Board, explain
from plumb.diagnosis.judgement import Likeliest, Likely, listing
from plumb.diagnosis.noise import Noise
from plumb.diagnosis.weighing import accounts, left_out, weigh
from plumb.fit.inputs import Inputs
from plumb.fit.observations import observe

WIDE = plan(5, 5, repeats=True)


def usual(index):
    """A usual machine with its marks, cut with published settings."""
    return cut(
        usual_machine(index, WIDE),
        WIDE,
        seed=900 + index,
        noise=0.4,
        tape_sigma=0.4,
        settings=PUBLISHED,
    )


@pytest.mark.parametrize("index", [0, 3, 6])
def test_what_every_machine_has_is_no_reason_for_doubt(index):
    # All three were not in the library, as only two or more effects together explain them.
    board = usual(index)
    diagnosis = diagnose(Inputs(PUBLISHED, board.measurements))
    assert diagnosis.verdict in ("one_suspect", "cannot_tell")
    first = diagnosis.explanations[0]
    assert set(board.machine.hidden.effects) <= set(first.effects) | {"sled_friction"}
    assert diagnosis.to_add == first.effects
    assert first.share > 0.5 and sum(each.share for each in diagnosis.explanations) <= 1 + 1e-9
    if diagnosis.verdict == "cannot_tell":
        assert "Most likely: " in verdict_sentence(diagnosis)


def test_the_likeliest_account_is_added():
    board = usual(6)
    result = add_auto(Inputs(PUBLISHED, board.measurements))
    assert set(result.chosen) == {"chain_stretch", "chain_pitch"}
    assert result.addition.after.left_out_rms < 0.7 * result.addition.before.left_out_rms


def test_a_field_that_no_mechanics_made_is_still_in_no_library():
    hidden = Hidden(outside="cubic", outside_mm=3.0)
    board = cut(hidden, plan(5, 5), seed=4, noise=0.4, tape_sigma=0.4, settings=PUBLISHED)
    assert diagnose(Inputs(PUBLISHED, board.measurements)).verdict == "not_in_library"


def test_where_the_frame_alone_is_likeliest_nothing_is_provable(monkeypatch):
    def frame_alone(frame, felt, noise):
        return Likeliest((Likely(frame, 1.0),), 0.0)

    monkeypatch.setattr(judgement, "likeliest", frame_alone)
    diagnosis = diagnose(Inputs(PUBLISHED, usual(0).measurements))
    assert diagnosis.verdict == "nothing_provable"
    assert diagnosis.explanations == () and diagnosis.to_add == ()


def test_published_settings_leave_out_the_stretch():
    for settings, missing in ((MAKER, ()), (PUBLISHED, ("chain_stretch",))):
        rows = observe(settings, usual(0).measurements)
        assert left_out(explain(Board.of(settings, rows, sigma=0.4))) == missing


def test_that_nothing_acts_is_an_account_too():
    board = cut(Hidden(), WIDE, seed=5, noise=0.4, tape_sigma=0.4, settings=MAKER)
    frame = explain(Board.of(MAKER, observe(MAKER, board.measurements), sigma=0.4))
    felt = felt_effects(frame)
    sets, before = accounts(frame, felt)
    weights = dict(zip(sets, before, strict=True))
    assert weights[()] == 0 and weights[felt[:1]] == pytest.approx(np.log(0.1 / 0.9))
    weighed = weigh(frame, felt, Noise(0.4, KNOWN, "stated"))
    assert weighed.best == ()
    # Without it a board on which nothing acts would be taken for one with an effect.
    assert listing(weighed.effects, weighed.clean)[0].effects == ()


def test_a_set_with_more_effects_than_a_likelier_one_counts_with_it():
    sets = ((), ("a",), ("a", "b"), ("c", "b"), ("d",))
    weights = np.array([0.001, 0.6, 0.2, 0.149, 0.05])
    listed = listing(sets, np.log(weights) + 7.0)
    assert [each.effects for each in listed] == [("a",), ("c", "b"), ("d",)]
    assert [each.share for each in listed] == pytest.approx([0.8, 0.149, 0.05])
    assert [each.members for each in listed] == [(1, 2), (3,), (4,)]
    # Beyond 95 % of all weight nothing is listed.
    few = np.log([1e-9, 0.96, 1e-9, 0.03, 0.01])
    assert [each.effects for each in listing(sets, few)] == [("a",)]
