"""Evidence of accounts against full covariances, the noise of a reading, and what is listed."""

from dataclasses import replace

import numpy as np
import pytest
from boards import cut
from hidden_boards import board, board_cut, size_for
from linear_boards import NAMES, covariance_of, in_full, log_density, made_up
from plumb.diagnosis import diagnose
from plumb.diagnosis.evidence import (
    KNOWN,
    ONE_IN,
    SURPRISING,
    Clean,
    Noise,
    Noises,
    accounts_of,
    asked_for,
    clean_of,
    left_by_noise,
    misfit_chance,
    noise_by,
    noises_of,
)
from plumb.diagnosis.explanation import Board, explain, measured_board
from plumb.diagnosis.posterior import LISTED, MOST_LISTED, listing, posterior_of
from plumb.diagnosis.priors import ACTS, ALL, PITCH, PITCH_CHANCE, STATED_SPREAD, UNUSUAL
from plumb.fit.inputs import Inputs, Stated
from plumb.fit.observations import observe
from plumb.hidden import BARE, MAKER, Hidden, plan
from plumb.marks.read import Measurements
from plumb.model.catalogue import EVERY_MACHINE
from plumb.text.values import MM
from scipy import integrate, stats
from synthetic import BELIEVED, TRUE, grid, marks_on


def constant(board):
    """The constant that the engine leaves out of each density."""
    return len(board.read) / 2 * np.log(2 * np.pi)


def variant(accounts, *names):
    """The part of a set, and the place of its variant with typical sizes."""
    for part in accounts.parts:
        for a, number in enumerate(part.sets):
            if accounts.effects[number] == names:
                return part, a
    raise AssertionError(names)


def test_accounts_are_all_sets_of_a_few_effects_with_small_and_large_sizes():
    accounts = accounts_of(made_up(), 2)
    assert len(accounts.effects) == 1 + 4 + 6 + 1 and accounts.effects[-1] == NAMES
    counts = np.bincount(np.concatenate([part.sets for part in accounts.parts]))
    assert counts.tolist() == [1, *[2] * 4, *[4] * 6, 1]
    part, small = variant(accounts, "frame_flex")
    # Stretch is there in every account, as usual; an effect has all its numbers of one kind.
    assert part.index[small].tolist() == [0, 3, 4]
    assert part.variance[small] == pytest.approx([0.36, 1.0, 1.0])
    assert part.variance[small + 1] == pytest.approx([0.36, 4.0, 6.25])
    part, small = variant(accounts, "chain_stretch")
    assert part.variance[small] == pytest.approx([0.36 + 1.0])
    assert part.variance[small + 1] == pytest.approx([0.36 + 16.0])


def test_an_account_is_as_likely_before_the_marks_as_its_effects():
    accounts = accounts_of(made_up(), 2)
    for names, odds in (
        ((), 1.0),
        (("chain_plane",), ACTS / (1 - ACTS) / 2),
        (("chain_stretch",), UNUSUAL / (1 - UNUSUAL) / 2),
        (("chain_plane", "frame_flex"), (ACTS / (1 - ACTS) / 2) ** 2),
        (NAMES, ALL),
    ):
        part, a = variant(accounts, *names)
        assert part.log_prior[a] == pytest.approx(np.log(odds))


def test_a_noise_that_is_final_is_one_point():
    board = made_up()
    noises = noises_of(board, accounts_of(board), Stated(0.7, is_final=True))
    assert noises.sigmas.tolist() == [0.7] and noises.log_prior.tolist() == [0.0]


@pytest.mark.parametrize("stated", [None, Stated(0.7)])
def test_noises_are_looked_at_as_far_as_the_marks_allow_them(stated):
    board = made_up(measured=60)
    for true in (0.3, 1.5):
        source = np.random.default_rng(3)
        read = np.r_[true * source.standard_normal(60), source.standard_normal(2)]
        noises = noises_of(replace(board, read=read[:, np.newaxis]), accounts_of(board), stated)
        assert noises.sigmas[0] < true < noises.sigmas[-1]
        assert np.all(np.diff(np.log(noises.sigmas)) < 0.3)
        assert noises.sigmas[-1] / noises.sigmas[0] < 4
        # What is far from what was stated is less likely before the marks.
        middle = np.log(noises.sigmas / (0.7 if stated else 0.5))
        order = np.argsort(np.abs(middle))
        assert np.all(np.diff(noises.log_prior[order]) <= 0)


SIGMA = 0.5
NOISES = Noises(np.array([SIGMA]), np.zeros(1))


def half_likely(board):
    """The same board with chains that half of all machines have, under their name."""
    columns = {PITCH if name == "sheet_skew" else name: at for name, at in board.columns.items()}
    return replace(board, columns=columns)


def test_half_of_all_chains_are_as_new():
    board = half_likely(made_up(pitch=0.4, least=(-np.inf,) * 4))
    accounts = accounts_of(board, 1)
    clean = clean_of(board, accounts, NOISES)
    part = accounts.parts[0]
    assert accounts.effects[part.sets[0]] == ()
    nominal, drifting = (
        log_density(board, in_full(board, part, 0, covariance_of(board, SIGMA, pitch=pitch)))
        for pitch in (False, True)
    )
    constant = len(board.read) / 2 * np.log(2 * np.pi)
    wanted = np.log(PITCH_CHANCE * np.exp(drifting) + (1 - PITCH_CHANCE) * np.exp(nominal))
    assert clean.total[0, 0] - constant == pytest.approx(wanted)
    assert clean.nominal[0, 0] - constant == pytest.approx(np.log(1 - PITCH_CHANCE) + nominal)


@pytest.mark.parametrize("size", [1.0, 0.2, 3.0])
def test_the_settings_are_doubted_by_how_likely_they_make_the_readings(size):
    # Dickey: the density of a size after the marks to that before them is the ratio of evidences.
    board = made_up(seed=4, least=(0.0, -np.inf, -np.inf, -np.inf))
    column, noise = board.effects[:, 0], np.random.default_rng(2).standard_normal(len(board.read))
    board = replace(board, read=((size - 1.0) * column + 0.3 * noise)[:, np.newaxis])
    accounts = accounts_of(board, 1)
    ratio = clean_of(board, accounts, NOISES).on(0).at_settings[0][0]
    density = stats.multivariate_normal(cov=covariance_of(board, SIGMA))

    def of_size(off):
        return density.pdf(board.read[:, 0] - off * column)

    prior = stats.truncnorm(-1 / 0.6, np.inf, scale=0.6)
    whole = integrate.quad(lambda off: of_size(off) * prior.pdf(off), -1, 8, limit=200)[0]
    # The settings know of no stretch: it is off by one from what is usual.
    assert ratio == pytest.approx(np.log(of_size(-1.0) / whole), abs=1e-4)
    assert (ratio < -np.log(ONE_IN)) == (size > 2)


def clean(*, nominal=0.0, at_settings=0.0):
    """The figures of three sets: the log share of nominal chains, the log ratio at settings."""
    return Clean(np.zeros(3), np.full(3, nominal), {0: np.full(3, at_settings)}, np.zeros(1))


def asked(said):
    """The effects that the sets need."""
    board = half_likely(made_up(pitch=0.4))
    accounts = replace(accounts_of(board), effects=((), ("chain_plane",), (PITCH, "chain_stretch")))
    return asked_for(board, accounts, said, range(3))


@pytest.mark.parametrize(("ratio", "is_named"), [(1.05, True), (0.95, False)])
def test_stretch_is_named_once_the_settings_are_twenty_times_less_likely(ratio, is_named):
    stretch = ("chain_stretch",) if is_named else ()
    assert asked(clean(at_settings=-np.log(ratio * ONE_IN))) == [
        stretch,
        ("chain_plane", *stretch),
        (PITCH, *stretch),  # a set with unusual stretch asks for it no sooner
    ]


@pytest.mark.parametrize(("odds", "is_named"), [(1.05, True), (0.95, False)])
def test_pitch_is_named_once_nominal_chains_are_twenty_times_less_likely(odds, is_named):
    pitch = (PITCH,) if is_named else ()
    nominal = -np.log1p(odds * ONE_IN)
    assert asked(clean(nominal=nominal)) == [pitch, ("chain_plane", *pitch), (PITCH,)]


FINAL = Stated(0.5, is_final=True)


def board_of(*, noise, columns=5, rows=3, times=1, seed=1, true=BELIEVED, sigma=0.5):
    """Marks with noise, each read several times; only the frame is off."""
    exact = marks_on(true, BELIEVED, grid(columns, rows)) * times
    source = np.random.default_rng(seed)
    marks = [
        replace(mark, measured=tuple(mark.measured + noise * source.standard_normal(2)))
        for mark in exact
    ]
    return Board.of(BELIEVED, observe(BELIEVED, Measurements(tuple(marks))), sigma=sigma)


def weights_for(sigmas, sigma, degrees):
    """Log weights of noises of which a sigma with some degrees of freedom was seen."""
    return -degrees * (np.log(sigmas) + 0.5 * (sigma / sigmas) ** 2)


@pytest.mark.parametrize("degrees", [10, 200])
def test_a_noise_is_known_as_well_as_its_posterior_is_narrow(degrees):
    sigmas = np.geomspace(0.05, 5.0, 400)
    noise = noise_by(sigmas, weights_for(sigmas, 0.6, degrees), None, MM)
    assert noise.source == "marks" and noise.sigma == pytest.approx(0.6, rel=1.5 / degrees)
    assert noise.degrees == pytest.approx(degrees, rel=2 / degrees + 0.01)
    assert noise.quantile == pytest.approx(stats.t.isf(0.025, noise.degrees))
    assert noise.upper_quantile == pytest.approx(stats.t.isf(0.05, noise.degrees))
    # A constant in all weights is none.
    less = noise_by(sigmas, weights_for(sigmas, 0.6, degrees) - 900.0, None, MM)
    assert (less.sigma, less.degrees) == pytest.approx((noise.sigma, noise.degrees))


def test_a_noise_that_is_final_stays_whatever_the_marks_say():
    for noise in (0.1, 2.0):
        said = posterior_of(board_of(noise=noise), FINAL).noise
        assert said == Noise(0.5, KNOWN, "stated") and said.quantile == 1.96


@pytest.mark.parametrize(("stated", "true"), [(None, 0.3), (Stated(0.5), 1.0)])
def test_marks_move_what_was_stated_towards_what_they_scatter(stated, true):
    few, many = (
        posterior_of(board_of(noise=true, columns=columns, rows=3, times=times), stated).noise
        for columns, times in ((3, 1), (5, 4))
    )
    assert many.source == ("stated and marks" if stated else "marks")
    assert many.sigma == pytest.approx(true, rel=0.2)
    assert abs(np.log(many.sigma / true)) < abs(np.log(few.sigma / true)) + 0.1
    assert few.degrees < many.degrees < 200


@pytest.mark.parametrize(
    ("off", "says"), [(0.95, ""), (1.05, "more"), (-1.05, "less"), (-0.95, "")]
)
def test_noise_far_from_the_stated_noise_is_reported(off, says):
    stated = Stated(0.5)
    sigma = stated.sigma * np.exp(off * SURPRISING * STATED_SPREAD)
    sigmas = np.geomspace(0.05, 5.0, 4001)
    noise = noise_by(sigmas, weights_for(sigmas, sigma, 4000), stated, MM)
    assert len(noise.notes) == bool(says)
    assert not says or f", {says} than the stated 0.50 mm" in noise.notes[0]


# Lack of fit.


def test_the_chance_of_a_misfit_is_uniform_where_the_noise_is_known():
    chances = [misfit_chance(explain(board_of(noise=0.5, seed=seed)), FINAL) for seed in range(60)]
    assert stats.kstest(chances, "uniform").pvalue > 0.01


def test_noise_leaves_the_same_error_as_on_many_boards():
    noise = Noise(0.5, KNOWN, "stated")
    left = [explain(board_of(noise=0.5, seed=seed)).rms ** 2 for seed in range(40)]
    said = left_by_noise(explain(board_of(noise=0.5)), noise)
    assert said == pytest.approx(np.sqrt(np.mean(left)), rel=0.06)
    assert said < 0.5 * np.sqrt(2)
    more = left_by_noise(explain(board_of(noise=0.5, true=TRUE), ("chain_pitch",)), noise)
    assert more < said


def test_a_field_does_not_count_as_noise():
    """Accounts without a field need a large noise here; those with a field the noise there is."""
    board = board_cut({}, plan(5, 5), seed=4, noise=0.5, tape_sigma=None, bump=4.0)
    diagnosis = diagnose(Inputs(MAKER, board.measurements))
    posterior = diagnosis.readings.posterior
    assert diagnosis.verdict == "not_in_library" and posterior.field_chance > 0.9
    assert diagnosis.noise.sigma == pytest.approx(0.5, rel=0.3)
    # The accounts without a field keep theirs.
    assert posterior.noises.sigmas.max() > 1.5 * diagnosis.noise.sigma


NINE = plan(3, 3)


def listed(shares):
    """The accounts that are listed, by the shares of all."""
    several, weights = [*shares], np.log([*shares.values()]) + 7.0
    return [(several[place], share) for place, share in listing(several, weights)]


def test_the_fewest_accounts_that_hold_nearly_all_are_listed():
    shares = {("a",): 0.6, ("b",): 0.3, ("c",): 0.06, ("d",): 0.04}
    assert [each for each, _ in listed(shares)] == [("a",), ("b",), ("c",)]
    assert [share for _, share in listed(shares)] == pytest.approx([0.6, 0.3, 0.06])
    assert listed({("a",): LISTED + 0.001, ("b",): 0.049}) == [(("a",), pytest.approx(0.951))]
    assert [each for each, _ in listed({("a",): LISTED - 0.001, ("b",): 0.051})] == [("a",), ("b",)]
    many = {(str(i),): 0.05 for i in range(20)}
    assert len(listed(many)) == MOST_LISTED


def test_an_account_that_only_adds_to_a_likelier_one_counts_with_it():
    shares = {("a",): 0.6, ("a", "b"): 0.2, ("b", "c"): 0.15, ("d",): 0.05}
    assert listed(shares) == [(("a",), pytest.approx(0.8)), (("b", "c"), pytest.approx(0.15))]
    # One that is likelier with more stays, and what is in it stays beside it.
    assert [each for each, _ in listed({("a", "b"): 0.6, ("a",): 0.4})] == [("a", "b"), ("a",)]


def bare_posterior(layout, noise):
    """Of a machine as every machine is, cut with settings that know of no sag and no stretch."""
    made = cut(Hidden(), layout, seed=3, noise=noise, settings=BARE).measurements
    return posterior_of(measured_board(Inputs(BARE, made)), Stated(noise, is_final=True))


def test_usual_effects_are_not_suspects_where_marks_do_not_show_them():
    # Settings without sag or stretch, and marks that are read too badly to tell.
    posterior = bare_posterior(NINE, 4.0)
    assert all(not {*each.account.effects} & {*EVERY_MACHINE} for each in posterior.listed())
    # Read well, they tell that the chain sags.
    assert "chain_sag" in bare_posterior(plan(5, 5), 0.1).accounts[0].effects


def test_sizes_that_no_machine_has_are_unlikely_by_themselves():
    # A leaning frame draws the same arrows as sag, but would have to lean by 58 degrees.
    size = size_for("chain_sag", NINE, 3.0)
    measured = board({"chain_sag": size}, NINE, seed=101)
    posterior = posterior_of(measured_board(Inputs(MAKER, measured)), FINAL)
    assert posterior.listed()[0].account.effects == ("chain_sag",)
    assert not any(each.account.effects == ("frame_lean",) for each in posterior.listed())
