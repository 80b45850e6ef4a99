"""The evidence of accounts against the covariance of all readings, written out in full."""

from dataclasses import replace

import numpy as np
import pytest
from linear_boards import NAMES, covariance_of, in_full, log_density, made_up
from plumb.diagnosis.evidence import (
    Noises,
    accounts_of,
    add_by_set,
    fitted,
    log_orthant,
    noises_of,
    outlier_weights,
    weights_of,
)
from plumb.diagnosis.linear import Metric, Other
from plumb.diagnosis.priors import ACTS, ALL, OUTLIER_SPREADS, UNUSUAL
from plumb.fit.inputs import Stated
from scipy import special, stats

SIGMAS = np.array([0.3, 0.5, 1.1])
EITHER_SIGN = (-np.inf,) * 4


def field(board, seed=3):
    """A field in fewer columns than there are readings."""
    return Other.of(np.random.default_rng(seed).standard_normal((board.measured, 3)))


def constant(board):
    """What the engine leaves out of each density alike."""
    return len(board.read) / 2 * np.log(2 * np.pi)


@pytest.mark.parametrize("has_field", [False, True])
@pytest.mark.parametrize("pitch", [0.0, 0.4])
def test_the_evidence_is_the_density_of_the_readings(has_field, pitch):
    board = made_up(boards=3, least=EITHER_SIGN, pitch=pitch)
    other = field(board) if has_field else None
    metric = Metric.of(board, SIGMAS, other, pitch=pitch > 0)
    for part in accounts_of(board).parts:
        fit = fitted(part, metric)
        loose = fit.evidence.reshape(3, len(part.sets), len(SIGMAS))
        for a in range(len(part.sets)):
            for m, sigma in enumerate(SIGMAS):
                covariance = covariance_of(board, sigma, other, pitch=pitch > 0)
                wanted = log_density(board, in_full(board, part, a, covariance))
                ours = loose[:, a, m] - part.log_prior[a] - constant(board)
                assert ours == pytest.approx(wanted, abs=1e-8)


def test_sizes_are_those_of_the_textbook():
    board = made_up(least=EITHER_SIGN)
    part = accounts_of(board).parts[-1]
    fit = fitted(part, Metric.of(board, SIGMAS[:1]))
    precision = np.linalg.inv(covariance_of(board, SIGMAS[0]))
    for a in (0, len(part.sets) - 1):
        columns = board.effects[:, part.index[a]]
        covariance = np.linalg.inv(columns.T @ precision @ columns + np.diag(1 / part.variance[a]))
        assert fit.inverse[:, :, a] == pytest.approx(covariance)
        assert fit.mean[:, 0, a] == pytest.approx(
            covariance @ columns.T @ precision @ board.read[:, 0]
        )


def variant(accounts, *names):
    """The part of a set, and the place of its variant with typical sizes."""
    for part in accounts.parts:
        for a, number in enumerate(part.sets):
            if accounts.effects[number] == names:
                return part, a
    raise AssertionError(names)


@pytest.mark.parametrize("pull", [2.0, 0.3, -0.3, -1.0, -3.0, -8.0])
def test_what_cannot_be_negative_counts_over_its_possible_sizes_alone(pull):
    board = made_up(seed=2, least=(-np.inf, 0.0, -np.inf, -np.inf))
    board = replace(board, read=pull * board.effects[:, [1]])
    accounts = accounts_of(board)
    part, first = variant(accounts, "chain_plane")
    fit = fitted(part, Metric.of(board, SIGMAS[1:2]))
    place = list(part.index[first]).index(1)
    for a in (first, first + 1):  # of typical and of large sizes
        without = replace(part, variance=part.variance * (np.arange(part.index.shape[1]) != place))
        covariance = in_full(board, without, a, covariance_of(board, SIGMAS[1]))
        wanted = log_density_of_half_normal(board, covariance, np.sqrt(part.variance[a, place]))
        ours = fit.evidence[0, a] - part.log_prior[a] - constant(board)
        assert ours == pytest.approx(wanted, abs=1e-4)


def log_density_of_half_normal(board, covariance, spread):
    """Of the readings, over all sizes of the second effect that are not negative."""
    density = stats.multivariate_normal(cov=covariance)

    def log_at(size):
        return density.logpdf(board.read[:, 0] - size * board.effects[:, 1])

    sizes = np.linspace(0.0, 8 * spread, 200001)[:, np.newaxis]
    logs = log_at(sizes) + stats.halfnorm.logpdf(sizes[:, 0], scale=spread)
    return special.logsumexp(logs, b=np.r_[0.5, np.ones(len(logs) - 1)]) + np.log(sizes[1, 0])


def random_normals(source, k):
    """A mean near the edge, and a covariance."""
    root = source.standard_normal((k, 3 * k))
    covariance = root @ root.T / k
    return np.sqrt(np.diag(covariance)) * source.uniform(-1.5, 2.5, k), covariance


@pytest.mark.parametrize("k", [2, 3, 4, 5])
def test_the_mass_where_nothing_is_negative_is_that_of_the_normal(k):
    source = np.random.default_rng(k)
    for _ in range(12):
        mean, covariance = random_normals(source, k)
        wanted = stats.multivariate_normal(np.zeros(k), covariance, seed=1).logcdf(mean)
        (ours,) = log_orthant(mean[:, np.newaxis], covariance[:, :, np.newaxis])
        # What is hardly possible need not be known so well.
        assert ours == pytest.approx(wanted, abs=0.03 + 0.05 * max(-wanted - 1.5, 0.0))


def test_the_mass_of_independent_numbers_is_a_product():
    mean = np.array([[0.5, -2.0], [-1.0, 9.0], [0.2, 0.0]])
    covariance = np.repeat(np.diag([1.0, 4.0, 0.25])[:, :, np.newaxis], 2, axis=2)
    wanted = special.log_ndtr(mean / np.array([[1.0], [2.0], [0.5]])).sum(axis=0)
    assert log_orthant(mean, covariance) == pytest.approx(wanted, abs=1e-6)


def test_what_has_either_sign_changes_no_mass():
    mean, covariance = random_normals(np.random.default_rng(4), 4)
    free = np.where([False, True, False, True], np.inf, mean)
    bound = np.ix_([0, 2], [0, 2])
    wanted = log_orthant(mean[[0, 2], np.newaxis], covariance[bound][:, :, np.newaxis])
    assert log_orthant(free[:, np.newaxis], covariance[:, :, np.newaxis]) == pytest.approx(wanted)
    nothing = log_orthant(np.full((4, 1), np.inf), covariance[:, :, np.newaxis])
    assert nothing.tolist() == [0.0]


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


def test_sets_keep_their_weights_when_others_are_left_out():
    board, noises = made_up(), Noises(SIGMAS, np.log([0.2, 0.5, 0.3]))
    metric, accounts = Metric.of(board, SIGMAS), accounts_of(board, 2)
    whole = weights_of(accounts, metric, noises)
    few = weights_of(accounts.up_to(1), metric, noises)
    assert few[:5] == pytest.approx(whole[:5]) and np.all(few[5:-1] == -np.inf)
    wanted = np.arange(len(whole)) % 3 == 1
    some = weights_of(accounts.among(wanted), metric, noises)
    assert some[wanted] == pytest.approx(whole[wanted]) and np.all(some[~wanted] == -np.inf)


def test_variants_of_a_set_are_added_to_their_set():
    accounts = accounts_of(made_up(), 2)
    total = np.full((len(accounts.effects), 1), -np.inf)
    for part in accounts.parts:
        add_by_set(total, part, np.zeros((len(part.sets), 1)))
    assert np.exp(total[:, 0]) == pytest.approx([1, *[2] * 4, *[4] * 6, 1])


# Readings that are off: an added column for each.


@pytest.mark.parametrize("pull", [0.0, -5.0, 5.0])
@pytest.mark.parametrize("count", [1, 2, 6])
def test_a_reading_that_is_off_is_a_shift_of_its_own_numbers(count, pull):
    board = made_up(seed=5, measured=7, pitch=0.4, least=(0.0, 0.0, -np.inf, -np.inf))
    # A reading that is off as only an impossible gap would have it.
    board.read[:2, 0] += pull * board.effects[:2, 1]
    noises = Noises(np.geomspace(0.3, 0.9, count), np.log(np.full(count, 1 / count)))
    numbers = np.array([[0, 1], [2, 3], [4, 5], [6, len(board.read)]])
    accounts = accounts_of(board, 2)
    ours = outlier_weights(board, accounts, noises, numbers)
    drifting = board.effects[:, [2]] * board.sizes.pitch[2]
    for reading, rows in enumerate(numbers):
        each = []
        for spread in OUTLIER_SPREADS:
            shifts = spread * np.eye(len(board.read) + 1)[:-1, rows]
            moved = replace(board, frame=np.hstack([board.frame, drifting, shifts]))
            each.append(weights_of(accounts, Metric.of(moved, noises.sigmas), noises))
        wanted = np.logaddexp.reduce(np.concatenate(each), axis=None)
        wanted -= np.log(len(numbers) * len(OUTLIER_SPREADS))
        # The sizes' spread is taken as if no reading were off.
        assert ours[reading] == pytest.approx(wanted, abs=0.1)


# Noises worth a look.


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
