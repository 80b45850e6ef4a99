"""What to measure where no effect is in question: readings that disagree, marks nobody explains."""

from __future__ import annotations

from collections.abc import Sequence
from math import erf, sqrt

import numpy as np

from plumb.diagnosis.explanation import Explanation
from plumb.diagnosis.slip_cause import Slip
from plumb.model.ranks import ascending, ranked
from plumb.plan.case import Case
from plumb.plan.options import MARK, READING, ROUND, Option, spots
from plumb.plan.planned_visits import Visits, joined, nowhere, sent
from plumb.plan.sites import usable

Array = np.ndarray
SURE = 3.0  # deviations by which a second reading shows that the first was wrong
WORST = 2  # places around which marks are proposed
BESIDE = 200.0  # [mm] from such a place
READ_AGAIN = 3


def for_slips(case: Case, slips: Sequence[Slip]) -> list[tuple[Option, float]]:
    """Reading those marks or distances again, with the chance that it shows the slip."""
    offered = []
    for slip in slips:
        # Two readings with the same noise differ by its square root of two.
        chance = 0.5 * (1 + erf((slip.length / (sqrt(2) * case.noise.sigma) - SURE) / sqrt(2)))
        what = slip.name if slip.name in case.board.rows.names else f"the distance {slip.name}"
        do = f"Read {what} again with a newly laid tape, before anything else."
        offered.append(
            (Option("reread", f"{slip.name} again", (do,), 2.0, _old(case, slip.name)), chance)
        )
    return offered


def near_the_worst(case: Case) -> list[Option]:
    """Marks around the places that are explained worst, then readings of these once more."""
    rows = case.board.rows
    best = ranked(
        [case.frame, *case.singles.values()],
        lambda explanation: explanation.cost + 2 * len(case.board.columns(explanation.effects)),
    )[0]
    if not len(rows.measured):
        return [_worst_distances(case, best)]
    errors = best.numbers[: rows.measured.size].reshape(-1, 2)
    worst = ascending(-np.linalg.norm(errors, axis=1))
    places: dict[str, Array] = {}
    for i in worst:
        places.setdefault(rows.names[i], rows.targets[i])
        if len(places) == WORST:
            break
    near = _around(case, list(places.values()))
    names = ", ".join(places)
    again = joined(*[_old(case, name) for name in places for _ in range(READ_AGAIN)])
    offered = [
        Option(
            "repeats",
            "the worst marks read again",
            (f"Read {names} {READ_AGAIN} more times: this tells a slip from something real.",),
            ROUND + READING * len(again),
            again,
        )
    ]
    if len(near):
        do = (
            f"Cut and read marks around {names}, where the error is worst, at {spots(near)}: what "
            "is local (a bent frame, a bump in the sheet, a sticking chain) shows itself here."
        )
        minutes = ROUND + MARK * len(near)
        offered.append(Option("near", "marks around the worst places", (do,), minutes, near))
    return offered


def _worst_distances(case: Case, best: Explanation) -> Option:
    """The distances that are explained worst, to be measured again."""
    worst = ascending(-np.abs(best.numbers))[: 2 * WORST]
    said = ", ".join(case.spans[i] for i in worst)
    do = f"Measure the distances {said} {READ_AGAIN} more times: this tells a slip from more."
    minutes = ROUND + READING * READ_AGAIN * len(worst)
    return Option("repeats", "the worst distances again", (do,), minutes, nowhere())


def _around(case: Case, places: Sequence[Array]) -> Visits:
    """Two new marks near each place, on the sheet."""
    half = np.array(case.settings.sheet) / 2 - 50.0
    wanted = [
        np.round(np.clip(at + side, -half, half), -1)
        for at in places
        for side in ((-np.sign(at[0] or 1) * BESIDE, 0.0), (0.0, -np.sign(at[1] or 1) * BESIDE))
    ]
    targets = np.array(wanted).reshape(-1, 2)
    targets = targets[usable(case.settings, targets, case.usual_weight)]
    if not len(targets):
        return nowhere()
    return sent(case.settings, targets, controller=case.controller, sled_weight=case.usual_weight)


def _old(case: Case, name: str) -> Visits:
    """One visit of a mark that is there; nothing for a distance."""
    rows = case.board.rows
    if name not in rows.names:
        return nowhere()
    i = rows.names.index(name)
    row = [int(rows.mark_rows[i])]
    return Visits(
        (name,),
        rows.targets[[i]],
        rows.chains[row],
        rows.sled_weights[row],
        rows.approaches[row],
        rows.swapped[row],
    )
