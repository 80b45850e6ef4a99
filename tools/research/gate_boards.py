"""Boards for the gates of the diagnosis: machines of two worlds, what is hidden, what is read.

Unlike the scenarios of `plumb bench`, all of a board comes from its seed, the hidden sizes too, so
boards of a new seed were seen by nobody. The judge cuts them, as it does for the bench.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from zlib import crc32

import numpy as np
from plumb.bench.boards import (
    GAP_SIGMA,
    POSE_SIGMA,
    TURN_SIGMA,
    BoardCut,
    TrueMachine,
    chains_for,
    plan,
)
from plumb.bench.causes import (
    CHAIN,
    MAKER,
    OUTSIDE,
    PUBLISHED,
    SLED,
    Cause,
    Hidden,
    Plan,
    causes_of,
)
from plumb.bench.hiding import Slip, slip
from plumb.bench.scenarios import GRIDS
from plumb.marks.read import Mark, Measurements
from plumb.model.lab_effects import LAB_EFFECTS
from plumb.model.predict import with_parameters
from plumb.settings.machine import MachineSettings

Array = np.ndarray
Source = np.random.Generator
Sized = tuple[tuple[Cause, float], ...]
Draw = Callable[[Source, int, Plan], Hidden]  # by chance, in turns, for these marks
TRIES = 50  # drawings until the sled hangs at every mark
WORLDS = ("known", "stock")
STRETCH, STRETCH_SIGMA, LEAST_STRETCH = 5.2e-6, 1.5e-6, 5e-7  # [1/N] of a chain
SAG_SHARE = 0.1  # by which a chain is heavier or lighter than the settings say, at most
PITCH_CHANCE, PITCH_SIGMA = 0.5, 5e-4
# A machine like none of the bench: [mm] gap and height above the sheet, sled as a share of SLED.
OTHER_GAP, OTHER_HEIGHT, OTHER_SLED = 3600.0, 460.0, 1.3
SAG = "chain_sag.weight_ratio_squared"


@dataclass(frozen=True)
class Kind:
    """Boards of a kind."""

    name: str  # the world first: known/one-25
    what: str  # is hidden
    draw: Draw
    marks: int = 25
    noise: float = 0.5  # [mm], and stated so
    repeats: bool = False
    slips: tuple[Slip, ...] = ()  # in turns
    slip_chance: float = 1.0
    is_cured: bool = False  # whether the sled is measured with what was named
    is_other: bool = False  # whether the machine is like none of the bench

    @property
    def world(self) -> str:
        """What the settings know."""
        return self.name.partition("/")[0]

    @property
    def settings(self) -> MachineSettings:
        """In force when the board is cut."""
        settings = MAKER if self.world == "known" else PUBLISHED
        if not self.is_other:
            return settings
        other = replace(
            settings,
            motor_gap=OTHER_GAP,
            motor_height=settings.sheet_height / 2 + OTHER_HEIGHT,
            sled_weight=OTHER_SLED * SLED,
        )
        # The same chain is lighter against a heavier sled.
        return with_parameters(other, {SAG: CHAIN[SAG] / OTHER_SLED**2})

    @property
    def plan(self) -> Plan:
        """Its marks."""
        weight = self.settings.sled_weight
        return plan(*GRIDS[self.marks], repeats=self.repeats, sled_weight=weight)


@dataclass(frozen=True)
class HiddenBoard:
    """A board, and all that is hidden in it."""

    kind: Kind
    plan: Plan
    board: BoardCut
    slipped: tuple[str, ...] = ()
    slip_mm: float = 0.0

    @property
    def hidden(self) -> Hidden:
        """What is wrong with the machine."""
        return self.board.machine.hidden


def board_of(kind: Kind, index: int, *, seed: int) -> HiddenBoard:
    """Return a board of a kind; raises ValueError if no machine like it can cut its marks."""
    for attempt in range(TRIES):
        source = np.random.default_rng([seed, crc32(kind.name.encode()), index, attempt])
        try:
            return _board(kind, index, source)
        except ValueError as error:
            reason = error
    raise reason


def _board(kind: Kind, index: int, source: Source) -> HiddenBoard:
    marks, settings = kind.plan, kind.settings
    hidden = _in_world(kind.world, kind.draw(source, index, marks), source)
    machine = TrueMachine(
        hidden,
        motor_gap=settings.motor_gap + GAP_SIGMA * source.standard_normal(),
        motor_height=settings.motor_height + POSE_SIGMA * source.standard_normal(),
        motor_center_x=POSE_SIGMA * source.standard_normal(),
        turn=TURN_SIGMA * source.standard_normal(),
    )
    where = places(machine, marks, settings) + _field(hidden, marks, source)
    board = BoardCut(machine, _measured(where, marks, kind.noise, source))
    if not kind.slips or source.uniform() > kind.slip_chance:
        return HiddenBoard(kind, marks, board)
    mishap = kind.slips[index % len(kind.slips)]
    board, slipped = slip(board, mishap, source)
    return HiddenBoard(kind, marks, board, slipped, mishap.millimetres)


def places(machine: TrueMachine, marks: Plan, settings: MachineSettings) -> Array:
    """Return where marks would be read (n, 2) [mm] without noise; ValueError if the sled cannot
    hang there.
    """
    where = machine.read(
        chains_for(marks, settings), approaches=marks.approaches, weights=marks.sled_weights
    )
    if not np.isfinite(where).all():
        raise ValueError("the judge's sled cannot hang at some mark")
    return where


def _measured(where: Array, marks: Plan, noise: float, source: Source) -> Measurements:
    """Return what is written down of places (n, 2) [mm]."""
    order = [*range(len(where)), *marks.again]
    read = where[order] + noise * source.standard_normal((len(order), 2))
    several = tuple(
        Mark(
            name=f"{marks.targets[i, 0]:.0f}/{marks.targets[i, 1]:.0f}",
            target=tuple(marks.targets[i].tolist()),
            measured=tuple(place),
            approach=tuple(marks.approaches[i].tolist()),
            sled_weight=float(marks.sled_weights[i]),
        )
        for i, place in zip(order, read.tolist(), strict=True)
    )
    return Measurements(several, (), tape_sigma=noise, source="hidden")


# What is on every machine of a world.


def _in_world(world: str, hidden: Hidden, source: Source) -> Hidden:
    """Return the same on a machine of a world; what is hidden goes before what is usual."""
    usual = _stock_machine(source) if world == "stock" else ()
    left = tuple((cause, size) for cause, size in usual if cause.effect not in hidden.effects)
    return replace(hidden, usual=(*hidden.usual, *left))


def _stock_machine(source: Source) -> Sized:
    """Return a chain that stretches, weighs nearly what it should, and is often too long."""
    (stretch,), (sag,) = causes_of("chain_stretch"), causes_of("chain_sag")
    believed, typical = (stretch.sizes(size)["compliance"] for size in (0.0, 1.0))
    truth = max(STRETCH + STRETCH_SIGMA * source.standard_normal(), LEAST_STRETCH)
    usual: Sized = (
        (stretch, (truth - believed) / (typical - believed)),
        (sag, float(source.uniform(-SAG_SHARE, SAG_SHARE))),
    )
    if source.uniform() > PITCH_CHANCE:
        return usual
    left, right = (PITCH_SIGMA * source.standard_normal(2)).tolist()
    return (*usual, (cause_of("chain_pitch", {"left": left, "right": right}), 1.0))


def cause_of(effect: str, values: Mapping[str, float]) -> Cause:
    """Return an effect with these values of its parameters, at the size 1."""
    hidden_as = {each.name: each.hidden_as for each in LAB_EFFECTS}.get(effect)
    first = next(iter(values.values()))
    return replace(
        causes_of(effect)[0],
        label="drawn",
        sizes=lambda _: dict(values),
        drag=first if hidden_as == "drag" else 0.0,
        skew=first if hidden_as == "skew" else 0.0,
        strain=first if hidden_as == "strain" else 0.0,
    )


# Fields that no effect draws.

PROCESS = "Gaussian process"
PROCESS_MM, WIDTHS = (1.0, 2.0, 4.0), (0.35, 0.7, 1.4)  # [mm], halves of what the marks span


def _field(hidden: Hidden, marks: Plan, source: Source) -> Array:
    """Return how far the field moves marks (n, 2) [mm]."""
    if not hidden.outside:
        return np.zeros((len(marks.targets), 2))
    if hidden.outside == PROCESS:
        moved = _process(marks.targets, float(source.choice(WIDTHS)), source)
        return hidden.outside_mm * moved
    moved = OUTSIDE[hidden.outside](marks.targets, source)
    length = float(np.sqrt(np.mean(np.sum(moved**2, axis=1))))
    return hidden.outside_mm * moved / max(length, 1e-9)


def _process(targets: Array, width: float, source: Source) -> Array:
    """Return a Gaussian process of 1 mm in each coordinate (n, 2)."""
    half = np.ptp(targets, axis=0) / 2
    apart = np.sum(((targets[:, np.newaxis] - targets) / half) ** 2, axis=2)
    values, turned = np.linalg.eigh(np.exp(-apart / (2 * width**2)))
    moved: Array = turned @ (
        np.sqrt(np.maximum(values, 0.0))[:, np.newaxis] * source.standard_normal(targets.shape)
    )
    return moved
