"""The parts of a diagnosis, each against a number from elsewhere."""

from dataclasses import replace

import numpy as np
import pytest
from plumb.diagnosis.clean import shifts
from plumb.diagnosis.explanation import (
    KNOWN,
    Board,
    Spread,
    explain,
    negative_log_p,
    negative_log_ps,
    tail,
)
from plumb.diagnosis.gain import LEVEL, bases_beyond_fit, detection_threshold, search
from plumb.diagnosis.noise import Noise, guessed_noise, known_noise, misfit_chance, repeats_of
from plumb.diagnosis.outliers import readings_of, without
from plumb.diagnosis.sizes import hidden_share, room_for, sizes_of
from plumb.fit.fit import fit
from plumb.fit.inputs import Stated
from plumb.fit.observations import observe
from plumb.marks.read import Measurements, Round
from plumb.model.catalogue import effect_names
from scipy import stats
from synthetic import BELIEVED, TRUE, distances_between, grid, marks_on

STATED = Noise(0.5, KNOWN, "stated")


def rows_of(*, noise=0.5, seed=1, columns=5, rows=3, true=TRUE):
    return observe(
        BELIEVED,
        Measurements(marks_on(true, BELIEVED, grid(columns, rows), noise=noise, seed=seed)),
    )


def board_of(**options):
    return Board.of(BELIEVED, rows_of(**options), sigma=0.5)


def test_chances_are_those_of_the_tables():
    # Upper 5 % points of chi-square and F, from any printed table.
    assert tail(3.841, 1, KNOWN) == pytest.approx(0.05, abs=1e-4)
    assert tail(9.488, 4, KNOWN) == pytest.approx(0.05, abs=1e-4)
    assert tail(2 * 3.885, 2, 12) == pytest.approx(0.05, abs=1e-4)


@pytest.mark.parametrize("parameters", [1, 2, 4])
@pytest.mark.parametrize("degrees", [KNOWN, 4.0, 24.0])
def test_negative_log_p_is_the_logarithm_of_the_chance_and_never_runs_out(parameters, degrees):
    gains = np.array([0.5, 3.0, 11.0, 60.0, 199.0, 500.0])
    wanted = [
        stats.chi2.logsf(g, parameters)
        if np.isinf(degrees)
        else stats.f.logsf(g / parameters, parameters, degrees)
        for g in gains
    ]
    assert [negative_log_p(g, parameters, degrees) for g in gains] == pytest.approx(
        np.negative(wanted)
    )
    assert negative_log_ps(gains, parameters, degrees) == pytest.approx(
        np.negative(wanted), rel=2e-3
    )
    far = [negative_log_p(g, parameters, degrees) for g in (150.0, 199.9, 200.1, 400.0, 1e4, 1e6)]
    assert np.all(np.diff(far) > 0) and np.isfinite(far).all()


def test_repeats_may_be_made_beside_the_first_mark():
    marks = marks_on(BELIEVED, BELIEVED, grid(3, 3) + np.array([[20.0, 0.0]]), noise=0.3, seed=9)
    first = marks_on(BELIEVED, BELIEVED, grid(3, 3), noise=0.3, seed=8)
    near = tuple(
        replace(again, name=original.name) for again, original in zip(marks, first, strict=True)
    )
    spread = repeats_of(observe(BELIEVED, Measurements((*first, *near))))
    assert spread.degrees == 18 and spread.sigma == pytest.approx(0.3, rel=0.4)
    # Settings that were changed in between move the mark: that is no noise.
    rounds = tuple(replace(again, round=1) for again in near)
    joined = Measurements((*first, *rounds), rounds=(Round(), Round()))
    assert repeats_of(observe(BELIEVED, joined)).degrees == 0


def test_repeats_count_only_what_was_done_alike():
    twice = marks_on(TRUE, BELIEVED, grid(3, 1), noise=0.3, seed=1)
    again = marks_on(TRUE, BELIEVED, grid(3, 1), noise=0.3, seed=2)
    heavy = marks_on(TRUE, BELIEVED, grid(3, 1), noise=0.3, seed=3, sled_weight=150.0)
    spread = repeats_of(observe(BELIEVED, Measurements((*twice, *again, *heavy))))
    apart = np.subtract([m.measured for m in twice], [m.measured for m in again])
    assert spread.degrees == 6
    assert spread.squares == pytest.approx(np.sum(apart**2) / 2)


@pytest.mark.parametrize(
    ("repeats", "stated", "source", "sigma", "degrees"),
    [
        (Spread(12 * 0.09, 12), None, "repeats", 0.3, 12),
        (Spread(2 * 0.09, 2), None, "repeats", 0.3, 2),
        (Spread(0.0, 0), Stated(0.5), "stated", 0.5, np.inf),
        # 12 of 0.4^2 and 10 of 0.5^2 are 22 of 0.448^2.
        (Spread(12 * 0.16, 12), Stated(0.5), "stated and repeats", 0.4484, 22),
        (Spread(2 * 0.16, 2), Stated(0.5), "stated and repeats", 0.4848, 12),
        (Spread(12 * 1.0, 12), Stated(0.5), "repeats", 1.0, 12),
        # Few repeats do not overrule a statement, however much they differ from it.
        (Spread(5 * 4.0, 5), Stated(0.5), "stated and repeats", 1.2247, 15),
        (Spread(6 * 4.0, 6), Stated(0.5), "repeats", 2.0, 6),
        (Spread(12 * 0.01, 12), Stated(0.5), "repeats", 0.1, 12),
        (Spread(12 * 1.0, 12), Stated(0.5, is_final=True), "stated", 0.5, np.inf),
    ],
)
def test_statements_and_repeats_count_together(repeats, stated, source, sigma, degrees):
    noise = known_noise(repeats, stated)
    assert noise.source == source and noise.sigma == pytest.approx(sigma, rel=1e-3)
    assert noise.degrees == degrees
    contradicted = stated is not None and repeats.degrees > 2 and not 0.3 < repeats.sigma < 0.7
    assert contradicted == any("chance alone hardly does that" in note for note in noise.notes)


@pytest.mark.parametrize(
    ("scatter", "source", "sigma"),
    [
        (Spread(20 * 0.04, 20), "default", 0.5),
        (Spread(20 * 0.64, 20), "scatter", 0.8),
        (Spread(20 * 9.0, 20), "default", 1.0),
        (Spread(4 * 0.64, 4), "default", 0.5),
    ],
)
def test_the_scatter_is_asked_where_nobody_said_anything(scatter, source, sigma):
    assert known_noise(Spread(0.0, 0.0), None) is None
    noise = guessed_noise(scatter)
    assert noise.source == source and noise.sigma == pytest.approx(sigma)
    assert np.isfinite(noise.degrees) == (source == "scatter")


def test_repeats_by_chance_alone_do_not_make_a_statement_wrong():
    # The 1 % and 99 % points of chi-square with 12 degrees of freedom, from any printed table.
    for squares, said in ((3.60, False), (3.54, True), (26.1, False), (26.3, True)):
        notes = known_noise(Spread(squares, 12), Stated(1.0)).notes
        assert any("stated 1.00 mm" in note for note in notes) == said


@pytest.mark.parametrize(
    "effects", [(), ("chain_pitch",), ("chain_sag", "chain_stretch"), ("tape_scale",)]
)
def test_an_explanation_is_the_fit_of_plumb_add(effects):
    rows = rows_of()
    ours = explain(Board.of(BELIEVED, rows, sigma=0.5), effects)
    theirs = fit(BELIEVED, rows, effects=effects, sigma=0.5)
    assert ours.settled and ours.rms == pytest.approx(theirs.rms, abs=1e-4)
    sizes = [size for name in effects for size in sizes_of(ours, name, STATED)]
    wanted = theirs.estimates[len(theirs.estimates) - len(sizes) :]
    for size, estimate in zip(sizes, wanted, strict=True):
        width = estimate.high - estimate.low
        assert size.value == pytest.approx(estimate.value, abs=1e-3 * width)
        assert size.high - size.low == pytest.approx(width, rel=1e-3)


def test_a_gain_is_what_the_refit_saves():
    frame = explain(board_of(noise=0.2))
    detection = search(frame, effect_names(), STATED)
    for name in ("chain_pitch", "chain_plane", "sheet_skew"):
        saved = frame.cost - explain(frame.board, (name,), start=frame).cost
        assert detection.of(name).drop == pytest.approx(saved, rel=0.02, abs=0.2)


def test_more_parameters_are_no_advantage_in_the_gate():
    # On noise alone each effect is first about as often as any other of its kind: the effect with
    # four parameters must not win because it has four.
    frame = explain(board_of(columns=5, rows=5))
    bases = bases_beyond_fit(frame, effect_names())
    source = np.random.default_rng(3)
    drawn = source.standard_normal((3000, len(frame.residual)))
    names = [name for name in bases if bases[name].shape[1]]
    scores = np.array(
        [
            negative_log_ps(np.sum((drawn @ bases[n]) ** 2, axis=1), bases[n].shape[1], KNOWN)
            for n in names
        ]
    )
    wins = np.bincount(scores.argmax(axis=0), minlength=len(names)) / 3000
    assert wins[names.index("sprocket_runout")] < 0.25
    above = np.mean(scores.max(axis=0) > detection_threshold(bases, STATED))
    assert above == pytest.approx(LEVEL, abs=0.012)


def test_the_gate_rises_as_the_noise_is_known_less():
    bases = bases_beyond_fit(explain(board_of()), effect_names())
    known = detection_threshold(bases, STATED)
    few = detection_threshold(bases, Noise(0.5, 6.0, "repeats"))
    # The limit is a chance, so it hardly moves; the gain that reaches it grows a lot.
    gains = [
        np.interp(level, negative_log_ps(_GRID, 1, d), _GRID)
        for level, d in ((known, KNOWN), (few, 6.0))
    ]
    assert 7 < gains[0] < 12 and gains[1] > 1.7 * gains[0]


_GRID = np.linspace(0, 400, 40001)


def test_the_noise_in_the_gate_is_the_same_each_time():
    bases = bases_beyond_fit(explain(board_of()), effect_names())
    assert detection_threshold(bases, STATED) == detection_threshold(bases, STATED)


def test_a_shift_is_the_error_of_the_fit_without_that_mark():
    frame = explain(board_of())
    for shift in shifts(frame)[:4]:
        left = explain(replace_rows(frame, without(frame.board.rows, shift.reading)))
        full = explain(replace_rows(left, frame.board.rows), start=left)
        del full
        predicted = predict_at(frame.board, left.unknowns)[shift.reading.index]
        wanted = frame.board.rows.measured[shift.reading.index] - predicted
        assert shift.offset == pytest.approx(wanted, abs=5e-3)


def replace_rows(explanation, rows):
    board = explanation.board
    return replace(board, problem=replace(board.problem, observations=rows))


def predict_at(board, unknowns):
    sighting, _ = board.problem.predict(unknowns)
    return sighting.read.where[board.rows.mark_rows]


def test_every_reading_can_be_taken_out():
    given = marks_on(TRUE, BELIEVED, grid(3, 2))
    spans = distances_between(given)
    rows = observe(BELIEVED, Measurements(given, spans.distances[:4]))
    readings = readings_of(rows)
    assert len(readings) == 6 + 4
    assert all(without(rows, reading).count == rows.count - reading.size for reading in readings)


def test_misfit_is_uniform_on_noise():
    chances = [
        misfit_chance(
            explain(board_of(seed=s), ("chain_sag", "chain_stretch", "chain_pitch")), STATED
        )
        for s in range(60)
    ]
    assert stats.kstest(chances, "uniform").pvalue > 0.01


def test_the_frame_swallows_what_it_can():
    frame = explain(board_of(columns=5, rows=5))
    shares = {name: hidden_share(frame, name) for name in effect_names()}
    assert shares["sled_friction"] is None  # no mark has an approach
    assert shares["sprocket_runout"] < 0.2 < shares["motor_level"]
    assert shares["frame_flex"] > 0.8 and shares["chain_stretch"] > 0.5


def test_room_for_what_is_not_there_holds_the_truth():
    # The 95 % upper limit of the stretch that is truly there, while sag and pitch are fitted.
    held = 0
    for seed in range(40):
        board = board_of(columns=5, rows=5, seed=seed)
        others = explain(board, ("chain_sag", "chain_pitch"))
        held += room_for("chain_stretch", (others,), STATED).limits[0].largest >= 5.2e-6
    assert held >= 34  # 38 on average


def test_room_of_two_parameters_is_that_of_both_together():
    # Pitch of both chains moves these marks by 4.67 mm RMS; each chain alone by 4.22 and 1.61.
    board = Board.of(BELIEVED, rows_of(noise=0.0, columns=5, rows=5), sigma=0.05)
    others = explain(board, ("chain_sag", "chain_stretch"))
    room = room_for("chain_pitch", (others,), Noise(0.05, KNOWN, "stated"))
    assert room.mm == pytest.approx(4.672, abs=0.12)


def test_what_points_below_nothing_leaves_no_room_above():
    shrinking = {**TRUE.effects, "chain_stretch": {"compliance": -4e-6}}
    board = board_of(noise=0.0, columns=5, rows=5, true=replace(TRUE, effects=shrinking))
    others = explain(board, ("chain_sag", "chain_pitch"))
    assert room_for("chain_stretch", (others,), STATED).limits[0].largest == 0.0


def test_what_no_mark_feels_has_no_room():
    room = room_for("sled_friction", (explain(board_of()),), STATED)
    assert room.mm is None and room.limits[0].largest is None
