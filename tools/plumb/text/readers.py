"""Who reads a message: somebody at a command line, or somebody at the lab's page.

An option of the command line means nothing on the page. So what to do about a fault is written for
both, and each reader gets what he can do. A test holds every message of the lab's rooms to it.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

_on_page: ContextVar[bool] = ContextVar("on_page", default=False)


@contextmanager
def read_on_page() -> Iterator[None]:
    """Until the end, messages are read on the lab's page."""
    token = _on_page.set(True)
    try:
        yield
    finally:
        _on_page.reset(token)


def to_do(line: str, *, page: str) -> str:
    """What its reader can do: with options on a command line, or on the page."""
    return page if _on_page.get() else line
