"""A board, its priors, and an explanation: frame and effects refitted, with the slopes there."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import scipy

from plumb.fit.expected import plausible_range
from plumb.fit.fit import AT_REST, PRIORS, USUAL_SIGMA, Checked, Linearized, Problem, solve
from plumb.fit.inputs import Inputs, Stated
from plumb.fit.observations import Observations, different_numbers
from plumb.marks.read import Measurements
from plumb.model.catalogue import EVERY_MACHINE, ZEROING_NAMES, effect_names, parameter_names
from plumb.settings.machine import MachineSettings
from plumb.text.errors import InputError
from plumb.text.values import MM, Unit

# An explanation: the frame and some effects refitted together, and the slopes at that fit.


Array = np.ndarray
INVISIBLE = 1e-5  # share of a column's length below which its rest is rounding


@dataclass(frozen=True)
class Board:
    """A measured board with every effect of the catalogue as an unknown."""

    problem: Problem
    effect_columns: Mapping[str, tuple[int, ...]]  # in the catalogue's order
    usual: int = 0  # the last rows of its direct checks say only what is usual
    unit: Unit = MM  # of the lengths in what is said of it

    @staticmethod
    def of(
        settings: MachineSettings,
        rows: Observations,
        *,
        sigma: float,
        priors: Mapping[str, float] = PRIORS,
        checked: Sequence[Checked] = (),
        unit: Unit = MM,
    ) -> Board:
        """Return the board of a model that starts from these settings; sigma [mm] whitens it."""
        problem = Problem.of(settings, rows, effect_names(), priors, sigma, checked)
        effect_columns = {
            effect: tuple(problem.names.index(name) for name in parameter_names(effect))
            for effect in effect_names()
        }
        return Board(problem, effect_columns, unit=unit)

    @property
    def rows(self) -> Observations:
        """Measured numbers."""
        return self.problem.observations

    @property
    def sigma(self) -> float:
        """[mm] of one number."""
        return self.problem.sigma

    @property
    def frame(self) -> Array:
        """Columns of the frame and the sheet's pose, which every explanation refits."""
        return np.flatnonzero(self.problem.held)

    def columns(self, effects: Iterable[str]) -> Array:
        """Columns of these effects' parameters."""
        return np.array([i for effect in effects for i in self.effect_columns[effect]], dtype=int)

    def with_rows(self, rows: Observations, *, sigma: float | None = None) -> Board:
        """Return the same machine with other observations, and another sigma [mm] if it is
        given.
        """
        sigma = self.sigma if sigma is None else sigma
        return replace(self, problem=replace(self.problem, observations=rows, sigma=sigma))

    @cached_property
    def fitted(self) -> Explanation:
        """The frame alone, as it fits best."""
        return explain(self)

    @property
    def usual_checks(self) -> tuple[Checked, ...]:
        """Sizes that are held near their usual values."""
        count = len(self.problem.checked)
        return self.problem.checked[count - self.usual :]

    def with_usual(self, checks: Sequence[Checked]) -> Board:
        """Return the same board on which some numbers are held near what is usual."""
        if not checks:
            return self
        made = self.problem.checked[: len(self.problem.checked) - self.usual]
        return replace(
            self, problem=replace(self.problem, checked=(*made, *checks)), usual=len(checks)
        )


@dataclass(frozen=True)
class Explanation:
    """Frame and effects as they fit best together."""

    board: Board
    effects: tuple[str, ...]
    at: Linearized  # unknowns that were not fitted are at their start
    settled: bool

    @property
    def unknowns(self) -> Array:
        """Of every name (u,)."""
        return self.at.unknowns

    @property
    def residual(self) -> Array:
        """Residuals, whitened: measured numbers, priors, direct checks."""
        return self.at.residual

    @property
    def slopes(self) -> Array:
        """Of what is predicted, whitened, by every name (rows, u)."""
        return self.at.slopes

    @property
    def cost(self) -> float:
        """Chi-square of what is left."""
        return self.at.cost

    @property
    def free(self) -> Array:
        """Columns that were fitted."""
        return free_columns(self.board, self.effects)

    @property
    def numbers(self) -> Array:
        """Residuals of the measured numbers (n,) [mm]."""
        return self.residual[: self.board.rows.count] * self.board.sigma

    @property
    def rms(self) -> float:
        """Root mean square error of the marks (as vectors), or of distances without marks [mm]."""
        return self.board.rows.rms_of(self.numbers)

    @cached_property
    def basis(self) -> Array:
        """Orthonormal columns of what was fitted."""
        return span(self.slopes[:, self.free])

    @cached_property
    def covariance(self) -> Array:
        """Of what was fitted, for readings with the noise of the board."""
        return covariance_of(self.slopes[:, self.free])

    def beyond_fit(self, effects: Iterable[str]) -> Array:
        """Columns of effects without what the fitted columns can imitate."""
        return beyond(self.basis, self.slopes[:, self.board.columns(effects)])

    def with_effects(self, effects: tuple[str, ...]) -> Explanation:
        """Return about what a refit with these effects would be, by the slopes here."""
        free = free_columns(self.board, effects)
        step = np.linalg.lstsq(self.slopes[:, free], self.residual, rcond=1e-10)[0]
        unknowns = self.unknowns.copy()
        unknowns[free] += step
        residual = self.residual - self.slopes[:, free] @ step
        at = replace(self.at, unknowns=unknowns, residual=residual)
        return Explanation(self.board, effects, at, settled=True)


def beyond(basis: Array, columns: Array) -> Array:
    """Return columns without what orthonormal columns can imitate."""
    left: Array = columns - basis @ (basis.T @ columns)
    return left


def covariance_of(columns: Array) -> Array:
    """Return the covariance of unknowns with these whitened columns."""
    return np.linalg.pinv(columns.T @ columns, rcond=1e-12, hermitian=True)


def span(columns: Array, *, against: Array | None = None) -> Array:
    """Orthonormal basis of columns; what is tiny against the columns `against` is rounding."""
    if columns.shape[1] == 0:
        return columns
    lengths = np.linalg.norm(columns if against is None else against, axis=0)
    felt = columns[:, lengths > 0] / lengths[lengths > 0]
    left, sizes, _ = np.linalg.svd(felt, full_matrices=False)
    return left[:, sizes > INVISIBLE]


def explain(
    board: Board, effects: tuple[str, ...] = (), *, start: Explanation | None = None
) -> Explanation:
    """Refit the frame and these effects."""
    solution = solve(
        board.problem,
        free=free_columns(board, effects),
        start=None if start is None else start.unknowns,
        at_start=start.at if start and start.board.problem is board.problem else None,
        close_enough=AT_REST,
    )
    return Explanation(board, effects, solution.at, solution.settled)


def free_columns(board: Board, effects: Iterable[str]) -> Array:
    """Columns of the frame and of these effects."""
    return np.concatenate([board.frame, board.columns(effects)])


# The measured board of a diagnosis: readings as numbers with weights, every effect an unknown.

FEWEST_NUMBERS = 6  # three marks: below that the frame explains everything


def measured_board(inputs: Inputs) -> Board:
    """Return the board of these inputs; raises InputError for too few marks, and for bad
    targets.
    """
    model, rows = inputs.model_and_observations()
    _refuse_too_few(inputs.measurements, rows)
    return board_of(inputs, model, rows)


def board_of(inputs: Inputs, model: MachineSettings, rows: Observations) -> Board:
    """Return the board of these observations, whitened by what is known of a reading."""
    sigma = inputs.stated.sigma if inputs.stated else USUAL_SIGMA
    return Board.of(
        model, rows, sigma=sigma, priors=inputs.priors, checked=inputs.checked, unit=inputs.unit
    )


def _refuse_too_few(measurements: Measurements, rows: Observations) -> None:
    count = different_numbers(measurements, rows)
    if count < FEWEST_NUMBERS:
        raise InputError(
            f"{measurements.source}: {count} measured numbers are too few for a diagnosis; measure "
            "at least three marks, better nine or more all over the sheet"
        )


# Gaussian processes, which no mechanics made, as they would be measured.


def gaussian_process_columns(
    frame: Explanation, widths: Sequence[float], least: float
) -> Iterator[Array]:
    """Yield for each width what independent normals move of the measured numbers (n, c) [mm],
    together as a Gaussian process of 1 mm each way does.

    widths: its length scales, in halves of what the marks span. least [mm^2]: what the columns
    may leave out of its variance at any place.
    """
    places = places_of(frame)
    half = half_span(places)
    apart = np.sum(((places[:, np.newaxis] - places[np.newaxis]) / half) ** 2, axis=2)
    for width in widths:
        root = _root(np.exp(-apart / (2 * width**2)), least)
        yield measured_columns(root, places, frame.board.rows)


def places_of(frame: Explanation) -> Array:
    """Return where each visit is by a fit (visits, 2) [mm]."""
    sighting, _ = frame.board.problem.predict(frame.unknowns)
    where: Array = sighting.taped.where
    return where


def half_span(places: Array) -> Array:
    """Halves (2,) [mm] of what places span."""
    half: Array = np.maximum(np.ptp(places, axis=0) / 2, 1.0)
    return half


def measured_columns(moved: Array, places: Array, rows: Observations) -> Array:
    """Columns (n, 2 c) of the measured numbers; each column of `moved` (visits, c) [mm] acts once
    to the right and once upwards."""
    along = places[rows.distance_rows]
    along = along[:, 1] - along[:, 0]
    along = along / np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-9)
    stretched = moved[rows.distance_rows[:, 1]] - moved[rows.distance_rows[:, 0]]
    columns = np.zeros((rows.count, 2, moved.shape[1]))
    for axis in (0, 1):
        columns[axis : rows.measured.size : 2, axis] = moved[rows.mark_rows]
        columns[rows.measured.size :, axis] = along[:, [axis]] * stretched
    return columns.reshape(rows.count, -1)


def _root(covariance: Array, least: float) -> Array:
    """Columns whose covariance it is, but for `least`: few where places lie close together."""
    lower, pivots, rank, _ = scipy.linalg.lapack.dpstrf(covariance, tol=least, lower=1)
    root = np.zeros((len(covariance), rank))
    root[pivots - 1] = np.tril(lower)[:, :rank]
    return root


# Priors of the posterior: machines and readings before any mark is read.
#
# Each number stands here with its source. To change what the lab believes, change it here.


LIKELIER = 0.5  # chance from which on something is likelier than not

# How likely each thing is on a machine in question. No machines were counted, so
# these are guesses; docs/diagnosis.md says which answers hang on them, and by how much.
ACTS = 0.1  # an effect
UNUSUAL = 0.05  # that what every machine has is far from usual
ALL = 0.01  # that every effect of the library acts at once
TOGETHER = 3  # effects at once in an account; the marks of one sheet hardly carry more
FIELD = 0.15  # that the machine also does what no effect of the library does: half of it all over
# the sheet, half about a single place
OUTLIER = 0.1  # that some reading is off
MOVED = 0.05  # that a later round was not cut by the same machine on the same sheet
TURNED = 0.01  # that all y errors have the wrong sign

# [mm] Readings that are off: a misread tick, a wrong hook, exchanged digits. All as likely.
OUTLIER_SPREADS = (4.0, 20.0, 200.0)
# [mm] and halves of what the marks span: what a smooth field of no effect does. All as likely.
FIELD_SPREADS = (1.0, 2.0, 4.0)
FIELD_WIDTHS = (0.35, 0.7, 1.4)
SPOT_WIDTHS = (0.25, 0.45)  # of a field that acts about a single place
ROUND_SPREAD = 6.0  # [mm] of a sheet laid elsewhere, and of a chain hung by a link less

# The noise of a reading: the logarithm of its standard deviation is Student's t about what is
# stated. A careful owner's tape reads to about 0.5 mm.
NOISE_DEGREES = 4.0
STATED_SPREAD = 0.22  # how well people know it
UNSTATED_SPREAD = 0.5  # of tapes in general, about USUAL_SIGMA


@dataclass(frozen=True)
class Usual:
    """Usual sizes of a parameter on every machine, as shares of its typical size."""

    mean: float  # of machines whose settings do not know it
    spread: float  # from machine to machine, where the settings do not know it
    known: float  # the same about the value that the settings have


# Stretch: makers and owners state 4.1e-6 to 8.1e-6 1/N for this chain; WebControl takes 5.17e-6.
# Sag goes with the square of the chain's weight, which differs by a tenth from maker to maker.
USUAL: Mapping[str, Usual] = {
    "chain_stretch.compliance": Usual(mean=1.0, spread=0.6, known=0.3),
    "chain_sag.weight_ratio_squared": Usual(mean=1.0, spread=0.2, known=0.12),
}
# Pitch: ANSI allows this chain to be up to 0.26 % too long. Half of all chains are taken to be a
# little off, each chain by itself.
PITCH = "chain_pitch"
PITCH_CHANCE, PITCH_SPREAD = 0.5, 0.0005
# Where pitch is far from usual, both chains are off by about as much, for they come from one reel:
# the only machine whose two numbers are published has 0.35 and 0.36 %.
PITCH_CORRELATION = 0.9
ZERO = 1e-4  # of a typical size: how near zero what cannot be negative is held


@dataclass(frozen=True)
class SizePriors:
    """Normal priors of the parameters of some effects, in typical sizes off the settings' values.

    A parameter that cannot be negative is at least its `least`. What every machine has counts in
    each account, about `mean` with `usual`; an effect that acts adds one of two spreads. All are
    independent; the pitches of both chains are not, and stand as `turned` has them.
    """

    mean: Array  # (p,)
    usual: Array  # (p,) standard deviation on every machine; 0: only where the effect acts
    typical: Array  # (p,) spread of the sizes that are met most
    largest: Array  # (p,) spread of the sizes that were met at all
    least: Array  # (p,) off the settings' value; -inf: it has either sign
    pitch: Array  # (p,) usual standard deviation that half of all machines have


def size_priors(board: Board, columns: Array) -> SizePriors:
    """Return the priors of these columns of a board's unknowns."""
    problem = board.problem
    names = [problem.names[column] for column in columns]
    scale, start = problem.scale[columns], problem.start[columns] / problem.scale[columns]
    met = [plausible_range(name) for name in names]
    usual = [USUAL.get(name) for name in names]
    is_set = start != 0
    alike, drift = np.ones(len(names)), np.zeros(len(names))
    pair = _pitches(board, columns)
    if pair:
        alike[pair] = np.sqrt([1 + PITCH_CORRELATION, 1 - PITCH_CORRELATION])
        # Settings that have the pitch of a chain know that of the other too.
        drift[pair] = 0.0 if is_set[pair].any() else PITCH_SPREAD / scale[pair]
    return SizePriors(
        mean=np.array([each.mean if each else 0.0 for each in usual]) * ~is_set,
        usual=np.array(
            [
                (each.known if known else each.spread) if each else 0.0
                for each, known in zip(usual, is_set, strict=True)
            ]
        ),
        typical=alike,
        largest=largest_met(board, columns) * alike,
        least=np.where([each.low >= 0 for each in met], -start, -np.inf),
        pitch=drift,
    )


def largest_met(board: Board, columns: Array) -> Array:
    """Return the largest sizes (p,) that real machines have of these columns, in typical sizes."""
    met = [plausible_range(board.problem.names[column]) for column in columns]
    sizes = np.array([max(abs(each.low), abs(each.high)) for each in met])
    largest: Array = sizes / board.problem.scale[columns]
    return largest


def turned(board: Board, columns: Array, slopes: Array) -> Array:
    """Return the slopes (n, p) of these columns, with those of the pitches of both chains along
    their sum and their difference, each over the root of two: these are independent.
    """
    pair = _pitches(board, columns)
    if pair:
        slopes = slopes.copy()
        slopes[:, pair] = slopes[:, pair] @ (np.array([[1.0, 1.0], [1.0, -1.0]]) / np.sqrt(2))
    return slopes


def _pitches(board: Board, columns: Array) -> list[int]:
    """Return the places of both pitches among some columns; none where that effect is not."""
    names = [board.problem.names[column] for column in columns]
    return [place for place, name in enumerate(names) if name.startswith(f"{PITCH}.")]


def usual_checks(board: Board, effects: Iterable[str]) -> tuple[Checked, ...]:
    """Return what is usual of the parameters of some effects, as if it had been measured."""
    problem, checks = board.problem, []
    for column in board.columns(effects):
        name, scale, start = problem.names[column], problem.scale[column], problem.start[column]
        known = USUAL.get(name)
        if known:
            share = known.known if start else known.spread
            checks.append(Checked(name, float(start or known.mean * scale), float(share * scale)))
        elif name.startswith(f"{PITCH}."):
            checks.append(Checked(name, float(start), PITCH_SPREAD))
    return tuple(checks)


def zero_checks(fitted: Explanation) -> tuple[Checked, ...]:
    """Return the sizes of an explanation that are below zero and cannot be, as zero."""
    problem = fitted.board.problem
    checks = []
    for column in fitted.board.columns(fitted.effects):
        name, scale = problem.names[column], float(problem.scale[column])
        value = problem.start[column] + scale * fitted.unknowns[column]
        if plausible_range(name).low >= 0 and value < 0:
            checks.append(Checked(name, 0.0, ZERO * scale))
    return tuple(checks)


def chance_of(effect: str) -> float:
    """Return how likely an effect acts, or is unusual on this machine, before the marks."""
    return UNUSUAL if effect in EVERY_MACHINE or effect == PITCH else ACTS


def noise_prior(stated: Stated | None) -> tuple[float, float]:
    """Return the middle [mm] of the noise, and the spread of its logarithm; 0: it is known."""
    if stated is None:
        return USUAL_SIGMA, UNSTATED_SPREAD
    return stated.sigma, 0.0 if stated.is_final else STATED_SPREAD


# A board made linear about a fit, and what is left of it once noise and frame are allowed for.
#
# What is measured is then a sum of normals: noise, the frame within its priors, effects, and
# perhaps a smooth field or a round that moved. With Z = [frame, effects, readings] as columns, all
# that any account needs is the Gram matrix Z' C^-1 Z, where C holds noise and field. The frame is
# integrated out by a Schur complement. A field is written in few orthonormal columns U with
# variances l, so Woodbury's identity gives C^-1 for each noise s and each field without another
# factorization:
#
# C^-1 = (1 - U diag(l / (s^2 + l)) U') / s^2


ROUNDING = 1e-9  # [mm] less than that moves nothing
LEFT_OUT = 1e-3  # share of the noise's variance to which a field is described


@dataclass(frozen=True)
class LinearBoard:
    """Readings and slopes about a fit. Measured numbers come first, then direct checks.

    Rows of measured numbers are in mm, those of checks in their standard deviations; effects are
    in typical sizes (pitches as `turned` has them), the frame in standard deviations of its priors.
    """

    measured: int  # rows of measured numbers
    frame: Array  # (n, f)
    effects: Array  # (n, p)
    read: Array  # (n, boards) less what the settings predict with usual sizes
    columns: dict[str, Array]  # of each effect that is felt, among the p
    sizes: SizePriors

    @staticmethod
    def of(at: Explanation, felt: Sequence[str]) -> LinearBoard:
        """Make the board of an explanation linear about its fit, with the effects that are felt."""
        board = at.board
        count, held = board.rows.count, int(board.problem.held.sum())
        kept = np.r_[0:count, count + held : len(at.residual) - board.usual]
        slopes = _unwhitened(at.slopes[kept], count, board.sigma)
        read = at.residual[kept] + at.slopes[kept] @ at.unknowns
        columns = board.columns(felt)
        sizes = size_priors(board, columns)
        read = _unwhitened(read[:, np.newaxis], count, board.sigma)
        starts = np.cumsum([0, *(len(board.columns([name])) for name in felt)])
        return LinearBoard(
            measured=count,
            frame=slopes[:, board.frame],
            effects=turned(board, columns, slopes[:, columns]),
            read=read - slopes[:, columns] @ sizes.mean[:, np.newaxis],
            columns={
                name: np.arange(low, high)
                for name, low, high in zip(felt, starts[:-1], starts[1:], strict=True)
            },
            sizes=sizes,
        )


def _unwhitened(rows: Array, measured: int, sigma: float) -> Array:
    return np.vstack([rows[:measured] * sigma, rows[measured:]])


# What else may move readings: a smooth field, and a round that was moved.


@dataclass(frozen=True)
class Disturbance:
    """Something that moves the measured numbers as independent normals do."""

    axes: Array  # (n, r) orthonormal
    variances: Array  # (r,) [mm^2]

    @staticmethod
    def of(columns: Array) -> Disturbance:
        """Return what columns (n, c) [mm] of independent normals move."""
        left, sizes, _ = np.linalg.svd(columns, full_matrices=False)
        seen = sizes > 1e-6 * max(sizes.max(initial=0.0), 1e-9)
        return Disturbance(left[:, seen], sizes[seen] ** 2)

    def times(self, length: float) -> Disturbance:
        """Return the same, larger by a factor."""
        return replace(self, variances=self.variances * length**2)


def smooth_fields(frame: Explanation, sigma: float) -> list[Disturbance]:
    """Return smooth fields that no effect draws, of all usual widths and spreads; sigma [mm]."""
    least = LEFT_OUT * sigma**2 / max(FIELD_SPREADS) ** 2
    return [
        unit.times(spread)
        for columns in gaussian_process_columns(frame, FIELD_WIDTHS, least)
        for unit in [Disturbance.of(columns)]
        for spread in FIELD_SPREADS
    ]


@dataclass(frozen=True, eq=False)
class MovedRound:
    """A later round that does not go with the others, and what would make it so."""

    number: int
    cause: str  # "new_sheet", "chains_rezeroed", or "" for another machine
    other: Disturbance


def moved_rounds(frame: Explanation) -> list[MovedRound]:
    """Return how each later round may have been moved; none if all marks are of one round."""
    board, rows = frame.board, frame.board.rows
    number = np.concatenate([np.repeat(rows.rounds[rows.mark_rows], 2), rows.distance_rounds])
    slopes = frame.slopes[: rows.count] * board.sigma
    by_cause = _causes_of_moves(board, slopes)
    return [
        MovedRound(int(later), cause, Disturbance.of(columns[:, moved] * mine[:, np.newaxis]))
        for later in np.unique(number)[1:]
        for mine in [number == later]
        for cause, columns in by_cause.items()
        for moved in [np.any(np.abs(columns[mine]) > ROUNDING, axis=0)]
        if moved.any()
    ]


def _causes_of_moves(board: Board, slopes: Array) -> dict[str, Array]:
    """Columns (n, c) [mm] of what may change from one round to the next."""
    names, scale, marks = board.problem.names, board.problem.scale, board.rows.measured.size
    shifts = np.zeros((len(slopes), 2))
    for axis in (0, 1):
        shifts[axis:marks:2, axis] = ROUND_SPREAD
    zeros = [names.index(name) for name in ZEROING_NAMES]
    hung = slopes[:, zeros] * ROUND_SPREAD / scale[zeros]
    turned = slopes[:, [i for i in board.frame if names[i] == "sheet_rotation"]]
    everything = np.hstack([shifts, hung, slopes[:, board.frame]])
    return {"new_sheet": np.hstack([shifts, turned]), "chains_rezeroed": hung, "": everything}


# Gram matrices of readings and effects, for each noise, with the frame integrated out.


@dataclass(frozen=True)
class Metric:
    """Distances between readings: for each of m noises, with noise, frame and one other thing."""

    sigmas: Array  # (m,) [mm] of the noise
    gram: Array  # (m, p, p) of the effects
    along: Array  # (m, p, boards) of effects and readings
    square: Array  # (m, boards) of the readings
    log_determinant: Array  # (m,) of the covariance of the readings

    @staticmethod
    def of(
        board: LinearBoard, sigmas: Array, other: Disturbance | None = None, *, pitch: bool = False
    ) -> Metric:
        """Return the metrics for noises (m,) [mm]; `pitch`: with chains as makers sell them."""
        columns = np.hstack([board.frame, board.effects, board.read])
        inside, beyond = np.split(columns, [board.measured])
        precision = 1 / sigmas**2
        whole = precision[:, np.newaxis, np.newaxis] * (inside.T @ inside) + beyond.T @ beyond
        log_determinant = board.measured * 2 * np.log(sigmas)
        if other is not None:
            seen = other.axes.T @ inside
            taken = other.variances / (sigmas[:, np.newaxis] ** 2 + other.variances)
            weights = precision[:, np.newaxis] * taken
            whole = whole - np.einsum("ri,mr,rj->mij", seen, weights, seen, optimize=True)
            log_determinant = log_determinant - np.sum(np.log1p(-taken), axis=1)
        return _without_frame(board, sigmas, whole, log_determinant, pitch=pitch)


def _without_frame(
    board: LinearBoard, sigmas: Array, whole: Array, log_determinant: Array, *, pitch: bool
) -> Metric:
    """Integrate the frame out of Gram matrices (m, z, z), and usual pitch if asked."""
    frame, effects = board.frame.shape[1], board.effects.shape[1]
    drifting = np.flatnonzero(board.sizes.pitch) if pitch else np.zeros(0, dtype=int)
    loose = np.concatenate([np.arange(frame), frame + drifting])
    spread = np.concatenate([np.ones(frame), board.sizes.pitch[drifting]])
    kept = np.arange(frame, whole.shape[1])
    inner = whole[:, loose[:, np.newaxis], loose] * np.outer(spread, spread) + np.eye(len(loose))
    mixed = whole[:, loose[:, np.newaxis], kept] * spread[:, np.newaxis]
    rest = whole[:, frame:, frame:] - np.swapaxes(mixed, 1, 2) @ np.linalg.solve(inner, mixed)
    return Metric(
        sigmas=sigmas,
        gram=rest[:, :effects, :effects],
        along=rest[:, :effects, effects:],
        square=np.diagonal(rest[:, effects:, effects:], axis1=1, axis2=2),
        log_determinant=log_determinant + np.linalg.slogdet(inner)[1],
    )


def rows_in_metric(board: LinearBoard, sigma: float) -> tuple[Array, Array]:
    """Return C^-1 [effects, first readings] (n, p + 1), and C^-1 among the two numbers of each
    mark or the number of each distance, with noise and frame in C.
    """
    weight = np.r_[
        np.full(board.measured, 1 / sigma**2), np.ones(len(board.frame) - board.measured)
    ]
    weighted = weight[:, np.newaxis] * board.frame
    inner = np.eye(board.frame.shape[1]) + board.frame.T @ weighted
    root = np.linalg.solve(np.linalg.cholesky(inner), weighted.T).T
    drawn = np.hstack([board.effects, board.read[:, :1]])
    return weight[:, np.newaxis] * drawn - root @ (root.T @ drawn), root
