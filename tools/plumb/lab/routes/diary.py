"""The diary: each fit with its error, and the history of the numbers."""

from datetime import datetime

from fastapi import APIRouter
from pydantic import BaseModel

from plumb.diary.file import FIT, Course, Diary, DiaryFit, history_of, noted, read_diary
from plumb.lab.routes.project import TheProject
from plumb.text.values import Unit
from plumb.words import Heading
from plumb.words.recheck import what_is_noted

router = APIRouter(tags=["diary"])
MOST = 50  # other entries that are shown


class Noted(BaseModel):
    """Something else that was done."""

    at: datetime
    said: str


class DiaryAnswer(BaseModel):
    """Rounds and notes of the folder's diary."""

    heading: Heading
    fits: tuple[DiaryFit, ...]
    courses: tuple[Course, ...]
    others: list[Noted]
    spoilt: int  # lines that cannot be read


@router.get("/diary")
def show_diary(project: TheProject) -> DiaryAnswer:
    """Return the diary of the folder."""
    return diary_answer(read_diary(project.folder), project.choices.unit)


def diary_answer(diary: Diary, unit: Unit) -> DiaryAnswer:
    """Return a diary as the page shows it."""
    fits, courses = history_of(diary, unit)
    others = _others(diary)
    return DiaryAnswer(
        heading=what_is_noted(any_note=bool(fits or others)),
        fits=fits,
        courses=courses,
        others=others,
        spoilt=len(diary.spoilt),
    )


def _others(diary: Diary) -> list[Noted]:
    """Return the newest first."""
    others = [entry for entry in diary.entries if entry.kind != FIT][-MOST:]
    return [Noted(at=entry.at, said=noted(entry)) for entry in reversed(others)]
