"""Whether a machine knows where its sled is: its greeting alone says so, its reports do not."""

from __future__ import annotations

from collections.abc import Iterable

# What a machine says at its start, or to a line that would move it.
LOST_PLACE = ("Position Lost", "Chain lengths are not known", "Unable to find valid machine")


def lost_place(said: Iterable[str]) -> str:
    """The machine's words for a place that it does not know; empty if there are none."""
    return next((line for line in said if any(words in line for words in LOST_PLACE)), "")
