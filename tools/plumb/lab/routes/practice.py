"""Practice: what the folder's virtual machine hides, and what the opened settings are worth."""

from __future__ import annotations

from fastapi import APIRouter
from pydantic import BaseModel

from plumb.fit.inputs import settings_in
from plumb.lab.choices import read_choices
from plumb.lab.routes.project import TheProject
from plumb.text.errors import InputError
from plumb.vm.practice import score, secret_in

router = APIRouter(tags=["practice"])


class Revealed(BaseModel):
    """What was hidden; error of the sled all over the sheet [mm RMS]."""

    hidden: str
    sentence: str
    before_mm: float
    after_mm: float | None  # by the opened settings; None where a place is out of their reach


@router.post("/practice/reveal")
def reveal(project: TheProject) -> Revealed:
    """Reveal the secret of the folder."""
    secret, (choices, _) = secret_in(project.folder), read_choices(project)
    if not choices.settings:
        raise InputError("no settings are open; open the settings of the machine first")
    result = score(secret, settings_in(project.path(choices.settings)))
    return Revealed(
        hidden=result.hidden,
        sentence=result.sentence,
        before_mm=result.before_mm,
        after_mm=result.after_mm,
    )
