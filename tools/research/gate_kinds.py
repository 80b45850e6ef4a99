"""What is hidden in the boards of the gates, and their kinds.

A kind is there twice: on machines whose settings know them, and on machines as they are.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations

import numpy as np
from gate_boards import PROCESS, PROCESS_MM, WORLDS, Draw, Kind, Source, cause_of
from plumb.bench.boards import size_for
from plumb.bench.causes import CHAIN, OUTSIDE, Cause, Hidden, Plan, causes_of
from plumb.bench.hiding import (
    LARGE,
    LARGE_MM,
    LARGEST_DRAG,
    REAL,
    REAL_MM,
    SMALL,
    Slip,
    by_effect,
)
from plumb.fit.expected import plausible_range
from plumb.model.catalogue import EVERY_MACHINE, every_effect

RUBS, BACKLASH = 0.3, 0.2  # typical sizes of friction, [mm] at most


def nothing(source: Source, index: int, marks: Plan) -> Hidden:
    """Only the frame is off."""
    return Hidden()


def _turn(causes: tuple[Cause, ...], index: int) -> Cause:
    """Effects take turns, and so do the causes of each."""
    effects = by_effect(causes)
    of_effect = effects[index % len(effects)]
    return of_effect[index // len(effects) % len(of_effect)]


def raw(millimetres: float, causes: tuple[Cause, ...]) -> Draw:
    """Return one cause after the other, as large as moves marks by so much RMS."""

    def draw(source: Source, index: int, marks: Plan) -> Hidden:
        cause = _turn(causes, index)
        return Hidden(((cause, size_for(cause, marks, millimetres)),))

    return draw


def usual_sizes(low: float, high: float, causes: tuple[Cause, ...]) -> Draw:
    """Return one cause after the other, of some typical sizes."""

    def draw(source: Source, index: int, marks: Plan) -> Hidden:
        cause = _turn(causes, index)
        return Hidden(((cause, _size(cause, low, high, source)),))

    return draw


def _size(cause: Cause, low: float, high: float, source: Source) -> float:
    size = float(source.uniform(low, high))
    return min(size, LARGEST_DRAG) if cause.drag else size


def several(count: int, low: float, high: float, causes: tuple[Cause, ...]) -> Draw:
    """Return different effects at once, each of some typical sizes."""
    effects = by_effect(causes)

    def draw(source: Source, index: int, marks: Plan) -> Hidden:
        chosen = source.choice(len(effects), count, replace=False)
        each = [effects[i][int(source.integers(len(effects[i])))] for i in chosen]
        return Hidden(tuple((cause, _size(cause, low, high, source)) for cause in each))

    return draw


def pairs(millimetres: float, causes: tuple[Cause, ...]) -> Draw:
    """Return two effects at once, each of so much RMS."""
    both = [(a, b) for a, b in combinations(causes, 2) if a.effect != b.effect]

    def draw(source: Source, index: int, marks: Plan) -> Hidden:
        chosen = both[int(source.integers(len(both)))]
        return Hidden(tuple((cause, size_for(cause, marks, millimetres)) for cause in chosen))

    return draw


def beyond_usual(low: float, high: float, causes: tuple[Cause, ...]) -> Draw:
    """Return one cause after the other, larger than the largest that was met."""
    causes = tuple(cause for cause in causes if not cause.drag)

    def draw(source: Source, index: int, marks: Plan) -> Hidden:
        cause, share = _turn(causes, index), float(source.uniform(low, high))
        return Hidden(((cause, _largest(cause, share)),))

    return draw


def _largest(cause: Cause, share: float) -> float:
    """Return the size at which the first parameter reaches a share of the largest that was met."""
    believed, there = cause.sizes(0.0), cause.sizes(1.0)
    sizes = []
    for name, start in believed.items():
        met, step = plausible_range(f"{cause.effect}.{name}"), there[name] - start
        if step:
            sizes.append((share * (met.high if step > 0 else met.low) - start) / step)
    return min(sizes)


def usual_machine(source: Source, index: int, marks: Plan) -> Hidden:
    """Return one effect of usual size on a machine that rubs and has backlash."""
    there = (*EVERY_MACHINE, "sled_friction")
    causes = tuple(cause for cause in SMALL if cause.effect not in there)
    return Hidden(
        ((_turn(causes, index), float(source.uniform(1.0, 2.0))),),
        usual=((causes_of("sled_friction")[0], RUBS),),
        backlash=float(source.uniform(0.0, BACKLASH)),
    )


def besides(millimetres: float, draw: Draw) -> Draw:
    """Return the same with a bump that the library has no word for."""

    def both(source: Source, index: int, marks: Plan) -> Hidden:
        return replace(draw(source, index, marks), outside="bump", outside_mm=millimetres)

    return both


def outside(millimetres: float) -> Draw:
    """Return what the library has no word for, in turns."""

    def draw(source: Source, index: int, marks: Plan) -> Hidden:
        return Hidden(outside=list(OUTSIDE)[index % len(OUTSIDE)], outside_mm=millimetres)

    return draw


# Machines drawn from what a posterior over accounts takes for usual before the marks.

EFFECT, UNUSUAL = 0.1, 0.05  # chance that an effect acts; that what every machine has is unusual
MOST_TOGETHER = 3
FIELD, SLIPPED = 0.1, 0.05


def by_prior(source: Source, index: int, marks: Plan) -> Hidden:
    """Return effects that act by chance, and now and then a field."""
    names = _acting(source)
    while len(names) > MOST_TOGETHER:
        names = _acting(source)
    causes = tuple((cause_of(name, _values(name, source)), 1.0) for name in names)
    if source.uniform() > FIELD:
        return Hidden(causes)
    return Hidden(causes, outside=PROCESS, outside_mm=float(source.choice(PROCESS_MM)))


def _acting(source: Source) -> tuple[str, ...]:
    names = [effect["name"] for effect in every_effect()]
    chances = [UNUSUAL if name in EVERY_MACHINE else EFFECT for name in names]
    acts = source.uniform(size=len(names)) < np.array(chances)
    return tuple(name for name, there in zip(names, acts, strict=True) if there)


def _values(effect: str, source: Source) -> dict[str, float]:
    """Return sizes that are half normal by the typical and half by the largest that was met."""
    words = next(each for each in every_effect() if each["name"] == effect)
    by_largest = source.uniform() < 0.5
    values = {}
    for parameter in words["parameters"]:
        largest = max(abs(parameter["low"]), abs(parameter["high"]))
        spread = largest if by_largest else parameter["typical"]
        usual = CHAIN.get(f"{effect}.{parameter['name']}", 0.0)
        value = usual + spread * float(source.standard_normal())
        while parameter["low"] == 0 and value < 0:
            value = usual + spread * float(source.standard_normal())
        if effect == "sled_friction":
            value = min(value, LARGEST_DRAG * parameter["typical"])
        values[parameter["name"]] = value
    return values


# The kinds.

_SLIPS_MM = (5.0, 10.0, 30.0)
_ANY_SLIP = tuple(Slip("turned", mm, where) for where in ("once", "repeated") for mm in _SLIPS_MM)
_SLIP_OF_PRIOR = tuple(Slip("turned", mm) for mm in _SLIPS_MM)
_COUNTS = ("nothing", "one effect", "two effects")
READ_AGAIN_MM = 0.4  # noise of boards with marks that are read again


def _kinds_of(world: str) -> Iterator[Kind]:
    single = f"one effect of {REAL_MM:g} mm"
    usual, two = "1 to 3 usual sizes", "two effects of 1 to 3 usual sizes"
    for marks in (9, 15, 25, 35):
        yield Kind(f"{world}/none-{marks}", "nothing", nothing, marks, is_cured=marks == 25)
    for marks in (9, 25):
        yield Kind(f"{world}/one-{marks}", single, raw(REAL_MM, REAL), marks, is_cured=True)
        draw = usual_sizes(1.0, 3.0, SMALL)
        yield Kind(f"{world}/typical-{marks}", usual, draw, marks, is_cured=True)
    larger = "1 to 1.5 times the largest that was met"
    yield Kind(f"{world}/beyond-25", larger, beyond_usual(1.0, 1.5, SMALL), is_cured=True)
    apart = f"two effects of {LARGE_MM:g} mm"
    yield Kind(f"{world}/pairs-25", apart, pairs(LARGE_MM, LARGE), is_cured=True)
    yield Kind(f"{world}/two-25", two, several(2, 1.0, 3.0, SMALL), is_cured=True)
    for marks in (9, 15, 25):
        yield Kind(f"{world}/field-{marks}", "2 mm of no effect", outside(2.0), marks)
    for count in (1, 2, 3):
        for bump in (0.3, 0.7):
            what = f"{count} of 1 to 3 usual sizes, and {bump:g} mm of no effect; noise 0.2"
            draw = besides(bump, several(count, 1.0, 3.0, SMALL))
            yield Kind(f"{world}/bump-{count}-{bump:g}", what, draw, noise=0.2, is_cured=True)
    yield from _slips_of(world)
    for marks in (15, 25):
        what = "effects, a field, a slip, drawn from the prior"
        yield Kind(
            f"{world}/prior-{marks}",
            what,
            by_prior,
            marks,
            slips=_SLIP_OF_PRIOR,
            slip_chance=SLIPPED,
        )
    for name, what, draw in (
        ("none", "nothing", nothing),
        ("typical", usual, usual_sizes(1.0, 3.0, SMALL)),
        ("two", two, several(2, 1.0, 3.0, SMALL)),
    ):
        yield Kind(f"{world}/other-{name}-25", f"{what}; other machine", draw, is_other=True)


def _slips_of(world: str) -> Iterator[Kind]:
    """Yield slips next to effects, and the same without a slip."""
    for count, words in enumerate(_COUNTS):
        draw = several(count, 1.0, 3.0, SMALL)
        for marks in (15, 25):
            yield Kind(
                f"{world}/slips-{count}-{marks}",
                f"a slip, {words}",
                draw,
                marks,
                READ_AGAIN_MM,
                repeats=True,
                slips=_ANY_SLIP,
            )
    what = "two effects, no slip"
    yield Kind(f"{world}/no-slips-2-25", what, draw, 25, READ_AGAIN_MM, repeats=True)


def _kinds() -> Iterator[Kind]:
    for world in WORLDS:
        yield from _kinds_of(world)
    what = "an effect on a usual machine"
    name = "stock/usual-one-25"
    yield Kind(name, what, usual_machine, 25, READ_AGAIN_MM, repeats=True, is_cured=True)


KINDS = {kind.name: kind for kind in _kinds()}
