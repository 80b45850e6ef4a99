"""Marks that the settings were fitted to are known again by their readings."""

from dataclasses import replace

from plumb.fit.inputs import known_outside, with_settings_in_force
from plumb.marks.read import Mark, Measurements, Round
from plumb.settings.machine import SettingsFile
from plumb.settings.toml import FitRecord, FittedBoard
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
