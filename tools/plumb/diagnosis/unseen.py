"""Causes that may act although the marks do not show it, in one set of words for terminal, page and
report.
"""

from dataclasses import dataclass

from plumb.diagnosis.answer import Diagnosis
from plumb.model.plain import noun_of, plainly, ranked

TITLE = "What may act too"
HEADER = ("may act too", "up to", "taken up")
TAKEN_UP = "the share of it that other numbers of the motors would make up for"
WORDS = (
    "These causes may act too, unseen by these marks. Up to: by how much each may move the marks, "
    f"RMS. Taken up: {TAKEN_UP}."
)


@dataclass(frozen=True)
class UnseenCause:
    """A cause that is no suspect and may act all the same."""

    noun: str
    mm: float  # RMS by which it may move the marks
    taken_up: str  # how much of that a fitted frame takes up


@dataclass(frozen=True)
class Unseen:
    """Effects that may act unseen, and the words for them."""

    causes: tuple[UnseenCause, ...]  # that with the largest size first
    silent: str  # a sentence on the causes of which the marks say nothing; empty: there is none
    title: str = TITLE
    words: str = WORDS
    header: tuple[str, str, str] = HEADER


def unseen_by(diagnosis: Diagnosis, most: int) -> Unseen:
    """Return the largest causes that may act unseen, `most` at most."""
    rooms = [room for room in diagnosis.could_hide if room.effect not in diagnosis.suspects]
    shares = {each.effect: each.hidden_share for each in diagnosis.ranking}
    causes = [
        UnseenCause(noun_of(room.effect), room.mm, share_words(shares[room.effect]))
        for room in rooms
        if room.mm
    ]
    silent = [room.effect for room in rooms if room.mm is None]
    return Unseen(
        causes=tuple(ranked(causes, lambda cause: -cause.mm)[:most]),
        silent=f"these marks say nothing of {plainly(silent)}" if silent else "",
    )


def share_words(share: float | None) -> str:
    """Return a share for people; a dash where no mark feels the cause."""
    return "-" if share is None else f"{100 * share:.0f} %"
