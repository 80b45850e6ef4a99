"""How far a cut came: kept in the folder, so that it can go on after a Stop or a restart."""

from __future__ import annotations

import json
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import asdict, dataclass, replace

from plumb.lab.project import CUT, Project, digest_of


@dataclass(frozen=True)
class BrokenCut:
    """A cut that did not come to its end, as far as the folder knows."""

    program: str  # name of its file
    digest: str  # of its text
    marks: int  # that are cut
    is_virtual: bool  # its sheet is gone with the program that ran it


def broken_cut(project: Project, program: str, text: str) -> BrokenCut | None:
    """Return how far this program came when it broke off; None if it did not begin, or ended."""
    content = project.read(CUT)
    if content is None:
        return None
    try:
        cut = BrokenCut(**json.loads(content))
    except (ValueError, TypeError):
        return None  # somebody else wrote it
    return cut if (cut.program, cut.digest) == (program, digest_of(text.encode())) else None


class Noting:
    """Notes in the folder how far a cut comes."""

    def __init__(self, project: Project, cut: BrokenCut, ends: Sequence[int]) -> None:
        """Take how many lines the machine took when each mark is cut."""
        self._project, self._cut, self._ends = project, cut, ends
        self._noted = -1

    def __call__(self, lines: int) -> None:
        """Note how far it is: how many lines the machine took."""
        marks = max(self._cut.marks, sum(end <= lines for end in self._ends))
        if marks == self._noted:
            return
        self._noted = marks
        content = json.dumps(asdict(replace(self._cut, marks=marks))).encode()
        with suppress(OSError):  # a full disk stops no cut
            self._project.save({CUT: content}, read={})


def end(project: Project) -> None:
    """Note that the cut came to its end, or that its sheet is gone."""
    with suppress(OSError):
        project.remove([CUT], read={})


def rest_of(lines: Sequence[str], ends: Sequence[int], marks: int) -> tuple[list[str], int]:
    """Return the lines that cut the marks after the first `marks`, and how many are left out.

    The modes and the lift before the first mark come again.
    """
    if marks == 0:
        return list(lines), 0
    head = next(i for i, line in enumerate(lines) if "X" in line)
    done = ends[marks - 1]
    return [*lines[:head], *lines[done:]], done - head
