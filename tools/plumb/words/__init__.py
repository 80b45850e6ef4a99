"""Answers in words, for terminal, page and report: a headline, sentences and tables."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

Kind = Literal["good", "open", "bad"]  # of a state: the colour of its headline


@dataclass(frozen=True)
class Rows:
    """A table; the first `left` columns and those in `words` (-1 is the last) hold words, the rest
    numbers. The note stands below it."""

    header: Sequence[str]
    rows: Sequence[Sequence[str]]
    left: int = 1
    words: Sequence[int] = ()
    note: str = ""


@dataclass(frozen=True)
class Sentences:
    """Sentences below each other, each behind a mark, or paragraphs without one."""

    lines: Sequence[str]
    mark: str = "- "


Part = Rows | Sentences


@dataclass(frozen=True)
class Heading:
    """What a screen is called, and what it says first: at most forty words."""

    title: str
    say: str


@dataclass(frozen=True)
class Link:
    """Where a screen goes on."""

    text: str
    screen: str


def filled(*parts: Part) -> list[Part]:
    """Return the parts that hold anything."""
    return [each for each in parts if (each.rows if isinstance(each, Rows) else each.lines)]


def paragraph(*lines: str) -> Sentences:
    """Return sentences without a mark, those that are not empty."""
    return Sentences([*filter(None, lines)], "")
