"""The diagnosis: observe, weigh all accounts, set outliers aside, and read the answers off."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from plumb.diagnosis.answer import Diagnosis, Ranked, Together
from plumb.diagnosis.clean import CleanReadings, clean_readings
from plumb.diagnosis.doubts import doubts_of
from plumb.diagnosis.expected_error import left_open
from plumb.diagnosis.explanation import Explanation, measured_board
from plumb.diagnosis.noise import Noise, left_by_noise
from plumb.diagnosis.posterior import Listed, explain_account
from plumb.diagnosis.sizes import hidden_share, room_for, sizes_of
from plumb.diagnosis.verdict import judge
from plumb.fit.inputs import Inputs
from plumb.model.catalogue import effect_names
from plumb.model.plain import ranked


def diagnose(inputs: Inputs) -> Diagnosis:
    """Find what the model of these settings misses in the marks, and in numbers checked directly.

    Raises InputError for too few marks, and marks that cannot be reached.
    """
    readings = clean_readings(measured_board(inputs), inputs)
    judgement = judge(readings, inputs.stated)
    frame, noise = readings.frame, readings.noise
    explanations = tuple(
        explain_account(frame, each.account.effects, each.account.acting)
        for each in judgement.listed
    )
    best = (
        explanations[0]
        if explanations
        else explain_account(frame, judgement.best.effects, judgement.best.acting)
    )
    doubts = doubts_of(readings, judgement.verdict, best, inputs.measurements.rounds)
    return Diagnosis(
        verdict=judgement.verdict,
        readings=readings,
        fits=explanations,
        best=best,
        rms_before=frame.rms,
        noise_rms=left_by_noise(frame, noise),
        explanations=tuple(
            _together(each, explanation, noise)
            for each, explanation in zip(judgement.listed, explanations, strict=True)
        ),
        differences=_differences(explanations),
        ranking=_ranking(readings),
        nothing_chance=readings.posterior.nothing_chance,
        field_chance=readings.posterior.field_chance,
        to_add=() if readings.outliers else best.effects,
        usual=best.board.usual_checks,
        outliers=readings.outliers,
        could_hide=tuple(room_for(name, explanations or (best,), noise) for name in effect_names()),
        left_open=left_open(frame),
        warnings=doubts.warnings,
        disagreements=doubts.disagreements,
    )


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
        (j, i): _rms_between(explanations[i], explanations[j])
        for i in range(len(explanations))
        for j in range(i)
    }


def _rms_between(explanation: Explanation, other: Explanation) -> float:
    """Over the marks as vectors, or over distances where no mark was measured [mm]."""
    rows = explanation.board.rows
    apart = explanation.numbers - other.numbers
    counted = apart[: rows.measured.size] if len(rows.measured) else apart
    return float(np.sqrt(counted @ counted / (len(rows.measured) or len(counted))))


def _ranking(readings: CleanReadings) -> tuple[Ranked, ...]:
    """Return every effect of the library by itself, the likeliest first; sizes by the slopes at the
    frame's fit.
    """
    frame, noise = readings.frame, readings.noise
    chances = readings.posterior.effect_chances
    effects = []
    for name in effect_names():
        single = frame.with_effects((name,))
        effects.append(
            Ranked(
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
