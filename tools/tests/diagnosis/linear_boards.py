"""Linear boards that no machine made, small enough for the covariance of all readings."""

import numpy as np
from plumb.diagnosis.evidence import LinearBoard
from plumb.diagnosis.priors import SizePriors
from scipy import stats

NAMES = ("chain_stretch", "chain_plane", "sheet_skew", "frame_flex")


def made_up(
    seed=1, *, measured=8, checks=2, boards=1, least=(0.0, 0.0, -np.inf, -np.inf), pitch=0.0
):
    """A board: stretch as every machine has it, a gap that cannot be negative, and three numbers
    of either sign, of which two belong to one effect."""
    source, rows = np.random.default_rng(seed), measured + checks
    least = np.array([*least, -np.inf])
    sizes = SizePriors(
        mean=np.array([1.0, 0.0, 0.0, 0.0, 0.0]),
        usual=np.array([0.6, 0.0, 0.0, 0.0, 0.0]),
        typical=np.ones(5),
        largest=np.array([4.0, 3.0, 5.0, 2.0, 2.5]),
        least=least,
        pitch=np.array([0.0, 0.0, pitch, 0.0, 0.0]),
    )
    return LinearBoard(
        measured=measured,
        frame=source.standard_normal((rows, 3)),
        effects=source.standard_normal((rows, 5)),
        read=source.standard_normal((rows, boards)),
        columns={
            name: np.array(columns)
            for name, columns in zip(NAMES, ([0], [1], [2], [3, 4]), strict=True)
        },
        sizes=sizes,
    )


def covariance_of(board, sigma, other=None, *, pitch=False):
    """Of all readings, by noise, frame, something else and drifting chains."""
    beyond = len(board.read) - board.measured
    covariance = np.diag(np.r_[np.full(board.measured, sigma**2), np.ones(beyond)])
    covariance += board.frame @ board.frame.T
    if other is not None:
        inside = slice(0, board.measured)
        covariance[inside, inside] += other.axes * other.variances @ other.axes.T
    if pitch:
        columns = board.effects * board.sizes.pitch
        covariance += columns @ columns.T
    return covariance


def log_density(board, covariance):
    """Of the readings of each board."""
    return stats.multivariate_normal(cov=covariance).logpdf(board.read.T)


def in_full(board, part, a, covariance):
    """The covariance with the effects of a variant."""
    columns = board.effects[:, part.index[a]]
    return covariance + columns * part.variance[a] @ columns.T
