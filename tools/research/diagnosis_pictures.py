"""Pictures of docs/diagnosis.md: how evidence decides on a board, and how far stated odds hold."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from gate_rates import PRIOR, bins_of, stated_of
from gate_records import Record
from plumb.diagnosis.evidence import Accounts, Noises, Part, accounts_of, fitted
from plumb.diagnosis.explanation import explain, measured_board
from plumb.diagnosis.linear import LinearBoard, Metric
from plumb.diagnosis.posterior import explain_account, felt_effects
from plumb.diagnosis.priors import NOISE_DEGREES, noise_prior
from plumb.fit.inputs import Inputs, Stated
from plumb.pictures.scale import saved
from plumb.pictures.sheet import BAD, EDGE, GOOD, INK

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Array = np.ndarray
SMALL = 9  # [pt]
GRID = 120  # points of a curve
REACH, NOISES = 6.0, 49  # spreads of the prior, points
LEAST_COUNT = 5  # stated chances in a bin that is drawn


# Evidence at work, on a board on which two effects draw the same arrows.


@dataclass(frozen=True)
class Shown:
    """The terms of the evidence of a set [nats], and what it says of noise and size."""

    label: str
    misfit: float  # half of r' C^-1 r
    room: float  # half of log |C|
    sign: float  # of the sizes that cannot be negative
    prior: float
    by_noise: Array  # (m,) log evidence
    part: Part  # its variants
    mean: Array  # (k, a * m)
    spread: Array  # (k, a * m)
    weight: Array  # (a * m,) log


def shown(board: LinearBoard, accounts: Accounts, noises: Noises, names: tuple[str, ...]) -> Shown:
    """Return what a set of effects says; its terms are those of its likeliest size and noise."""
    wanted = np.array([set(each) == set(names) for each in accounts.effects])
    (part,) = accounts.among(wanted).parts
    metric = Metric.of(board, noises.sigmas)
    fit = fitted(part, metric)
    weight = fit.evidence[0] + np.tile(noises.log_prior, len(part.sets))
    best = int(np.argmax(weight))
    m = len(noises.sigmas)
    variance = part.variance[best // m]
    explained = fit.mean[:, 0, best] @ metric.along[best % m][part.index[best // m], 0]
    misfit = float(metric.square[best % m, 0] - explained) / 2
    log_prior = float(part.log_prior[best // m])
    room = log_prior - float(fit.loose[0, best]) - misfit
    assert len(variance) == len(fit.mean)
    return Shown(
        label=" + ".join(names) or "nothing",
        misfit=misfit,
        room=room,
        sign=-float(fit.possible[0, best]),
        prior=-log_prior - float(noises.log_prior[best % m]),
        by_noise=np.logaddexp.reduce(weight.reshape(len(part.sets), m)),
        part=part,
        mean=fit.mean[:, 0],
        spread=np.sqrt(np.diagonal(fit.inverse, axis1=0, axis2=1).T),
        weight=weight,
    )


def evidence_picture(inputs: Inputs, sets: Sequence[tuple[str, ...]], truth: float) -> str:
    """Return the picture as SVG. The sets are shown worst first; the last is the likeliest, a
    single effect, whose true first size is `truth` [its unit].
    """
    from matplotlib.figure import Figure

    frame = explain(measured_board(inputs))
    felt = felt_effects(frame)
    board = LinearBoard.of(frame, felt)
    accounts = accounts_of(board, 2)
    noises = _noises(inputs.stated)
    several = [shown(board, accounts, noises, names) for names in sets]
    figure = Figure(figsize=(10, 3.3), layout="constrained")
    terms, noise, size = figure.subplots(1, 3, width_ratios=(1.25, 1, 1))
    _draw_terms(terms, several)
    _draw_noise(noise, noises, several)
    column = int(board.columns[sets[-1][0]][0])
    scale = float(frame.board.problem.scale[frame.board.columns(sets[-1])[0]])
    start = float(frame.board.problem.start[frame.board.columns(sets[-1])[0]])
    # About its fit, as the likeliest accounts are weighed again.
    near = LinearBoard.of(explain_account(frame, sets[-1], sets[-1]), felt)
    again = shown(near, accounts, noises, sets[-1])
    _draw_size(size, near, again, column, (truth - start) / scale)
    return _svg(figure)


def _noises(stated: Stated | None) -> Noises:
    """Return all noises that the prior allows."""
    middle, spread = noise_prior(stated)
    off = np.linspace(-REACH, REACH, NOISES)
    log_prior = -(NOISE_DEGREES + 1) / 2 * np.log1p(off**2 / NOISE_DEGREES)
    return Noises(middle * np.exp(spread * off), log_prior - np.logaddexp.reduce(log_prior))


def _draw_terms(axis: Axes, several: Sequence[Shown]) -> None:
    colours = ("#7f7f7f", GOOD, BAD, EDGE)
    names = ("misfit", "log |C + E V E'| / 2", "signs", "prior")
    least = min(each.room for each in several)
    for row, each in enumerate(several):
        left = 0.0
        terms = (each.misfit, each.room - least, each.sign, each.prior)
        for name, term, colour in zip(names, terms, colours, strict=True):
            label = name if row == 0 else None
            axis.barh(row, max(term, 0.0), left=left, color=colour, label=label, height=0.6)
            left += max(term, 0.0)
        axis.text(left, row, f" {left:.0f}", va="center", fontsize=SMALL, color=INK)
    axis.set_yticks(range(len(several)), [each.label.replace(" + ", "\n+ ") for each in several])
    axis.margins(x=0.12)
    axis.legend(fontsize=SMALL - 1, frameon=False, loc="upper right")
    _title(axis, "what each account costs, nats", "")


def _draw_noise(axis: Axes, noises: Noises, several: Sequence[Shown]) -> None:
    prior = np.exp(noises.log_prior - np.logaddexp.reduce(noises.log_prior))
    axis.plot(noises.sigmas, prior, "--", color="#7f7f7f", label="before the marks")
    for each, colour in zip((several[0], several[-1]), (BAD, GOOD), strict=True):
        after = np.exp(each.by_noise - np.logaddexp.reduce(each.by_noise))
        axis.plot(noises.sigmas, after, color=colour, label=each.label)
    axis.legend(fontsize=SMALL - 1, frameon=False)
    _title(axis, "the noise, by account", "standard deviation of a reading, mm")


def _draw_size(axis: Axes, board: LinearBoard, best: Shown, column: int, truth: float) -> None:
    """Sizes are in typical sizes off the settings' value."""
    sizes, place = board.sizes, int(np.argmax(best.part.index[0] == column))
    middle, least = float(sizes.mean[column]), float(sizes.least[column])
    chances = np.exp(best.weight - np.logaddexp.reduce(best.weight))
    means, spreads = middle + best.mean[place], best.spread[place]
    after_high = float((means + 5 * spreads)[chances > 0.01].max())
    x = np.linspace(max(least, -3.0), max(after_high, 1.2 * truth), GRID)
    after = np.exp(-0.5 * ((x[:, np.newaxis] - means) / spreads) ** 2) / spreads @ chances
    axis.fill_between(x, after / after.max(), color=GOOD, alpha=0.35, label="after the marks")
    for variance, name, style in zip(
        np.sort(best.part.variance[:, place]), ("typical", "largest met"), ("-", "--"), strict=True
    ):
        slab = np.exp(-0.5 * (x - middle) ** 2 / variance)
        axis.plot(x, slab / 2, style, color="#7f7f7f", label=f"slab: {name}")
    axis.axvline(truth, color=BAD, linewidth=1, label="hidden")
    axis.set_yticks([])
    axis.legend(fontsize=SMALL - 1, frameon=False)
    _title(axis, f"the size of {best.label}", "typical sizes off the settings' value")


# Stated odds against what came true.

SHOWN = ("an effect acts", "the first explanation", "nothing", "a field")


def reliability_picture(records: Sequence[Record]) -> str:
    """Return how often stated chances came true, as SVG."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(10, 3.1), layout="constrained")
    drawn = [record for record in records if PRIOR in record.kind]
    for axis, what in zip(figure.subplots(1, len(SHOWN), sharey=True), SHOWN, strict=True):
        axis.plot((0, 100), (0, 100), color="#bbbbbb", linewidth=1)
        for several, style in (
            (records, {"fmt": "o", "color": EDGE, "mfc": "white", "label": "all boards"}),
            (drawn, {"fmt": "o", "color": GOOD, "label": "drawn from the prior"}),
        ):
            bins = [each for each in bins_of(stated_of(what, several)) if each.count >= LEAST_COUNT]
            axis.errorbar(
                [100 * each.stated for each in bins],
                [100 * each.seen for each in bins],
                yerr=[100 * each.error for each in bins],
                markersize=4,
                linewidth=1,
                **style,
            )
        axis.set_ylim(-4, 104)
        _title(axis, what, "stated, %")
        if what == SHOWN[0]:
            axis.set_ylabel("came true, %", fontsize=SMALL)
            axis.legend(fontsize=SMALL - 1, frameon=False)
    return _svg(figure)


def _title(axis: Axes, text: str, below: str) -> None:
    axis.set_title(text, loc="left", fontsize=SMALL + 1, color=INK)
    axis.set_xlabel(below, fontsize=SMALL)
    axis.tick_params(labelsize=SMALL - 1)


def _svg(figure: Figure) -> str:
    """Return a figure's SVG with letters as letters, so that it stays small."""
    import matplotlib as mpl

    with mpl.rc_context({"svg.fonttype": "none"}):
        return saved(figure, "svg").decode()
