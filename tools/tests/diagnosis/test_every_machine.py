"""Effects that every machine has are part of each account, and named only if marks need them."""

from dataclasses import replace

import numpy as np
import pytest
from linear_boards import covariance_of, in_full, log_density, made_up
from plumb.diagnosis.every_machine import ONE_IN, Clean, asked_for, clean_of
from plumb.diagnosis.evidence import Noises, accounts_of
from plumb.diagnosis.priors import PITCH, PITCH_CHANCE
from scipy import integrate, stats

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
