"""The diary: each fit with its error, and how the numbers went."""

from dataclasses import dataclass
from datetime import datetime

from fastapi import APIRouter
from pydantic import BaseModel

from plumb.diary.file import FIT, Diary, noted, read_diary
from plumb.diary.history import Course, DiaryFit, Point, history_of
from plumb.lab.routes.project import TheProject
from plumb.model.plain import plain_change, plainly

router = APIRouter(tags=["diary"])
MOST = 50  # other entries that are shown


class Round(BaseModel):
    """A fit, and its effects in words."""

    fit: DiaryFit
    said: str


@dataclass(frozen=True)
class CoursePoint(Point):
    """A number after a fit, as text too."""

    said: str


class NumberCourse(BaseModel):
    """How a number went."""

    noun: str
    unit: str
    points: list[CoursePoint]
    has_moved: bool  # the last two intervals have no value in common


class Noted(BaseModel):
    """Something else that was done."""

    at: datetime
    said: str


class DiaryAnswer(BaseModel):
    """Rounds and notes of the folder's diary."""

    rounds: list[Round]
    courses: list[NumberCourse]
    others: list[Noted]
    spoilt: int  # lines that cannot be read


@router.get("/diary")
def show_diary(project: TheProject) -> DiaryAnswer:
    """Return the diary of the folder."""
    return diary_answer(read_diary(project.folder))


def diary_answer(diary: Diary) -> DiaryAnswer:
    """Return a diary as the page shows it."""
    history = history_of(diary)
    return DiaryAnswer(
        rounds=[Round(fit=fit, said=plainly(fit.effects)) for fit in history.fits],
        courses=[_course(course) for course in history.courses],
        others=_others(diary),
        spoilt=len(diary.spoilt),
    )


def _course(course: Course) -> NumberCourse:
    last = course.points[-1]
    words = plain_change(course.name, last.value, last.value, last.low, last.high)
    return NumberCourse(
        noun=words.noun,
        unit=words.unit,
        points=[
            CoursePoint(
                **vars(point),
                said=plain_change(
                    course.name, point.value, point.value, point.low, point.high
                ).after,
            )
            for point in course.points
        ],
        has_moved=course.has_moved,
    )


def _others(diary: Diary) -> list[Noted]:
    """Return the newest first."""
    others = [entry for entry in diary.entries if entry.kind != FIT][-MOST:]
    return [Noted(at=entry.at, said=noted(entry)) for entry in reversed(others)]
