"""Plays a dialogue of test/dialogues on a virtual machine, as the stage of the host's tests does.

test/vm/script.h says what its lines mean, test/test_dialogues/stage_questions.cpp what is asked.
As a program it takes a dialogue, an ELF file, the sled's weight [N] and the shield.
"""

from __future__ import annotations

import re
import sys
from collections import deque
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from plumb import _judge, _vm

ROOT = Path(__file__).resolve().parents[3]
DIALOGUES = ROOT / "test/dialogues"
NUMBER = re.compile(r"[-+]?\d+(?:\.\d*)?")
SPECIAL = {"X": b"\x18", "N": b"\n", "H": b"\x84", **{str(i): bytes([0x90 + i]) for i in range(5)}}
PATIENCE = 150.0  # [s] for a line that is expected
UNPOWERED, LOOKS_ALIKE, MEASURED = 0.15, 0.25, 0.02  # [s] as on the pins of a Mega
SLED_WEIGHT, CHAIN_WEIGHT = 97.9, 0.00137293  # [N], [N/mm] as the firmware takes them
NUMBERS = {
    **{f"{side}.weight": CHAIN_WEIGHT for side in ("left", "right")},
    **{f"{side}.compliance": 5.2e-6 for side in ("left", "right")},
}
WIRES = {
    "complain": "driver_complains",
    "block": "blocked",
    "unplug": "encoder_unplugged",
    "reverse": "motor_reversed",
}
ENDS = {"free": "block", "plug": "unplug"}


class DialogueError(AssertionError):
    """What came otherwise than written."""


@dataclass(frozen=True)
class Step:
    """A line of a dialogue."""

    mark: str
    text: str
    place: str


def steps_of(name: str) -> list[Step]:
    """The steps of a dialogue, with those of the files that it includes."""
    steps = []
    for number, line in enumerate((DIALOGUES / name).read_text(encoding="latin-1").split("\n"), 1):
        if line.startswith("~~ include "):
            steps += steps_of(line[11:])
        elif line and not line.startswith(";"):
            steps.append(Step(line[:2], line[3:], f"{name}:{number}"))
    return steps


def weighed(steps: list[Step], sled_weight: float) -> list[Step]:
    """The steps with the settings of another sled where they set how far its chains sag."""
    sag = f"$160={(CHAIN_WEIGHT / sled_weight) ** 2 / 24:.4g}"
    others: list[Step] = []
    for step in steps:
        if step.mark == "->" and step.text.startswith("$160=") and sled_weight != SLED_WEIGHT:
            weight = Step("->", f"$62={sled_weight}", step.place)
            others += [weight, Step("<-", "ok", step.place), Step("->", sag, step.place)]
        else:
            others.append(step)
    return others


def matches(line: str, wanted: str) -> bool:
    """Whether a line is as expected: `*` any rest, `#` any number, numbers within t."""
    text, _, within = wanted.rpartition(" within ")
    text, tolerance = (text, float(within)) if text else (wanted, 0.0)
    rest = text.endswith("*")
    pattern, numbers = "", []
    for part in re.split(rf"({NUMBER.pattern}|#)", text[: -1 if rest else None]):
        if part == "#":
            pattern += NUMBER.pattern
        elif tolerance and NUMBER.fullmatch(part):
            pattern += f"({NUMBER.pattern})"
            numbers.append(float(part))
        else:
            pattern += re.escape(part)
    match = re.match(pattern + ("" if rest else r"\Z"), line)
    return match is not None and all(
        abs(float(seen) - number) <= tolerance
        for seen, number in zip(match.groups(), numbers, strict=True)
    )


class Player:
    """A virtual machine, and whoever reads it a dialogue."""

    def __init__(
        self,
        name: str,
        *,
        elf: str | None = None,
        sled_weight: float = SLED_WEIGHT,
        shield: int = 2,
    ) -> None:
        """`sled_weight` [N]: the firmware's setting says the same. `shield`: N of v1.N."""
        self.steps = weighed(steps_of(name), sled_weight)
        self.sled_weight = sled_weight
        self.machine = _vm.VirtualMachine(
            NUMBERS | {"sled_weight": sled_weight}, paid_out=1651.0, elf=elf, shield=shield
        )
        self.lines = deque[str]()
        self.partial = self.status = self.errors = ""
        self.reported = self.since = 0.0
        self.driven = dict.fromkeys(("left", "right", "z"), -1.0)
        self.answers = self.halts = 0
        self.stops_when_halted = False
        self.held: np.ndarray | None = None
        self.step = self.steps[0]

    def play(self) -> float:
        """From power-on to the end; how long that took the machine [s]. Raises DialogueError."""
        self.machine.start()
        for step in self.steps:
            self.step = step
            self.since = self.machine.seconds
            while not self.take(self.step):
                self.pass_time(1)
        self.pass_time(1)
        self.hold_that(not self.lines, f"one line too many: {list(self.lines)[:1]}")
        return self.machine.seconds

    def pass_time(self, milliseconds: int) -> None:
        """Let time pass and hear what is said."""
        self.machine.advance(milliseconds)
        for axis in self.driven:
            if self.machine.duty(axis):
                self.driven[axis] = self.machine.seconds
        said = self.machine.take_said()
        if not said:
            return
        *lines, self.partial = (self.partial + said.decode("ascii")).split("\n")
        for line in lines:
            self.hear(line.rstrip("\r"))

    def hear(self, line: str) -> None:
        if line.startswith("<"):
            self.status, self.reported = line, self.machine.seconds
        elif line.startswith("[PE:"):
            self.errors = line
        else:
            self.lines.append(line)
        self.answers += line == "ok" or line.startswith("error:")
        if line.startswith("ALARM: Halted"):
            self.halts += 1
            if self.stops_when_halted:
                self.machine.send(b"!\n")

    @property
    def waited(self) -> float:
        """[s] since this step began."""
        return self.machine.seconds - self.since

    def hold_that(self, holds: bool, otherwise: str) -> None:
        if not holds:
            raise DialogueError(
                f"{self.step.place}: {self.step.text}\n  {otherwise}\n  {self.status}"
            )

    def take(self, step: Step) -> bool:
        """Whether a step is over."""
        if step.mark == "->":
            self.machine.send(step.text.encode() + b"\n")
        elif step.mark == ">>":
            parts = re.split(r"\^(.)", step.text)
            raw = [
                SPECIAL.get(part, b"\n") if i % 2 else part.encode("latin-1")
                for i, part in enumerate(parts)
            ]
            self.machine.send(b"".join(raw))
        elif step.mark in ("<-", "<*"):
            return self.expect(step)
        else:
            verb, _, rest = step.text.partition(" ")
            return self.ask(verb, rest.strip())
        return True

    def expect(self, step: Step) -> bool:
        while self.lines:
            line = self.lines.popleft()
            if matches(line, step.text):
                return True
            self.hold_that(step.mark == "<*", f"came instead: {line}")
        self.hold_that(self.waited < PATIENCE, "nothing came")
        return False

    def ask(self, verb: str, rest: str) -> bool:
        question = getattr(self, "ask_" + verb.replace("-", "_"), None)
        if question is not None:
            answer: bool = question(rest)
            return answer
        axis, numbers = rest.split(" ")[0], [float(each) for each in NUMBER.findall(rest)]
        if verb in WIRES or verb in ENDS:
            self.machine.set_wire(axis, WIRES[ENDS.get(verb, verb)], verb in WIRES)
        elif verb == "pull":
            self.machine.pull(axis, numbers[0])
        elif verb == "coast":
            pass  # the world's motors run on as they do
        elif verb == "miss":
            self.machine.miss_edges(axis, int(numbers[0]))
        elif verb == "supply":
            self.machine.set_board_supply(numbers[0])
        elif verb == "hook":
            self.machine.hook_across(axis, numbers[0])
        elif verb == "unhook":
            self.machine.unhook()
        elif verb == "probe":
            self.machine.set_probe_height(numbers[0])
        elif verb == "hang":
            self.machine.hang_at(*numbers[:2])
        else:
            self.hold_that(False, f"nobody understands {verb}")
        return True

    def ask_wait(self, rest: str) -> bool:
        left = float(rest) - self.waited
        if left > 0.0005:
            self.pass_time(min(20, max(1, int(left * 1000))))
        return left <= 0.0005

    def ask_await(self, rest: str) -> bool:
        self.hold_that(self.waited < 2000, f"only {self.answers} came")
        return self.answers >= int(rest)

    def ask_answers(self, rest: str) -> bool:
        self.lines.clear()
        since = self.answers
        if rest == "from now":
            self.answers = 0
        self.hold_that(rest == "from now" or since == int(rest), f"{since} came")
        return True

    def ask_quiet(self, rest: str) -> bool:
        self.hold_that(not self.lines, f"came: {list(self.lines)[:1]}")
        return True

    def ask_status(self, rest: str) -> bool:
        if self.reported <= self.since:
            return False
        self.hold_that(matches(self.status, rest), "it is")
        return True

    def ask_errors(self, rest: str) -> bool:
        if self.reported <= self.since or not self.errors:
            return False
        self.hold_that(matches(self.errors, rest), self.errors)
        return True

    def place(self) -> np.ndarray:
        """[mm] where the judge hangs the sled on these chains."""
        chains = np.array([self.machine.chains])
        weights = np.array([self.sled_weight])
        return _judge.places(NUMBERS, chains, pushes=0 * chains, weights=weights)[0]

    def ask_sled(self, rest: str) -> bool:
        x, y, most = map(float, NUMBER.findall(rest))
        off = np.hypot(*(self.place() - (x, y)))
        self.hold_that(off <= most, f"the sled is at {self.place()}, off by {off}")
        return True

    def ask_chains(self, rest: str) -> bool:
        left, right, most = map(float, NUMBER.findall(rest))
        off = np.abs(np.subtract(self.machine.chains, (left, right))).max()
        self.hold_that(off <= most, f"they are {self.machine.chains}")
        return True

    def ask_z(self, rest: str) -> bool:
        z, most = map(float, NUMBER.findall(rest))
        self.hold_that(abs(self.machine.height - z) <= most, f"z is at {self.machine.height}")
        return True

    def ask_hold(self, rest: str) -> bool:
        if self.held is None:
            self.held = self.place()
            self.machine.send(b"\x84")
        if self.waited < 1:
            return False
        way, self.held = np.hypot(*(self.place() - self.held)), None
        self.hold_that(way <= float(NUMBER.findall(rest)[0]), f"it went on for {way}")
        return True

    def ask_off(self, rest: str) -> bool:
        is_on = self.is_powered(rest)
        if is_on and self.waited < LOOKS_ALIKE:
            return False
        self.hold_that(not is_on, "it is not")
        return True

    def ask_on(self, rest: str) -> bool:
        self.hold_that(self.is_powered(rest), "it is not")
        return True

    def is_powered(self, axis: str) -> bool:
        return self.machine.seconds - self.driven[axis] < UNPOWERED

    def ask_laser(self, rest: str) -> bool:
        return self.ask_level(self.machine.laser, rest)

    def ask_spindle(self, rest: str) -> bool:
        return self.ask_level(self.machine.spindle, rest)

    def ask_level(self, level: int, rest: str) -> bool:
        numbers = [float(each) for each in NUMBER.findall(rest)] or [255 if rest == "high" else 0]
        within = numbers[1] if len(numbers) > 1 else 0
        is_level = abs(level - numbers[0]) <= within
        if not is_level and self.waited < MEASURED:
            return False
        self.hold_that(is_level, f"it is at {level}")
        return True

    def ask_servo(self, rest: str) -> bool:
        wanted = 255 if rest == "loose" else int(rest)
        self.hold_that(self.machine.servo == wanted, f"it is at {self.machine.servo}")
        return True

    def ask_declare(self, rest: str) -> bool:
        left, right = self.machine.chains
        self.machine.send(f"B06 L{left:.4f} R{right:.4f}\n".encode())
        return True

    def ask_stop_when_halted(self, rest: str) -> bool:
        self.stops_when_halted = True
        return True

    def ask_halts(self, rest: str) -> bool:
        self.hold_that(self.halts >= int(rest), f"{self.halts} came")
        return True

    def ask_power(self, rest: str) -> bool:
        self.machine.cut_power(self.answers % 256)
        self.lines.clear()
        self.partial = ""
        self.machine.start()
        return True


if __name__ == "__main__":
    Player(
        sys.argv[1], elf=sys.argv[2], sled_weight=float(sys.argv[3]), shield=int(sys.argv[4])
    ).play()
