"""The gates of the diagnosis: boards of a seed, what marks can show, and rates of records."""

import re

import evidence_gates
import numpy as np
import pytest
from gate_boards import board_of
from gate_kinds import KINDS
from gate_rates import MEASURES, Stated, bins_of, rate_of
from gate_records import Account, Record, needed_gain, truth_of
from gate_tables import tables
from plumb.bench.outcome import look_alikes


def record(verdict, *accounts, index=0, **more):
    """A board on which frame_flex was hidden, on a machine with stretch."""
    given = {
        "effects": ["frame_flex"],
        "usual": ["chain_stretch"],
        "parameters": {},
        "gains": {"frame_flex": 50.0},
        "provable": ["frame_flex"],
        "allowed": ["frame_flex", "chain_stretch", "chain_plane"],
        "alike": {"frame_flex": ["chain_plane"]},
        "outside": "",
        "slipped": [],
        "slip_mm": 0.0,
    }
    several = [Account(list(effects), None, True) for effects in accounts]
    return Record("known/one-25", index, **{**given, **more}, verdict=verdict, accounts=several)


def value(name, *records):
    rate = rate_of(MEASURES[name], records)
    return None if rate is None else rate.value


def test_a_board_follows_from_its_seed_its_hidden_sizes_too():
    kind = KINDS["stock/typical-9"]
    boards = [board_of(kind, 4, seed=seed) for seed in (3, 3, 4)]
    same, again, other = (each.board.measurements for each in boards)
    assert same == again != other
    sizes = [each.hidden.causes[0][1] for each in boards]
    assert sizes[0] == sizes[1] != sizes[2]
    # Stretch is on every stock machine, and hidden there it is not usual as well.
    assert "chain_stretch" in {cause.effect for cause, _ in boards[0].hidden.usual}
    stretched = [board_of(KINDS["stock/one-9"], index, seed=3).hidden for index in range(20)]
    for hidden in stretched:
        names = [cause.effect for cause, _ in (*hidden.usual, *hidden.causes)]
        assert len(set(names)) == len(names)


def test_the_oracle_shows_large_effects_and_no_small_and_knows_the_look_alikes_of_the_bench():
    seen = {}
    for index in range(10):
        hidden = board_of(KINDS["known/one-9"], index, seed=5)
        truth, (cause, size) = truth_of(hidden), hidden.hidden.causes[0]
        assert set(truth.alike[cause.effect]) == look_alikes(cause, size, hidden.plan, 0.5)
        seen[cause.effect] = truth
    assert seen["chain_sag"].alike["chain_sag"] and seen["chain_sag"].provable
    assert seen["sheet_skew"].gains["sheet_skew"] > 10 * needed_gain("sheet_skew")
    lean = next(
        truth
        for truth in (truth_of(board_of(KINDS["known/typical-9"], i, seed=5)) for i in range(10))
        if truth.effects == ("frame_lean",)
    )
    assert lean.provable == () and "frame_lean" in lean.allowed


@pytest.mark.parametrize(
    ("verdict", "accounts", "right"),
    [
        ("one_suspect", [["frame_flex", "chain_stretch"]], "best exact first inside"),
        ("one_suspect", [["chain_plane"]], "best exact first inside"),
        ("one_suspect", [["frame_flex", "sled_swing"]], "best first inside invented"),
        ("cannot_tell", [["chain_stretch"], ["frame_flex"]], "first inside"),
        ("cannot_tell", [["sled_swing"], ["frame_flex"]], "inside invented"),
        ("nothing_provable", [], ""),
        ("not_in_library", [["frame_flex"]], "best exact first inside strange"),
        ("slip", [], "strange"),
    ],
)
def test_what_is_said_of_a_known_board_is_counted(verdict, accounts, right):
    said = record(verdict, *accounts)
    names = ("best", "exact", "first", "inside", "invented", "strange")
    assert [name for name in names if value(name, said)] == right.split()


def test_what_marks_cannot_show_need_not_be_named_but_nothing_else_may_be():
    hidden = {"provable": [], "gains": {"frame_flex": 1.0}}
    assert value("inside", record("nothing_provable", **hidden)) == 1
    assert value("inside", record("one_suspect", ["sled_swing"], **hidden)) == 0
    assert value("best", record("nothing_provable", **hidden)) is None


def test_fields_and_slips_are_counted_apart():
    field = record("not_in_library", outside="bump")
    slipped = record("slip", slipped=["a"], slip_mm=5.0)
    slipped.outliers = ["a"]
    assert value("flagged", field, slipped) == 1 and value("strange", field, slipped) is None
    assert value("small slip", field, slipped) == 1 and value("false slip", field, slipped) == 0
    slipped.outliers = ["a", "b"]
    assert value("small slip", slipped) == 0 and value("false slip", slipped) == 1


def test_a_table_says_what_the_odds_decide_from_which_a_field_is_called():
    likely = record("not_in_library", ["frame_flex"], field_chance=0.3)
    sure = record("not_in_library", ["frame_flex"], field_chance=0.6)
    misfit = record("not_in_library", ["frame_flex"], field_chance=0.1)  # called by the guard
    table = tables([[likely, sure, misfit, record("one_suspect", ["frame_flex"])]])
    rows = re.findall(r"^\| (1 to \d) \| (\d+)±", table, re.MULTILINE)
    assert rows == [("1 to 4", "75"), ("1 to 3", "75"), ("1 to 2", "50"), ("1 to 1", "50")]
    nearly = [record("one_suspect", ["frame_flex"], index=i) for i in range(99)]
    assert "| 1 to 4 | 1.0±1.0 |" in tables([[sure, *nearly]])


def test_a_change_is_judged_on_the_same_boards():
    good, bad = ("one_suspect", ["frame_flex"]), ("one_suspect", ["sled_swing"])
    before = rate_of(MEASURES["best"], [record(*good, index=i) for i in range(50)])
    few = [record(*(bad if i < 2 else good), index=i) for i in range(50)]
    after = rate_of(MEASURES["best"], few)
    assert before.difference(before) == (0.0, 0.0)
    change, error = after.difference(before)
    assert change == pytest.approx(-0.04) and error == pytest.approx(np.sqrt(0.04 * 0.96 / 50))


def test_stated_chances_go_into_bins():
    stated = [Stated(0.96, i > 0) for i in range(25)] + [Stated(1.0, True), Stated(0.0, False)]
    bins = {each.low: (each.seen, each.count) for each in bins_of(stated)}
    assert bins == {0.0: (0.0, 1), 0.95: (0.96, 25), 0.98: (1.0, 1)}


def test_records_are_saved_and_counted_again(tmp_path, capsys):
    file = tmp_path / "gates.json"
    words = ("--boards", "1", "--kinds", "known/none-9", "--save", str(file))
    assert evidence_gates.main(words) == 0
    assert evidence_gates.main([*words, "--first", "1"]) == 0
    capsys.readouterr()
    assert evidence_gates.main(["--table", str(file), str(file)]) == 0
    assert "| known/none-9 | 2 |" in capsys.readouterr().out
    assert evidence_gates.main([*words, "--seed", "2"]) == 2
    assert "seed 1" in capsys.readouterr().err
    assert evidence_gates.main(["--boards", "1"]) == 2
