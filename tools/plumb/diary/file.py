"""The file of a diary: `diary.jsonl` in the machine's folder, a line of JSON for each entry.

Entries are only added. Each line begins with a digest of its rest, so a line that was cut in the
middle is noticed, and the next entry begins on a line by itself. Writers wait for each other.
"""

import json
import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from datetime import datetime
from hashlib import sha256
from pathlib import Path
from typing import Annotated, Any

from plumb.cure.add import Addition, Parameter
from plumb.fit.inputs import Inputs
from plumb.line.memory import WrittenNumbers, as_lines, version_of, write_numbers
from plumb.line.sender import Sender
from plumb.model.plain import PlainChange, plain_change, plainly
from plumb.text.answers import Internal, Moment, Number, in_json, key, plain
from plumb.text.compiled import version
from plumb.text.errors import InputError, Source
from plumb.text.files import Unlinked, hold, opened, reaches_disk, write_whole
from plumb.text.values import Unit

NAME = "diary.jsonl"
DIGITS = 16  # of a line's digest
HEAD = '{"digest": "%s", '  # what a line begins with

Folder = Source


@dataclass(frozen=True)
class Entry:
    """Entry of the diary."""

    kind: str  # "fit", "numbers", "program", "recheck", "home" or "check"
    at: Moment  # with its offset from UTC
    content: Internal[Mapping[str, Any]]  # lists, numbers and words as JSON has them


@dataclass(frozen=True)
class Diary:
    """All that a machine's folder remembers, the oldest entry first."""

    path: Path
    entries: tuple[Entry, ...]
    spoilt: tuple[int, ...] = ()  # lines that cannot be read, counted from 1

    def of_kind(self, *kinds: str) -> tuple[Entry, ...]:
        """Return the entries of these kinds."""
        return tuple(entry for entry in self.entries if entry.kind in kinds)


def diary_path(folder: Folder) -> Path:
    """Return where the diary of a folder is, or would be."""
    return Unlinked(folder) / NAME


def has_diary(folder: Folder) -> bool:
    """Return whether this folder has a diary."""
    return diary_path(folder).is_file()


def append(
    folder: Folder, kind: str, content: Mapping[str, Any], *, at: datetime | None = None
) -> Entry:
    """Add an entry to the diary of a folder; it is on the disk when this returns.

    Raises InputError where nothing can be written.
    """
    entry = Entry(kind, at or datetime.now().astimezone().replace(microsecond=0), plain(content))
    path = diary_path(folder)
    try:
        _add_line(path, _line(entry).encode())
    except OSError as error:
        why = f"cannot be written ({error.strerror})"
        raise InputError(
            path, why, remedy="check the rights of the folder, and its space"
        ) from None
    return entry


def read_diary(folder: Folder) -> Diary:
    """Return the diary of a folder; empty if there is none. Raises InputError."""
    path = diary_path(folder)
    try:
        with os.fdopen(opened(path, os.O_RDONLY), "rb") as file:
            content = file.read()
    except FileNotFoundError:
        return Diary(path, ())
    except NotADirectoryError:
        raise InputError(folder, "is not a folder", remedy="give the machine's folder") from None
    except OSError as error:
        raise InputError(
            path, f"cannot be read ({error.strerror})", remedy="check its rights"
        ) from None
    entries, spoilt = list[Entry](), list[int]()
    for number, line in enumerate(content.split(b"\n"), start=1):
        entry = _entry(line)
        if entry:
            entries.append(entry)
        elif line.strip():
            spoilt.append(number)
    return Diary(path, tuple(entries), tuple(spoilt))


def _line(entry: Entry) -> str:
    head = {"kind": entry.kind, "at": entry.at.isoformat()}
    rest = json.dumps({**head, **entry.content}, allow_nan=False)[1:]
    return HEAD % _digest(rest.encode()) + rest + "\n"


def _digest(rest: bytes) -> str:
    return sha256(rest).hexdigest()[:DIGITS]


def _entry(line: bytes) -> Entry | None:
    """Return what a line says; None if it is cut or changed."""
    length = len(HEAD % ("0" * DIGITS))
    head, rest = line[:length], line[length:]
    if head != (HEAD % _digest(rest)).encode():
        return None
    try:
        content = json.loads(b"{" + rest)
        return Entry(content.pop("kind"), datetime.fromisoformat(content.pop("at")), content)
    except (ValueError, KeyError, TypeError):
        return None


def _add_line(path: Path, line: bytes) -> None:
    """Put a line at the end, behind a cut line if there is such; all of it reaches the disk."""
    is_new = not path.exists()
    handle = opened(path, os.O_RDWR | os.O_CREAT | os.O_APPEND)
    try:
        hold(handle)
        length = os.lseek(handle, 0, os.SEEK_END)
        os.lseek(handle, max(0, length - 1), os.SEEK_SET)
        is_cut = os.read(handle, 1) not in (b"", b"\n")
        rest = memoryview(b"\n" + line if is_cut else line)
        try:
            while rest:
                rest = rest[os.write(handle, rest) :]
            os.fsync(handle)
        except OSError:
            os.ftruncate(handle, length)
            if is_new:
                path.unlink()
            raise
    finally:
        os.close(handle)
    if is_new:
        reaches_disk(path.parent)


# What goes into the diary: a fit with its marks and numbers, numbers sent, programs sent.

FIT, NUMBERS, PROGRAM = "fit", "numbers", "program"
CHECK = "check"  # as the page called its rechecks before
RECHECK, HOME = "recheck", "home"


def fit_entry(
    result: Addition, inputs: Inputs, *, machine: str, settings: str, firmware: str = "plumb"
) -> dict[str, Any]:
    """Return a fit: the new settings (text of the file `machine`), marks, errors, numbers and how
    well they are known together. mm, N, rad.
    """
    fitted = result.after_fit
    return {
        "plumb": version(),
        "machine": machine,
        "settings": settings,
        "firmware": firmware,
        "marks_files": [each.name for each in inputs.measurements.rounds],
        "before_mm": result.raw.rms,
        "rms_mm": result.after.fit_rms,
        "priced_mm": result.after.corrected_rms,
        "left_out_mm": result.after.left_out_rms,
        "worst_mm": result.after.worst,
        "sigma_mm": fitted.sigma,
        "marks": _marks(result, inputs),
        "distances": _distances(result, inputs),
        "numbers": [_number(parameter) for parameter in result.parameters],
        "effects": list(result.effects_added),
        # Of all unknowns, in the units of their numbers: what a later recheck has to allow for.
        "unknowns": [estimate.name for estimate in fitted.estimates],
        "covariance": fitted.covariance.tolist(),
    }


def program_entry(name: str, lines: list[str], *, whole: bool) -> dict[str, Any]:
    """Return a program that was sent; whole: False if it was stopped or refused."""
    text = "\n".join(lines)
    return {
        "program": name,
        "sha256": sha256(text.encode()).hexdigest(),
        "lines": len(lines),
        "whole": whole,
    }


def _marks(result: Addition, inputs: Inputs) -> list[dict[str, Any]]:
    readings, fitted = inputs.measurements.readings, result.after_fit
    return [
        {
            "name": mark.name,
            "file": inputs.measurements.rounds[mark.round].name,
            "target": list(mark.target),
            "measured": list(measured),
            "predicted": list(predicted),
            "error": list(error),
        }
        for (mark, measured), predicted, error in zip(
            readings, fitted.predicted.tolist(), fitted.errors.tolist(), strict=True
        )
    ]


def _distances(result: Addition, inputs: Inputs) -> list[dict[str, Any]]:
    return [
        {"between": list(distance.between), "mm": distance.length, "error_mm": error}
        for distance, error in zip(
            inputs.measurements.distances, result.after_fit.distance_errors.tolist(), strict=True
        )
    ]


def _number(parameter: Parameter) -> dict[str, Any]:
    names = ("name", "value", "low", "high", "unit", "before")
    return {name: getattr(parameter, name) for name in names}


# What an entry of the diary says in a sentence, on a screen and in a terminal.


def noted(entry: Entry) -> str:
    """Return what was done, for people; fits have a table."""
    content = entry.content
    if entry.kind == NUMBERS:
        count, machine = len(content["changed"]), content["machine"]
        numbers = f"{count} number{'' if count == 1 else 's'}"
        if content.get("back"):
            return f"took {machine} back: {numbers} as before it"
        return f"{numbers} changed by {machine}"
    if entry.kind == PROGRAM:
        end = "" if content["whole"] else ", not to its end"
        return f"sent {content['program']}{end}"
    if entry.kind in (CHECK, RECHECK) and "form" in content:
        return f"{content['form']}, by {content['machine']}: {content['sentence']}"
    if entry.kind == HOME:
        return f"home mark {content['mark']} {'kept' if content['kept'] else 'used'}"
    return str(content.get("sentence", entry.kind))


# Keeping the diary for the commands and the lab: which folder it is in, and what if it fails.
#
# A result that is written already stays written, whether or not its entry could be added.


def folder_of(path: str) -> Path | None:
    """Return the machine's folder, or that of a file in it; None for a device and what is not
    there.
    """
    place = Path(path)
    if place.is_dir():
        return place
    return place.parent if place.is_file() else None


def keep(path: str, kind: str, content: Mapping[str, Any], *, begin: bool = True) -> str:
    """Add an entry to the diary of a folder, or next to a file; a sentence if that failed, else ''.

    begin: whether to begin a diary where there is none.
    """
    folder = folder_of(path)
    if folder is None or not (begin or has_diary(folder)):
        return ""
    try:
        append(folder, kind, content)
    except InputError as error:
        return f"nothing was added to the diary: {error}"
    return ""


# Writes numbers to the machine; the old numbers go into a file, and the change into the diary.


def write_and_keep(
    sender: Sender, path: Path, lines: list[str], *, back: bool = False
) -> tuple[WrittenNumbers, Path, str]:
    """Write numbers and read them back; `back`: they are those from before `path` was sent.

    Comes with the file of the numbers that were replaced, named after `path`, and a sentence if
    the diary could not be kept. The file is there before a number is sent, so an InputError of a
    machine that took only some leaves a way back.
    """
    # What is taken back is not what was before it was sent: it keeps another name.
    when = "undone" if back else "before"
    kept = path.with_name(f"{path.stem}-{when}-{datetime.now():%Y-%m-%d-%H%M%S}.nc")
    try:
        written = write_numbers(
            sender, lines, keep=lambda before: write_whole(kept, as_lines(before).encode())
        )
    except InputError as error:
        if not kept.exists():
            raise
        raise InputError(f"{error}. The old numbers are in {kept}") from None
    entry = {
        "plumb": version(),
        "machine": path.name,
        "lines": lines,
        "changed": {f"${number}": list(both) for number, both in written.changed.items()},
        "firmware": version_of(sender),
        "kept": kept.name,
        "back": back,
    }
    return written, kept, keep(str(path), NUMBERS, entry)


# Course of a diary over time: errors of the fits, and each number with its interval.


@dataclass(frozen=True)
class DiaryFit:
    """A fit as the diary tells it. mm."""

    at: Moment
    machine: str  # name of its file
    count: Annotated[int, key("readings")]  # of marks and distances
    before: Annotated[Number, key("before_mm")]  # RMS with the settings before
    rms: Annotated[Number, key("rms_mm")]
    left_out: Annotated[Number, key("left_out_mm")]  # RMS of marks that took no part
    effects: tuple[str, ...]

    @in_json
    def said(self) -> str:
        """The effects in words."""
        return plainly(self.effects)


@dataclass(frozen=True)
class Point:
    """A fitted number at a time, with its 95 % interval."""

    at: datetime
    value: float
    low: float
    high: float
    said: str  # the number as text


@dataclass(frozen=True)
class Course:
    """The history of a number, fit by fit."""

    name: str
    noun: str
    unit: str  # of the text
    points: tuple[Point, ...]

    @in_json
    def has_moved(self) -> bool:
        """Whether the newest interval and the interval before have no value in common."""
        if len(self.points) < 2:
            return False
        before, now = self.points[-2:]
        return now.low > before.high or now.high < before.low


def history_of(diary: Diary, unit: Unit) -> tuple[tuple[DiaryFit, ...], tuple[Course, ...]]:
    """Return all fits of a diary, the oldest first, and how their numbers went, in the order in
    which they came up.
    """
    fits = diary.of_kind(FIT)
    return tuple(map(_fit, fits)), tuple(_courses(fits, unit))


def _fit(entry: Entry) -> DiaryFit:
    content = entry.content
    return DiaryFit(
        at=entry.at,
        machine=content["machine"],
        count=len(content["marks"]) + len(content["distances"]),
        before=_finite(content["before_mm"]),
        rms=_finite(content["rms_mm"]),
        left_out=_finite(content["left_out_mm"]),
        effects=tuple(content["effects"]),
    )


def _courses(fits: Iterable[Entry], unit: Unit) -> Iterable[Course]:
    points: dict[str, list[Point]] = {}
    words: dict[str, PlainChange] = {}
    for entry in fits:
        for each in entry.content["numbers"]:
            name = each["name"]
            value, low, high = (_finite(each[end]) for end in ("value", "low", "high"))
            words[name] = plain_change(name, value, value, low, high, unit)
            point = Point(entry.at, value, low, high, words[name].after)
            points.setdefault(name, []).append(point)
    for name, course in points.items():
        yield Course(name, words[name].noun, words[name].unit, tuple(course))


def _finite(value: float | None) -> float:
    """Return a number of an entry; where there was none it is NaN."""
    return float("nan") if value is None else float(value)
