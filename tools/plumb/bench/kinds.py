"""The kinds of boards of the bench, each on two machines, and how a board is made.

All of a board comes from its seed, the hidden sizes too, so boards of a new seed were seen by
nobody.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from zlib import crc32

import numpy as np

from plumb.bench.boards import BoardCut, cut, plan
from plumb.bench.causes import MAKER, PUBLISHED, Hidden, Plan
from plumb.bench.hiding import (
    Draw,
    PenSlip,
    as_bought,
    besides,
    beyond,
    nothing,
    outside,
    raw,
    several,
    slip,
    usual_machine,
)
from plumb.settings.machine import MachineSettings

GRIDS = {9: (3, 3), 15: (5, 3), 25: (5, 5), 63: (9, 7)}
# What the settings know: all that every machine has, or as much as published settings do.
WORLDS = {"known": MAKER, "stock": PUBLISHED}
TRIES = 50  # drawings until the sled hangs at every mark


@dataclass(frozen=True)
class Kind:
    """Boards of one kind."""

    name: str  # the world first: known/one
    what: str  # is hidden
    draw: Draw
    noise: float = 0.5  # [mm] of a coordinate
    is_stated: bool = True  # whether the file of marks says so
    repeats: bool = False  # three marks are read three times
    slips: tuple[PenSlip, ...] = ()  # of a reading, in turns

    @property
    def settings(self) -> MachineSettings:
        """In force when the board is cut."""
        return WORLDS[self.name.partition("/")[0]]

    def plan(self, marks: int) -> Plan:
        """Return where so many marks lie."""
        return plan(*GRIDS[marks], repeats=self.repeats)


@dataclass(frozen=True)
class HiddenBoard:
    """A board, and all that is hidden in it."""

    kind: Kind
    plan: Plan
    board: BoardCut
    slipped: tuple[str, ...] = ()  # marks with a reading that is wrong

    @property
    def hidden(self) -> Hidden:
        """Faults of the machine."""
        return self.board.machine.hidden


def board_of(kind: Kind, index: int, *, marks: int, seed: int) -> HiddenBoard:
    """Return a board of one kind; raises ValueError if no machine like it can cut its marks."""
    layout = kind.plan(marks)
    for attempt in range(TRIES):
        # Each kind draws by itself, or one odd board would show in all of them.
        source = np.random.default_rng([seed, crc32(kind.name.encode()), index, attempt])
        hidden = kind.draw(source, index, layout)
        if kind.settings is PUBLISHED:
            hidden = as_bought(hidden, source)
        try:
            board = cut(
                hidden,
                layout,
                seed=source,
                noise=kind.noise,
                tape_sigma=kind.noise if kind.is_stated else None,
                settings=kind.settings,
            )
        except ValueError as error:
            reason = error
            continue
        if not kind.slips:
            return HiddenBoard(kind, layout, board)
        board, slipped = slip(board, kind.slips[index % len(kind.slips)], source)
        return HiddenBoard(kind, layout, board, (slipped,))
    raise reason


def _kinds_of(world: str) -> Iterator[Kind]:
    usual = "of 1 to 3 usual sizes"
    for name, what, draw in (
        ("none", "nothing", nothing),
        ("one", "one effect of 3 mm", raw),
        ("typical", f"one effect {usual}", several(1)),
        ("beyond", "one effect, larger than the largest that was met", beyond),
        ("two", f"two effects {usual}", several(2)),
        ("several", f"three effects {usual}", several(3)),
        ("four", f"four effects {usual}", several(4)),
        ("field", "2 mm of no effect", outside),
    ):
        yield Kind(f"{world}/{name}", what, draw)
    what = "one effect on a machine that rubs and has backlash"
    yield Kind(f"{world}/usual", what, usual_machine, 0.4, repeats=True)
    for count in (1, 2, 3, 4):
        for pattern in (0.3, 0.7):
            what = f"{count} {usual}, and a bump of {pattern:g} mm of no effect"
            draw = besides(pattern, several(count), ["bump"])
            yield Kind(f"{world}/bump-{count}-{pattern:g}", what, draw, 0.2)
    for pattern in (0.3, 0.7):
        what = f"two effects {usual}, and {pattern:g} mm of no effect: a cubic or a sled that tips"
        draw = besides(pattern, several(2), ["cubic", "tipping sled"])
        yield Kind(f"{world}/other-2-{pattern:g}", what, draw, 0.2)
    slips = tuple(PenSlip(mm, where) for where in ("once", "repeated") for mm in (5.0, 10.0, 30.0))
    what = f"one effect {usual}, and a slip of 5, 10 or 30 mm"
    yield Kind(f"{world}/slip", what, several(1), 0.4, repeats=True, slips=slips)


KINDS = {kind.name: kind for world in WORLDS for kind in _kinds_of(world)}
