"""The steps of the guide. Each takes a Visit, and says whether it is done."""

import math
from collections.abc import Callable, Collection
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from plumb.diary.file import write_and_keep
from plumb.firmware.settings import CLIENT_NUMBERS, firmware_numbers, gcode, machine_of_numbers
from plumb.fit.compare import expected_anywhere, expected_error, expected_priors, expected_sentence
from plumb.fit.inputs import settings_in
from plumb.guide.talk import (
    HEAVIEST,
    HEIGHT,
    LENGTHS,
    LIGHTEST,
    GuideProgress,
    Jog,
    Talk,
    chain_jog,
    height_jog,
    ran_away,
    remedy,
)
from plumb.line.memory import read_numbers
from plumb.line.sender import RefusedError, Sender
from plumb.model.reach import percent, survey_sheet
from plumb.settings.machine import GRAVITY, MachineSettings, frame_of, machine_toml
from plumb.text.files import numbered, read_bytes, write_whole

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
    lines = gcode(firmware_numbers(changed)).decode().splitlines()
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
