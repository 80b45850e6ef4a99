"""Settings against marks: how far the marks lie from where the settings predict them."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from math import inf
from typing import Annotated, Any, Literal

import numpy as np

from plumb.fit.fit import PRIORS, USUAL_SIGMA, Checked, Fit
from plumb.fit.inputs import Inputs, known_outside
from plumb.fit.observations import (
    SHEET_ROTATION,
    Observations,
    Sighting,
    chains_to,
    rms,
    sighted,
    strands_at,
)
from plumb.marks.read import Measurements
from plumb.model.catalogue import empirical_effects, parameter_names, parameter_words
from plumb.model.plain import plain_range, ranked
from plumb.model.predict import (
    FOUND,
    FOUND_WORDS,
    NAMES,
    Array,
    believed_lengths,
    frame_words,
    places_with_slopes,
    values_of,
)
from plumb.settings import FRAME_FIELDS, FitRecord, MachineSettings
from plumb.text.answers import Internal, in_json, key
from plumb.text.errors import InputError, to_do
from plumb.text.values import Unit

Point = tuple[float, float]
Nearness = Literal["near_noise", "off"]
NOISY = 1.5  # times the error of a reading, up to which an RMS may be reading alone


@dataclass(frozen=True)
class ComparedMark:
    """A measured mark and its prediction [mm]."""

    name: str
    target: Point
    predicted: Point
    measured: Point
    error: Point  # measured - predicted
    left_chain_residual: float | None  # chain to the measured place - chain to the predicted place
    right_chain_residual: float | None  # None: no chain reaches the measured place

    @property
    def length(self) -> float:
        """Length of the error [mm]."""
        return float(np.hypot(*self.error))


@dataclass(frozen=True)
class ComparedDistance:
    """A measured distance and its prediction [mm]."""

    between: tuple[str, str]
    predicted: float
    measured: float
    error: float  # measured - predicted


@dataclass(frozen=True)
class ComparedRound:
    """A file of several: its errors [mm]; None where it has no such readings."""

    name: str
    date: str
    count: int  # of marks, or of distances if it has no marks
    rms: Annotated[float | None, key("rms_mm")]
    distance_rms: Annotated[float | None, key("distance_rms_mm")]


@dataclass(frozen=True)
class Comparison:
    """Settings compared with marks."""

    state: Nearness  # whether reading alone may have made the RMS
    marks: tuple[ComparedMark, ...]
    distances: tuple[ComparedDistance, ...]
    # [mm] of the marks as vectors, or of the distances if there are no marks
    rms: Annotated[float, key("rms_mm")]
    worst: Annotated[float, key("worst_mm")]  # [mm] the same choice
    distance_rms: Annotated[float | None, key("distance_rms_mm")]  # [mm]
    # [mm] of the marks after the best shift and rotation
    shape_rms: Annotated[float | None, key("shape_rms_mm")]
    shift: Point | None  # [mm] that best shift
    rotation: float | None  # [rad] and rotation, counter-clockwise
    # of the fit that gave the settings, if these are its marks
    promised: Internal[FitRecord | None] = None
    warnings: tuple[str, ...] = ()
    rounds: tuple[ComparedRound, ...] = ()  # if there are several files

    @in_json
    def promised_rms_mm(self) -> float | None:
        """Error of these marks by that fit [mm]."""
        return self.promised.rms if self.promised else None


def compare(inputs: Inputs) -> Comparison:
    """Return how far the marks lie from where our model of the settings predicts them.

    Raises InputError for a mark that these settings cannot reach.
    """
    settings, measurements = inputs.settings, inputs.measurements
    model, rows = inputs.model_and_observations()
    outside = known_outside(settings, measurements, cut_with=inputs.cut_with)
    seen = predicted_sighting(model, rows, measurements, outside)
    where = seen.read.where
    marks = _marks(model, rows, seen, predicted_sighting(model, rows, measurements, {}))
    both = zip(measurements.distances, seen.taped_spans(rows.distance_rows).tolist(), strict=True)
    distances = tuple(
        ComparedDistance(each.between, span, each.length, each.length - span) for each, span in both
    )
    errors = np.array([mark.error for mark in marks]).reshape(-1, 2)
    spans = np.array([distance.error for distance in distances])
    pose = best_pose(where[rows.mark_rows], rows.measured)
    counted = np.hypot(errors[:, 0], errors[:, 1]) if marks else np.abs(spans)
    whole = rms(errors if marks else spans)
    sigma = inputs.stated.sigma if inputs.stated else USUAL_SIGMA
    read = sigma * np.sqrt(2.0) if marks else sigma
    # The record of the fit, if all its boards are here, cut as it took them.
    record = settings.fitted
    is_whole = record and record.is_of(each.digest for each in measurements.rounds)
    return Comparison(
        state="near_noise" if whole <= NOISY * read else "off",
        marks=marks,
        distances=distances,
        rms=whole,
        worst=float(counted.max()),
        distance_rms=rms(spans) if distances else None,
        shape_rms=rms(pose.errors) if pose else None,
        shift=pose.shift if pose else None,
        rotation=pose.rotation if pose else None,
        promised=record if is_whole and outside else None,
        warnings=_warnings(inputs),
        rounds=_rounds(measurements, errors, spans),
    )


def _rounds(
    measurements: Measurements, errors: np.ndarray, spans: np.ndarray
) -> tuple[ComparedRound, ...]:
    """Return each file by itself, if there are several."""
    if len(measurements.rounds) < 2:
        return ()
    marks = np.array([mark.round for mark in measurements.measured_marks], dtype=int)
    distances = np.array([distance.round for distance in measurements.distances], dtype=int)
    compared = []
    for number, file_round in enumerate(measurements.rounds):
        of_marks, of_spans = errors[marks == number], spans[distances == number]
        compared.append(
            ComparedRound(
                name=file_round.name,
                date=file_round.date,
                count=len(of_marks) or len(of_spans),
                rms=rms(of_marks) if len(of_marks) else None,
                distance_rms=rms(of_spans) if len(of_spans) else None,
            )
        )
    return tuple(compared)


def predicted_sighting(
    model: MachineSettings,
    rows: Observations,
    measurements: Measurements,
    outside: Mapping[str, float],
) -> Sighting:
    """Return what our model says is measured on every visit; InputError where the sled
    cannot hang.
    """
    sighting = _seen_by(model, rows, outside)
    for i in np.flatnonzero(sighting.outcome != FOUND)[:1]:
        raise InputError(
            f"{measurements.source}, mark {measurements.marks[i].name}: with these settings its "
            f"chains lead nowhere ({FOUND_WORDS[sighting.outcome[i]]}); check the settings, or "
            + to_do(
                "give those it was cut with by --cut-with",
                page="name those it was cut with in its form, as cut_with",
            )
        )
    return sighting


def _marks(
    model: MachineSettings, rows: Observations, seen: Sighting, hung: Sighting
) -> tuple[ComparedMark, ...]:
    """Return each mark as it is seen; `hung` is where the sled was, whatever the sheet did."""
    where, measured = seen.read.where[rows.mark_rows], rows.measured
    hangs, weights = hung.read.where[rows.mark_rows], rows.sled_weights[rows.mark_rows]
    chains = chain_errors(model, hangs, measured - where, weights)
    each = np.stack([rows.targets, where, measured, measured - where], axis=1).tolist()
    more = ([None if np.isnan(end) else float(end) for end in ends] for ends in chains)
    marks = []
    for name, places, (left, right) in zip(rows.names, each, more, strict=True):
        target, predicted, at, error = ((x, y) for x, y in places)
        marks.append(ComparedMark(name, target, predicted, at, error, left, right))
    return tuple(marks)


def _warnings(inputs: Inputs) -> tuple[str, ...]:
    measurements = inputs.measurements
    whose = inputs.controller or measurements.controller
    known = inputs.cut_with or all(file_round.cut_with for file_round in measurements.rounds)
    if known or inputs.settings.controller != "plumb" or whose in (None, "plumb"):
        return ()
    return (
        f"the marks were cut by the {whose} controller, but these settings are of plumb: "
        + to_do(
            "give the groundcontrol.ini that was in force with --cut-with",
            page="name the groundcontrol.ini that was in force in their form, as cut_with",
        ),
    )


# Errors on the sheet seen by the chains: how much more of each chain the measured place needs.


def hung_places(model: MachineSettings, rows: Observations) -> Array:
    """Return where the sled hangs on each visit (r, 2) [mm], whatever the sheet and the tape do."""
    return _seen_by(model, rows, {}).read.where


def _seen_by(model: MachineSettings, rows: Observations, outside: Mapping[str, float]) -> Sighting:
    """Return what is measured on every visit, with what lies outside of the machine."""
    top, weight = model.feed == "top", model.sled_weight
    return sighted(values_of(model), outside, rows, over_top=top, usual_weight=weight, names=())


def chain_errors(model: MachineSettings, places: Array, errors: Array, weights: Array) -> Array:
    """Return how much more of each chain (n, 2) [mm] a sled needs at places + errors than at the
    places.

    nan where no chain reaches.
    """
    there, reached = chains_to(model, places + errors, weights)
    here, hanging = chains_to(model, places, weights)
    good = (reached == FOUND) & (hanging == FOUND)
    more: Array = np.where(good[:, np.newaxis], there - here, np.nan)
    return more


# The shape of errors: what no shift and no turn of the sheet takes away.


@dataclass(frozen=True)
class Pose:
    """The shift and rotation of all measured marks against the predicted marks."""

    shift: tuple[float, float]  # [mm] of the middle of all marks
    rotation: float  # [rad] counter-clockwise
    errors: Array  # (n, 2) [mm] what is left


def best_pose(predicted: Array, measured: Array) -> Pose | None:
    """Return the rigid motion that brings predicted (n, 2) closest to measured (n, 2) [mm].

    None for fewer than two different places: one place has no shape.
    """
    if len(predicted) < 2 or np.ptp(predicted, axis=0).max() == 0:
        return None
    middle, aim = predicted.mean(axis=0), measured.mean(axis=0)
    before, after = predicted - middle, measured - aim
    # tan(rotation) = sum of cross products / sum of dot products (Procrustes in the plane)
    cross = np.sum(before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0])
    rotation = float(np.arctan2(cross, np.sum(before * after)))
    cosine, sine = np.cos(rotation), np.sin(rotation)
    turned = before @ np.array([[cosine, sine], [-sine, cosine]])
    shift = aim - middle
    return Pose((float(shift[0]), float(shift[1])), rotation, after - turned)


# Covariates of a chain's error: its tension, length, angle, wrap, phase, place and way.
#
# Each covariate has a number for each visit and chain, by a model of the machine.


@dataclass(frozen=True)
class Covariate:
    """A quantity against which errors of the chains are drawn."""

    name: str
    unit: str
    values: Array  # (n, 2) of left and right chain; nan where it is not known


def covariates(model: MachineSettings, rows: Observations) -> tuple[Covariate, ...]:
    """Return all covariates of every visit of `rows` (r,), by our model of the machine.

    The phase counts as the effect sprocket_runout does: free length over the sprocket's radius.
    The wrap is the chain on the sprocket, from 12 o'clock to the tangent point. The order is that
    of the file. An approach is the direction of the last move.
    """
    places = hung_places(model, rows)
    strands = strands_at(
        values_of(model), rows, places, over_top=model.feed == "top", usual_weight=model.sled_weight
    )
    turned = np.mod(strands.length / model.sprocket_radius, 2 * np.pi)
    angle = np.arctan2(strands.down, strands.across)
    past_noon = angle if model.feed == "top" else np.pi - angle
    # Left and right have the same of these; a direction is nan where it is not known.
    heading = np.arctan2(rows.approaches[:, 1], rows.approaches[:, 0])
    heading = np.where(rows.approaches.any(axis=1), heading, np.nan)
    order = np.arange(1.0, len(places) + 1)
    x, y, order, heading = (np.stack([each, each], 1) for each in (*places.T, order, heading))
    return (
        Covariate("tension", "N", strands.tension),
        Covariate("length", "mm", strands.span),
        Covariate("angle", "rad", angle),
        Covariate("wrap", "mm", model.sprocket_radius * past_noon),
        Covariate("phase", "rad", turned),
        Covariate("x", "mm", x),
        Covariate("y", "mm", y),
        Covariate("order", "", order),
        Covariate("approach", "rad", heading),
    )


# The residual patch: a smooth map of what no known effect explains, chosen knowingly, not physics.
#
# Its terms are held near zero by one common size, and that size is chosen by the error of marks
# left out: where the patch follows noise alone, none is as good as any.

PATCH = empirical_effects()[0]["name"]
SIZES = (0.2, 0.4, 0.8, 1.6, 3.2, 6.4)  # [mm] of one term, one standard deviation
WORTH = 0.9  # a patch must bring the left-out error below this share of what it was


@dataclass(frozen=True)
class Patched:
    """A fit with the patch."""

    fit: Fit
    size: float  # [mm] to which its terms were held


def best_patch(
    weighted: Callable[..., Fit],
    *,
    effects: Sequence[str],
    priors: Mapping[str, float],
    without: Fit,
) -> Patched | None:
    """Return the patch with the frame and these effects; None if it buys nothing.

    `weighted` is fit() with all but effects and priors; `without` is the fit without a patch.
    """
    tried = []
    for size in SIZES:
        held = {**priors, **dict.fromkeys(parameter_names(PATCH), size)}
        tried.append(Patched(weighted(effects=effects, priors=held), size))
    best = ranked(tried, lambda patched: patched.fit.left_out_rms)[0]
    return best if best.fit.left_out_rms < WORTH * without.left_out_rms else None


# The expected error of marks before anything is measured, by what is known of the machine.
#
# Each number of the frame is wrong by its stated error, and each effect that the settings leave out
# may be there in its typical size, all independent of each other.


# [mm, N] how far a number may be off that no fit moves, before the owner measured it.
WIDE = {"rotation_radius": 5.0, "sled_weight": 15.0}
COLUMNS, ROWS, MARGIN = 7, 5, 100.0  # of the places that are looked at; [mm] from the edge


@dataclass(frozen=True)
class Expected:
    """Usual error, RMS over the sheet [mm]."""

    frame: Internal[float]  # by the frame's numbers and where the sheet lies
    shape: Internal[float]  # by the same, the sheet laid at its best
    effects: Internal[float]  # by effects that the settings leave out, the sheet laid at its best

    @in_json
    def whole_mm(self) -> float:
        """All of it, as a tape from the sheet's edges reads it."""
        return float(np.hypot(self.frame, self.effects))

    @in_json
    def among_marks_mm(self) -> float:
        """All of it, the sheet laid at its best."""
        return float(np.hypot(self.shape, self.effects))


def expected_priors(known: Mapping[str, float]) -> dict[str, float]:
    """Return how far each number of the frame may be off, with those that the owner knows
    better.
    """
    frame = {name: sigma for name, sigma in known.items() if "." not in name}
    return {**PRIORS, **WIDE, **frame}


def expected_sentence(expected: Expected | None, unit: Unit) -> str:
    """Return what is normal, for people; empty if no mark can be made."""
    if expected is None:
        return ""
    return (
        "Before anything is corrected, marks may well be off by "
        f"{unit.worded(expected.among_marks_mm, 1)} among each other, and all together by "
        f"{unit.worded(expected.whole_mm, 0)} where the sheet hangs otherwise. That is normal."
    )


def expected_error(
    settings: MachineSettings, priors: Mapping[str, float], *, at: Array | None = None
) -> Expected:
    """Return how far marks will be off, all over the sheet or at places (n, 2) [mm].

    Raises ValueError where the controller cannot go.
    """
    model = settings.as_plumb_model()
    targets = places_over(settings.sheet) if at is None else at
    where, slopes, outcome = places_with_slopes(
        values_of(model), over_top=model.feed == "top", chains=believed_lengths(settings, targets)
    )
    good = outcome == FOUND
    where, slopes = where[good], slopes[good]
    of_frame = [
        slopes[:, :, NAMES.index(name)] * priors[name]
        for name in FRAME_FIELDS
        if priors.get(name) and name in NAMES
    ]
    turned = np.column_stack([-where[:, 1], where[:, 0]]) * priors.get(SHEET_ROTATION, 0.0)
    of_effects = [
        slopes[:, :, NAMES.index(name)] * abs(float(words["typical"]))
        for name, words in parameter_words().items()
        if name in NAMES and not settings.effect(*name.split("."))
    ]
    return Expected(
        frame=_together([*of_frame, turned]),
        shape=_together([_shape(where, moved) for moved in of_frame]),
        effects=_together([_shape(where, moved) for moved in of_effects]),
    )


def expected_anywhere(settings: MachineSettings, priors: Mapping[str, float]) -> Expected | None:
    """Return how far marks will be off all over the sheet; None where no sled hangs there."""
    try:
        expected = expected_error(settings, priors)
    except ValueError:
        return None
    return expected if np.isfinite(expected.whole_mm) else None


def places_over(sheet: tuple[float, float]) -> Array:
    """Return places (n, 2) [mm] all over a sheet."""
    width, height = sheet
    x = np.linspace(-width / 2 + MARGIN, width / 2 - MARGIN, COLUMNS)
    y = np.linspace(height / 2 - MARGIN, -height / 2 + MARGIN, ROWS)
    places: Array = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    return places


def _shape(where: Array, moved: Array) -> Array:
    """Return what is left of a motion (n, 2) when the sheet is shifted and turned back."""
    pose = best_pose(where, where + moved)
    return pose.errors if pose else np.zeros_like(moved)


def _together(several: list[Array]) -> float:
    """RMS of independent motions (n, 2), added up."""
    return float(np.sqrt(sum(rms(moved) ** 2 for moved in several)))


# Which sizes a real machine can have: one rule for the fit, the diagnosis and the proposals.
#
# The catalogue's range is what was met in workshops. A value in it is plausible. What was met is no
# wall, so an interval is refused only where all of it lies beyond MARGIN times the range: of 18
# made-up boards with a size 1.25 times the largest, the range itself refused the truth in 11.

OUTSIDE = 1.5
ROUNDING = 1e-3  # of the larger end: what is held at zero comes out about zero


@dataclass(frozen=True)
class PlausibleRange:
    """From the smallest to the largest value that was met; infinite where no limit is known."""

    low: float = -np.inf
    high: float = np.inf

    @property
    def limits(self) -> tuple[float | None, float | None]:
        """Both ends; None where no limit is known."""
        low, high = (end if np.isfinite(end) else None for end in (self.low, self.high))
        return low, high

    def holds(self, value: float) -> bool:
        """Return whether a value is plausible."""
        ends = [abs(end) for end in (self.low, self.high) if np.isfinite(end)]
        tiny = ROUNDING * max(ends, default=0.0)
        return bool(self.low - tiny <= value <= self.high + tiny)

    def is_near(self, low: float | Array, high: float | Array) -> Any:
        """Return whether an interval (or each of many) reaches what a real machine may have."""
        least = self.low * OUTSIDE if self.low < 0 else self.low / OUTSIDE
        most = self.high / OUTSIDE if self.high < 0 else self.high * OUTSIDE
        return (np.asarray(high) >= least) & (np.asarray(low) <= most)


@cache
def plausible_range(name: str) -> PlausibleRange:
    """Return the range of a parameter, or of a number of the frame, by its full name."""
    words = {frame["name"]: frame for frame in frame_words()} | parameter_words()
    if name not in words:
        return PlausibleRange()
    return PlausibleRange(words[name]["low"], words[name]["high"])


def range_said(name: str, unit: Unit) -> str:
    """Return the same in words; empty: no limit is known."""
    low, high = plausible_range(name).limits
    return "" if low is None or high is None else plain_range(name, low, high, unit)


# Numbers that no real machine has: a slip of the pen, or another unit, and no measurement.

FARTHEST = 3.0  # times the largest size that was met: a size beyond it is no measurement
SURE = 2.0  # [sigmas] by which a poor measurement may lie beyond
FRAME_SHARE, FRAME_SIGMAS = 0.1, 10.0  # a number of the frame may lie this far from the settings
SMALLEST = 1 / 3  # of a length or a weight of the settings


def refuse_absurd(checks: Sequence[Checked], settings: MachineSettings) -> None:
    """Raise InputError for a number that cannot have been measured on such a machine."""
    for check in checks:
        if is_absurd(check, settings):
            said = f" {check.name}={check.value:g}: {_why(check, settings)}"
            raise InputError(to_do("--checked", page="known") + said)


def is_absurd(check: Checked, settings: MachineSettings) -> bool:
    """Return whether a number cannot have been measured on such a machine."""
    low, high = _possible(check.name, settings)
    surely = SURE * check.sigma
    return not low <= check.value + surely or not check.value - surely <= high


def _possible(name: str, settings: MachineSettings) -> tuple[float, float]:
    """From the smallest to the largest value that a measurement may have."""
    met = plausible_range(name)
    if name in parameter_words():
        # An effect's size against what was met in workshops.
        largest = FARTHEST * max(abs(met.low), abs(met.high))
        return -largest, largest
    if name not in FRAME_FIELDS:
        return -inf, inf
    stated = dict(settings.frame)[name]
    allowed = max(FRAME_SHARE * abs(stated), FRAME_SIGMAS * {**PRIORS, **WIDE}.get(name, 0.0))
    smallest = SMALLEST * stated if met.low >= 0 else -inf
    return max(stated - allowed, smallest), stated + allowed


def _why(check: Checked, settings: MachineSettings) -> str:
    if check.name in FRAME_FIELDS:
        return (
            f"that is far from the {dict(settings.frame)[check.name]:g} of the settings; check the "
            "number, its unit (mm, N), and that the settings are those of this machine"
        )
    unit, met = parameter_words()[check.name]["unit"], plausible_range(check.name)
    meant = "as a share of the whole: 0.1 mm per metre is 0.0001" if unit == "1" else f"in {unit}"
    return f"real machines have {met.low:g} to {met.high:g}; write it {meant}"
