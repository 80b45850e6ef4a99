"""The first day of a machine, step by step: wires, numbers, reach, chains, the first mark.

Nothing moves without a yes to a sentence that names what will move and how far.
"""

import json
import math
from collections.abc import Callable, Collection
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Literal

import numpy as np
from pydantic.dataclasses import dataclass as pydantic_dataclass

from plumb.diary.file import write_and_keep
from plumb.firmware.settings import CLIENT_NUMBERS, machine_of_numbers
from plumb.fit.compare import expected_anywhere, expected_error, expected_priors, expected_sentence
from plumb.fit.inputs import settings_in
from plumb.line.memory import lines_for, read_numbers
from plumb.line.sender import RefusedError, Sender
from plumb.model.reach import percent, survey_sheet
from plumb.settings import GRAVITY, MachineSettings, frame_of, machine_toml
from plumb.text.errors import InputError
from plumb.text.files import numbered, read_bytes, read_text, write_whole
from plumb.text.values import Unit

# The guide's dialogue with its owner, the evidence of a short jog, and the progress so far.


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
        {"s": "it went up", "l": "it went down", "o": "a chain moved", "n": "nothing moved"},
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


# The steps of the guide. Each takes a Visit, and says whether it is done.

SETTINGS = "machine.toml"
SLEDS = {"r": "on a ring or a linkage: both chains point at the bit", "b": "on two brackets"}
EXTENDED, Z_ATTACHED, Z_GAIN = 11, 16, 29  # $-numbers
TURN = 40.0  # [mm] of chain: two thirds of a turn of the sprocket
NEAR = 0.5  # [mm] from the middle, at most
DIMPLE = 2.0  # [mm] depth of the first mark
HEIGHT_AFTER = 5.0  # [mm] the bit goes up after it
WEIGHT_SIGMA = 0.3  # [kg]
FARTHEST = 200.0  # [mm] of a first mark from the middle: more is a misreading


@dataclass
class GuideVisit:
    """A machine at the end of a line, its owner, and how far they came."""

    sender: Sender
    talk: Talk
    progress: GuideProgress
    hang: Callable[[], None] = lambda: None  # hears that the sled hangs now: for virtual machines

    @property
    def path(self) -> Path:
        return self.progress.folder / SETTINGS

    @property
    def height(self) -> float:
        """Of the bit, as the machine last reported it [mm]."""
        return self.sender.status.place[2] if self.sender.status else np.nan

    def settings(self) -> MachineSettings:
        """Return the machine as the folder knows it."""
        return settings_in(self.path)

    def write(self, text: str) -> None:
        """Write the settings; those that were there stay under another name, as marks need them."""
        keep_other(self.path, text.encode())
        write_whole(self.path, text.encode())

    def move(self, *lines: str) -> str:
        """Send lines and wait until the machine stands; what it said if it refused them."""
        try:
            self.sender.stream(lines)
            self.sender.await_rest(attended=True)
        except RefusedError as error:
            self.sender.brake()
            self.sender.await_rest()
            return str(error).partition("the machine says: ")[2] or str(error)
        return ""

    def is_stopped(self, *lines: str) -> bool:
        """Do the same, and say what the machine said; whether it refused them."""
        alarm = self.move(*lines)
        if alarm:
            self.talk.say(f"The machine stopped: {alarm}")
        return bool(alarm)


def read_machine(visit: GuideVisit) -> bool:
    """Read the machine's numbers into machine.toml. Nothing moves."""
    numbers = read_numbers(visit.sender)
    if visit.path.exists():
        question = f"{visit.path.name} exists. Replace it with the machine's numbers?"
        if not visit.talk.says_yes(question):
            return True
    visit.write(machine_toml(machine_of_numbers(numbers)))
    visit.talk.say(f"The machine answers, and its numbers are in {visit.path.name}.")
    return True


def check_wires(visit: GuideVisit) -> bool:
    """Jog each axis a little and ask what the owner saw."""
    unit = visit.talk.unit
    jogs = [chain_jog("left", unit), chain_jog("right", unit)]
    if _has_z(visit):
        jogs.append(height_jog(unit))
    return all(_is_wired_right(visit, jog) for jog in jogs)


def _has_z(visit: GuideVisit) -> bool:
    """Return whether z has a motor; it gets the gain that a client sends, without which it
    drifts.
    """
    numbers = read_numbers(visit.sender)
    if not numbers.get(Z_ATTACHED):
        return False
    if not numbers.get(Z_GAIN):
        line = f"${Z_GAIN}={CLIENT_NUMBERS[Z_GAIN]:g}"
        visit.sender.stream([line])
        visit.talk.say(f"No client has told this machine how to hold z, so it got {line}.")
    return True


def _is_wired_right(visit: GuideVisit, jog: Jog) -> bool:
    if not visit.talk.agrees(jog.moves, jog.act):
        return False
    before = visit.height
    alarm = visit.move(*jog.there)
    is_height = jog.axis == "z" and not alarm
    astray = ran_away(HEIGHT, visit.height - before, visit.talk.unit) if is_height else ""
    seen = visit.talk.choice(jog.question, jog.answers)
    mend = astray or remedy(jog.axis, seen, alarm)
    if not (alarm or astray):
        visit.move(*jog.back)
    if not mend:
        return True
    visit.talk.say(
        f"{mend}\nSwitch the power off before you touch a wire. Then run this step again."
    )
    return False


def tell_numbers(visit: GuideVisit) -> bool:
    """Ask what the owner knows, write it into machine.toml and into the machine."""
    settings, talk = visit.settings(), visit.talk
    if talk.choice("How does the sled hang?", SLEDS) == "b":
        talk.say(
            "Two fixed brackets tilt the sled, and the lab's model has no such tilt. Set this sled "
            "up with GroundControl, or hang it on a ring."
        )
        return False
    talk.say("Measure with a steel tape.")
    frame = dict(settings.frame)
    for known in LENGTHS:
        # People measure the height from the sheet's edge, the frame counts it from its middle.
        below = settings.sheet_height / 2 if known.name == "motor_height" else 0.0
        now = frame[known.name] - below
        frame[known.name] = below + talk.number(known.question, known.low, known.high, usual=now)
        visit.progress.sigmas[known.name] = talk.number(
            "How far may that be wrong", 0.1, 100.0, usual=known.sigma
        )
    now = settings.sled_weight / GRAVITY
    question = "Weight of the sled with router and bricks"
    frame["sled_weight"] = GRAVITY * talk.number(
        question, LIGHTEST, HEAVIEST, usual=now, kind="mass"
    )
    visit.progress.sigmas["sled_weight"] = GRAVITY * WEIGHT_SIGMA
    changed = replace(settings, **frame_of(frame))
    lines = lines_for(changed, visit.path.name)
    written, _, failure = write_and_keep(visit.sender, visit.path, lines)
    visit.write(machine_toml(changed))
    rows = [f"  ${number}: {old:g} -> {new:g}" for number, (old, new) in written.changed.items()]
    talk.say("\n".join(["The machine holds these numbers; each was read back.", *rows]))
    talk.say("The numbers that it had before are kept in this folder: nothing is lost.")
    if failure:
        talk.say(failure)
    return True


def show_reach(visit: GuideVisit) -> bool:
    """Say how much of the sheet the machine can use, and how far off is normal now."""
    settings = visit.settings()
    survey = survey_sheet(settings)
    expected = expected_anywhere(settings, expected_priors(visit.progress.sigmas))
    visit.talk.say(
        f"The machine can use {percent(survey.shares['usable'])} of the sheet; Reach shows where.\n"
        f"{expected_sentence(expected, visit.talk.unit)}"
    )
    return True


def set_chains(visit: GuideVisit) -> bool:
    """Return both sprockets to 12 o'clock, chains on their top teeth, chains paid out."""
    talk, unit = visit.talk, visit.talk.unit
    talk.say("Take both chains off their sprockets.")
    for side in ("left", "right"):
        _turn_to_twelve(visit, side)
    hooked = (
        "Lay each chain's end link over the tooth that points straight up. The machine then takes "
        f"both chains as {unit.brief(0)} long. Nothing moves."
    )
    if not talk.agrees(hooked, f"Take both chains as {unit.brief(0)} long; nothing moves"):
        return False
    visit.move("B06 L0 R0")
    out = read_numbers(visit.sender)[EXTENDED]
    for side, line in (("left", "B02 L1 R0"), ("right", "B02 L0 R1")):
        length = unit.brief(out)
        moves = f"The {side.upper()} motor pays out {length} of chain. Keep the chain on the teeth."
        if not talk.agrees(moves, f"Pay out {length} of the {side} chain"):
            return False
        if visit.is_stopped(line):
            return False
    return True


def _turn_to_twelve(visit: GuideVisit, side: str) -> None:
    """Turn a sprocket by what the owner types, until a tooth points straight up."""
    question = (
        f"Turn the {side} sprocket until a tooth points straight up; minus turns it back. Length "
        "of chain"
    )
    while size := visit.talk.number(question, -TURN, TURN, kind="turn"):
        visit.is_stopped("G91", f"B09 {side[0].upper()}{size:.2f} F300", "G90")


def first_mark(visit: GuideVisit) -> bool:
    """Hang the sled, drive it to the middle, make a dimple, and compare with the tape."""
    talk, settings, unit = visit.talk, visit.settings(), visit.talk.unit
    _has_z(visit)
    moves = "Hang the sled on both chains. Both motors then bring it to the MIDDLE of the sheet."
    if not talk.agrees(moves, "Move the sled to the middle of the sheet"):
        return False
    visit.hang()
    alarm = visit.move("B15")
    place = visit.sender.status.place if visit.sender.status else (np.inf, np.inf, 0.0)
    if alarm or max(abs(place[0]), abs(place[1])) > NEAR:
        reported = f"it reports {unit.bare(place[0])}, {unit.bare(place[1])} {unit.name}"
        talk.say(f"The sled is not in the middle: {alarm or reported}")
        return False
    moves = (
        "Switch the router on, its bit just above the sheet. The Z motor lowers the bit by "
        f"{unit.brief(DIMPLE)} and raises it by {unit.brief(HEIGHT_AFTER)}."
    )
    act = f"Lower the bit by {unit.brief(DIMPLE)} and raise it by {unit.brief(HEIGHT_AFTER)}"
    if not talk.agrees(moves, act):
        return False
    if visit.is_stopped("G91", f"G1 Z-{DIMPLE:g} F100", f"G0 Z{HEIGHT_AFTER:g}", "G90"):
        return False
    return _judge_mark(visit, settings)


def _judge_mark(visit: GuideVisit, settings: MachineSettings) -> bool:
    """Say how far the first mark is off, and whether that is normal."""
    unit = visit.talk.unit
    ways = (("left", settings.sheet_width / 2), ("top", settings.sheet_height / 2))
    off = math.hypot(
        *(
            visit.talk.number(
                f"From the sheet's {edge} edge to the mark",
                middle - FARTHEST,
                middle + FARTHEST,
                usual=middle,
            )
            - middle
            for edge, middle in ways
        )
    )
    priors = expected_priors(visit.progress.sigmas)
    normal = 2 * expected_error(settings, priors, at=np.zeros((1, 2))).frame
    said = f"The mark is {unit.worded(off, 1)} from the middle"
    visit.talk.say(
        f"{said}. Up to {unit.worded(normal, 0)} is normal."
        if off <= normal
        else f"{said}; more than the {unit.worded(normal, 0)} that your numbers allow. Measure the "
        "motors again, and look whether a chain sits a tooth off."
    )
    return off <= normal


@dataclass(frozen=True)
class Step:
    """A step of the guide."""

    name: str
    title: str
    run: Callable[[GuideVisit], bool]


STEPS = (
    Step("read", "Read the machine's numbers", read_machine),
    Step("wires", "Does each motor turn the right way?", check_wires),
    Step("numbers", "What do you know of the machine?", tell_numbers),
    Step("reach", "What can it reach?", show_reach),
    Step("chains", "Chains at 12 o'clock", set_chains),
    Step("mark", "The first mark", first_mark),
)


def take(visit: GuideVisit, step: Step) -> bool:
    """Take a step, and keep that it is done. Raises LeftError if the owner leaves it."""
    done = step.run(visit)
    if done:
        visit.progress.finish(step.name)
    return done


def open_step(done: Collection[str]) -> str:
    """Return the name of the first step that is not done; empty if all are."""
    return next((step.name for step in STEPS if step.name not in done), "")


# A file that the guide replaces: what was in it stays in the folder under another name.


def keep_other(path: Path, content: bytes) -> None:
    """Keep what is in a file if it is not this content, as NAME-old, NAME-old-2 and so on."""
    if not path.is_file() or path.stat().st_size == 0 or read_bytes(path) == content:
        return
    before = read_bytes(path)
    for name in numbered(f"{path.stem}-old"):
        each = path.with_name(f"{name}{path.suffix}")
        if not each.exists():
            return write_whole(each, before)
        if each.is_file() and read_bytes(each) == before:
            return
