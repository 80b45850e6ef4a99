"""The diagnosis: observe, weigh all accounts, set outliers aside, and read the answers off."""

from collections.abc import Iterable, Mapping, Sequence

import numpy as np
import scipy

from plumb.diagnosis.answer import Diagnosis, Fall, RankedEffect, Together, judge
from plumb.diagnosis.expected_error import left_open
from plumb.diagnosis.explanation import Explanation, explain, measured_board
from plumb.diagnosis.noise import Noise, left_by_noise
from plumb.diagnosis.posterior import Listed
from plumb.diagnosis.priors import LIKELIER
from plumb.diagnosis.readings import CleanReadings, clean_readings, shifts
from plumb.diagnosis.sizes import hidden_share, room_for, sizes_of
from plumb.fit.inputs import Inputs
from plumb.model.catalogue import effect_names
from plumb.model.plain import ranked
from plumb.model.predict import NAMES

# A test whether the marks can fault the settings, or noise alone could explain the errors.


FEIGNED = 0.005  # chance below which noise is no longer believed to do it


def is_good(frame: Explanation, fits: Iterable[Explanation] = ()) -> bool:
    """Return whether noise alone may lower chi-square as much as the fitted frame does, and each
    of some fits, against the settings as they are. Where the sheet lies is no setting.

    If the settings are right, a fit of k numbers lowers chi-square by that of k degrees of freedom
    at most: what is known of them before the marks only makes it less.
    """
    problem = frame.board.problem
    at = problem.at(np.zeros(len(frame.unknowns)))
    if at is None:
        return False
    pose = [i for i in frame.board.frame if problem.names[i] not in NAMES]
    count = frame.board.rows.count
    left, slopes = at.residual[:count], at.slopes[:count, pose]
    left = left - slopes @ np.linalg.lstsq(slopes, left, rcond=1e-10)[0]
    as_set = float(left @ left)
    return all(
        scipy.special.chdtrc(len(fit.free) - len(pose), max(as_set - _left(fit), 0.0)) > FEIGNED
        for fit in (frame, *fits)
    )


def _left(fit: Explanation) -> float:
    return float(np.sum(fit.residual[: fit.board.rows.count] ** 2))


# From readings to a verdict.


def diagnose(inputs: Inputs) -> Diagnosis:
    """Find what the model of these settings misses in the marks, and in numbers checked directly.

    Raises InputError for too few marks, and marks that cannot be reached.
    """
    readings = clean_readings(measured_board(inputs), inputs)
    judgement = judge(readings, inputs.stated)
    best = readings.explained(judgement.best)
    frame, noise = readings.frame, readings.noise
    # Where a field acts, all chances are on that condition; else that nothing else is wrong.
    is_unknown = judgement.verdict == "not_in_library"
    explanations = tuple(readings.explained(each.account) for each in judgement.listed)
    doubts = doubts_of(readings, judgement.verdict, best)
    names = [part.name for part in inputs.measurements.rounds]
    open_now = left_open(frame)
    is_nothing = judgement.verdict == "nothing_provable"
    good = is_nothing and is_good(frame, [best])
    return Diagnosis(
        verdict=judgement.verdict,
        readings=readings,
        fits=explanations,
        best=best,
        likely=judgement.best.effects,
        rms_before=frame.rms,
        noise_rms=left_by_noise(frame, noise),
        explanations=tuple(
            _together(each, explanation, noise)
            for each, explanation in zip(judgement.listed, explanations, strict=True)
        ),
        differences=_differences(explanations),
        ranking=_ranking(readings, judgement.posterior.effect_chances(with_field=is_unknown)),
        nothing_chance=judgement.posterior.nothing_chance(with_field=is_unknown),
        field_chance=readings.posterior.field_chance,
        to_add=() if readings.outliers else best.effects,
        usual=best.board.usual_checks,
        outliers=readings.outliers,
        could_hide=tuple(room_for(name, explanations or (best,), noise) for name in effect_names()),
        left_open=open_now,
        is_good=good,
        is_cured=good and inputs.settings.fitted is not None,
        falls=_falls(frame, best, judgement.best.effects),
        warnings=tuple(filter(None, [open_now.sentence, *doubts])),
        disagreements=tuple(_round_warnings(readings, names)),
    )


def _falls(frame: Explanation, best: Explanation, effects: Sequence[str]) -> tuple[Fall, ...]:
    """Return how the error falls, that effect first which takes most."""
    falls: list[Fall] = []
    so_far: tuple[str, ...] = ()
    while len(so_far) + 1 < len(effects):
        several = [(*so_far, name) for name in effects if name not in so_far]
        fits = [explain(best.board, each, start=frame) for each in several]
        fitted = ranked(fits, lambda each: each.rms)[0]
        so_far = fitted.effects
        falls.append(Fall(so_far[-1], fitted.rms))
    last = [name for name in effects if name not in so_far]
    return (*falls, *(Fall(name, best.rms) for name in last))


def _together(listed: Listed, explanation: Explanation, noise: Noise) -> Together:
    effects = listed.account.effects
    return Together(
        effects=effects,
        sizes={name: sizes_of(explanation, name, noise) for name in effects},
        rms_after=explanation.rms,
        noise_rms=left_by_noise(explanation, noise),
        share=listed.share,
    )


def _differences(explanations: Sequence[Explanation]) -> dict[tuple[int, int], float]:
    """RMS between what two explanations leave of the readings [mm]."""
    return {
        (j, i): explanations[i].board.rows.rms_of(explanations[i].numbers - explanations[j].numbers)
        for i in range(len(explanations))
        for j in range(i)
    }


def _ranking(readings: CleanReadings, chances: Mapping[str, float]) -> tuple[RankedEffect, ...]:
    """Return every effect of the library by itself, the likeliest first; sizes by the slopes at the
    frame's fit.
    """
    frame, noise = readings.frame, readings.noise
    effects = []
    for name in effect_names():
        single = frame.with_effects((name,))
        effects.append(
            RankedEffect(
                effect=name,
                gain=max(frame.cost - single.cost, 0.0),
                chance=chances.get(name, 0.0),
                sizes=sizes_of(single, name, noise),
                rms_after=single.rms,
                hidden_share=hidden_share(frame, name),
            )
        )
    by_gain = ranked(effects, lambda effect: -effect.gain)
    return tuple(ranked(by_gain, lambda effect: -effect.chance))


# What does not go together, in sentences.


def doubts_of(readings: CleanReadings, verdict: str, best: Explanation) -> tuple[str, ...]:
    """Return all doubts about a verdict."""
    return (
        *readings.noise.notes,
        *(_place_warnings(readings, best) if verdict == "not_in_library" else []),
        *_unsettled_warnings((readings.frame, best)),
        *_sign_warnings(readings),
    )


def _place_warnings(readings: CleanReadings, nearest: Explanation) -> list[str]:
    """Return where to look first if nothing in the library explains the marks."""
    board = nearest.board
    of_marks = [shift for shift in shifts(nearest) if shift.reading.is_mark]
    if not of_marks:
        return []
    worst = ranked(of_marks, lambda shift: -shift.drop)[0]
    name = board.rows.names[worst.reading.index]
    far = board.unit.worded(float(np.hypot(*worst.offset)), 1)
    if board.rows.names.count(name) > 1:
        return [f"mark {name} stays {far} off when it is read again: it is the machine there"]
    if spot := readings.posterior.with_fields.spot:
        x, y = (board.unit.worded(float(along), 0) for along in spot.middle)
        return [
            f"what no effect draws acts about x {x}, y {y}: look there for a sheet that gives or "
            "lies uneven, and for a cable or hose that pulls"
        ]
    return [
        f"the marks are farthest off at {name}, by {far}: read it again; if it stays, it is the "
        "machine there"
    ]


def _unsettled_warnings(explanations: Sequence[Explanation]) -> list[str]:
    unsettled = [fitted for fitted in explanations if not fitted.settled]
    names = ", ".join(" + ".join(fitted.effects) or "frame" for fitted in unsettled)
    return [f"the fit did not come to rest: {names}"] if unsettled else []


def _sign_warnings(readings: CleanReadings) -> list[str]:
    """Return whether the other sign of y would explain the marks better than anything does."""
    if readings.posterior.turned_chance < LIKELIER:
        return []
    return [
        "with all y errors the other way round these marks would be explained better: check that "
        "measured and target count y in the same direction"
    ]


_WAYS_OUT = {
    "new_sheet": "new_sheet = true in {name} would explain it; if it is not so, use one at a time",
    "chains_rezeroed": "chains_rezeroed = true in {name} would explain it; if it is not so, use "
    "one at a time",
    "": "use one file at a time and compare what they say",
}


def _round_warnings(readings: CleanReadings, names: Sequence[str]) -> list[str]:
    """Return a sentence for each round that likely does not go with the others."""
    posterior = readings.posterior
    causes: dict[int, tuple[float, str]] = {}
    for move, chance in posterior.moved_chances.items():
        causes[move.number] = max(causes.get(move.number, (0.0, "")), (chance, move.cause))
    return [
        f"{names[number]} does not go with the other rounds: do not pool them; "
        + _WAYS_OUT[causes[number][1]].format(name=names[number])
        for number in posterior.apart
    ]
