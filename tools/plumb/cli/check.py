"""`plumb check`: runs a program dry, and says what to expect of it."""

import argparse
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from plumb.cli.arguments import PROGRAM, add_shared, file, length, unit_of
from plumb.cli.inputs import inputs_of, picture_form
from plumb.cli.output import refuse_twins, say_failure, write_outputs
from plumb.cli.screen import (
    BAD,
    GOOD,
    bar,
    free_name,
    headline,
    next_step,
    print_json,
    sentences,
    table,
)
from plumb.cure.live_board import refuse_other_origin
from plumb.fit.inputs import Inputs, settings_in
from plumb.job.bits import INCH, Tools
from plumb.job.check import CheckedJob, Error, Part, check_job
from plumb.job.dry_run import comment_of, outline_of, program_in
from plumb.job.findings import HALTS, IGNORED, SINKS, WAITS, Finding, Hanging, Slower, Times
from plumb.job.fixes import FixedLine, fixed, has_habit
from plumb.job.resume import JobMachine
from plumb.job.wood import Piece
from plumb.model.predict import CANNOT_HANG, REACH_WORDS
from plumb.pictures.drawing import BAD as WRONG
from plumb.pictures.drawing import GOOD as CUT
from plumb.pictures.drawing import NOWHERE, QUIET, Corners, Dot, Panel, Ways, draw, shades_of
from plumb.settings.machine import GRAVITY, MachineSettings
from plumb.text.answers import Internal, in_json, part
from plumb.text.values import MM, Unit, time_text

NAMED = 30  # parts that get their number in the picture


@dataclass(frozen=True)
class JobAnswer:
    """Expectations of a program."""

    checked: Internal[CheckedJob]
    written: list[str]
    changed: tuple[FixedLine, ...]  # by --fix

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


def run(arguments: argparse.Namespace) -> int:
    """Check, draw, print, and return the exit code."""
    refuse_twins(arguments.picture, arguments.outline, arguments.fix)
    form = picture_form(arguments.picture) if arguments.picture else ""
    settings = settings_in(arguments.settings)
    arguments.controller = None
    lines = program_in(arguments.job, say=say_failure)
    inputs = inputs_of(arguments) if arguments.marks else None
    if inputs:
        refuse_other_origin(inputs)
    unit = inputs.unit if inputs else unit_of(arguments)
    checked = _checked(arguments, settings, lines, inputs)
    files, changes = {}, tuple[FixedLine, ...]()
    if arguments.fix:
        machine = JobMachine(settings, (*arguments.start, 0.0), dict(arguments.set))
        mended = fixed(machine, lines, checked.findings, source=arguments.job)
        changes = mended.changes
        # In front of the first line, so that each line keeps its number.
        title = f"(plumb: {comment_of(Path(arguments.job).name)} as this machine runs it) "
        files[arguments.fix] = (title + "\n".join([*mended.lines, ""])).encode()
        checked = _checked(arguments, settings, mended.lines, inputs) if changes else checked
    if arguments.picture:
        files[arguments.picture] = _picture(checked, settings, arguments.job, unit, form=form)
    if arguments.outline:
        outline = outline_of(checked.over_sheet, checked.samples, name=Path(arguments.job).name)
        files[arguments.outline] = outline.encode()
    write_outputs(files, inputs=[arguments.job, arguments.settings, *arguments.marks])
    if arguments.json:
        print_json(JobAnswer(checked, list(files), changes))
    else:
        if arguments.fix:
            print(f"{_changed(changes, arguments)}\n")
        print(as_text(checked, arguments, unit))
    return 0 if checked.is_good else 1


def _checked(
    arguments: argparse.Namespace,
    settings: MachineSettings,
    lines: Sequence[str],
    inputs: Inputs | None,
) -> CheckedJob:
    return check_job(
        settings,
        lines,
        inputs=inputs,
        numbers=dict(arguments.set),
        tools=Tools.of(
            lines,
            diameter=arguments.bit,
            length=arguments.bit_length,
            thickness=arguments.thickness,
        ),
        start=(*arguments.start, 0.0),
        progress=bar("running the program dry"),
    )


def _picture(
    checked: CheckedJob, settings: MachineSettings, name: str, unit: Unit, *, form: str
) -> bytes:
    """Return the whole sheet with the job on it, and below it the job from near."""
    sheet = sheet_of(checked, settings, name)
    meaning = "Blue: the bit in the wood; grey: above the sheet; orange: wrong, or not usable"
    piece = checked.piece
    depth = f"; brown: the wood, cut up to {unit.worded(piece.deepest)} deep." if piece else "."
    near = replace(sheet, title="From near", view=near_view(checked))
    panels = [replace(sheet, dots=()), near]
    words = [f"{meaning}{depth}"]
    return draw(panels, sheet=settings.sheet, words=words, columns=1, form=form)


def sheet_of(checked: CheckedJob, settings: MachineSettings, name: str) -> Panel:
    """Return the sheet with the job: its ways by their kind, its parts by number, its depth."""
    over_sheet, samples, piece = checked.over_sheet, checked.samples, checked.piece
    ways = np.split(samples.places, np.flatnonzero(np.diff(samples.move)) + 1)
    spoiled = {line for finding in checked.findings if finding.is_wrong for line in finding.lines}
    bad = np.isin(over_sheet["line"], list(spoiled))
    if checked.hanging is not None:
        # Above the sheet the sled may pass where it could not cut.
        passing = checked.hanging.unusable
        bad[passing] |= over_sheet.cut[passing]
    kinds = np.where(bad, "bad", np.where(over_sheet.cut, "cut", "rapid"))
    of = {
        kind: [way for way, each in zip(ways, kinds, strict=True) if each == kind]
        for kind in ("rapid", "cut", "bad")
    }
    labels = [
        Dot((part.low[0] + part.high[0]) / 2, (part.low[1] + part.high[1]) / 2, f"{i}", size=0)
        for i, part in enumerate(checked.parts[:NAMED], start=1)
    ]
    # Straight down is no line from above.
    down = [way[0] for way in of["bad"] if np.ptp(way, axis=0).max() < POINT]
    dots = [Dot(x, y, colour=WRONG) for x, y in down]
    verdict = "nothing is wrong" if checked.is_good else "something is wrong"
    return Panel(
        title=f"{Path(name).name}: {verdict}",
        good=checked.is_good,
        ways=[
            Ways(of["rapid"], QUIET, 0.6, "--"),
            Ways(of["cut"], CUT, 0.7),
            Ways(of["bad"], WRONG, 2.4),
        ],
        dots=[*labels, *dots],
        shades=shades_of(-piece.heights / (piece.deepest or 1.0)) if piece else None,
        shaded=_corners(piece.corners) if piece else NOWHERE,
    )


POINT, LEAST, FREE = 0.1, 20.0, 0.08  # [mm] of a way, of wood from near; of the job's size


def near_view(checked: CheckedJob) -> Corners:
    """Return what of the sheet is shown from near: the job with a little around it."""
    piece = checked.piece
    cut = checked.samples.places[checked.over_sheet.cut[checked.samples.move]]
    places = np.vstack([cut if len(cut) else np.zeros((1, 2)), piece.corners if piece else cut])
    low, high = places.min(axis=0), places.max(axis=0)
    half = np.maximum((high - low) / 2 * (1 + 2 * FREE), LEAST / 2)
    # No flatter than a quarter, and no higher than it is wide.
    half = np.maximum(half, [half[1], half[0] / 4])
    return _corners(np.array([(low + high) / 2 - half, (low + high) / 2 + half]))


def _corners(corners: np.ndarray) -> Corners:
    (left, low), (right, high) = corners.tolist()
    return (left, low), (right, high)


# The arguments of `plumb check`.

EXAMPLES = (
    "plumb check pocket.nc machine.toml",
    "plumb check pocket.nc machine.toml --marks marks.toml --picture job.png",
)
EXIT = "Exit: 0 nothing is wrong; 1 something is; 2 an input cannot be used."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `plumb check`."""
    add_shared(parser, *PROGRAM)
    parser.add_argument(
        "--marks",
        metavar="MARKS",
        type=file,
        action="append",
        default=[],
        help="measured marks of this machine: they tell which errors to expect of each part",
    )
    add_shared(parser, "--cut-with")
    for option, of, usual in (
        ("--bit", "diameter of the bit", "what JOB says, else 6.35"),
        ("--bit-length", "how long the bit cuts", "what JOB says"),
        ("--thickness", "how thick the sheet is", "what JOB says, else 19.05"),
    ):
        parser.add_argument(option, metavar="MM", type=length, help=f"{of} [{usual}]")
    add_shared(parser, picture="draw the job on its sheet, shaded by depth")
    parser.add_argument(
        "--outline",
        metavar="FILE",
        help="write a program that goes round the job, slowly, with the bit above the sheet",
    )
    parser.add_argument(
        "--fix",
        metavar="FILE",
        help="write a program that cuts the same on this machine, and list what was changed",
    )
    add_shared(parser, "--force", "--units", "--json")


# What `plumb check` says to people.

SHOWN = 12  # lines with the same fault
PARTS = 12  # parts in the table


def as_text(checked: CheckedJob, arguments: argparse.Namespace, unit: Unit) -> str:
    """Return the check for people: what is wrong, the job, its parts, what to do next."""
    name = Path(arguments.fix or arguments.job).name
    paragraphs = [headline(_verdict(checked, name), GOOD if checked.is_good else BAD)]
    wrong = _wrong(checked)
    if wrong:
        paragraphs.append(sentences(wrong))
    paragraphs.append(_job(checked, unit))
    if checked.parts:
        paragraphs.append(_parts(checked, unit))
    notes = _notes(checked, unit)
    if notes:
        paragraphs.append(sentences(notes))
    if has_habit(checked.findings):
        words = "To write an equal program that this machine runs:"
        name = free_name("mended", ".nc")
        fix = ["check", arguments.job, arguments.settings, "--fix", name]
        paragraphs.append(next_step(words, fix))
    if arguments.outline:
        words = "See where it will cut, with the bit above the sheet:"
        paragraphs.append(next_step(words, ["send", arguments.outline]))
    return "\n\n".join(filter(None, paragraphs))


def _changed(changes: Sequence[FixedLine], arguments: argparse.Namespace) -> str:
    """Return what was changed: each pair of lines once, with its first line."""
    name = Path(arguments.fix).name
    if not changes:
        return f"Nothing in {Path(arguments.job).name} had to change; {name} holds the same."
    alike: dict[tuple[str, str], list[FixedLine]] = {}
    for each in changes:
        alike.setdefault((each.before, each.after), []).append(each)
    said = []
    for (before, after), those in alike.items():
        lines = _lines([each.line for each in those])
        said.append(f"line {lines}: {before} -> {after or 'nothing'} ({those[0].why})")
    more = len(said) - SHOWN
    said = said[:SHOWN] + ([f"and {more} more; --json has all"] if more > 0 else [])
    head = f"{name} cuts the same, with {_count(len(changes), 'line')} changed:"
    return f"{head}\n{sentences(said)}"


def _verdict(checked: CheckedJob, name: str) -> str:
    if checked.is_good:
        return f"Nothing is wrong with {name}."
    lines = {line for finding in checked.findings if finding.is_wrong for line in finding.lines}
    if not lines:
        return f"{name} cuts where this machine is not usable."
    return f"{_count(len(lines), 'line')} of {name} {'is' if len(lines) == 1 else 'are'} wrong."


def _wrong(checked: CheckedJob) -> list[str]:
    """Return each wrong line, and where no sled should cut."""
    wrong = [finding for finding in checked.findings if finding.is_wrong]
    halts = {HALTS: "the machine halts: "}
    said = [f"{_where(each)}: {halts.get(each.kind, '')}{each.says}" for each in wrong[:SHOWN]]
    if len(wrong) > SHOWN:
        said.append(f"and {len(wrong) - SHOWN} more; --json has all")
    if checked.done.halted_at is not None:
        said.append(f"behind line {checked.done.halted_at} nothing was looked at")
    for bad in checked.hanging.bad if checked.hanging else ():
        who = "the sled" if bad.verdict == REACH_WORDS[CANNOT_HANG] else "a chain is"
        said.append(
            f"from line {bad.first} on, {100 * bad.share:.1f} % of the cuts lie where {who} "
            f"{bad.verdict}"
        )
    return said


def _where(finding: Finding) -> str:
    if finding.count == 1:
        return f"line {finding.line}"
    return f"{finding.count} lines from line {finding.line} on"


def _job(checked: CheckedJob, unit: Unit) -> str:
    times = checked.times
    rows = [
        ["time", time_text(times.whole), "without the operator's pauses"],
        ["cutting", time_text(times.cutting), _without_limits(times)],
    ]
    piece, hanging = checked.piece, checked.hanging
    if piece is not None:
        rows.append(["deepest", unit.worded(piece.deepest), f"at line {piece.line}"])
        rows.append(["removed", _volume(piece.removed, unit), f"with {_bits(piece, unit)}"])
    if hanging is not None:
        slack, tight = hanging.tension
        push = f"by a push of 1 kg on the bit, most at line {hanging.give_line}"
        rows.append(["chains", f"{slack:.0f} to {tight:.0f} N", "slackest and tightest"])
        rows.append(["give", unit.worded(GRAVITY * hanging.give), push])
    return table(["the job", "", ""], rows, words=[1, 2])


def _without_limits(times: Times) -> str:
    """Return how long the cutting would take without acceleration, arcs, z and chains."""
    asked, capped = time_text(times.asked), time_text(times.capped)
    at_feeds = f"{asked} at the feeds asked for"
    return at_feeds if asked == capped else f"{at_feeds}, {capped} with none above $15"


def _volume(volume: float, unit: Unit) -> str:
    """Return a volume [mm3] in the unit that fits the lengths on the screen."""
    if unit == MM:
        return f"{volume / 1000:.1f} cm3"
    return f"{volume / INCH**3:.2f} cubic inches"


def _bits(piece: Piece, unit: Unit) -> str:
    several = " and ".join(sorted({unit.brief(bit.diameter) for bit in piece.bits}))
    return f"a bit of {several}" + ("" if piece.is_said else ", the usual; --bit says otherwise")


def _parts(checked: CheckedJob, unit: Unit) -> str:
    header = ["part", "lines", "size", "deep"]
    header += ["width", "height", "askew"] if checked.has_errors else []
    rows = []
    for number, each in enumerate(checked.parts, start=1):
        width, height = each.size
        row = [str(number), f"{each.first_line}-{each.last_line}"]
        row += [f"{unit.bare(width, 1)} x {unit.bare(height, 1)}", unit.bare(-each.deepest)]
        if checked.has_errors:
            errors = (each.width_error, each.height_error, each.skew)
            row += [_error(error, unit) for error in errors]
        rows.append(row)
    more = len(rows) - PARTS
    words = [f"Sizes by the middle of the bit, {unit.name}."]
    if checked.has_errors:
        words.append(
            "Width and height: how much too large the part will come out; askew: how far its top "
            "lies too far right. Behind +-: what the marks leave open, 95 %."
        )
    if more > 0:
        words.append(f"And {more} more parts; --json has all.")
    return f"{table(header, rows[:PARTS])}\n\n{sentences(words, mark='')}"


def _error(error: Error | None, unit: Unit) -> str:
    return "-" if error is None else f"{unit.signed(error.mm)} +-{unit.bare(error.within)}"


def _notes(checked: CheckedJob, unit: Unit) -> list[str]:
    notes = [
        f"{_count(each.moves, 'move')} slower than the program asks, by {each.because}: line "
        f"{each.line} asks for {_feed(each.asked, unit)} {unit.name}/min and gets "
        f"{_feed(each.feed, unit)}"
        for each in checked.slower
    ]
    notes += [
        f"the machine waits for you at line {_lines(each.lines)}"
        for each in checked.findings
        if each.kind == WAITS
    ]
    notes += [f"line {each.line}: {each.says}" for each in checked.findings if each.kind == SINKS]
    notes += [
        f"{each.says} means nothing to this machine and is passed over: "
        f"{_count(each.count, 'line')}"
        for each in checked.findings
        if each.kind == IGNORED
    ]
    if not checked.has_errors and checked.parts:
        notes.append("to know how well the parts will fit, give --marks with this machine's marks")
    if checked.hanging is not None:
        notes += checked.hanging.assumed
    return notes


def _feed(feed: float, unit: Unit) -> str:
    """Return a feed [mm/min] in the unit of lengths."""
    return f"{feed:.0f}" if unit == MM else f"{feed / INCH:.1f}"


def _lines(numbers: Sequence[int]) -> str:
    first = ", ".join(map(str, numbers[:SHOWN]))
    return first if len(numbers) <= SHOWN else f"{first} and {len(numbers) - SHOWN} more"


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}" + ("" if number == 1 else "s")
