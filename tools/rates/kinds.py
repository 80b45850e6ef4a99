"""The kinds of boards: what is hidden in each, and how a board is made."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from zlib import crc32

import numpy as np
from boards import PUBLISHED, BoardCut, cut
from plumb.fit.compare import plausible_range
from plumb.hidden import (
    MAKER,
    OUTSIDE,
    REAL,
    REAL_MM,
    USUAL,
    Cause,
    Hidden,
    Plan,
    causes_of,
    plan,
    size_for,
)
from plumb.model.catalogue import EVERY_MACHINE
from plumb.settings import MachineSettings

# Effects to hide in boards, drawn by chance or in turns, and slips of the pen.


Source = np.random.Generator
# What is hidden in board number i, on this plan.
Draw = Callable[[Source, int, Plan], Hidden]

LEAST, MOST = 1.0, 3.0  # usual sizes of an effect
LARGEST_DRAG = 1.5  # typical sizes of friction beyond which lower corners stick for centimetres
BEYOND = 1.5  # times the largest size that was met, at most
RUBS, BACKLASH = 0.3, 0.2  # of a usual machine: typical sizes of friction, [mm] at most


def nothing(source: Source, index: int, plan: Plan) -> Hidden:
    """Only the frame is off."""
    return Hidden()


def raw(source: Source, index: int, plan: Plan) -> Hidden:
    """Return one cause after the other, each as large as moves marks by REAL_MM RMS."""
    cause = _turn(REAL, index)
    return Hidden(((cause, size_for(cause, plan, REAL_MM)),))


def beyond(source: Source, index: int, plan: Plan) -> Hidden:
    """Return one cause after the other, larger than the largest that was met."""
    cause = _turn(tuple(cause for cause in USUAL if not cause.drag), index)
    share = float(source.uniform(1.0, BEYOND))
    believed, there = cause.sizes(0.0), cause.sizes(1.0)
    sizes = []
    for name, start in believed.items():
        met, step = plausible_range(f"{cause.effect}.{name}"), there[name] - start
        if step:
            sizes.append((share * (met.high if step > 0 else met.low) - start) / step)
    return Hidden(((cause, min(sizes)),))


def several(count: int) -> Draw:
    """Return different effects at once, each of usual size; a single effect is taken in turns."""

    def draw(source: Source, index: int, plan: Plan) -> Hidden:
        effects = list(dict.fromkeys(cause.effect for cause in USUAL))
        if count == 1:
            causes = [_turn(USUAL, index)]
        else:
            chosen = [effects[i] for i in source.choice(len(effects), count, replace=False)]
            causes = [_one_of(effect, source) for effect in chosen]
        return Hidden(tuple((cause, _size(cause, source)) for cause in causes))

    return draw


def usual_machine(source: Source, index: int, plan: Plan) -> Hidden:
    """Return one effect of usual size on a machine that rubs and has backlash."""
    there = (*EVERY_MACHINE, "sled_friction")
    causes = tuple(cause for cause in USUAL if cause.effect not in there)
    return Hidden(
        ((_turn(causes, index), float(source.uniform(1.0, 2.0))),),
        usual=((causes_of("sled_friction")[0], RUBS),),
        backlash=float(source.uniform(0.0, BACKLASH)),
    )


def outside(source: Source, index: int, plan: Plan) -> Hidden:
    """Return 2 mm of what the library has no word for, in turns."""
    return Hidden(outside=list(OUTSIDE)[index % len(OUTSIDE)], outside_mm=2.0)


def besides(millimetres: float, draw: Draw, patterns: Sequence[str]) -> Draw:
    """Return the same with one of some patterns of OUTSIDE, in turns."""

    def both(source: Source, index: int, plan: Plan) -> Hidden:
        pattern = patterns[index % len(patterns)]
        return replace(draw(source, index, plan), outside=pattern, outside_mm=millimetres)

    return both


def _turn(causes: tuple[Cause, ...], index: int) -> Cause:
    """Effects take turns, and so do the causes of each."""
    effects = list(dict.fromkeys(cause.effect for cause in causes))
    of_effect = [cause for cause in causes if cause.effect == effects[index % len(effects)]]
    return of_effect[index // len(effects) % len(of_effect)]


def _one_of(effect: str, source: Source) -> Cause:
    causes = [cause for cause in USUAL if cause.effect == effect]
    return causes[int(source.integers(len(causes)))]


def _size(cause: Cause, source: Source) -> float:
    size = float(source.uniform(LEAST, MOST))
    return min(size, LARGEST_DRAG) if cause.drag else size


# What every machine with published settings has.

STRETCH, STRETCH_SIGMA, LEAST_STRETCH = 5.2e-6, 1.5e-6, 5e-7  # [1/N] of a chain
SAG_SHARE = 0.1  # by which a chain is heavier or lighter than the settings say, at most
SMALLEST = "chain_sag"  # of what is usual: a tenth of it is not worth a fit
PITCH_CHANCE, PITCH_SIGMA = 0.5, 5e-4


def as_bought(hidden: Hidden, source: Source) -> Hidden:
    """Return the same on a chain that stretches, weighs nearly what it should, and is often too
    long; what is hidden goes before what is usual.
    """
    (stretch,), (sag,) = causes_of("chain_stretch"), causes_of("chain_sag")
    believed, typical = (stretch.sizes(size)["compliance"] for size in (0.0, 1.0))
    truth = max(STRETCH + STRETCH_SIGMA * source.standard_normal(), LEAST_STRETCH)
    usual = [
        (stretch, (truth - believed) / (typical - believed)),
        (sag, float(source.uniform(-SAG_SHARE, SAG_SHARE))),
    ]
    if source.uniform() < PITCH_CHANCE:
        left, right = (PITCH_SIGMA * source.standard_normal(2)).tolist()
        both = {"left": left, "right": right}
        usual.append((Cause("chain_pitch", "drawn", sizes=lambda _: both), 1.0))
    more = tuple(each for each in usual if each[0].effect not in hidden.effects)
    return replace(hidden, usual=(*hidden.usual, *more))


@dataclass(frozen=True)
class PenSlip:
    """A reading that is written down some millimetres away, in any direction."""

    millimetres: float = 5.0
    where: str = ""  # "once": at a mark that is read once; "repeated": at one read again


def slip(board: BoardCut, kind: PenSlip, source: Source) -> tuple[BoardCut, str]:
    """Return the board with one reading written down wrongly, and the mark's name."""
    marks = list(board.measurements.marks)
    names = [mark.name for mark in marks]
    again = np.array([names.count(name) > 1 for name in names])
    allowed = np.ones(len(names)) if not kind.where else again == (kind.where == "repeated")
    index = int(source.choice(np.flatnonzero(allowed)))
    x, y = marks[index].measured or marks[index].target
    turn = source.uniform(0, 2 * np.pi)
    moved = (x + kind.millimetres * np.cos(turn), y + kind.millimetres * np.sin(turn))
    marks[index] = replace(marks[index], measured=moved)
    measurements = replace(board.measurements, marks=tuple(marks))
    return replace(board, measurements=measurements), names[index]


# The kinds of boards of the bench, each on two machines, and how a board is made.
#
# All of a board comes from its seed, the hidden sizes too, so boards of a new seed were seen by
# nobody.


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
