"""The right to edit the folder goes from tab to tab."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Header
from pydantic import BaseModel

from plumb.lab.editor import TheEditor

router = APIRouter(tags=["project"])


class EditorAnswer(BaseModel):
    """The tab that edits; the live line says it, too."""

    editor: str


@router.post("/editor")
def take_over(
    editor: TheEditor, x_plumb_tab: Annotated[str, Header(max_length=64)]
) -> EditorAnswer:
    """Let the tab that asks edit; the tab that did so far only shows."""
    editor.take_over(x_plumb_tab)
    return EditorAnswer(editor=editor.tab)
