"""Slips on the judge's machines: the right chain and count, and hardly ever a slip that is none."""

import numpy as np
import pytest
from plumb.bench.slipped_chains import (
    HAND,
    MARKS,
    MISHAPS,
    Mishap,
    count_slips,
    fitted_machine,
    main,
    touched,
)
from plumb.job.slip import LINK, NO_LINKS

PURE = [mishap for mishap in MISHAPS if mishap.links != NO_LINKS and not mishap.shift]
HARMLESS = [mishap for mishap in MISHAPS if mishap.links == NO_LINKS]


@pytest.mark.slow
def test_no_slip_is_named_where_there_is_none():
    counts = [count_slips(mishap, range(1, 25)) for mishap in HARMLESS]
    assert len(counts) == 6
    assert sum(count.false for count in counts) <= 0.01 * sum(count.boards for count in counts)
    assert all(count.right == count.boards - count.false for count in counts)


def test_a_slip_and_a_moved_sheet_at_once_name_no_wrong_count():
    (mishap,) = (each for each in MISHAPS if each.links != NO_LINKS and each.shift)
    assert count_slips(mishap, range(1, 25)).false == 0


def test_a_machine_is_touched_as_it_hangs():
    machine, source = fitted_machine(1), np.random.default_rng(1)
    first, second = touched(machine, Mishap("nothing"), source)
    assert first.hole == tuple(MARKS[0]) and second.hole == tuple(MARKS[1])
    apart = np.abs(np.subtract(first.shown, first.hole))
    assert 0 < apart.max() < 5 * HAND
    slipped, _ = touched(machine, Mishap("slip", (1, 0)), np.random.default_rng(1))
    assert np.linalg.norm(np.subtract(slipped.shown, slipped.hole)) > 0.8 * LINK


def test_machines_that_no_gate_was_tuned_on_get_the_right_chain_and_count():
    worst = next(each for each in PURE if each.links == (3, -3))
    far = range(1001, 1013)
    assert count_slips(worst, far).right >= 11
    assert count_slips(worst, far).false == 0


def test_a_shape_that_no_effect_makes_changes_what_was_fitted():
    usual, strange = fitted_machine(3), fitted_machine(3, outside=1.0)
    assert strange.board.machine.hidden.outside == "bump"
    assert strange.settings.fitted.rms > usual.settings.fitted.rms
    counted = count_slips(PURE[0], range(1, 5), outside=1.0)
    assert (counted.boards, counted.false) == (4, 0)


def test_the_table_has_a_row_for_each_mishap(capsys):
    main([1])
    said = capsys.readouterr().out
    assert said.count("\n| ") == 3 + len(MISHAPS) - len(PURE)
    assert "False slips: 0 of 48 slips" in said
    assert f"False slips: 0 of {len(HARMLESS)} harmless mishaps" in said
    assert "| a chain slips by 1 to 3 links, either way | 100.0 | 0.0 | 0.0 |" in said


@pytest.mark.parametrize("taped", [None, 0.5])
def test_a_taped_hole_is_known_less_well(taped):
    machine, source = fitted_machine(2), np.random.default_rng(5)
    holes = [touch.hole for touch in touched(machine, MISHAPS[0], source, taped=taped)]
    assert np.allclose(holes, MARKS) is (taped is None)
