"""Tables of the gates, before and after: the lines to be reached, every kind, stated chances."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

from gate_kinds import KINDS
from gate_rates import (
    MEASURES,
    PRIOR,
    STATED,
    Measure,
    Rate,
    Stated,
    bins_of,
    brier,
    is_plain,
    rate_of,
    stated_of,
)
from gate_records import Record
from plumb.bench.outcome import Line
from plumb.bench.outcome import Rate as BenchRate
from plumb.diagnosis.answer import UNKNOWN
from tables import markdown_table

Records = Sequence[Record]
SURE = 2.0  # standard errors by which a rate must change to be called another
CALLED_FROM = (UNKNOWN, 1 / 4, 1 / 3, 1 / 2)  # chances of a field
SMALL = 0.03  # a share that is said with a digit more
FEWEST = 30  # stated chances in a bin that is judged
PLAIN = ("invented", "named", "best", "exact", "first", "inside", "sets", "causes", "needless")
PLAIN_TOO = ("strange", "interval", "limit", "cure", "auto", "CPU s")
OTHERS = ("flagged", "not in library", "small slip", "large slip", "false slip", "CPU s")


@dataclass(frozen=True)
class Gate:
    """A line to be reached by a rate over boards of some kinds."""

    name: str
    measure: str
    kinds: tuple[str, ...]  # ends or whole names, without the world
    line: Line


_ONE_25 = ("one-25", "typical-25")
_EFFECTS_25 = (*_ONE_25, "pairs-25", "two-25", "other-typical-25", "other-two-25")
_EFFECTS_9 = ("one-9", "typical-9")
_NONE = ("none-9", "none-15", "none-25", "none-35", "other-none-25")
_CURED = (*_ONE_25, "pairs-25", "two-25", "usual-one-25")
_SLIPS = tuple(f"slips-{count}-{marks}" for count in range(3) for marks in (15, 25))
_FIELDS = ("field-9", "field-15", "field-25")
_ALL = tuple(dict.fromkeys(name.partition("/")[2] for name in KINDS))
GATES = (
    Gate("nothing hidden, an effect named", "invented", _NONE, Line("", most=0.04)),
    Gate("best holds the truth, 25 marks", "best", _EFFECTS_25, Line("", least=0.97)),
    Gate("best holds the truth, 9 marks", "best", _EFFECTS_9, Line("", least=0.92)),
    Gate("exact", "exact", (*_EFFECTS_25, *_EFFECTS_9), Line("", least=0.90)),
    Gate("usual machine, that effect first", "first", ("usual-one-25",), Line("", least=0.92)),
    Gate("truth inside", "inside", (*_EFFECTS_25, *_EFFECTS_9), Line("", least=0.93, most=0.97)),
    Gate("truth inside, beyond usual", "inside", ("beyond-25",), Line("", least=0.93, most=0.97)),
    Gate("sets listed", "sets", (*_EFFECTS_25, *_EFFECTS_9), Line("")),
    Gate("needless causes", "needless", _ALL, Line("")),
    Gate("a known board called strange", "strange", _ALL, Line("", most=0.005)),
    Gate("2 mm flagged, 15 marks", "flagged", ("field-15",), Line("", least=0.95)),
    Gate("2 mm flagged, 25 marks", "flagged", ("field-25",), Line("", least=0.95)),
    Gate("2 mm flagged, 9 marks", "flagged", ("field-9",), Line("", least=0.85)),
    Gate("slips of 5 mm named", "small slip", _SLIPS, Line("")),
    Gate("slips of 10 and 30 mm named", "large slip", _SLIPS, Line("")),
    Gate("false slips", "false slip", _ALL, Line("")),
    Gate("error over that of the truth", "cure", _CURED, Line("", most=1.3)),
    Gate("the same by add auto", "auto", _CURED, Line("", most=1.3)),
    Gate("CPU, 35 marks [s]", "CPU s", ("none-35",), Line("", most=0.1)),
    Gate("add auto ends in a traceback", "failed", _ALL, Line("", most=0.0)),
)


def tables(sides: Sequence[Records]) -> str:
    """Return all tables of records, or of those before and those after."""
    parts = [
        "## Gates",
        _gates(sides),
        "## Boards with neither a field nor a slip",
        _kinds(sides, (*PLAIN, *PLAIN_TOO), is_of_plain=True),
        "## Fields and slips",
        _kinds(sides, OTHERS, is_of_plain=False),
    ]
    if len(sides) > 1:
        parts += ["## Changes beyond chance", _changes(sides)]
    parts += ["## If a field were called from other odds", _called_later(sides[-1])]
    for where, kinds in (("drawn from the prior", (PRIOR,)), ("of all kinds", ("",))):
        chosen = [[record for record in side if _has(record, kinds)] for side in sides]
        parts += [f"## Stated chances on boards {where}", _chances(chosen)]
    return "\n\n".join(parts)


def _has(record: Record, parts: Iterable[str]) -> bool:
    return any(part in record.kind for part in parts)


def _gates(sides: Sequence[Records]) -> str:
    rows = []
    for gate in GATES:
        for world in ("known", "stock"):
            kinds = {f"{world}/{kind}" for kind in gate.kinds}
            measure = MEASURES[gate.measure]
            rates = [_rate(measure, side, kinds) for side in sides]
            if any(rates):
                last = rates[-1]
                judged = gate.line.judge(_as_bench(last)) if last and _is_line(gate.line) else ""
                words = gate.line.words if _is_line(gate.line) else ""
                count = f"{last.count:.0f}" if last and measure.is_share else ""
                rows.append([gate.name, world, words, count, _cell(measure, rates), judged])
    header = ("gate", "world", "line", "of", _sides(sides), "")
    return markdown_table(header, rows)


def _is_line(line: Line) -> bool:
    return line.least is not None or line.most is not None


def _as_bench(rate: Rate) -> BenchRate:
    return BenchRate("", rate.value, rate.error, int(rate.count))


def _rate(measure: Measure, side: Records, kinds: set[str]) -> Rate | None:
    return rate_of(measure, [record for record in side if record.kind in kinds])


def _sides(sides: Sequence[Records]) -> str:
    return "before → after" if len(sides) > 1 else "now"


def _kinds(sides: Sequence[Records], names: Sequence[str], *, is_of_plain: bool) -> str:
    """Return a row for each kind that has such boards."""
    measures = [MEASURES[name] for name in names]
    rows: list[list[object]] = []
    for kind in KINDS:
        of_kind = [[record for record in side if record.kind == kind] for side in sides]
        boards = [record for side in of_kind for record in side]
        if not any(is_plain(record) == is_of_plain for record in boards):
            continue
        cells = [
            _cell(measure, [rate_of(measure, side) for side in of_kind]) for measure in measures
        ]
        rows.append([kind, max(map(len, of_kind)), *cells])
    return markdown_table(("kind", "boards", *names), rows)


def _cell(measure: Measure, rates: Sequence[Rate | None]) -> str:
    """Return a rate with its standard error, in percent if it is a share; bold if it changed."""
    if not any(rates):
        return "-"
    said = " → ".join(_words(measure, rate) for rate in rates)
    return f"**{said}**" if _change(rates) else said


def _words(measure: Measure, rate: Rate | None) -> str:
    if rate is None:
        return "-"
    if measure.is_share:
        digits = 1 if rate.value < SMALL else 0
        return f"{100 * rate.value:.{digits}f}±{100 * rate.error:.{digits}f}"
    return f"{rate.value:.2f}±{rate.error:.2f}"


def _change(rates: Sequence[Rate | None]) -> int:
    """Return 1 where a rate grew beyond chance, -1 where it fell."""
    before, after = rates[0], rates[-1]
    if before is None or after is None or len(rates) < 2:
        return 0
    change, error = after.difference(before)
    if abs(change) <= SURE * error or not change:
        return 0
    return 1 if change > 0 else -1


def _changes(sides: Sequence[Records]) -> str:
    """Return what became better and worse, kind by kind."""
    rows: list[list[str]] = []
    for kind in KINDS:
        for measure in MEASURES.values():
            rates = [_rate(measure, side, {kind}) for side in sides]
            change = _change(rates) * measure.better
            if change:
                words = "better" if change > 0 else "worse"
                rows.append([kind, measure.name, _cell(measure, rates), words])
    rows.sort(key=lambda row: row[3], reverse=True)
    return markdown_table(("kind", "rate", _sides(sides), ""), rows)


def _called_later(records: Records) -> str:
    """Return what the bound of `not_in_library` decides: boards called strange, and fields seen."""
    measured = [("strange", "strange", _ALL)]
    for kind in _FIELDS:
        measured.append((f"flagged, {kind.rpartition('-')[2]} marks", "flagged", (kind,)))
    columns = [
        (f"{words}, {world}", MEASURES[name], {f"{world}/{kind}" for kind in kinds})
        for words, name, kinds in measured
        for world in ("known", "stock")
    ]
    rows = []
    for chance in CALLED_FROM:
        said = [_unless_likelier(record, chance) for record in records]
        cells = [_cell(measure, [_rate(measure, said, kinds)]) for _, measure, kinds in columns]
        rows.append([f"1 to {1 / chance - 1:g}", *cells])
    return markdown_table(("from odds of", *(words for words, _, _ in columns)), rows)


def _unless_likelier(record: Record, chance: float) -> Record:
    """Return what would be said of a board if a field had to be so likely."""
    if record.verdict != "not_in_library" or not UNKNOWN < (record.field_chance or 0.0) <= chance:
        return record
    return replace(record, verdict="cannot_tell")


def _chances(sides: Sequence[Records]) -> str:
    """Return bins of stated chances and how often they came true."""
    rows: list[list[str]] = []
    for what in STATED:
        for number, side in enumerate(sides):
            name = ("before", "after")[number] if len(sides) > 1 else "now"
            rows += _bins(what, name, stated_of(what, side))
    header = ("chance of", "", "from", "to", "stated %", "came true %", "of", "")
    return markdown_table(header, rows)


def _bins(what: str, side: str, stated: Sequence[Stated]) -> Iterator[list[str]]:
    for each in bins_of(stated):
        off = abs(each.stated - each.seen)
        judged = ""
        if each.count >= FEWEST:
            judged = "within 5" if off <= 0.05 else "open" if off <= SURE * each.error else "off"
        yield [
            what,
            side,
            f"{100 * each.low:g}",
            f"{100 * each.high:g}",
            f"{100 * each.stated:.1f}",
            f"{100 * each.seen:.1f}±{100 * each.error:.1f}",
            f"{each.count}",
            judged,
        ]
    if stated:
        yield [what, side, "", "", "Brier", f"{brier(stated):.3f}", f"{len(stated)}", ""]
