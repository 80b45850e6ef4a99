"""Whether the sled can take the way of a grid, by our model of the machine.

The grid itself knows straight chains without weight; the model knows all that the settings say.
"""

from __future__ import annotations

import numpy as np

import plumb.grid as marks_grid
from plumb.model.predict import CANNOT_HANG, TOO_SLACK, TOO_TIGHT, USABLE, Array, reach
from plumb.settings.machine import MachineSettings
from plumb.text.errors import InputError
from plumb.text.readers import to_do


def refuse_way(
    grid: marks_grid.Grid,
    machine: marks_grid.PlainMachine,
    settings: MachineSettings,
    *,
    most_give: float,
) -> None:
    """Raise InputError for the first place that the sled passes and the model refuses.

    Raises GridError for a grid that cannot be made. Chains must be soft in the settings.
    """
    passed: list[tuple[str, float, float]] = []
    marks_grid.check(grid, machine)
    marks_grid.check(grid, machine, lambda _grid, _machine, *place: passed.append(place))
    reached = reach(
        settings,
        np.array([place[1:] for place in passed]),
        most_tension=grid.max_tension,
        least_tension=grid.min_tension,
        least_free=marks_grid.MIN_FREE_CHAIN,
        most_give=most_give,
    )
    for i in np.flatnonzero(reached.verdict != USABLE)[:1]:
        what, x, y = passed[i]
        why = _reason(int(reached.verdict[i]), reached.tension[i], float(reached.give[i]))
        move, also = marks_grid.inwards(grid), _remedy(int(reached.verdict[i]))
        map_of_it = to_do("see plumb reach", page="Reach shows where that is")
        raise InputError(f"{what} at x {x:.1f} y {y:.1f} {why}: {move}{also}; {map_of_it}")


def _reason(verdict: int, tension: Array, give: float) -> str:
    if verdict == CANNOT_HANG:
        return "is a place where no sled can hang"
    if verdict == TOO_TIGHT:
        return f"puts {max(tension):.0f} N on a chain"
    if verdict == TOO_SLACK:
        return f"leaves {min(tension):.1f} N on a chain"
    return f"lets every newton move the sled {give:.2f} mm"


def _remedy(verdict: int) -> str:
    """What else would help than another place."""
    if verdict == CANNOT_HANG:
        return ""
    if verdict == TOO_TIGHT:
        return ", or lighten the sled"
    if verdict == TOO_SLACK:
        return ", or move the motors apart"
    return to_do(", or raise --most-give", page="")
