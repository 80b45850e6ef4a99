"""Where on the sheet a machine is usable: its tightest, slackest and softest places."""

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass

import numpy as np

import plumb.grid as marks_grid
from plumb.model.plain import greatest, noun_of
from plumb.model.predict import (
    CANNOT_HANG,
    REACH_LIMITS,
    REACH_WORDS,
    TOO_SLACK,
    TOO_TIGHT,
    USABLE,
    Array,
    Reached,
    reach,
    usual_parameters,
    with_parameters,
)
from plumb.settings import MachineSettings
from plumb.text.errors import InputError, to_do

COLUMNS, ROWS = 305, 153  # of a survey: a place each 8 mm of the usual sheet, edges included


@dataclass(frozen=True)
class Extreme:
    """The place where a chain pulls most or least, or where the sled gives most."""

    title: str
    place: tuple[float, float]  # [mm]
    value: float
    unit: str  # N, or mm/N
    limit: float
    side: str  # whose chain; empty: no chain's


@dataclass(frozen=True)
class Survey:
    """The whole sheet, place by place."""

    sheet: tuple[float, float]  # [mm] width and height
    x: Array  # (COLUMNS,) [mm]
    y: Array  # (ROWS,) [mm] from the top down
    reached: Reached  # of the places row by row
    assumed: tuple[str, ...]  # what the settings do not say, a sentence each
    extremes: tuple[Extreme, ...]  # tightest, slackest, softest; none where no sled hangs

    @property
    def shares(self) -> dict[str, float]:
        """The share of the sheet of each verdict."""
        verdicts = self.reached.verdict
        return {word: float((verdicts == i).mean()) for i, word in enumerate(REACH_WORDS)}

    @property
    def all_usable(self) -> bool:
        """Whether every place of the sheet is usable."""
        return bool((self.reached.verdict == USABLE).all())


def with_soft_chains(settings: MachineSettings) -> tuple[MachineSettings, tuple[str, ...]]:
    """Return the machine with chains that give, whether or not its settings know it, and what was
    assumed.

    Real chains sag and stretch, also where a fit left that out or made it negative.
    """
    missing = {
        name: size
        for name, size in usual_parameters(settings).items()
        if settings.effect(*name.split(".")) <= 0
    }
    assumed = tuple(
        f"Your settings have {_too_little(settings, name)}. A usual chain is taken instead."
        for name in missing
    )
    return with_parameters(settings, missing), assumed


def _too_little(settings: MachineSettings, name: str) -> str:
    """Return what settings say of a parameter that no chain has so small."""
    effect, _, parameter = name.partition(".")
    noun = noun_of(effect)
    return f"a {noun} that no chain has" if settings.effect(effect, parameter) else f"no {noun}"


def survey_sheet(settings: MachineSettings) -> Survey:
    """Return every place of the sheet by our model of the machine."""
    machine, assumed = with_soft_chains(settings.as_plumb_model())
    width, height = machine.sheet
    x = np.linspace(-width / 2, width / 2, COLUMNS)
    y = np.linspace(height / 2, -height / 2, ROWS)
    places = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    reached = reach(machine, places)
    return Survey(machine.sheet, x, y, reached, assumed, tuple(_extremes(places, reached)))


def _extremes(places: Array, reached: Reached) -> Iterator[Extreme]:
    """Yield the extreme places; none where no sled hangs on the whole sheet."""
    hangs = (reached.verdict != CANNOT_HANG)[:, None]
    for title, limit, unit, values, sign in (
        ("tightest chain", "most_tension", "N", reached.tension, 1),
        ("slackest chain", "least_tension", "N", reached.tension, -1),
        ("softest place", "most_give", "mm/N", reached.give[:, None], 1),
    ):
        if hangs.any():
            most = greatest(np.where(hangs, sign * values, -np.inf))
            i, side = np.unravel_index(most, values.shape)
            place, value = (float(places[i, 0]), float(places[i, 1])), float(values[i, side])
            whose = ("left", "right")[side] if unit == "N" else ""
            yield Extreme(title, place, value, unit, REACH_LIMITS[limit], whose)


def percent(share: float) -> str:
    """Return a share for people; what is not quite all or nothing does not look it."""
    near = min(share, 1 - share)
    return f"{100 * share:.{2 if 0 < near < 0.001 else 1}f} %"


def conclusion_of(survey: Survey) -> str:
    """Return how much of the sheet is usable, in a sentence."""
    if survey.all_usable:
        return "The whole sheet is usable."
    if not survey.shares[REACH_WORDS[0]]:
        return "No place of the sheet is usable."
    usable, *bad = [(word, share) for word, share in survey.shares.items() if share]
    rest = ", ".join(f"{percent(share)} {word}" for word, share in bad)
    return f"{percent(usable[1])} of the sheet is usable; {rest}."


# Whether the sled can take the way of a grid, by our model of the machine.
#
# The grid itself knows straight chains without weight; the model knows all that the settings say.

# What else would help than another place.
WIDEST = 500  # [mm] of a margin that leaves marks enough on a sheet
ALSO = {TOO_TIGHT: ", or lighten the sled", TOO_SLACK: ", or move the motors apart"}


def plain_machine(settings: MachineSettings) -> marks_grid.PlainMachine:
    """Return the machine as a grid sees it."""
    return marks_grid.PlainMachine(
        sheet_width=settings.sheet_width,
        sheet_height=settings.sheet_height,
        motor_spacing=settings.motor_gap,
        motor_offset=settings.motor_offset,
        rotation_radius=settings.rotation_radius,
        sled_weight_n=settings.sled_weight,
    )


def refuse_way(
    grid: marks_grid.Grid, machine: marks_grid.PlainMachine, settings: MachineSettings
) -> None:
    """Raise InputError for the first place that the sled passes and the model refuses.

    Raises GridError for a grid that cannot be made. Chains must be soft in the settings.
    """
    refused = _refused(grid, machine, settings)
    if refused:
        where, also = refused
        move = marks_grid.inwards(grid, _wide_enough(grid, machine, settings))
        map_of_it = to_do("see plumb reach", page="Reach shows where that is")
        raise InputError(f"{where}: " + move + f"{also}; " + map_of_it)


def _refused(
    grid: marks_grid.Grid, machine: marks_grid.PlainMachine, settings: MachineSettings
) -> tuple[str, str] | None:
    """Return the first place that the model refuses, and what else would help; None: all pass."""
    passed: list[tuple[str, float, float]] = []
    marks_grid.check(grid, machine)
    marks_grid.check(grid, machine, lambda _grid, _machine, *place: passed.append(place))
    reached = reach(settings, np.array([place[1:] for place in passed]))
    for i in np.flatnonzero(reached.verdict != USABLE)[:1]:
        what, x, y = passed[i]
        why = _reason(int(reached.verdict[i]), reached.tension[i], float(reached.give[i]))
        return f"{what} at x {x:.1f} y {y:.1f} {why}", ALSO.get(int(reached.verdict[i]), "")
    return None


def _wide_enough(
    grid: marks_grid.Grid, machine: marks_grid.PlainMachine, settings: MachineSettings
) -> float | None:
    """Return the least margin [mm], in tens, with which the sled can go all the way."""
    if grid.places:
        return None
    for tens in range(int(grid.margin / 10) + 1, WIDEST // 10):
        wider = grid._replace(margin=10.0 * tens)
        with suppress(marks_grid.GridError):
            if not _refused(wider, machine, settings):
                return wider.margin
    return None


def _reason(verdict: int, tension: Array, give: float) -> str:
    if verdict == CANNOT_HANG:
        return "is a place where no sled can hang"
    if verdict == TOO_TIGHT:
        return f"puts {max(tension):.0f} N on a chain"
    if verdict == TOO_SLACK:
        return f"leaves {min(tension):.1f} N on a chain"
    return f"lets every newton move the sled {give:.2f} mm"
