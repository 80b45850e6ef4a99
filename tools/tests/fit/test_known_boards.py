"""Marks that the settings were fitted to are known again by their readings."""

from dataclasses import replace

import pytest
from plumb.fit.inputs import known_outside, with_settings_in_force
from plumb.marks.read import Mark, Measurements, Round
from plumb.settings.machine import SettingsFile
from plumb.settings.toml import FitRecord, FittedBoard
from plumb.text.errors import InputError
from synthetic import BELIEVED, TRUE

OLD = replace(BELIEVED, file=SettingsFile("groundcontrol.ini", ""))
OTHER = replace(BELIEVED, motor_gap=2950.0, file=SettingsFile("other.ini", ""))
FIRST = FittedBoard("a.toml", "digest a", OLD)
SECOND = FittedBoard("b.toml", "digest b", OTHER, sheet=(1.0, 2.0, 0.003), zeros=(4.0, 5.0))
RECORD = FitRecord(
    start_rms=5.0,
    rms=0.5,
    priced_rms=0.6,
    left_out_rms=0.7,
    sheet_rotation=0.001,
    lab_effects={"tape_scale": {"strain": 0.0004}},
    boards=(FIRST, SECOND),
)
FITTED = replace(TRUE, fitted=RECORD)
PLACE = (100.0, 200.0)


def board(digest="", **how):
    rounds = (Round(digest=digest, **how),)
    return Measurements((Mark("1", PLACE, PLACE),), source="m.toml", rounds=rounds)


def in_force(part, settings=FITTED, *, cut_with=None):
    (file_round,) = with_settings_in_force(settings, part, cut_with=cut_with).rounds
    return file_round.cut_with


def test_a_known_board_was_cut_with_what_the_fit_took_it_for():
    assert in_force(board("digest a")) is OLD
    assert in_force(board("digest b")) is OTHER


def test_what_is_said_goes_first():
    assert in_force(board("digest a", cut_with=TRUE)) is TRUE
    assert in_force(board("digest a"), cut_with=TRUE) is None
    assert in_force(board("", changed="gone.ini"), cut_with=TRUE) is None


def test_an_unknown_board_is_asked_about_with_names():
    with pytest.raises(InputError, match=r"cut with groundcontrol\.ini and other\.ini"):
        in_force(board("else"))
    nameless = replace(RECORD, boards=(replace(FIRST, cut_with=BELIEVED),))
    with pytest.raises(InputError, match="cut with other settings"):
        in_force(board("else"), replace(TRUE, fitted=nameless))


def test_nothing_is_asked_where_nothing_can_be_mistaken():
    assert in_force(board("else"), TRUE) is None  # never fitted
    # Fitted to marks that these settings cut themselves.
    same = replace(RECORD, boards=(replace(FIRST, cut_with=TRUE),))
    assert in_force(board("else"), replace(TRUE, fitted=same)) is None
    chains = replace(board("else"), marks=(Mark("1", PLACE, PLACE, chains=(1700.0, 1700.0)),))
    assert in_force(chains) is None


def test_chains_of_some_marks_are_not_enough():
    marks = (Mark("1", PLACE, PLACE, chains=(1700.0, 1700.0)), Mark("2", PLACE, PLACE))
    with pytest.raises(InputError, match="does not say which settings"):
        in_force(replace(board("else"), marks=marks))


def test_settings_that_changed_since_are_refused():
    with pytest.raises(InputError, match=r"groundcontrol\.ini, which has changed since"):
        in_force(board("else", changed="groundcontrol.ini"), TRUE)


def test_what_a_fit_found_outside_of_the_machine_is_known_by_name():
    parts = (
        Round(digest="digest a", cut_with=OLD),
        Round(digest="digest b", cut_with=OTHER, sheet_group=1, zero_group=2),
    )
    both = Measurements(board().marks, rounds=parts)
    known = known_outside(FITTED, both, cut_with=None)
    assert known["sheet_rotation"] == 0.001 and known["tape_scale.strain"] == 0.0004
    assert [known[f"sheet2.{axis}"] for axis in ("x", "y", "rotation")] == [1.0, 2.0, 0.003]
    assert [known[f"zero3.{side}"] for side in ("left", "right")] == [4.0, 5.0]
    assert [known[f"sheet1.{axis}"] for axis in ("x", "y", "rotation")] == [0.0, 0.0, 0.0]
    alone = Measurements(board().marks, rounds=parts[:1])
    assert not any(
        name.startswith("sheet2") for name in known_outside(FITTED, alone, cut_with=None)
    )


def test_a_board_that_others_cut_is_not_that_of_the_fit():
    for cut_with in (TRUE, None):
        assert known_outside(FITTED, board("digest a"), cut_with=cut_with) == {}
    assert known_outside(FITTED, board("digest a"), cut_with=OLD)
    assert known_outside(FITTED, board("else", cut_with=OLD), cut_with=None) == {}
    assert known_outside(TRUE, board("digest a", cut_with=OLD), cut_with=None) == {}
    unfitted = replace(OLD, fitted=RECORD)
    assert known_outside(unfitted, board("digest a"), cut_with=None)
