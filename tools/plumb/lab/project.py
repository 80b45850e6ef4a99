"""A project: a plain folder with the files of the command line, and the choices made on the page.

Each file has a digest. A save names the digest that its author had read, so that nobody overwrites
what another program or the command line wrote in the meantime; `guard.py` lets a single tab edit.
"""

from __future__ import annotations

import json
import os
import re
from collections.abc import Callable, Iterable, Mapping
from hashlib import sha256
from pathlib import Path
from typing import Annotated, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field

from plumb.text.errors import InputError
from plumb.text.files import Unlinked, alone, numbered, opened, parsed, write_all
from plumb.text.tables import read_table
from plumb.text.values import Unit, unit_called

# A name is a single word without a folder, so no name from outside leads out of the project.
NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_.-]{0,63}")
CUT = ".cut.json"  # how far a cut came
# What the lab keeps for itself: that, and settings as they were when marks were cut with them.
KEPT = re.compile(r"\.settings-[0-9a-f]{16}\.(ini|json|toml)|" + re.escape(CUT))
MISSING = ""  # digest of a file that does not exist
LOCK = ".lab.lock"


class ChangedError(Exception):
    """A file changed since its author read it: `name` says which."""

    def __init__(self, name: str) -> None:
        super().__init__(f"{name} has changed in the meantime; look at what it says now")
        self.name = name


class Project:
    """The files of a folder, which may come from elsewhere: no link in it is followed."""

    def __init__(self, folder: Path) -> None:
        self.folder = Unlinked(folder)

    @property
    def choices(self) -> Choices:
        """Choices of its owner. Raises InputError if the file is damaged."""
        return read_choices(self)[0]

    def path(self, name: str) -> Path:
        """Return where a file of this name lies. Raises ValueError for a name that is not plain
        and for a link, which may lead out of the folder.
        """
        if not NAME.fullmatch(name) and not KEPT.fullmatch(name):
            raise ValueError(f"{name!r} is not a plain file name")
        path = self.folder / name
        if path.is_symlink():
            raise ValueError(f"{name} is a link; put the file itself into the folder")
        return path

    def names(self) -> list[str]:
        """Return the names of its files, sorted."""
        return sorted(
            path.name
            for path in self.folder.iterdir()
            if path.is_file() and not path.is_symlink() and NAME.fullmatch(path.name)
        )

    def read(self, name: str) -> bytes | None:
        """Return what is in a file; None if there is none."""
        path = self.path(name)
        if not path.is_file():
            return None
        with os.fdopen(opened(path, os.O_RDONLY), "rb") as file:
            return file.read()

    def digest(self, name: str) -> str:
        """Return a number for what is in a file; MISSING if there is none."""
        return digest_of(self.read(name))

    def free_name(self, stem: str, *endings: str) -> str:
        """Return the first of `stem`, `stem-2` ... that no file has with any of these endings; with
        the first of them.
        """
        return next(
            f"{each}{endings[0]}"
            for each in numbered(stem)
            if all(self.read(f"{each}{ending}") is None for ending in endings)
        )

    def place_for(self, content: bytes, stem: str, ending: str) -> str:
        """Return the first of these names that no file has, or a file with just this content."""
        return next(
            f"{each}{ending}"
            for each in numbered(stem)
            if self.read(f"{each}{ending}") in (None, content)
        )

    def save(self, files: Mapping[str, bytes], *, read: Mapping[str, str]) -> None:
        """Write all of them or none.

        `read` holds the digests of the files that the author knew. Raises ChangedError if one of
        these is another by now, and OSError if the disk takes nothing.
        """
        with alone(self.folder / LOCK):
            self._refuse_changed(read)
            staged = {str(self.path(name)): content for name, content in files.items()}
            try:
                write_all(staged, follows=False)
            except InputError as error:  # the disk's fault, so it may go later
                raise OSError(str(error).removeprefix(f"{self.folder}/")) from None

    def remove(self, names: Iterable[str], *, read: Mapping[str, str]) -> None:
        """Take files out of the folder; those that are not there are no matter.

        Raises ChangedError as `save` does.
        """
        with alone(self.folder / LOCK):
            self._refuse_changed(read)
            for name in names:
                self.path(name).unlink(missing_ok=True)

    def _refuse_changed(self, read: Mapping[str, str]) -> None:
        for name, digest in read.items():
            if self.digest(name) != digest:
                raise ChangedError(name)


def digest_of(content: bytes | None) -> str:
    """Return a number for what a file holds; MISSING for None."""
    return MISSING if content is None else sha256(content).hexdigest()


# What was chosen on the page and belongs to no other file: `lab.json` in the project's folder.

FILE = "lab.json"
TRIES = 5  # to save, while somebody else saves choices

Edges = Literal["top-left", "top-right", "bottom-left", "bottom-right"]
Layout = Literal["nine", "fifteen", "twenty-five", "own"]
# "distances" was a layout once; its file still opens.
GONE = BeforeValidator(lambda said: "nine" if said == "distances" else said)
FileName = Annotated[str, Field(pattern=f"^{NAME.pattern}$")]
FileOrNone = Annotated[str, Field(pattern=f"^({NAME.pattern})?$")]  # empty: none


class Number(BaseModel):
    """A number that the owner knows, and how far it may be wrong."""

    model_config = ConfigDict(allow_inf_nan=False)

    value: float
    sigma: float


class Bench(BaseModel):
    """Contents of the bench: effects in the order they were added, and sizes held by hand."""

    effects: list[str] = []
    held: dict[str, float] = {}


class Choices(BaseModel):
    """Choices made on the page. A new choice is a new field with a default."""

    model_config = ConfigDict(extra="forbid", allow_inf_nan=False)

    settings: FileOrNone = ""  # name of the settings' file in the folder
    marks: list[FileName] = []  # names of the files of marks, in the order they were cut
    units: Literal["mm", "inch"] = "mm"
    fineness: float = 0.5  # [mm] the finest division of the tape
    edges: Edges = "top-left"  # from which the marks are read
    layout: Annotated[Layout, GONE] = "nine"
    new_sheet: bool = False  # the next marks are cut on another sheet than those before
    # [mm] machine frame: marks of the layout "own"
    planned: list[tuple[float, float]] = Field(default=[], max_length=400)
    proposed: FileOrNone = ""  # the form of the accepted proposal
    known: dict[str, Number] = {}  # by name of the frame's number
    bench: Bench = Bench()
    accepted: list[str] = []  # numbers of the correction that the owner accepted
    settings_before: list[str] = []  # what was open before each correction, the latest last

    @property
    def unit(self) -> Unit:
        """In which lengths are shown."""
        return unit_called(self.units)


def read_choices(project: Project) -> tuple[Choices, str]:
    """Return the choices and the digest of their file. Raises InputError if the file is damaged."""
    content = project.read(FILE)
    if content is None:
        return _found(project), digest_of(None)
    said = parsed(FILE, content.decode(errors="replace"), json.loads, "JSON")
    return read_table(Choices, said, FILE), digest_of(content)


# The settings that a folder of the command line has, the newest first.
USUAL = ("machine.toml", "groundcontrol.ini", "webcontrol.json")
CUT_WITH = re.compile(rb'^cut_with *= *"([\w.-]+)"', re.MULTILINE | re.ASCII)
FORM = re.compile(rb"^\s*\[\[(mark|distance)\]\]", re.MULTILINE)


def _found(project: Project) -> Choices:
    """Return the settings and the forms of a folder that was not opened before."""
    names = project.names()
    toml = {name: project.read(name) or b"" for name in names if name.endswith(".toml")}
    forms = {name: text for name, text in toml.items() if FORM.search(text)}
    cut_with = [named[1].decode() for text in forms.values() if (named := CUT_WITH.search(text))]
    settings = next((name for name in (USUAL[0], *cut_with, *USUAL) if name in names), "")
    return Choices(settings=settings, marks=list(forms) if settings else [])


def choices_text(choices: Choices) -> bytes:
    """Return the file of the choices."""
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
    """Return the choices with a file of marks as the last that is used; as they are if it
    is used.
    """
    if name in choices.marks:
        return choices
    return choices.model_copy(update={"marks": [*choices.marks, name]})
