"""Planned visits: where the sled would be sent, how heavy, from which side, by which chain."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from typing import Annotated

import numpy as np

from plumb.fit.observations import Observations, loaded
from plumb.grid import APPROACH, PLUNGE_FEED, WAY_STEP, Grid
from plumb.marks.model import Mark, Point
from plumb.model.plain import greatest
from plumb.model.predict import USABLE, believed_lengths, reach, settings_of, values_of
from plumb.model.reach import with_soft_chains
from plumb.settings import GRAVITY, MachineSettings
from plumb.text.answers import key
from plumb.text.errors import InputError
from plumb.text.values import INCHES, Unit

Array = np.ndarray


@dataclass(frozen=True)
class Visit:
    """A visit whose place is yet to be read."""

    name: str
    target: Point  # [mm]
    sled_weight: Annotated[float, key("sled_weight_n")]
    approach: Point | None  # unit vector; None: the side is not prescribed


@dataclass(frozen=True)
class Visits:
    """Visits of the sled whose places are yet to be read."""

    names: tuple[str, ...]  # (n,) of the marks; one that is on the sheet already is visited again
    targets: Array  # (n, 2) [mm]
    chains: Array  # (n, 2) [mm] the controller will pay out
    sled_weights: Array  # (n,) [N]
    approaches: Array  # (n, 2) unit vectors; zero if the side is not prescribed

    def __len__(self) -> int:
        """Return how many visits."""
        return len(self.names)

    def taken(self, indices: Sequence[int]) -> Visits:
        """Return some of them, in that order."""
        chosen = np.array(indices, dtype=int)
        names = tuple(self.names[i] for i in chosen)
        return Visits(names, *(getattr(self, field.name)[chosen] for field in fields(self)[1:]))

    @property
    def each(self) -> tuple[Visit, ...]:
        """Visit by visit."""
        return tuple(
            Visit(
                name=name,
                target=tuple(self.targets[i].tolist()),
                approach=tuple(self.approaches[i].tolist()) if self.approaches[i].any() else None,
                sled_weight=float(self.sled_weights[i]),
            )
            for i, name in enumerate(self.names)
        )

    def marks(self, places: Array) -> list[Mark]:
        """Return the visits as marks that were read at places (n, 2) [mm]."""
        both = zip(self.each, places.tolist(), strict=True)
        return [Mark(**vars(visit), measured=tuple(place)) for visit, place in both]

    def rows(self) -> Observations:
        """Return the visits as observations whose readings are still zero."""
        count = len(self)
        return Observations(
            chains=self.chains,
            sled_weights=self.sled_weights,
            mark_rows=np.arange(count),
            measured=np.zeros((count, 2)),
            targets=self.targets,
            names=self.names,
            approaches=self.approaches,
            # As the first round: a few more marks need no new zeros or sheet.
            rounds=np.zeros(count, dtype=int),
            zero_groups=np.zeros(count, dtype=int),
            sheet_groups=np.zeros(count, dtype=int),
        )


def joined(*several: Visits) -> Visits:
    """Visits one after the other."""
    names = tuple(name for visits in several for name in visits.names)
    rest = [np.concatenate([getattr(v, f.name) for v in several]) for f in fields(Visits)[1:]]
    return Visits(names, *rest)


def nowhere() -> Visits:
    """No visit at all."""
    none = np.zeros((0, 2))
    return Visits((), none, none, np.zeros(0), none)


def sent(
    settings: MachineSettings,
    targets: Array,
    *,
    controller: str,
    sled_weight: float,
    approaches: Array | None = None,
) -> Visits:
    """Visits of targets (n, 2) [mm] by a machine with the settings in force; the approaches (n, 2)
    are zero if not given. Raises ValueError for a target that the controller cannot reach."""
    where = np.array(targets, dtype=float).reshape(-1, 2)
    count = len(where)
    return Visits(
        names=tuple(f"{x + 0.0:.0f}/{y + 0.0:.0f}" for x, y in where),
        targets=where,
        chains=believed_lengths(settings, where, controller=controller),
        sled_weights=np.full(count, float(sled_weight)),
        approaches=np.zeros((count, 2)) if approaches is None else np.array(approaches, float),
    )


# The G-code for planned visits: a touch of the bit at each, come to from the prescribed side.

USUAL = Grid()  # heights and feeds, as a grid has them


FIRST_LINE = "(Plumb: the best marks to measure next)"
LEAST = 1e-6  # [N] a smaller change of the weight is none
COMMENT = 70  # characters: a client sends no line that is longer than the machine's buffer


def program(visits: Visits, *, usual_weight: float, do: Sequence[str] = ()) -> str:
    """Return the G-code for planned visits.

    It waits (M0) where another weight is to hang on the sled, and at the end until it hangs as
    before; `usual_weight` [N] is that of the sled by itself. `do`: what to
    do first, as comments.
    """
    lines = [FIRST_LINE, "(X0 Y0 middle of sheet, Z0 surface; leave the router off)"]
    for sentence in do:
        bare = sentence.replace("(", "").replace(")", "")
        lines += [f"({line})" for line in textwrap.wrap(bare, COMMENT)]
    lines += ["G21", "G90", f"G0 Z{USUAL.safe_height:g}"]
    weight = usual_weight
    for visit in visits.each:
        lines += _weight_changes(weight, visit.sled_weight, usual_weight)
        weight, (x, y) = visit.sled_weight, way_into(visit)
        lines += [
            f"(mark {visit.name.replace('(', '').replace(')', '')})",
            f"G0 Z{USUAL.safe_height:g}",
            f"G0 X{x:.3f} Y{y:.3f}",
            f"G1 X{visit.target[0]:.3f} Y{visit.target[1]:.3f} F{USUAL.feed:g}",
            f"G1 Z{-USUAL.depth:g} F{PLUNGE_FEED:g}",
            f"G0 Z{USUAL.safe_height:g}",
        ]
    lines += ["(back to the middle)", "G0 X0 Y0"]
    return "\n".join([*lines, *_weight_changes(weight, usual_weight, usual_weight), ""])


def _weight_changes(weight: float, next_weight: float, usual: float) -> list[str]:
    """Return the pause in which another weight [N] is hung on the sled; no line for the same."""
    if abs(next_weight - weight) <= LEAST:
        return []
    kilograms = (next_weight - usual) / GRAVITY
    if abs(next_weight - usual) <= LEAST:
        return ["(take off what hangs on the sled)", "M0"]
    return [f"(let {kilograms:.1f} kg more hang on the sled, low and in the middle)", "M0"]


def way_into(mark: Mark | Visit) -> tuple[float, float]:
    """Return where [mm] the sled goes straight into a mark from: by the usual way if the side does
    not matter.
    """
    usual = np.array(APPROACH)
    lead_in = np.array(mark.approach) * np.hypot(*usual) if mark.approach else usual
    x, y = (np.array(mark.target) - lead_in).tolist()
    return x, y


# Whether the sled can take the way to planned marks, as heavy as it is on each part of it.

Place = tuple[float, float]


def refuse_way(settings: MachineSettings, marks: Sequence[Mark]) -> None:
    """Raise InputError for the first mark whose way leaves the sheet or what the sled can reach."""
    here: Place = (0.0, 0.0)
    half = settings.sheet_width / 2, settings.sheet_height / 2
    for mark in marks:
        weight = mark.sled_weight or settings.sled_weight
        for end in (way_into(mark), mark.target):
            steps = max(math.ceil(math.dist(here, end) / WAY_STEP), 1)
            passed = np.linspace(here, end, steps + 1)[1:]
            is_off = bool((np.abs(passed) > np.array(half) + 1e-6).any())
            if is_off or not usable(settings, passed, weight).all():
                where = "leaves the sheet" if is_off else "passes where the sled cannot hang well"
                raise InputError(
                    f"the way to mark {mark.name} {where}: take another measurement of the verdict"
                )
            here = end


# Places on the sheet that are worth a mark, as far as the machine reaches them.

COLUMNS, ROWS = 7, 5  # of the grid of new places
MARGIN = (
    0.05,
    0.09,
)  # of the sheet's width and height: closer to the edge the sled would tip over the edge
NEAR = 60.0  # [mm] nearer than this a new mark counts as the old mark


def grid(
    sheet: tuple[float, float],
    columns: int = COLUMNS,
    rows: int = ROWS,
    *,
    margin: tuple[float, float] = MARGIN,
) -> Array:
    """Return places (n, 2) [mm] spread over the sheet, from the top left, in whole 10 mm."""
    reach_x, reach_y = ((0.5 - share) * side for share, side in zip(margin, sheet, strict=True))
    across = np.linspace(-reach_x, reach_x, columns) if columns > 1 else np.zeros(1)
    up = np.linspace(reach_y, -reach_y, rows) if rows > 1 else np.zeros(1)
    return np.round(np.array([(x, y) for y in up for x in across]), -1)


def new_places(sheet: tuple[float, float], known: Array) -> Array:
    """Return places of the grid that are not near one of the known targets (n, 2) [mm]."""
    places = grid(sheet)
    if not len(known):
        return places
    gaps = np.linalg.norm(places[:, np.newaxis] - known[np.newaxis], axis=2).min(axis=1)
    far: Array = places[gaps > NEAR]
    return far


def usable(settings: MachineSettings, places: Array, sled_weight: float) -> Array:
    """Return whether a sled of that weight [N] may be sent to each place (n,): neither too tight
    nor too slack nor too soft by our model.
    """
    machine = with_soft_chains(settings.as_plumb_model())[0]
    loaded_values, _ = loaded(values_of(machine), sled_weight, machine.sled_weight)
    heavy = settings_of(loaded_values, like=replace(machine, sled_weight=sled_weight))
    is_usable: Array = reach(heavy, places).verdict == USABLE
    return is_usable


# Where to cut proof marks: reachable places, as far as can be from marks that were fitted.

FINE = (15, 9)  # places across and up that are considered
COUNT = 2
BELOW = 40.0  # [mm] that a sled comes from below, so this far down it must hang too


def proof_places(settings: MachineSettings, known: Array) -> Array:
    """Return the places (COUNT, 2) [mm], given the targets (n, 2) of the marks there are."""
    places = grid(settings.sheet, *FINE)
    for shift in (0.0, BELOW):
        places = places[usable(settings, places - [0.0, shift], settings.sled_weight)]
    taken = np.asarray(known, dtype=float).reshape(-1, 2)
    chosen: list[Array] = []
    while len(chosen) < COUNT and len(places):
        gaps = np.linalg.norm(places[:, np.newaxis] - np.vstack([taken, *chosen]), axis=2)
        best = places[greatest(gaps.min(axis=1, initial=np.inf))]
        chosen.append(best)
    return np.array(chosen).reshape(-1, 2)


# A marks.toml of planned visits that waits for the tape's readings.


def marks_file(
    visits: Visits,
    *,
    sheet: tuple[float, float],
    controller: str,
    said: tuple[str, ...],
    cut_with: str = "",
    unit: Unit,
) -> str:
    """Return the text of the file: places count from the sheet's top left corner, y down, in this
    unit; `cut_with` are lines that name the settings in force.
    """
    if unit == INCHES:
        cut_with = f'\nunits = "inch"  # fractions too, like 3 7/8{cut_with}'
    lines = [
        f"# Measured from the sheet's left and top edges, in {unit.name}: take away the # before",
        "# `measured` and write what the tape says. Give this file to plumb after your marks.",
        *(f"# {sentence}" for sentence in said),
        f'frame = "sheet-top-left"{cut_with}',
        f'controller = "{controller}"',
    ]
    for i, name in enumerate(visits.names):
        x, y = visits.targets[i, 0] + sheet[0] / 2, sheet[1] / 2 - visits.targets[i, 1]
        target = f"target = [{unit.bare(x, 3)}, {unit.bare(y, 3)}]"
        lines += ["", "[[mark]]", f'name = "{name}"', target]
        lines.append(f"sled_weight_n = {visits.sled_weights[i]:.1f}")
        side = visits.approaches[i]
        if side.any():
            lines.append(
                f"approach = [{side[0] + 0.0:.3f}, {-side[1] + 0.0:.3f}]  # y down here too"
            )
        lines.append("# measured = [ , ]")
    return "\n".join(lines) + "\n"
