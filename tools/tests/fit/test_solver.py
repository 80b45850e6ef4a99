"""The solver against another solver, and on curves made to lead it astray."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pytest
from plumb.fit.fit import PRIORS, Checked, Linearized, Problem, solve
from plumb.fit.observations import observe
from plumb.marks.read import Measurements
from plumb.text.errors import InputError
from scipy.optimize import least_squares
from synthetic import BELIEVED, TRUE, grid, marks_on

STARTED_AT = 3.0


@dataclass
class Curve:
    """A problem of one unknown: what is left of it, and its slope, at each place."""

    left: Callable[[float], float]
    slope: Callable[[float], float]
    hangs: Callable[[float], bool] = lambda place: True
    names: tuple[str, ...] = ("place",)
    asked: int = 0

    def at(self, unknowns):
        self.asked += 1
        place = float(unknowns[0])
        if not self.hangs(place):
            return None
        left, slope = self.left(place), self.slope(place)
        return Linearized(unknowns, np.array([left]), np.array([[slope]]), np.zeros((0, 2)))


def board(effects, checked=()):
    rows = observe(BELIEVED, Measurements(marks_on(TRUE, BELIEVED, grid(5, 3), noise=0.5, seed=4)))
    return Problem.of(BELIEVED, rows, effects, PRIORS, 0.5, checked)


def settled_at(curve):
    solution = solve(curve, start=np.array([STARTED_AT]))
    return solution.settled, float(solution.at.unknowns[0])


@pytest.mark.parametrize("effects", [(), ("chain_pitch",), ("chain_sag", "frame_flex")])
def test_it_rests_where_another_solver_does(effects):
    problem = board(effects, [Checked("motor_gap", 2980.0, 1.0)])
    judge = least_squares(
        lambda unknowns: problem.at(unknowns).residual, np.zeros(len(problem.names)), xtol=1e-14
    )
    solution = solve(problem)
    assert solution.settled
    assert solution.at.cost == pytest.approx(2 * judge.cost, rel=1e-9)
    assert solution.at.unknowns == pytest.approx(judge.x, abs=1e-4)


def test_only_free_columns_move():
    problem = board(("chain_pitch",))
    start = np.full(len(problem.names), 0.2)
    free = np.array([0, 2])
    solution = solve(problem, free=free, start=start)
    moved = np.flatnonzero(solution.at.unknowns != start)
    assert moved.tolist() == free.tolist()
    assert start.tolist() == [0.2] * len(start)


def test_a_step_that_overshoots_is_halved():
    # Newton's steps on an arc tangent grow without end from there.
    settled, place = settled_at(Curve(lambda x: -np.arctan(x), lambda x: 1 / (1 + x * x)))
    assert settled and place == pytest.approx(0.0, abs=1e-5)


def test_a_start_where_the_sled_cannot_hang_is_refused():
    with pytest.raises(InputError, match="cannot hang"):
        settled_at(Curve(lambda x: -x, lambda x: 1.0, hangs=lambda x: False))


def test_it_reports_that_no_step_helps():
    wrong_way = Curve(lambda x: -x, lambda x: -1.0)
    assert settled_at(wrong_way) == (False, STARTED_AT)


def test_it_stops_once_a_step_promises_too_little():
    slow = Curve(lambda x: -x, lambda x: 10.0)
    solution = solve(slow, start=np.array([STARTED_AT]), close_enough=1.0)
    # A step promises all of chi-square there, so the rest is below the limit.
    assert solution.settled and 0.8 < solution.at.cost < 1.0
