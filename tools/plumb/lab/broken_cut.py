"""The progress of a cut, kept in the folder, so that it can go on after a Stop or a restart."""

import re
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Annotated

from fastapi import Body
from pydantic import BaseModel, ConfigDict, NonNegativeInt, TypeAdapter, ValidationError

from plumb.lab.machine_line import MachineLine
from plumb.lab.project import CUT, Project, digest_of
from plumb.line.sender import cleaned, plain
from plumb.text.errors import InputError

PLUNGE = re.compile(r"G1 Z-")


class BrokenCut(BaseModel):
    """The last cut of a program, as far as the folder knows how far it came."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    digest: str  # of what the machine is sent
    marks: NonNegativeInt = 0  # that are surely cut
    begun: NonNegativeInt = 0  # with those that the machine may have cut when nobody saw it
    is_virtual: bool  # its sheet is gone with the program that ran it


NOTES = TypeAdapter(dict[str, BrokenCut])  # by the name of the program's file


@dataclass(frozen=True, kw_only=True)
class HowFar:
    """The progress of a program that broke off."""

    broke_off: int | None = None  # marks that are surely cut; None: it did not break off
    perhaps: int = 0  # marks after these that the machine may have cut
    goes_on: bool = False  # the next mark can be cut on that sheet


# The number of marks on the sheet, as counted by the owner.
OnSheet = Annotated[int, Body(embed=True)]


def how_far(project: Project, line: MachineLine, program: str, text: str) -> HowFar:
    """Return how far this program of marks came, if it broke off and does not run now."""
    progress = line.state.program
    runs = progress and progress.title == program and progress.outcome == "running"
    cut = None if runs else _broken_cut(project, program, text)
    if cut is None:
        return HowFar()
    return HowFar(
        broke_off=cut.marks,
        perhaps=cut.begun - cut.marks,
        goes_on=cut.is_virtual == (line.virtual is not None),
    )


def begin(
    project: Project,
    line: MachineLine,
    program: str,
    text: str,
    *,
    on_sheet: int | None = None,
    paused: Callable[[int], None] = lambda lines: None,
) -> None:
    """Send a program from its first mark, or the rest of one that broke off: the marks that are not
    `on_sheet`, which nobody but its owner sees. `paused` hears of its pauses. The machine moves.
    """
    is_virtual = line.virtual is not None
    cut = BrokenCut(digest=digest_of_sent(text), is_virtual=is_virtual)
    if on_sheet is not None:
        broken = _broken_cut(project, program, text)
        if broken is None or broken.is_virtual != is_virtual:
            raise InputError("no cut broke off that could go on: begin with the first mark")
        if not broken.marks <= on_sheet <= broken.begun:
            said = f"{broken.marks} to {broken.begun}"
            raise InputError(f"say how many marks are on the sheet: {said}")
        cut = broken.model_copy(update={"marks": on_sheet, "begun": on_sheet})
    plunges = plunges_in(text)
    lines, before = rest_of(text.splitlines(), plunges, cut.marks)
    noting = Noting(project, program, cut, plunges)
    line.worker.send(
        program,
        lines,
        then=lambda sender: noting.all_cut(),
        paused=paused,
        came=noting,
        before=before,
    )


def plunges_in(text: str) -> list[int]:
    """Return the numbers of the lines of a program that plunge into its marks."""
    lines = cleaned(text.splitlines())
    return [number for number, line in enumerate(lines, start=1) if PLUNGE.match(line)]


class Noting:
    """Notes in the folder how far a cut comes."""

    def __init__(
        self, project: Project, program: str, cut: BrokenCut, plunges: Sequence[int]
    ) -> None:
        """Take the number of the line that plunges into each mark."""
        self._project, self._program, self._cut, self._plunges = project, program, cut, plunges
        self._noted: BrokenCut | None = None

    def __call__(self, done: int, begun: int) -> None:
        """Note how far it is: how many lines are surely done, and how many perhaps."""
        self._note(marks := max(self._cut.marks, self._count(done)), max(marks, self._count(begun)))

    def all_cut(self) -> None:
        """Note that the cut came to its end."""
        self._note(len(self._plunges), len(self._plunges))

    def _note(self, marks: int, most: int) -> None:
        now = self._cut.model_copy(update={"marks": marks, "begun": most})
        if now != self._noted:
            self._noted = now
            _keep(self._project, {**_notes(self._project), self._program: now})

    def _count(self, lines: int) -> int:
        return sum(plunge <= lines for plunge in self._plunges)


def end_virtual(project: Project) -> None:
    """Note that the sheet of the virtual machine is gone."""
    notes = _notes(project)
    _keep(project, {name: cut for name, cut in notes.items() if not cut.is_virtual})


def _broken_cut(project: Project, program: str, text: str) -> BrokenCut | None:
    """Return how far this program came when it broke off; None if it did not begin, or ended."""
    cut = _notes(project).get(program)
    return cut if cut and cut.digest == digest_of_sent(text) else None


def digest_of_sent(text: str) -> str:
    """Return the digest of what the machine is sent of a program: comments may differ."""
    return digest_of("\n".join(cleaned(text.splitlines())).encode())


def _notes(project: Project) -> dict[str, BrokenCut]:
    """Return the cuts that broke off, by their programs."""
    try:
        return NOTES.validate_json(project.read(CUT) or b"{}")
    except ValidationError:
        return {}  # somebody else wrote it


def _keep(project: Project, notes: Mapping[str, BrokenCut]) -> None:
    with suppress(OSError):  # a full disk stops no cut
        if notes:
            project.save({CUT: NOTES.dump_json(dict(notes))}, read={})
        else:
            project.remove([CUT], read={})


def rest_of(lines: Sequence[str], plunges: Sequence[int], marks: int) -> tuple[list[str], int]:
    """Return the lines that cut the marks after the first `marks`, and how many are left out, of
    those that are sent.

    What is before the first mark comes again: the modes, the lift, and the pauses with what is
    to be done there.
    """
    if marks == 0:
        return list(lines), 0
    sent = [number for number, line in enumerate(lines) if plain(line)]
    head = next(number for number in sent if "X" in plain(lines[number]))
    done = sent[plunges[marks - 1]] + 1  # with the lift
    return [*lines[:head], *lines[done:]], sum(head <= number < done for number in sent)
