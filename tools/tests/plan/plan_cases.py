"""Cases for the planner that need no diagnosis: a board, and what stands of it."""

from dataclasses import replace

from plumb.diagnosis.clean import felt_effects
from plumb.diagnosis.explanation import KNOWN, Board, explain
from plumb.diagnosis.noise import Noise
from plumb.fit.observations import model_and_observations
from plumb.marks.read import Measurements
from plumb.plan.case import Case, _as_fitted, hidden_hypotheses
from synthetic import BELIEVED, EFFECTS, grid, marks_on

SIGMA = 0.5
# With sag and stretch: the chains give, so friction is felt.
MACHINE = replace(BELIEVED, effects=EFFECTS)


def nine(**how):
    """Nine marks that lie where the machine sends them but for noise, come to from below."""
    marks = marks_on(MACHINE, MACHINE, grid(3, 3), noise=SIGMA, **how)
    return Measurements(tuple(replace(mark, approach=(0.0, 1.0)) for mark in marks))


def case_on(measurements, *effects, verdict="cannot_tell", checked=()):
    """The case of marks of which these effects are the suspects, as probable each."""
    model, rows = model_and_observations(MACHINE, measurements)
    board = Board.of(model, rows, sigma=SIGMA, checked=checked)
    frame = explain(board)
    singles = {name: explain(board, (name,), start=frame) for name in felt_effects(frame)}
    fitted = tuple(_as_fitted(singles[name], 1 / len(effects)) for name in effects)
    hypotheses = fitted or hidden_hypotheses(frame)
    return Case(
        settings=MACHINE,
        controller="plumb",
        verdict=verdict if effects else "nothing_provable",
        board=board,
        noise=Noise(SIGMA, KNOWN, "stated"),
        frame=frame,
        singles=singles,
        hypotheses=hypotheses,
        truths=hypotheses,
    )
