"""Slips of whole links are named; a moved sheet and noise are none; which hole to touch next."""

from dataclasses import replace
from functools import cache
from itertools import product

import numpy as np
import pytest
from plumb.bench.boards import cut, plan
from plumb.bench.causes import MAKER
from plumb.bench.hiding import as_bought, usual_machine
from plumb.fit.fit import fit
from plumb.fit.inputs import Inputs
from plumb.job.home import HomeTouch, sigma_of
from plumb.job.slip import (
    CANNOT_TELL,
    COUNTS,
    GATE,
    LINK,
    NO_LINKS,
    NOTHING,
    OTHER,
    SHEET,
    SLIP,
    find_slip,
    next_hole,
)
from plumb.model.predict import lengths, places
from plumb.settings.toml import FitRecord

HOLES = np.array([(-900.0, 250.0), (900.0, -250.0)])  # [mm] that the machine made
HAND = 0.3  # [mm] of a coordinate: how well a bit sits in its hole


def record_of(left_out, turn=0.0):
    """The record of a fit, of which the error of marks that were left out [mm] and the sheet's
    turn [rad] matter."""
    return FitRecord(
        start_rms=5.0, rms=1.0, priced_rms=1.1, left_out_rms=left_out, sheet_rotation=turn
    )


@cache
def fitted_machine(number):
    """The judge's machine of this number and its settings, after a calibration on 15 marks."""
    sites, source = plan(5, 3), np.random.default_rng(number)
    board = cut(as_bought(usual_machine(source, number, sites), source), sites, seed=source)
    model, rows = Inputs(MAKER, board.measurements).model_and_observations()
    done = fit(model, rows, effects=("chain_pitch", "chain_stretch"), sigma=0.5)
    record = record_of(done.left_out_rms, done.sheet_rotation)
    return board.machine, replace(done.settings, fitted=record)


def touched(number, *, links=NO_LINKS, moved=(0.0, 0.0), seed, holes=HOLES):
    """The touches that the owner of a machine writes down; moved: one sigma of the
    sheet's shift [mm] and turn [rad].
    """
    (true, settings), source = fitted_machine(number), np.random.default_rng(seed)
    made = true.sleds(lengths(settings, holes)[0])
    shift, turn = moved[0] * source.standard_normal(2), moved[1] * source.standard_normal()
    turned = made @ np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    sleds = turned + shift + HAND * source.standard_normal(holes.shape)
    chains = aimed = lengths(settings, sleds)[0]
    for _ in range(6):  # until the judge's sled hangs there
        chains = chains + aimed - lengths(settings, true.sleds(chains))[0]
    assert np.abs(true.sleds(chains) - sleds).max() < 1e-3
    shown = places(settings, chains - LINK * np.array(links))[0]
    return [
        HomeTouch("1", tuple(h), tuple(s))
        for h, s in zip(holes.tolist(), shown.tolist(), strict=True)
    ]


@pytest.mark.parametrize("links", [(1, 0), (0, -2), (-1, 2)])
@pytest.mark.parametrize("first", [(-900.0, 250.0), (900.0, -250.0), (0.0, 0.0)])
def test_the_next_hole_is_nearly_the_best(links, first):
    single = touches(np.array([first]), links=links)
    finding = find_slip(MAKER, single)
    assert finding.verdict == CANNOT_TELL

    def rest(hole):
        """The odds of the sheet after a touch that fits the likeliest account."""
        again = find_slip(MAKER, single + touches(np.array([hole]), links=finding.best.links))
        return sum(each.odds for each in again.accounts if each.kind == SHEET)

    place = next_hole(MAKER, finding)
    assert np.hypot(*np.subtract(place, first)) > 400
    others = [rest(hole) for hole in product((-800.0, 0.0, 800.0), (-300.0, 0.0, 300.0))]
    assert np.log(rest(place)) < 0.7 * np.log(max(others))
    assert np.log(rest(place)) < 0.85 * np.log(min(others))


def test_the_worst_pair_of_slips_is_found_after_the_next_hole():
    pair, number = (3, -3), 1054  # its first two touches are the least lucky of 300
    settings = fitted_machine(number)[1]
    two = touched(number, links=pair, seed=[number, 41])
    finding = find_slip(settings, two)
    assert (finding.verdict, finding.best.links) == (CANNOT_TELL, pair)
    place = np.array([next_hole(settings, finding)])
    for seed in range(5):
        third = touched(number, links=pair, seed=seed, holes=place)
        settled = find_slip(settings, [*two, *third])
        assert (settled.verdict, settled.best.links) == (SLIP, pair)


THIRD = np.array([(0.0, -400.0)])


def touches(holes=HOLES, *, links=NO_LINKS, moved=(0.0, 0.0, 0.0), errors=0.0):
    """Touches of a machine that is as MAKER says; moved: the sheet's x, y [mm] and rotation."""
    x, y, turn = moved
    turned = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    sleds = holes @ turned.T + (x, y) + errors
    chains = lengths(MAKER, sleds)[0] - LINK * np.array(links)
    shown = places(MAKER, chains)[0]
    return [
        HomeTouch(str(i), tuple(hole), tuple(where))
        for i, (hole, where) in enumerate(zip(holes.tolist(), shown.tolist(), strict=True), 1)
    ]


@pytest.mark.parametrize("links", [(left, right) for left in COUNTS for right in COUNTS])
def test_each_count_of_links_is_named(links):
    finding = find_slip(MAKER, touches(links=links))
    assert finding.verdict == (SLIP if any(links) else NOTHING)
    assert finding.best.links == links and finding.best.odds >= GATE


@pytest.mark.parametrize("moved", [(6.0, 0, 0), (4, -5, 0), (0, 0, 0.006), (-25, 10, 0.01)])
def test_a_moved_sheet_is_no_slip(moved):
    finding = find_slip(MAKER, touches(np.concatenate([HOLES, THIRD]), moved=moved))
    assert finding.verdict == SHEET
    assert np.abs(finding.left).max() < 0.2 < np.abs(finding.errors).max()
    assert finding.left.shape == finding.errors.shape == (3, 2)


def test_holes_in_the_frame_rule_out_a_sheet():
    # As if the sheet had moved by 5 mm, which no whole link explains.
    asked = touches(moved=(5.0, 0, 0))
    assert find_slip(MAKER, asked, fixed=True).verdict == OTHER
    assert find_slip(MAKER, asked).verdict == SHEET


def test_a_taped_hole_is_as_good_as_the_fit():
    fitted = replace(MAKER, fitted=record_of(2.0))
    assert sigma_of(fitted, taped=False) == 0.5
    assert sigma_of(fitted, taped=True) == pytest.approx(2.0 / 2**0.5)
    assert sigma_of(MAKER, taped=True) == 0.5
    assert find_slip(fitted, touches(), taped=True).sigma == pytest.approx(2.0 / 2**0.5)


@pytest.mark.parametrize("turn", [0.004, -0.004])
def test_a_tape_on_a_turned_sheet_finds_the_holes_where_the_fit_has_them(turn):
    fitted = replace(MAKER, fitted=record_of(0.6, turn))
    holes = np.array([(-900.0, 400.0), (900.0, 400.0), (-900.0, -400.0), (900.0, -400.0)])
    # The sheet hangs as it did, or straight.
    for moved in ((0.0, 0.0, -turn), (0.0, 0.0, 0.0)):
        still = find_slip(fitted, touches(holes, moved=moved), taped=True)
        assert still.verdict == NOTHING and np.abs(still.left).max() < 0.05
        slipped = find_slip(fitted, touches(holes, links=(1, 0), moved=moved), taped=True)
        assert slipped.verdict == SLIP and slipped.best.links == (1, 0)
    # Holes that the machine made are where it was sent, however the sheet hangs.
    made = find_slip(fitted, touches(holes, moved=(0.0, 0.0, -turn)))
    assert made.verdict == SHEET


@pytest.mark.parametrize(
    ("links", "moved", "named"),
    [
        ((3, -3), (0.0, 0.0), 11),  # looks most like a turned sheet
        ((1, 0), (3.0, 0.001), 0),  # and the sheet moves: two holes rarely tell
        (NO_LINKS, (0.0, 0.0), 0),
        (NO_LINKS, (10.0, 0.004), 0),
    ],
)
def test_no_slip_is_invented_on_machines_of_the_judge(links, moved, named):
    """Machines on which neither odds nor gate were chosen."""
    found = [
        find_slip(fitted_machine(number)[1], touched(number, links=links, moved=moved, seed=number))
        for number in range(1001, 1013)
    ]
    slips = [finding.best.links for finding in found if finding.verdict == SLIP]
    assert len(slips) >= named and slips == [links] * len(slips)
