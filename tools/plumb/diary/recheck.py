"""Do two marks still lie where the fit promised? If not, which single change explains them.

The diary knows how well the numbers were known together when they were fitted. So it knows how far
marks may lie from where the settings put them, and which errors are too large for that.
"""

import tomllib
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from math import dist
from typing import Annotated, Literal

import numpy as np
import scipy

from plumb.diary.file import FIT, Diary, Entry
from plumb.fit.observations import SHEET_ROTATION
from plumb.model.plain import ranked
from plumb.model.predict import FOUND, NAMES, Array, believed_lengths, places_with_slopes, values_of
from plumb.settings import MachineSettings, machine_in
from plumb.text.answers import Internal, Moment, in_json, key, part
from plumb.text.errors import InputError
from plumb.text.values import MM, Unit

Point = tuple[float, float]
READ_SIGMA = 0.5  # [mm] of a coordinate, unless it is stated or the fit found more
FAR = 50.0  # [mm] between holes from which on they are two places; nearer, they err alike
LEVEL = 0.99  # of the rechecks of an unchanged machine hold
STEP = 0.1  # [mm] of chain
# Changes that need no new fit: how much longer a chain is than the machine believes, where the
# sheet lies, and the frame.
LEFT, RIGHT, SHEET_X, SHEET_Y = "left chain", "right chain", "sheet x", "sheet y"
Sameness = Literal["as_fitted", "sheet_moved", "changed", "beyond_these_marks"]
FRAME = ("motor_gap", "motor_height", "motor_center_x")


@dataclass(frozen=True)
class MeasuredMark:
    """A mark that took no part in the fit. mm, from the middle of the sheet, y up."""

    name: str
    hole: Point  # where it is
    target: Point  # where it was sent


def are_apart(measured: Sequence[MeasuredMark]) -> bool:
    """Return whether two of the holes are far enough apart to be two places."""
    return any(dist(one.hole, other.hole) >= FAR for one, other in combinations(measured, 2))


@dataclass(frozen=True)
class LikelyChange:
    """A single change that may explain the errors."""

    name: str  # a chain, the sheet along an axis, or a number of the frame or of an effect
    size: float  # [mm] or the number's unit
    sigma: float
    before: Internal[float]  # the number in the settings; 0 for a chain or the sheet
    chi_square: Internal[float]  # that it leaves
    explains: bool  # whether what it leaves is within the interval


@dataclass(frozen=True)
class RecheckedMark:
    """A mark against what the fit promised [mm]."""

    name: str
    hole: Point
    target: Point  # where it was sent
    error: Point  # of the hole, against the promise
    expected_mm: float  # an unchanged machine rarely errs by more

    @property
    def off(self) -> float:
        """The length of the error."""
        return float(np.hypot(*self.error))


@dataclass(frozen=True)
class Recheck:
    """Marks against what the fit promised."""

    fit: Internal[Entry]
    marks: tuple[RecheckedMark, ...]  # in the order in which they were read
    chi_square: float
    limit: float  # of chi-square
    # [rad] of the sheet, counter-clockwise: as it was fitted, or 0 if it hangs straight
    turn: Annotated[float, key("sheet_turned_rad")]
    changes: tuple[LikelyChange, ...]  # the best first
    unit: Internal[Unit] = MM  # of the lengths in what is said of it

    at = part("fit.at", Moment, "Of the diary.", name="fit")

    @in_json
    def holds(self) -> bool:
        """Whether the marks lie within the interval of the fit."""
        return self.chi_square <= self.limit

    @in_json
    def state(self) -> Sameness:
        """What the marks say."""
        if self.holds:
            return "as_fitted"
        best = self.changes[0]
        if not best.explains:
            return "beyond_these_marks"
        return "sheet_moved" if best.name in (SHEET_X, SHEET_Y) else "changed"


def recheck(
    fit: Entry,
    settings: MachineSettings,
    measured: Sequence[MeasuredMark],
    *,
    cut_with: MachineSettings | None = None,
    sigma: float | None = None,
    unit: Unit = MM,
) -> Recheck:
    """Hold marks against the fit that gave these settings. sigma [mm] of a coordinate.

    The sheet hangs as it was fitted, or somebody has hung it straight since, as the lab advises:
    whichever fits the marks better counts.
    """
    targets = np.array([mark.target for mark in measured], dtype=float)
    try:
        chains = believed_lengths(cut_with or settings, targets)
    except ValueError as error:
        raise InputError(str(error)) from None
    fitted = settings.fitted.last_sheet_rotation if settings.fitted else 0.0
    turned = [_recheck(fit, settings, measured, chains, turn, sigma) for turn in (fitted, 0.0)]
    return replace(ranked(turned, lambda checked: checked.chi_square)[0], unit=unit)


def _recheck(
    fit: Entry,
    settings: MachineSettings,
    measured: Sequence[MeasuredMark],
    chains: Array,
    turn: float,
    sigma: float | None,
) -> Recheck:
    """Hold marks on a sheet that is turned [rad] against a fit."""
    # From the edges of the turned sheet, as the machine has them.
    cosine, sine = np.cos(turn), np.sin(turn)
    holes = np.array([mark.hole for mark in measured]) @ np.array([[cosine, -sine], [sine, cosine]])
    where, slopes = _places(settings, chains)
    errors = holes - where
    noise = sigma or max(READ_SIGMA, fit.content.get("sigma_mm", 0.0))
    covariance = noise**2 * np.eye(errors.size) + _known(fit, where, slopes)
    left = errors.ravel()
    limit = float(scipy.special.chdtri(errors.size, 1 - LEVEL))
    spread = covariance.reshape(len(measured), 2, len(measured), 2)
    widest = [np.linalg.eigvalsh(spread[i, :, i])[-1] for i in range(len(measured))]
    expected = np.sqrt(scipy.special.chdtri(2, 1 - LEVEL) * np.array(widest))
    each = zip(measured, errors.tolist(), expected.tolist(), strict=True)
    return Recheck(
        fit=fit,
        marks=tuple(
            RecheckedMark(mark.name, mark.hole, mark.target, (x, y), most)
            for mark, (x, y), most in each
        ),
        chi_square=float(left @ np.linalg.solve(covariance, left)),
        limit=limit,
        turn=turn,
        changes=_changes(settings, fit, chains, left, covariance),
    )


def fit_of(diary: Diary, settings: MachineSettings) -> Entry | None:
    """Return the newest fit of the diary that gave these settings; None if it knows no such fit."""
    for entry in reversed(diary.of_kind(FIT)):
        machine = machine_in(tomllib.loads(entry.content["settings"]), diary.path)
        if replace(machine, fitted=None) == replace(settings, fitted=None):
            return entry
    return None


def _places(settings: MachineSettings, chains: Array) -> tuple[Array, Array]:
    """Return places (n, 2) [mm] and their slopes by every value (n, 2, len(NAMES))."""
    model = settings.as_plumb_model()
    over_top = model.feed == "top"
    where, slopes, outcome = places_with_slopes(values_of(model), over_top=over_top, chains=chains)
    assert (outcome == FOUND).all()
    return where, slopes


def _known(fit: Entry, where: Array, slopes: Array) -> Array:
    """Covariance (2n, 2n) [mm^2] of predicted places by that of the fitted numbers."""
    names = fit.content["unknowns"]
    columns = np.stack([_slope_of(name, where, slopes) for name in names], axis=1)
    whole: Array = columns @ np.array(fit.content["covariance"], dtype=float) @ columns.T
    return whole


def _slope_of(name: str, where: Array, slopes: Array) -> Array:
    """Return how predicted coordinates (2n,) follow a number; zero for what belongs to another
    board.
    """
    if name in NAMES:
        column: Array = slopes[:, :, NAMES.index(name)].ravel()
        return column
    if name == SHEET_ROTATION:
        return np.stack([-where[:, 1], where[:, 0]], axis=1).ravel()
    return np.zeros(where.size)


def _changes(
    settings: MachineSettings, fit: Entry, chains: Array, errors: Array, covariance: Array
) -> tuple[LikelyChange, ...]:
    """Return each single change, sized to explain the errors best, the best first.

    Of changes that explain them alike, first what moves most easily: a chain, the sheet, the frame.
    """
    where, slopes = _places(settings, chains)
    columns = {}
    for side, name in enumerate((LEFT, RIGHT)):
        longer = chains + STEP * np.eye(2)[side]
        columns[name] = (_places(settings, longer)[0] - where).ravel() / STEP
    for axis, name in enumerate((SHEET_X, SHEET_Y)):
        columns[name] = np.tile(np.eye(2)[axis], len(chains))
    for name in (*FRAME, *fit.content["unknowns"]):
        if name in NAMES:
            columns[name] = _slope_of(name, where, slopes)
    limit = scipy.special.chdtri(errors.size - 1, 1 - LEVEL)
    before = dict(zip(NAMES, values_of(settings.as_plumb_model()), strict=True))
    changes = []
    for name, column in columns.items():
        weighted = np.linalg.solve(covariance, column)
        size, sigma = weighted @ errors / (weighted @ column), (weighted @ column) ** -0.5
        left = errors - size * column
        rest = float(left @ np.linalg.solve(covariance, left))
        sizes = float(size), float(sigma), float(before.get(name, 0.0))
        changes.append(LikelyChange(name, *sizes, rest, explains=bool(rest <= limit)))
    return tuple(ranked(changes, lambda change: change.chi_square))
