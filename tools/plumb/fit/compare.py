"""Settings against marks: how far the marks lie from where the settings predict them."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated, Literal

import numpy as np

from plumb.fit.fit import USUAL_SIGMA, Fit
from plumb.fit.inputs import Inputs, known_outside
from plumb.fit.observations import Observations, Sighting, chains_to, rms, sighted, strands_at
from plumb.marks.read import Measurements
from plumb.model.catalogue import empirical_effects, parameter_names
from plumb.model.plain import ranked
from plumb.model.predict import FOUND, FOUND_WORDS, Array, values_of
from plumb.settings.machine import FitRecord, MachineSettings
from plumb.text.answers import Internal, in_json, key
from plumb.text.errors import InputError, to_do

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
        values_of(model),
        rows,
        places,
        over_top=model.feed == "top",
        usual_weight=model.sled_weight,
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
