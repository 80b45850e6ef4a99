"""Will the job fit? What is wrong with a program, what to expect of it, and where it goes on."""

from collections.abc import Sequence
from dataclasses import dataclass

from plumb.job.check import CheckedJob, Error, Fitness, Part
from plumb.job.dry_run import HALTS, IGNORED, SINKS, WAITS, Finding, Hanging, Slower
from plumb.job.fixes import FixedLine
from plumb.job.resume import Resumed
from plumb.job.wood import Piece
from plumb.model.predict import CANNOT_HANG, REACH_WORDS
from plumb.settings import GRAVITY
from plumb.text.answers import Internal, in_json, part
from plumb.text.values import INCH, INCHES, MM, Unit, time_text
from plumb.words import Part as Said
from plumb.words import Rows, Sentences

SHOWN = 12  # lines with the same fault, and parts in the table
PASSES = 8  # of a job that goes on, that are named
MEANING = (
    "Width and height: how much too large the part will come out; askew: how far its top lies too "
    "far right. Behind +-: what the marks leave open, 95 %."
)


@dataclass(frozen=True)
class JobAnswer:
    """Expectations of a program."""

    checked: Internal[CheckedJob]
    written: list[str]
    changed: tuple[FixedLine, ...]  # by --fix

    state = part("checked.state", Fitness)
    good = part("checked.is_good", bool)
    halted_at = part("checked.done.halted_at", int | None, "A line.")
    seconds = part("checked.times.whole", float)
    cutting_seconds = part("checked.times.cutting", float)
    rapid_seconds = part("checked.times.rapid", float)
    asked_seconds = part("checked.times.asked", float, "The cutting at the feeds of the program.")
    capped_seconds = part(
        "checked.times.capped", float, "The cutting at the feeds of the program, none above $15."
    )
    findings = part("checked.findings", tuple[Finding, ...])
    slower = part("checked.slower", tuple[Slower, ...])
    hanging = part("checked.hanging", Hanging | None, "Null where nothing is cut.")
    parts = part("checked.parts", tuple[Part, ...])
    piece = part("checked.piece", Piece | None, "Null where nothing is cut.")

    @in_json
    def moves(self) -> int:
        """The number of moves in the program."""
        return len(self.checked.done.moves)


def headline(checked: CheckedJob, name: str) -> str:
    """Return whether the program of this name can be cut."""
    if checked.state == "clean":
        return f"Nothing is wrong with {name}."
    found = [each for each in checked.findings if each.is_wrong or each.is_doubt]
    if checked.state == "doubtful":
        look = _lines(sorted({line for each in found for line in each.lines}))
        return f"Nothing is wrong with {name}, but look at line {look}."
    lines = {line for each in found if each.is_wrong for line in each.lines}
    if not lines:
        return f"{name} cuts where this machine is not usable."
    return f"{_count(len(lines), 'line')} of {name} {'is' if len(lines) == 1 else 'are'} wrong."


def runs_here(name: str) -> str:
    """Return the comment on the first line of a program that was changed for this machine."""
    return f"(plumb: {name} as this machine runs it) "


def all_of(checked: CheckedJob, unit: Unit) -> list[Said]:
    """Return what is wrong, the job, its parts, and what else is to be known."""
    wrong, notes = _wrong(checked), _notes(checked, unit)
    said: list[Said] = [Sentences(wrong)] if wrong else []
    said.append(Rows(["the job", "", ""], _job(checked, unit), words=[1, 2]))
    if checked.parts:
        said += _parts(checked, unit)
    return [*said, Sentences(notes)] if notes else said


def changes_said(changes: Sequence[FixedLine], name: str, fixed: str) -> tuple[str, Sentences]:
    """Return what was changed in a program: each pair of lines once, with its first line."""
    if not changes:
        return f"Nothing in {name} had to change; {fixed} holds the same.", Sentences([])
    alike: dict[tuple[str, str], list[FixedLine]] = {}
    for each in changes:
        alike.setdefault((each.before, each.after), []).append(each)
    said = [
        f"line {_lines([each.line for each in those])}: {before} -> {after or 'nothing'} "
        f"({those[0].why})"
        for (before, after), those in alike.items()
    ]
    head = f"{fixed} cuts the same, with {_count(len(changes), 'line')} changed:"
    return head, Sentences(_first(said))


def goes_on(resumed: Resumed, name: str, unit: Unit) -> Sentences:
    """Return where a job goes on."""
    x, y, z = resumed.begins
    where = f"X{unit.bare(x)} Y{unit.bare(y)}" + (" inch" if unit == INCHES else "")
    if resumed.entry is None:
        free = f"{name} goes on with line {resumed.first}, from {where}, where the bit was free."
        return Sentences([free], "")
    where = f"{where}, {unit.worded(-z)} deep"
    said = [f"{name} goes on in the middle of line {resumed.first}, at {where}."]
    others = [line for line in resumed.entry.passes if line != resumed.first]
    if others:
        more = " and more" if others[PASSES:] else ""
        named = ", ".join(map(str, others[:PASSES])) + more
        said.append(f"It cuts there again at line {named}: --line picks that pass.")
    return Sentences(said, "")


def _wrong(checked: CheckedJob) -> list[str]:
    """Return each wrong line, and where no sled should cut."""
    halts = {HALTS: "the machine halts: "}
    said = _first(
        [
            f"{_where(each)}: {halts.get(each.kind, '')}{each.says}"
            for each in checked.findings
            if each.is_wrong
        ]
    )
    if checked.done.halted_at is not None:
        said.append(f"behind line {checked.done.halted_at} nothing was looked at")
    for bad in checked.hanging.bad if checked.hanging else ():
        who = "the sled" if bad.verdict == REACH_WORDS[CANNOT_HANG] else "a chain is"
        share = f"{100 * bad.share:.1f} %"
        said.append(f"from line {bad.first} on, {share} of the cuts lie where {who} {bad.verdict}")
    return said


def _where(finding: Finding) -> str:
    if finding.count == 1:
        return f"line {finding.line}"
    return f"{finding.count} lines from line {finding.line} on"


def _job(checked: CheckedJob, unit: Unit) -> list[list[str]]:
    times, piece, hanging = checked.times, checked.piece, checked.hanging
    asked, capped = time_text(times.asked), time_text(times.capped)
    # The cutting without acceleration, arcs, z and chains.
    feeds = f"{asked} at the feeds asked for"
    feeds += "" if asked == capped else f", {capped} with none above $15"
    rows = [
        ["time", time_text(times.whole), "without the operator's pauses"],
        ["cutting", time_text(times.cutting), feeds],
    ]
    if piece is not None:
        several = " and ".join(sorted({unit.brief(bit.diameter) for bit in piece.bits}))
        usual = "" if piece.is_said else ", the usual; --bit says otherwise"
        inches = f"{piece.removed / INCH**3:.2f} cubic inches"
        removed = f"{piece.removed / 1000:.1f} cm3" if unit == MM else inches
        rows.append(["deepest", unit.worded(piece.deepest), f"at line {piece.line}"])
        rows.append(["removed", removed, f"with a bit of {several}{usual}"])
    if hanging is not None:
        slack, tight = hanging.tension
        push = f"by a push of 1 kg on the bit, most at line {hanging.give_line}"
        rows.append(["chains", f"{slack:.0f} to {tight:.0f} N", "slackest and tightest"])
        rows.append(["give", unit.worded(GRAVITY * hanging.give), push])
    return rows


def _parts(checked: CheckedJob, unit: Unit) -> list[Said]:
    header = ["part", "lines", "size", "deep"]
    header += ["width", "height", "askew"] if checked.has_errors else []
    rows = []
    for number, each in enumerate(checked.parts, start=1):
        size = " x ".join(unit.bare(side, 1) for side in each.size)
        errors = (each.width_error, each.height_error, each.skew) if checked.has_errors else ()
        lines = f"{each.first_line}-{each.last_line}"
        cells = [str(number), lines, size, unit.bare(-each.deepest)]
        rows.append([*cells, *(_error(error, unit) for error in errors)])
    words = [f"Sizes by the middle of the bit, {unit.name}."]
    words += [MEANING] if checked.has_errors else []
    more = len(rows) - SHOWN
    words += [f"And {more} more parts; --json has all."] if more > 0 else []
    return [Rows(header, rows[:SHOWN]), Sentences(words, "")]


def _error(error: Error | None, unit: Unit) -> str:
    return "-" if error is None else f"{unit.signed(error.mm)} +-{unit.bare(error.within)}"


def _notes(checked: CheckedJob, unit: Unit) -> list[str]:
    by_kind = {
        kind: [each for each in checked.findings if each.kind == kind]
        for kind in (WAITS, SINKS, IGNORED)
    }
    notes = [
        f"{_count(each.moves, 'move')} slower than the program asks, by {each.because}: line "
        f"{each.line} asks for {_feed(each.asked, unit)} {unit.name}/min and gets "
        f"{_feed(each.feed, unit)}"
        for each in checked.slower
    ]
    notes += [f"the machine waits for you at line {_lines(each.lines)}" for each in by_kind[WAITS]]
    notes += [f"line {each.line}: {each.says}" for each in by_kind[SINKS]]
    ignored = "means nothing to this machine and is passed over"
    notes += [f"{each.says} {ignored}: {_count(each.count, 'line')}" for each in by_kind[IGNORED]]
    if not checked.has_errors and checked.parts:
        notes.append("to know how well the parts will fit, give --marks with this machine's marks")
    return [*notes, *(checked.hanging.assumed if checked.hanging else ())]


def _feed(feed: float, unit: Unit) -> str:
    """Return a feed [mm/min] in the unit of lengths."""
    return f"{feed:.0f}" if unit == MM else f"{feed / INCH:.1f}"


def _first(said: list[str]) -> list[str]:
    more = len(said) - SHOWN
    return said[:SHOWN] + ([f"and {more} more; --json has all"] if more > 0 else [])


def _lines(numbers: Sequence[int]) -> str:
    first = ", ".join(map(str, numbers[:SHOWN]))
    return first if len(numbers) <= SHOWN else f"{first} and {len(numbers) - SHOWN} more"


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}" + ("" if number == 1 else "s")
