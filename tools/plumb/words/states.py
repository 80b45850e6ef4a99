"""What follows from the state of each answer, for terminal, page and JSON."""

from collections.abc import Mapping
from dataclasses import dataclass

from plumb.words import Kind

AGAIN, NEXT, ADD = "again", "next", "add"  # commands with the same board; again: the same command


@dataclass(frozen=True)
class Follows:
    """What follows from a state."""

    kind: Kind
    code: int  # exit code
    said: str  # what comes next, with a command below
    command: str  # empty: nothing comes next
    screen: str = "verdict"
    link: str = "Back to the verdict"  # to that screen
    title: str = ""  # where there are no numbers


COVER = "marks all over the sheet"
STATES: Mapping[str, Follows] = {
    "read_again": Follows(
        kind="bad",
        code=1,
        said="When the file is corrected:",
        command=AGAIN,
        screen="readings",
        link="Go to {}",
        title="A reading disagrees: look at it first",
    ),
    "measure_first": Follows(
        kind="open",
        code=1,
        said="What to measure next:",
        command=NEXT,
        screen="measure",
        link=f"Choose {COVER}",
        title=f"First measure {COVER}",
    ),
    "good": Follows("good", 0, "Nothing to change: cut your jobs.", "", title="Nothing to change"),
    "frame_only": Follows("good", 0, "Fit the frame:", ADD),
    "several_causes": Follows("open", 1, "Add what is known:", ADD),
    "unknown_cause": Follows("bad", 1, "What to measure next:", NEXT),
    "cannot_tell": Follows(
        "open", 0, "What to measure next:", NEXT, title="Several things could be it"
    ),
    "one_cause": Follows("good", 0, "Add it:", ADD),
    "impossible": Follows("bad", 1, "What to measure next:", NEXT),
    "better": Follows("good", 0, "Write it:", ADD, "correct", "Correct it: {}"),
}
# What follows from the states of all other answers; a bad one ends a command with 1.
KINDS: Mapping[str, Kind] = {
    "near_noise": "good",
    "off": "open",
    "settles": "good",
    "helps": "open",
    "nothing_would": "open",
    "as_fitted": "good",
    "sheet_moved": "bad",
    "changed": "bad",
    "beyond_these_marks": "bad",
    "clean": "good",
    "doubtful": "open",
    "wrong": "bad",
}
