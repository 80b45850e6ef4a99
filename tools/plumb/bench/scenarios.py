"""The scenarios of the bench, and the lines that a diagnosis should reach in each."""

from __future__ import annotations

from dataclasses import dataclass

from plumb.bench.boards import plan
from plumb.bench.causes import CAUSES, MAKER, PUBLISHED, Plan
from plumb.bench.hiding import (
    HUGE,
    LARGE,
    REAL,
    SMALL,
    Hide,
    Slip,
    nothing,
    outside,
    pairs,
    raw,
    several,
    typical,
    usual_machine,
)
from plumb.bench.outcome import Line
from plumb.settings.machine import MachineSettings

GRIDS = {9: (3, 3), 15: (5, 3), 25: (5, 5), 35: (7, 5)}
QUIET = Line("false naming", most=0.05)
INSIDE = Line("truth inside", least=0.935, most=0.965)


@dataclass(frozen=True)
class Scenario:
    """Boards of one kind."""

    name: str
    what: str  # is hidden, in a few words
    hide: Hide
    lines: tuple[Line, ...] = ()  # to be reached
    marks: int = 25
    noise: float = 0.5  # [mm]
    stated: float | None = 0.5  # [mm] what the file says of it
    repeats: bool = False  # three marks are read three times, which gives 12 degrees of freedom
    spans: bool = False  # distances between all marks instead of places
    slips: tuple[Slip, ...] = ()  # of a reading, in turns
    shown: tuple[str, ...] = ()  # rates without a line that are worth a look
    settings: MachineSettings = MAKER  # in force when the board is cut
    cured: bool = False  # whether the sled is measured too, with what was named added
    rounds: int = 0  # in which the best proposal of `plumb next` is carried out

    @property
    def plan(self) -> Plan:
        """Its marks."""
        return plan(*GRIDS[self.marks], repeats=self.repeats, spans=self.spans)

    @property
    def noise_words(self) -> str:
        """Its noise, and where the lab has it from."""
        if self.repeats:
            said = "from repeats" if self.stated is None else f"{self.stated:g} stated, repeats"
        else:
            said = "stated" if self.stated == self.noise else f"{self.stated:g} stated"
        return f"{self.noise:g} mm, {said}"


def _first(least: float, most: float) -> tuple[Line, ...]:
    return (Line("right class first", least=least), Line("suspects", most=most), INSIDE)


def _unknown(least: float) -> tuple[Line, ...]:
    return (Line("flagged", least=least),)


_NONE = "2 mm of no effect"
_ONE = "one effect of 3 mm"
_MORE = ("named", "interval holds", "limit holds")
_SLIP = (Line("slip named", least=0.99), Line("effect named first", most=0.01))

_ANY_SLIP = tuple(
    Slip("turned", millimetres, where)
    for where in ("once", "repeated")
    for millimetres in (5.0, 10.0, 30.0)
)
_NO_SLIP = Line("false slip", most=0.01)
_COUNTS = {1: "one effect", 2: "two effects"}


def _slips(count: int, marks: int) -> Scenario:
    """Slips of any size on a machine with several effects of usual sizes."""
    small = (Line("small slip named", least=0.95),) if marks == 25 else ()
    return Scenario(
        f"slips-{count}-{marks}",
        f"{_COUNTS[count]} of 1 to 3 usual sizes, slips of 5, 10 and 30 mm",
        several(count, 1.0, 3.0, SMALL),
        (Line("large slip named", least=0.99), *small, _NO_SLIP),
        marks=marks,
        noise=0.4,
        stated=0.4,
        repeats=True,
        slips=_ANY_SLIP,
        shown=() if small else ("small slip named",),
    )


def _no_slips(count: int) -> Scenario:
    """Return the same without a slip."""
    return Scenario(
        f"no-slips-{count}",
        f"{_COUNTS[count]} of 1 to 3 usual sizes",
        several(count, 1.0, 3.0, SMALL),
        (_NO_SLIP,),
        noise=0.4,
        stated=0.4,
        repeats=True,
        shown=("named", "truth inside", "both"),
    )


SCENARIOS: tuple[Scenario, ...] = (
    Scenario("none-9", "nothing", nothing, (QUIET,), marks=9, shown=("silent",)),
    Scenario("none-15", "nothing", nothing, (QUIET,), marks=15, shown=("silent",)),
    Scenario("none-25", "nothing", nothing, (QUIET,), shown=("silent",), cured=True),
    Scenario("none-35", "nothing", nothing, (QUIET,), marks=35, shown=("silent",)),
    Scenario(
        "none-repeats", "nothing", nothing, (QUIET,), stated=None, repeats=True, shown=("silent",)
    ),
    Scenario("none-quiet", "nothing", nothing, (QUIET,), noise=0.2, stated=0.2),
    Scenario("none-loud", "nothing", nothing, (QUIET,), noise=1.0, stated=1.0),
    Scenario("none-spans", "nothing", nothing, (QUIET,), marks=9, spans=True),
    Scenario("none-wrong", "nothing", nothing, (QUIET,), stated=0.33, repeats=True),
    Scenario("none-wrong-blind", "nothing", nothing, stated=0.33, shown=("false naming", "silent")),
    Scenario("one-9", _ONE, raw(3.0, REAL), _first(0.87, 2.4), marks=9, shown=_MORE, cured=True),
    Scenario("one-15", _ONE, raw(3.0, REAL), (INSIDE,), marks=15, shown=("right class first",)),
    Scenario("one-25", _ONE, raw(3.0, REAL), _first(0.93, 1.8), shown=_MORE, cured=True),
    Scenario("one-35", _ONE, raw(3.0, REAL), (INSIDE,), marks=35, shown=("right class first",)),
    Scenario(
        "one-repeats",
        _ONE,
        raw(3.0, REAL),
        (INSIDE,),
        stated=None,
        repeats=True,
        shown=("right class first", "suspects"),
    ),
    Scenario("one-quiet", _ONE, raw(3.0, REAL), (INSIDE,), noise=0.2, stated=0.2),
    Scenario(
        "one-loud",
        _ONE,
        raw(3.0, REAL),
        (INSIDE,),
        noise=1.0,
        stated=1.0,
        shown=("right class first", "suspects"),
    ),
    Scenario(
        "one-spans",
        _ONE,
        raw(3.0, tuple(cause for cause in REAL if not cause.skew)),
        (INSIDE,),
        marks=9,
        spans=True,
        shown=("right class first", "suspects"),
    ),
    Scenario(
        "huge-25",
        "lean or runout of 3 mm, which no machine has",
        raw(3.0, HUGE),
        (INSIDE,),
        shown=("right class first", "suspects"),
    ),
    Scenario(
        "typical-9", "1 to 3 usual sizes", typical(1, 3, CAUSES), (INSIDE,), marks=9, cured=True
    ),
    Scenario(
        "typical-25", "1 to 3 usual sizes", typical(1, 3, SMALL), (INSIDE,), shown=_MORE, cured=True
    ),
    Scenario(
        "pairs-25",
        "two effects of 6 mm",
        pairs(6.0, LARGE),
        (Line("both", least=0.90),),
        shown=("named", "truth inside"),
        cured=True,
    ),
    Scenario(
        "pairs-huge",
        "the same, also sizes that no machine has",
        pairs(6.0, REAL),
        (Line("both", least=0.90),),
        shown=("named", "truth inside"),
    ),
    Scenario("unknown-9", _NONE, outside(2.0), _unknown(0.92), marks=9, shown=("false slip",)),
    Scenario("unknown-15", _NONE, outside(2.0), _unknown(0.97), marks=15, shown=("false slip",)),
    Scenario("unknown-25", _NONE, outside(2.0), _unknown(0.97), shown=("false slip",)),
    Scenario("slip-9", "a slip of 5 mm", nothing, _SLIP, marks=9, slips=(Slip("turned"),)),
    Scenario("slip-25", "a slip of 5 mm", nothing, _SLIP, slips=(Slip("turned"),)),
    Scenario("slip-digits", "two digits exchanged", nothing, _SLIP, slips=(Slip("digits"),)),
    Scenario("slip-axes", "x and y exchanged", nothing, _SLIP, slips=(Slip("axes"),)),
    Scenario(
        "slip-one-25",
        "a slip of 5 mm, an effect of 3 mm",
        raw(3.0, REAL),
        _SLIP,
        slips=(Slip("turned"),),
    ),
    Scenario(
        "slip-one-9",
        "a slip of 5 mm, an effect of 3 mm",
        raw(3.0, REAL),
        marks=9,
        slips=(Slip("turned"),),
        shown=("slip named", "effect named first"),
    ),
    Scenario(
        "usual-25",
        "stretch that the settings leave out, one or two effects of usual size, friction, backlash",
        usual_machine,
        (
            Line("named", least=0.85),
            Line("truth covered", least=0.93, most=0.97),
            Line("not in library", most=0.05),
            Line("invented", most=0.05),
        ),
        noise=0.4,
        stated=0.4,
        repeats=True,
        shown=("right class first", "suspects", "false slip"),
        settings=PUBLISHED,
        cured=True,
    ),
    *(
        Scenario(
            f"loop-{name}",
            f"{what}; two rounds of what is proposed",
            hide,
            marks=marks,
            shown=("right class first", "named"),
            settings=settings,
            cured=True,
            rounds=2,
        )
        for name, what, hide, marks, settings in (
            ("one-9", _ONE, raw(3.0, REAL), 9, MAKER),
            ("typical-9", "1 to 3 usual sizes", typical(1, 3, CAUSES), 9, MAKER),
            ("pairs-25", "two effects of 6 mm", pairs(6.0, LARGE), 25, MAKER),
            ("usual-15", "as usual-25", usual_machine, 15, PUBLISHED),
        )
    ),
    *(_slips(count, marks) for count in (1, 2) for marks in (9, 15, 25, 35)),
    *(_no_slips(count) for count in (1, 2)),
)
NAMES = tuple(scenario.name for scenario in SCENARIOS)
CURE = Line("error over that of the known truth", most=1.3)
LOOP = Line(CURE.name, most=1.1)  # after two rounds
