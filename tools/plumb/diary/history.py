"""Course of a diary over time: errors of the fits, and each number with its interval."""

from collections.abc import Iterable
from dataclasses import dataclass
from datetime import datetime
from typing import Annotated

from plumb.diary.file import FIT, Diary, Entry
from plumb.model.plain import PlainChange, plain_change, plainly
from plumb.text.answers import Moment, Number, in_json, key
from plumb.text.values import Unit


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
        before=_number(content["before_mm"]),
        rms=_number(content["rms_mm"]),
        left_out=_number(content["left_out_mm"]),
        effects=tuple(content["effects"]),
    )


def _courses(fits: Iterable[Entry], unit: Unit) -> Iterable[Course]:
    points: dict[str, list[Point]] = {}
    words: dict[str, PlainChange] = {}
    for entry in fits:
        for each in entry.content["numbers"]:
            name = each["name"]
            value, low, high = (_number(each[end]) for end in ("value", "low", "high"))
            words[name] = plain_change(name, value, value, low, high, unit)
            point = Point(entry.at, value, low, high, words[name].after)
            points.setdefault(name, []).append(point)
    for name, course in points.items():
        yield Course(name, words[name].noun, words[name].unit, tuple(course))


def _number(value: float | None) -> float:
    """Return a number of an entry; where there was none it is NaN."""
    return float("nan") if value is None else float(value)
