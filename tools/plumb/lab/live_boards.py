"""The board of the bench, kept warm: read once, and again when a file or a choice has changed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from threading import Lock

from plumb.cure.add import raw_comparison
from plumb.cure.live_board import BoardView, LiveBoard
from plumb.fit.compare import Comparison
from plumb.fit.inputs import Inputs
from plumb.lab.choices import read_choices
from plumb.lab.project import Project

# Choices that a board does not depend on.
OF_THE_PAGE = {
    "units",
    "bench",
    "accepted",
    "edges",
    "fineness",
    "layout",
    "new_sheet",
    "planned",
    "proposed",
    "settings_before",
}


@dataclass(frozen=True)
class WarmBoard:
    """A board with its view, and the marks against the settings as they stand."""

    key: str  # of the files and choices that it was made of
    live: LiveBoard
    view: BoardView
    raw: Comparison


class LiveBoards:
    """Keeps the latest board."""

    def __init__(self) -> None:
        self._kept: WarmBoard | None = None
        self._making = Lock()

    def of(self, project: Project, inputs_of: Callable[[Project], Inputs]) -> WarmBoard:
        """The board of a project as it is on disk now. Raises InputError."""
        with self._making:
            key = key_of(project)
            if self._kept is None or self._kept.key != key:
                inputs = inputs_of(project)
                live = LiveBoard(inputs)
                self._kept = WarmBoard(key, live, BoardView(live), raw_comparison(inputs))
            return self._kept


def key_of(project: Project) -> str:
    """Another for other settings or marks, and for other choices that a fit depends on."""
    choices, _ = read_choices(project)
    said = choices.model_dump_json(exclude=OF_THE_PAGE)
    names = [name for name in (choices.settings, *choices.marks) if name]
    digests = [f"{name} {project.digest(name)}" for name in names]
    return "\n".join([said, *digests])
