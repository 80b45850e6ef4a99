"""Which tab of the page may edit the folder: a single tab at a time.

A tab is open as long as its live line is. The first has the right to edit; another may take it
over, and inherits it when the tab that has it is closed. Other programs name no tab.
"""

from __future__ import annotations

from collections import Counter
from typing import Annotated

from fastapi import Depends
from starlette.requests import HTTPConnection

TAB = "X-Plumb-Tab"
# What any tab may ask for: to stop a machine, and to edit.
ANY_TAB = ("/machine/stop", "/machine/hold", "/machine/go-on", "/editor")


class OtherTabError(Exception):
    """Another tab edits the folder."""

    def __init__(self) -> None:
        super().__init__("this folder is open in another tab: take over to change it here")


class Editor:
    """The tabs that are open, and which of them edits."""

    def __init__(self) -> None:
        self._open: Counter[str] = Counter()  # live lines, by tab; in the order of their opening
        self.tab = ""  # that edits; empty if none is open

    def opened(self, tab: str) -> None:
        """Count a live line of a tab."""
        self._open[tab] += 1
        self.tab = self.tab or tab

    def closed(self, tab: str) -> None:
        """Forget a live line; the next tab inherits the right of a tab that has none left."""
        self._open[tab] -= 1
        if not self._open[tab]:
            del self._open[tab]
            if self.tab == tab:
                self.tab = next(iter(self._open), "")

    def take_over(self, tab: str) -> None:
        """Give a tab the right to edit."""
        self.tab = tab

    def refuse_other(self, tab: str) -> None:
        """Raise OtherTabError if another tab edits."""
        if tab and self.tab not in ("", tab):
            raise OtherTabError


def editor_of(connection: HTTPConnection) -> Editor:
    """Return the editor of this server's folder."""
    editor = connection.app.state.editor
    assert isinstance(editor, Editor)
    return editor


async def may_change(connection: HTTPConnection) -> None:
    """Let a question through, and a change by the tab that edits."""
    changes = connection.scope.get("method") in ("POST", "PUT", "DELETE")
    if changes and not connection.url.path.endswith(ANY_TAB):
        editor_of(connection).refuse_other(connection.headers.get(TAB, ""))


TheEditor = Annotated[Editor, Depends(editor_of)]
