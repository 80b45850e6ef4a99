"""Numbers of the diagnosis: shares, sizes that were met, misfits, fields, and priors of sizes."""

from dataclasses import replace

import numpy as np
import pytest
from plumb.diagnosis.answer import Together
from plumb.diagnosis.clean import clean_readings
from plumb.diagnosis.explanation import Board, Spread, explain, tail
from plumb.diagnosis.gain import DRAWN, WIDTHS, _gaussian_processes
from plumb.diagnosis.judgement import _log_cauchy
from plumb.diagnosis.noise import Noise, misfit_chance, spare_numbers
from plumb.diagnosis.suspect_curves import visits_all_over
from plumb.diagnosis.weighing import largest_met
from plumb.fit.inputs import Inputs
from plumb.fit.observations import observe
from plumb.marks.read import Measurements
from plumb.model.catalogue import effect_names, parameter_words
from scipy import integrate
from synthetic import BELIEVED, distances_between, grid, marks_on

SIGMA = 0.5
NINE = Measurements(marks_on(BELIEVED, BELIEVED, grid(3, 3), noise=SIGMA))


def board_of(measurements):
    return Board.of(BELIEVED, observe(BELIEVED, measurements), sigma=SIGMA)


def test_what_is_explained_is_a_share_of_the_squared_error():
    half = Together(("chain_sag",), {}, rms_after=1.0)
    assert half.explained_share(2.0) == 0.75 and half.explained_share(1.0) == 0.0
    assert half.explained_share(0.5) == 0.0 and half.explained_share(0.0) == 0.0


def test_what_the_marks_do_not_feel_is_listed_too():
    readings = clean_readings(board_of(NINE), Inputs(BELIEVED, NINE))
    assert "sled_friction" not in readings.felt
    assert set(readings.singles) == set(effect_names())


def test_the_largest_size_that_was_met_is_told_in_typical_sizes():
    board = board_of(NINE)
    for name in ("chain_pitch", "motor_level", "chain_zero"):
        columns = np.array(board.columns([name]))
        known = [parameter_words()[board.problem.names[i]] for i in columns]
        wanted = [max(abs(each["low"]), abs(each["high"])) / each["typical"] for each in known]
        assert largest_met(board, columns) == pytest.approx(wanted)


def test_a_misfit_needs_half_a_number_to_spare():
    frame = explain(board_of(NINE))
    spare = spare_numbers(frame)
    noise = Noise(SIGMA, 20.0, "repeats")
    for left, is_tested in ((1.2, True), (0.6, True), (0.4, False)):
        within = replace(noise, within=Spread(0.0, spare - left))
        chance = misfit_chance(frame, within)
        residual = frame.residual[: frame.board.rows.count]
        wanted = float(tail(float(residual @ residual), left, 20.0)) if is_tested else 1.0
        assert chance == pytest.approx(wanted)


def test_a_field_moves_a_distance_by_what_its_ends_move_apart():
    frame = explain(board_of(distances_between(NINE.marks)))
    rows = frame.board.rows
    fields = _gaussian_processes(frame)[: rows.count] * SIGMA
    assert fields.shape == (36, DRAWN * len(WIDTHS))
    places = grid(3, 3)
    ends = places[rows.distance_rows] / (1100.0, 500.0)
    squares = np.sum((ends[:, 1] - ends[:, 0]) ** 2, axis=1)
    for i, width in enumerate(WIDTHS):
        wanted = 2 - 2 * np.exp(-squares / (2 * width**2))
        drawn = fields[:, i * DRAWN : (i + 1) * DRAWN]
        assert np.mean(drawn**2, axis=1).sum() == pytest.approx(wanted.sum(), rel=0.15)


def test_a_field_moves_a_mark_by_a_millimetre():
    fields = _gaussian_processes(explain(board_of(NINE)))[:18] * SIGMA
    assert np.sqrt(np.mean(fields**2)) == pytest.approx(1.0, rel=0.1)


def test_places_of_curves_lie_all_over_their_share_of_the_sheet():
    rows = observe(BELIEVED, NINE)
    for share in (1.0, 0.5):
        targets = visits_all_over(BELIEVED, rows, counts=(9, 5), share=share).targets
        across, up = share * BELIEVED.sheet_width / 2, share * BELIEVED.sheet_height / 2
        assert np.unique(targets[:, 0]) == pytest.approx(np.linspace(-across, across, 9))
        assert np.unique(targets[:, 1]) == pytest.approx(np.linspace(-up, up, 5))


def test_sizes_are_spread_like_cauchys_with_half_below_the_typical():
    density = integrate.quad(lambda x: np.exp(_log_cauchy(np.array([x]))), -1, 1)[0]
    assert density == pytest.approx(0.5)
    # In two parameters the density is that of a circle's radius.
    whole = integrate.quad(
        lambda r: 2 * np.pi * r * np.exp(_log_cauchy(np.array([r, 0.0]))), 0, np.inf
    )
    assert whole[0] == pytest.approx(1.0)
    assert _log_cauchy(np.array([0.6, 0.8])) == pytest.approx(_log_cauchy(np.array([1.0, 0.0])))
