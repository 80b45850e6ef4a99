"""What was chosen on the page and belongs to no other file: `lab.json` in the project's folder."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from plumb.lab.project import NAME, ChangedError, Project, digest_of
from plumb.text.errors import refusal

FILE = "lab.json"
TRIES = 5  # to save, while somebody else saves choices

Edges = Literal["top-left", "top-right", "bottom-left", "bottom-right"]
Layout = Literal["nine", "fifteen", "twenty-five", "distances", "own"]
FileName = Annotated[str, Field(pattern=f"^{NAME.pattern}$")]


class Number(BaseModel):
    """A number that the owner knows, and how far it may be wrong."""

    model_config = ConfigDict(allow_inf_nan=False)

    value: float
    sigma: float


class Bench(BaseModel):
    """What lies on the bench: effects in the order they were added, and sizes held by hand."""

    effects: list[str] = []
    held: dict[str, float] = {}


class Choices(BaseModel):
    """What somebody chose. A new choice is a new field with a default."""

    model_config = ConfigDict(extra="forbid", allow_inf_nan=False)

    settings: FileName | Literal[""] = (
        ""  # name of the settings' file in the folder; empty: none opened
    )
    marks: list[FileName] = []  # names of the files of marks, in the order they were cut
    units: Literal["mm", "inch"] = "mm"
    fineness: float = 0.5  # [mm] the finest division of the tape
    edges: Edges = "top-left"  # from which the marks are read
    layout: Layout = "nine"
    new_sheet: bool = False  # the next marks are cut on another sheet than those before
    # [mm] machine frame: marks of the layout "own"
    planned: list[tuple[float, float]] = Field(default=[], max_length=400)
    proposed: FileName | Literal[""] = ""  # the form of the proposal that somebody took
    known: dict[str, Number] = {}  # by name of the frame's number
    bench: Bench = Bench()
    accepted: list[str] = []  # numbers of the correction that the owner accepted
    settings_before: list[str] = []  # what was open before each correction, the latest last


def read_choices(project: Project) -> tuple[Choices, str]:
    """The choices and the digest of their file. Raises InputError if the file is damaged."""
    content = project.read(FILE)
    if content is None:
        return Choices(), digest_of(None)
    try:
        return Choices.model_validate_json(content), digest_of(content)
    except ValidationError as error:
        first = error.errors()[0]
        place = ".".join(str(part) for part in first["loc"])
        raise refusal(FILE, first["msg"], place=place, remedy="mend or delete it") from None


def choices_text(choices: Choices) -> bytes:
    """The file of the choices."""
    return f"{choices.model_dump_json(indent=2)}\n".encode()


def save_choices(
    project: Project,
    change: Callable[[Choices], Choices],
    *,
    files: Mapping[str, bytes] | None = None,
    read: Mapping[str, str] | None = None,
) -> None:
    """Change the choices, whatever they are by now, and write files that go with them.

    Raises ChangedError if one of the files in `read` is another, or if the choices never rest.
    """
    for _ in range(TRIES):
        choices, digest = read_choices(project)
        changed = {**(files or {}), FILE: choices_text(change(choices))}
        try:
            return project.save(changed, read={**(read or {}), FILE: digest})
        except ChangedError as error:
            if error.name != FILE:
                raise
    raise ChangedError(FILE)


def with_marks(choices: Choices, name: str) -> Choices:
    """The choices with a file of marks as the last that is used; as they are if it is used."""
    if name in choices.marks:
        return choices
    return choices.model_copy(update={"marks": [*choices.marks, name]})
