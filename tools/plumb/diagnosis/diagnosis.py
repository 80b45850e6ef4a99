"""The diagnosis, step by step: observe, clean the readings, detect, suspects, doubts, answer."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from plumb.diagnosis.answer import Diagnosis, Ranked, Together
from plumb.diagnosis.clean import CleanReadings, clean_readings
from plumb.diagnosis.doubts import find_doubts
from plumb.diagnosis.expected_error import left_open
from plumb.diagnosis.explanation import Explanation, measured_board
from plumb.diagnosis.gain import search
from plumb.diagnosis.judgement import Judgement, evidence, judge
from plumb.diagnosis.noise import Noise
from plumb.diagnosis.sizes import hidden_share, sizes_of
from plumb.fit.inputs import Inputs
from plumb.model.plain import ranked


@dataclass(frozen=True)
class Examined:
    """A diagnosis with the fits that it rests on."""

    diagnosis: Diagnosis
    readings: CleanReadings
    explanations: tuple[Explanation, ...]  # those of the diagnosis, in its order


def diagnose(inputs: Inputs) -> Diagnosis:
    """Find what the model of these settings misses in the marks, and in numbers checked directly.

    Raises InputError for too few marks, and marks that cannot be reached.
    """
    return examine(inputs).diagnosis


def examine(inputs: Inputs) -> Examined:
    """Return the same with its fits, for pictures of them."""
    board = measured_board(inputs)
    readings = clean_readings(board, inputs)
    detection = search(readings.frame, readings.felt, readings.noise)
    judgement = judge(readings, detection)
    ranking = rank(readings)
    rounds = [part.name for part in inputs.measurements.rounds]
    doubts = find_doubts(readings, detection, judgement, ranking, rounds)
    diagnosis = Diagnosis(
        verdict=judgement.verdict,
        noise=readings.noise,
        threshold=detection.threshold,
        rms_before=readings.frame.rms,
        explanations=_explanations(judgement, readings.noise),
        differences=_differences(judgement.explanations),
        ranking=ranking,
        library_fits=judgement.suspects.library_fits,
        chance=judgement.suspects.chance,
        to_add=judgement.to_add,
        outliers=readings.outliers,
        could_hide=doubts.could_hide,
        left_open=left_open(readings.frame),
        warnings=doubts.warnings,
        disagreements=doubts.disagreements,
    )
    return Examined(diagnosis, readings, judgement.explanations)


def _explanations(judgement: Judgement, noise: Noise) -> tuple[Together, ...]:
    explanations = judgement.explanations
    shares = judgement.shares or (None,) * len(explanations)
    return tuple(
        _together(explanation, noise, share)
        for explanation, share in zip(explanations, shares, strict=True)
    )


def _together(explanation: Explanation, noise: Noise, share: float | None) -> Together:
    return Together(
        effects=explanation.effects,
        sizes={name: sizes_of(explanation, name, noise) for name in explanation.effects},
        rms_after=explanation.rms,
        share=share,
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


# Every effect of the library by itself, what explains most first.


def rank(readings: CleanReadings) -> tuple[Ranked, ...]:
    """Return all effects, by how surprising it would be if noise alone gained as much."""
    frame, noise = readings.frame, readings.noise
    effects = [
        Ranked(
            effect=name,
            gain=max(frame.cost - single.cost, 0.0),
            negative_log_p=evidence(single, frame, noise),
            sizes=sizes_of(single, name, noise),
            rms_after=single.rms,
            hidden_share=hidden_share(frame, name),
        )
        for name, single in readings.singles.items()
    ]
    return tuple(ranked(effects, lambda effect: -effect.negative_log_p))
