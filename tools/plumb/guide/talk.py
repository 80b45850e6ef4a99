"""The guide's dialogue with its owner, the evidence of a short jog, and the progress so far."""

import json
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

from pydantic.dataclasses import dataclass as pydantic_dataclass

from plumb.text.errors import InputError
from plumb.text.files import read_text, write_whole
from plumb.text.values import Unit


class LeftError(Exception):
    """The owner leaves; what is done stays done."""


Kind = Literal["go", "choice", "length", "turn", "mass"]
YES, NO = "y", "n"


@dataclass(frozen=True)
class Question:
    """A question of the guide; lengths in mm, a mass in kg."""

    kind: Kind
    text: str
    answers: tuple[tuple[str, str], ...] = ()  # letter and words; none: a number is the answer
    usual: float | None = None
    low: float = 0.0
    high: float = 0.0
    number: int = 0

    def fits(self, reply: str) -> bool:
        """Return whether a reply answers it."""
        if self.answers:
            return reply in dict(self.answers)
        try:
            return self.low <= float(reply) <= self.high
        except ValueError:
            return False


@dataclass(frozen=True)
class Talk:
    """Says lines and asks questions. Each question raises LeftError if the owner leaves."""

    say: Callable[[str], None]
    put: Callable[[Question], str]  # waits for the answer
    unit: Unit  # of the lengths that are said

    def agrees(self, what: str, act: str) -> bool:
        """Return whether the owner says yes to what will move; `act` says it in a few words, for a
        button.
        """
        return self.put(Question("go", what, ((YES, act), (NO, "Not now")))) == YES

    def says_yes(self, question: str) -> bool:
        """Return whether the owner says yes to what moves nothing."""
        return self.choice(question, {YES: "Yes", NO: "No"}) == YES

    def choice(self, question: str, answers: dict[str, str]) -> str:
        """Return the letter of one of the answers."""
        return self.put(Question("choice", question, tuple(answers.items())))

    def number(
        self,
        question: str,
        low: float,
        high: float,
        *,
        usual: float | None = None,
        kind: Kind = "length",
    ) -> float:
        """Return a length [mm] or a mass [kg] from low to high."""
        return float(self.put(Question(kind, question, usual=usual, low=low, high=high)))


# What a short jog says of an axis' wires: what moved, which way, and what the machine noticed.

CHAIN, HEIGHT = 20.0, 1.0  # [mm] of a jog
FOLLOWS = 0.3  # [mm] between what was asked for and what the machine counts, at most
SPEED = 300  # [mm/min]
SLED = "The sled, if it hangs, rises a little on that side and comes back."
PLUGS = {"left": "MP3", "right": "MP1", "z": "MP2"}


@dataclass(frozen=True)
class Jog:
    """A move of a single axis, there and back."""

    axis: str
    there: tuple[str, ...]
    back: tuple[str, ...]
    moves: str  # names what will move and how far
    act: str  # the same in a few words
    question: str
    answers: dict[str, str]


def chain_jog(side: str, unit: Unit) -> Jog:
    """Winds 20 mm of a chain in, and pays it out again."""
    other = "right" if side == "left" else "left"
    word = side[0].upper()
    return Jog(
        side,
        ("G91", f"B09 {word}-{CHAIN:g} F{SPEED}", "G90"),
        ("G91", f"B09 {word}{CHAIN:g} F{SPEED}", "G90"),
        f"The {side.upper()} motor winds {unit.brief(CHAIN)} of its chain in, slowly. {SLED}",
        f"Wind {unit.brief(CHAIN)} of the {side} chain in",
        "What did you see?",
        {
            "s": f"the {side} chain got shorter",
            "l": f"the {side} chain got longer",
            "o": f"the {other} chain moved",
            "z": "the z axis moved",
            "n": "nothing moved",
        },
    )


def height_jog(unit: Unit) -> Jog:
    """Raise the bit by 1 mm, and lowers it again."""
    return Jog(
        "z",
        ("G91", f"G0 Z{HEIGHT:g}", "G90"),
        ("G91", f"G0 Z-{HEIGHT:g}", "G90"),
        f"The Z motor raises the router by {unit.brief(HEIGHT)}, or lowers it if a wire is wrong: "
        "take the bit out, or leave it room. Watch the screw that lifts the router.",
        f"Raise the router by {unit.brief(HEIGHT)}",
        "Did the router go up? A turn of its screw by a few degrees counts.",
        {
            "s": "it went up",
            "l": "it went down",
            "o": "a chain moved",
            "n": "nothing moved",
        },
    )


def ran_away(asked: float, counted: float, unit: Unit) -> str:
    """Return what is wrong with a way [mm] that the machine counted; empty if it is as was
    asked.
    """
    if abs(counted - asked) <= FOLLOWS:
        return ""
    return (
        f"The machine was to move by {unit.worded(asked)} and counts {unit.worded(counted)}: the "
        "motor does not follow. Check its power wires, its encoder, and its gains ($29 to $36)."
    )


def remedy(axis: str, seen: str, alarm: str) -> str:
    """Return what to mend after a jog; empty if all is right.

    `seen` is a letter of the jog's answers; `alarm` is what the machine said, empty for nothing.
    """
    motor = f"the {axis} motor" if axis != "z" else "the z motor"
    if seen in ("o", "z"):
        return (
            f"The plug of {motor} is on the wrong socket. It belongs on {PLUGS[axis]}: its power "
            "wires and its encoder together."
        )
    if "wired in reverse" in alarm:
        if seen == "l":
            return f"The power wires of {motor} are swapped: exchange the two."
        if seen == "n":
            return (
                f"The power wires of {motor} are swapped, or its encoder counts backwards; it "
                "stopped too soon to tell. Exchange its two power wires: if it was the encoder, "
                "this step then says what is left to do."
            )
        return f"The encoder of {motor} counts backwards: exchange its wires A and B."
    if "stands still" in alarm:
        if seen == "n":
            return (
                f"{motor.capitalize()} gets no power, or something blocks it. Check the 12 V "
                f"supply, then its power wires on {PLUGS[axis]}."
            )
        return f"{motor.capitalize()} turns, but its encoder is silent: push its plug in."
    if alarm:
        return f"The machine stopped: {alarm}"
    if seen == "n":
        return (
            "The machine counts a move that you do not see. Are its motors simulated? Send B99 OFF."
        )
    if seen == "s":
        return ""
    if axis == "z":
        return (
            "Z runs upside down: give $19 (its travel for one turn) the other sign, and in your "
            "client too, which sends its own zDistPerRot."
        )
    return (
        f"{motor.capitalize()} runs the wrong way. If the chains leave the bottom of the "
        "sprockets, set $38 to 2. If not, exchange its two power wires, and its encoder's A and B."
    )


# How far the owner came, in `guide.json`: each step can be left and taken up again.

FILE = "guide.json"


@pydantic_dataclass
class GuideProgress:
    """Steps that are done, and the owner's statements on the machine."""

    folder: Path
    done: list[str] = field(default_factory=list)
    sigmas: dict[str, float] = field(default_factory=dict)  # how far a number may be wrong

    def finish(self, step: str) -> None:
        """Keep that a step is done."""
        if step not in self.done:
            self.done.append(step)
        self.save()

    def save(self) -> None:
        """Write the file."""
        kept = {"done": self.done, "sigmas": self.sigmas}
        write_whole(self.folder / FILE, f"{json.dumps(kept, indent=2)}\n".encode())


def progress_in(folder: Path) -> GuideProgress:
    """Return the progress in a folder; an empty progress where nothing was begun. Raises
    InputError.
    """
    path = folder / FILE
    if not path.exists():
        return GuideProgress(folder)
    try:
        return GuideProgress(folder, **json.loads(read_text(path)))
    except (ValueError, TypeError):
        raise InputError(path, "is damaged", remedy="delete it, and begin again") from None


# What the owner knows of the machine, and how far each number may be wrong.


@dataclass(frozen=True)
class Known:
    """A number that a tape or a scale gives."""

    name: str  # of the frame
    question: str
    sigma: float  # [mm] how far it is usually wrong
    low: float  # [mm]
    high: float


LENGTHS = (
    Known(
        "motor_gap",
        "From the middle of the left motor's shaft to the middle of the right one's",
        3.0,
        1500.0,
        5000.0,
    ),
    Known(
        "motor_height",
        "From the sheet's top edge up to the line between the shafts",
        20.0,
        0.0,
        2000.0,
    ),
    Known(
        "rotation_radius",
        "From the bit to the end of a chain, along the chain's line (the ring's radius)",
        3.0,
        50.0,
        400.0,
    ),
)
LIGHTEST, HEAVIEST = 3.0, 40.0  # [kg] of a sled with its router
