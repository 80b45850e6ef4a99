"""What `plumb check` says to people."""

from __future__ import annotations

import argparse
from collections import Counter
from pathlib import Path

from plumb.cli.screen import headline, sentences, table
from plumb.cli.steps import next_step
from plumb.jobs.check import Checked
from plumb.jobs.expected import Error, PartErrors
from plumb.jobs.findings import HALTS, IGNORED, SINKS, WAITS
from plumb.jobs.hanging import Hanging
from plumb.text.shown import bare, signed, unit, worded

SHOWN = 12  # lines of a kind
PARTS = 12  # parts in the table
CUT = 10.0  # [N] the side force of a light cut


def as_text(checked: Checked, arguments: argparse.Namespace) -> str:
    """The check for people: what is wrong, the job, its parts, what to do next."""
    paragraphs = [headline(_verdict(checked, Path(arguments.job).name))]
    wrong = _wrong(checked)
    if wrong:
        paragraphs.append(sentences(wrong))
    paragraphs.append(_job(checked))
    if checked.parts:
        paragraphs.append(_parts(checked))
    notes = _notes(checked)
    if notes:
        paragraphs.append(sentences(notes))
    if arguments.outline:
        words = "See where it will cut, with the bit above the sheet:"
        paragraphs.append(next_step(words, ["send", arguments.outline]))
    return "\n\n".join(filter(None, paragraphs))


def _verdict(checked: Checked, name: str) -> str:
    if checked.is_good:
        return f"Nothing is wrong with {name}."
    lines = {finding.line for finding in checked.findings if finding.is_wrong}
    if not lines:
        return f"{name} cuts where this machine is not usable."
    return f"{_count(len(lines), 'line')} of {name} {'is' if len(lines) == 1 else 'are'} wrong."


def _wrong(checked: Checked) -> list[str]:
    """Each wrong line, and where no sled should cut."""
    wrong = [finding for finding in checked.findings if finding.is_wrong]
    halts = {HALTS: "the machine halts: "}
    said = [f"line {each.line}: {halts.get(each.kind, '')}{each.says}" for each in wrong[:SHOWN]]
    if len(wrong) > SHOWN:
        said.append(f"and {len(wrong) - SHOWN} more; --json has all")
    if checked.done.halted_at is not None:
        said.append(f"behind line {checked.done.halted_at} nothing was looked at")
    for bad in checked.hanging.bad if checked.hanging else ():
        said.append(
            f"{_count(bad.lines, 'line')} from line {bad.first} on cut where the sled is "
            f"{bad.verdict}: {100 * bad.share:.1f} % of the cuts"
        )
    return said


def _job(checked: Checked) -> str:
    times = checked.times
    rows = [
        ["time", time_text(times.whole), "without the operator's pauses"],
        ["cutting", time_text(times.cutting), f"{time_text(times.asked)} at the feeds asked for"],
    ]
    hanging = checked.hanging
    if hanging is not None:
        slack, tight = hanging.tension
        rows.append(["chains", f"{slack:.0f} to {tight:.0f} N", "slackest and tightest"])
        rows.append(["give", f"{worded(hanging.give)}/N", _give(hanging)])
    return table(["the job", "", ""], rows, words=[1, 2])


def _give(hanging: Hanging) -> str:
    return f"{CUT:g} N move the bit {worded(CUT * hanging.give)} at line {hanging.give_line}"


def _parts(checked: Checked) -> str:
    errors = checked.errors
    header = ["part", "lines", "size", "deep"]
    header += ["width", "height", "askew"] if errors else []
    rows = []
    shown = errors or (PartErrors(None, None, None),) * len(checked.parts)
    for number, (part, error) in enumerate(zip(checked.parts, shown, strict=True), start=1):
        width, height = part.size
        row = [str(number), f"{part.lines[0]}-{part.lines[1]}"]
        row += [f"{bare(width, 1)} x {bare(height, 1)}", bare(-part.deepest)]
        if errors:
            row += [_error(each) for each in (error.width, error.height, error.skew)]
        rows.append(row)
    more = len(rows) - PARTS
    words = [f"Sizes by the middle of the bit, {unit()}."]
    if errors:
        words.append(
            "Width and height: how much too large the part will come out; askew: how far its top "
            "lies too far right. Behind +-: what the marks leave open, 95 %."
        )
    if more > 0:
        words.append(f"And {more} more parts; --json has all.")
    return f"{table(header, rows[:PARTS])}\n\n{sentences(words, mark='')}"


def _error(error: Error | None) -> str:
    return "-" if error is None else f"{signed(error.mm)} +-{bare(error.within)}"


def _notes(checked: Checked) -> list[str]:
    notes = [
        f"{_count(each.moves, 'move')} slower than the program asks, by {each.because}: line "
        f"{each.line} asks for {each.asked:.0f} mm/min and gets {each.feed:.0f}"
        for each in checked.slower
    ]
    waits = [finding.line for finding in checked.findings if finding.kind == WAITS]
    if waits:
        notes.append(f"the machine waits for you at line {_lines(waits)}")
    notes += [f"line {each.line}: {each.says}" for each in checked.findings if each.kind == SINKS]
    ignored = Counter(each.says for each in checked.findings if each.kind == IGNORED)
    for code, count in ignored.items():
        notes.append(
            f"{code} means nothing to this machine and is passed over: {_count(count, 'line')}"
        )
    if not checked.errors and checked.parts:
        notes.append("to know how well the parts will fit, give --marks with this machine's marks")
    if checked.hanging is not None:
        notes += checked.hanging.assumed
    return notes


def _lines(numbers: list[int]) -> str:
    first = ", ".join(map(str, numbers[:SHOWN]))
    return first if len(numbers) <= SHOWN else f"{first} and {len(numbers) - SHOWN} more"


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}" + ("" if number == 1 else "s")


def time_text(seconds: float) -> str:
    """A time for people."""
    whole = round(seconds)
    hours, minutes = whole // 3600, whole // 60 % 60
    if hours:
        return f"{hours} h {minutes} min"
    return f"{minutes} min {whole % 60} s" if minutes else f"{whole} s"
