"""Answers come in the same order however a processor rounds: a board of ties, rounded otherwise."""

import numpy as np
from plumb.cli.compare import conclusion
from plumb.diagnosis import diagnose
from plumb.fit.compare import compare
from plumb.fit.inputs import Inputs
from plumb.marks.read import Mark, Measurements
from plumb.plan import propose
from plumb.text.values import MM
from synthetic import BELIEVED, grid


def mirrored_board(seed):
    """Marks whose errors mirror each other, left and right: what is of one chain ties with what is
    of the other, and so do marks of both halves."""
    targets = grid(3, 3)
    x = targets[:, 0]
    read = targets * 1.0015 + np.stack([0.0 * x, 2.0 - 1e-7 * x**2], axis=1)
    read *= 1 + 1e-12 * np.random.default_rng(seed).standard_normal(read.shape)
    marks = zip(targets.tolist(), read.tolist(), strict=True)
    return Measurements(
        tuple(Mark(str(i), tuple(there), tuple(seen)) for i, (there, seen) in enumerate(marks))
    )


def answers(seed):
    """The ranked answers that a user gets."""
    measurements = mirrored_board(seed)
    inputs = Inputs(BELIEVED, measurements, sigma=0.5)
    diagnosis = diagnose(inputs)
    proposals = propose(diagnosis, inputs).proposals
    return {
        "ranking": [each.effect for each in diagnosis.ranking],
        "explanations": [each.effects for each in diagnosis.explanations],
        "proposals": [(each.option.title, each.option.do) for each in proposals],
        "worst mark": conclusion(compare(Inputs(BELIEVED, measurements)), MM),
    }


def test_rounding_changes_no_answer():
    usual, otherwise = answers(0), answers(1)
    for what, order in usual.items():
        assert otherwise[what] == order, what
    assert len(usual["proposals"]) > 3
