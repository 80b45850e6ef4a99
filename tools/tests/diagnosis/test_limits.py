"""Limits of the diagnosis, from both sides: how sure it must be, and how much it must have read."""

from dataclasses import replace

import numpy as np
import pytest
from plumb.cure.add import add
from plumb.diagnosis import diagnose
from plumb.diagnosis.doubts import half_warnings
from plumb.diagnosis.explanation import KNOWN, Board, Spread, explain
from plumb.diagnosis.noise import Noise, mark_spread, misfit_chance
from plumb.diagnosis.sizes import room_for
from plumb.fit.inputs import Inputs
from plumb.fit.observations import observe
from plumb.fit.problem import PRIORS
from plumb.marks.read import Distance, Measurements, Round, join_measurements
from plumb.text.errors import InputError
from scipy import optimize, stats
from synthetic import BELIEVED, distances_between, grid, marks_on

PRIORED = tuple(PRIORS)
STATED = Noise(0.5, KNOWN, "stated")


def torn(sigmas, axis, parameter):
    """The frame's explanation of marks of which a half wants a number of the frame to be off."""
    rows = observe(BELIEVED, Measurements(marks_on(BELIEVED, BELIEVED, grid(5, 4))))
    frame = explain(Board.of(BELIEVED, rows, sigma=0.5))
    column = frame.at.slopes[:, parameter].copy()
    near = rows.targets[:, axis] <= np.median(rows.targets[:, axis])
    column[: 2 * len(near)][np.repeat(near, 2)] = 0.0
    column[2 * len(near) :] = 0.0
    beyond = column - frame.basis @ (frame.basis.T @ column)
    pull = sigmas * beyond / np.linalg.norm(beyond)
    return replace(frame, at=replace(frame.at, residual=pull))


@pytest.mark.parametrize("axis", [0, 1])
@pytest.mark.parametrize("parameter", range(4))
def test_a_half_is_off_only_beyond_what_the_worst_of_all_parameters_reaches(axis, parameter):
    # 0.27 % in 4 parameters: each may be off by 3.4 sigma, a single parameter by 3.
    limit = stats.norm.isf(0.0027 / 4 / 2)
    assert limit == pytest.approx(3.40, abs=0.01)
    names = ("left and right", "lower and upper")
    assert half_warnings(torn(limit - 0.05, axis, parameter), STATED) == []
    said = half_warnings(torn(limit + 0.05, axis, parameter), STATED)
    assert any(
        names[axis] in sentence and f"{PRIORED[parameter]} by 3.4 sigma" in sentence
        for sentence in said
    )


def pulled(effect, sigmas):
    """The frame's explanation of marks that an effect of one parameter pulls by this many sigma."""
    rows = observe(BELIEVED, Measurements(marks_on(BELIEVED, BELIEVED, grid(5, 4))))
    frame = explain(Board.of(BELIEVED, rows, sigma=0.5))
    (beyond,) = frame.beyond_fit([effect]).T
    size = np.linalg.norm(beyond)
    scale = frame.board.problem.scale[frame.board.columns([effect])[0]]
    rest = replace(frame, at=replace(frame.at, residual=sigmas * beyond / size))
    return rest, scale / size


@pytest.mark.parametrize("effect", ["sheet_skew", "tape_scale"])
def test_a_limit_reaches_as_far_below_zero_as_above(effect):
    # One-sided 95 % of what is measured as 4 sigma, whichever way it points.
    for sigmas in (4.0, -4.0):
        frame, sigma_of_size = pulled(effect, sigmas)
        (limit,) = room_for(effect, (frame,), STATED).limits
        assert limit.largest == pytest.approx((4 + stats.norm.isf(0.05)) * sigma_of_size, rel=0.01)


def test_a_limit_of_what_cannot_be_negative_is_its_upper_end():
    for sigmas, left in ((4.0, 4 + stats.norm.isf(0.05)), (-4.0, 0.0)):
        frame, sigma_of_size = pulled("chain_plane", sigmas)
        (limit,) = room_for("chain_plane", (frame,), STATED).limits
        assert limit.largest == pytest.approx(left * sigma_of_size, rel=0.01, abs=1e-12)


def test_halves_of_few_marks_are_not_compared():
    rows = observe(BELIEVED, Measurements(marks_on(BELIEVED, BELIEVED, grid(5, 1))))
    frame = explain(Board.of(BELIEVED, rows, sigma=0.5))
    loud = replace(frame, at=replace(frame.at, residual=100 * np.ones(len(frame.residual))))
    assert half_warnings(loud, STATED) == []


def two_rounds(shift):
    """Two rounds of the same marks with noise, the second shifted to the right [mm]."""
    first, second = (
        marks_on(BELIEVED, BELIEVED, grid(3, 3), noise=0.5, seed=seed) for seed in (1, 2)
    )
    moved = [replace(m, measured=(m.measured[0] + shift, m.measured[1])) for m in second]
    return join_measurements(
        [
            Measurements(tuple(marks), source=source, rounds=(Round(),))
            for marks, source in ((first, "a.toml"), (moved, "b.toml"))
        ]
    )


def squares_of(shift):
    """Of the differences of both rounds: as they are, and without shift, turn and stretch."""
    read = two_rounds(shift).measured
    apart = (read[9:] - read[:9]) / np.sqrt(2)
    columns = np.column_stack([np.ones(9), grid(3, 3)])
    left = apart - columns @ np.linalg.lstsq(columns, apart, rcond=None)[0]
    return np.sum(apart**2), np.sum(left**2)


def test_a_round_has_moved_once_an_f_test_says_so():
    limit = stats.f.isf(0.0027, 6, 12)

    def beyond(shift):
        plain, moved = squares_of(shift)
        return (plain - moved) / 6 / (moved / 12) - limit

    shift = optimize.brentq(beyond, 0.0, 10.0)
    still, moved = (mark_spread(observe(BELIEVED, two_rounds(shift + by))) for by in (-0.02, 0.02))
    assert still.degrees == 18 and still.squares == pytest.approx(squares_of(shift - 0.02)[0])
    assert moved.degrees == 12 and moved.squares == pytest.approx(squares_of(shift + 0.02)[1])


@pytest.mark.parametrize("missing", [0.0, 1.0])
def test_a_misfit_between_places_is_judged_by_an_f_test_against_repeats(missing):
    # Lack of fit as in any textbook: what the means of 12 places leave, over the scatter in them.
    readings = [
        replace(mark, measured=(mark.measured[0], mark.measured[1] + missing * (i % 2)))
        for seed in (1, 2, 3)
        for i, mark in enumerate(marks_on(BELIEVED, BELIEVED, grid(4, 3), noise=0.5, seed=seed))
    ]
    rows = observe(BELIEVED, Measurements(tuple(readings)))
    read = rows.measured.reshape(3, 12, 2)
    within, degrees = np.sum((read - read.mean(axis=0)) ** 2), 2 * 12 * 2
    sigma = np.sqrt(within / degrees)
    frame = explain(Board.of(BELIEVED, rows, sigma=sigma))
    left = frame.numbers[: rows.measured.size].reshape(3, 12, 2)
    spent = np.sum(frame.basis[: rows.count] ** 2)
    spare = 2 * 12 - spent
    expected = stats.f.sf(np.sum(3 * left.mean(axis=0) ** 2) / spare / sigma**2, spare, degrees)
    noise = Noise(sigma, degrees, "repeats", within=Spread(within, degrees))
    assert misfit_chance(frame, noise) == pytest.approx(expected, rel=1e-6)
    assert (expected < 0.015) == bool(missing)


@pytest.mark.parametrize("judge", [diagnose, lambda inputs: add(inputs, effects=["chain_pitch"])])
def test_repeats_are_no_further_marks(judge):
    twice = marks_on(BELIEVED, BELIEVED, grid(2, 1), noise=0.5)
    marks = twice + marks_on(BELIEVED, BELIEVED, grid(2, 1), noise=0.5, seed=2)
    marks += marks_on(BELIEVED, BELIEVED, grid(2, 1), noise=0.5, seed=3)
    with pytest.raises(InputError, match="4 measured numbers"):
        judge(Inputs(BELIEVED, Measurements(marks, source="two marks")))


@pytest.mark.parametrize("judge", [diagnose, lambda inputs: add(inputs, effects=["chain_pitch"])])
def test_a_distance_is_the_same_from_both_ends(judge):
    spans = distances_between(marks_on(BELIEVED, BELIEVED, grid(3, 1), noise=0.5))
    back = tuple(Distance(span.between[::-1], span.length + 0.3) for span in spans.distances)
    with pytest.raises(InputError, match="3 measured numbers"):
        judge(Inputs(BELIEVED, replace(spans, distances=spans.distances + back)))


def test_three_marks_are_enough_to_begin_with():
    marks = marks_on(BELIEVED, BELIEVED, np.array([(-900.0, 400.0), (900.0, 400.0), (0.0, -400.0)]))
    assert diagnose(Inputs(BELIEVED, Measurements(marks))).verdict == "nothing_provable"
