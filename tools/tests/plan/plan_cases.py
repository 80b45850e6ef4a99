"""Cases for the planner that need no diagnosis: a board, and what stands of it."""

from dataclasses import replace

from plumb.diagnosis.explanation import Board, explain
from plumb.diagnosis.posterior import posterior_of
from plumb.fit.inputs import Stated
from plumb.fit.observations import model_and_observations
from plumb.marks.read import Measurements
from plumb.plan.case import Case, Hypothesis, hidden_hypotheses
from synthetic import BELIEVED, EFFECTS, grid, marks_on

SIGMA = 0.5
# With sag and stretch: the chains give, so friction is felt.
MACHINE = replace(BELIEVED, effects=EFFECTS)


def nine(**how):
    """Nine marks that lie where the machine sends them but for noise, come to from below."""
    marks = marks_on(MACHINE, MACHINE, grid(3, 3), noise=SIGMA, **how)
    return Measurements(tuple(replace(mark, approach=(0.0, 1.0)) for mark in marks))


def case_on(measurements, *effects, verdict="cannot_tell", checked=(), machine=MACHINE):
    """The case of marks of which these effects are the suspects, as likely each."""
    model, rows = model_and_observations(machine, measurements)
    board = Board.of(model, rows, sigma=SIGMA, checked=checked)
    posterior = posterior_of(board, Stated(SIGMA, is_final=True))
    frame = posterior.frame
    parts = [(name, explain(board, (name,), start=frame)) for name in effects]
    fitted = tuple(Hypothesis((name,), each, 1 / len(effects)) for name, each in parts)
    return Case(
        settings=machine,
        controller="plumb",
        verdict=verdict if effects else "nothing_provable",
        posterior=posterior,
        frame=frame,
        best=fitted[0].at if fitted else frame,
        hypotheses=fitted or hidden_hypotheses(frame),
    )
