"""Lets a virtual machine work for an hour, and says what drifted, was late or wore out.

The jobs are drawn by chance, while somebody holds the machine and changes its feed.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import ceil

import numpy as np
from job import Job
from plumb.cli.arguments import length
from plumb.cli.output import ended
from plumb.cli.screen import Bar, sentences, table
from plumb.firmware.telemetry import latest
from plumb.line.sender import Sender
from scene import Scene

REACH = (800.0, 400.0)  # [mm] to either side of the middle of the sheet
MOVES = 15  # of a job, which ends with a rest
HOLD = b"\x84"
FEEDS = (b"\x90", b"\x91", b"\x92", b"\x93", b"\x94")  # 100 %, +10, -10, +1, -1
EVENTS_EACH = 4.0  # [s] between what the operator does
SILENCE = 1.5  # [s] clients give up after two
TICK = 10_000  # [us] from a control tick to the next
ASTRAY = 0.05  # [mm] of the bit: what the model and a resting motor leave
DRIFT = 0.02  # [mm] a report shows hundredths
ENDURES = 100_000  # writes of a byte of the EEPROM
SLOTS, WRITES_EACH = 65, 2  # of the ring of positions; of a slot's byte of motion


@dataclass(frozen=True)
class Soak:
    """What became of a machine in a long time of work."""

    hours: float  # of the machine's time
    lines: int
    rests: int  # after each of which the position is kept
    holds: int
    feeds: int  # changes of the feed
    astray: float  # [mm] at most, at any rest, from where the machine said it was
    drift: float  # [mm] by which that grew from the first quarter of the rests to the last
    silence: float  # [s] at most between two lines
    late: int  # times that the motors waited for a move in the middle of another
    longest_tick: int  # [us] 0 where nobody measures it
    most_writes: int  # of a byte of the EEPROM
    due_writes: int  # as the ring of positions has it
    suspected: int  # slips of a chain, of which there was none
    complaints: tuple[str, ...]

    @property
    def is_well(self) -> bool:
        """Whether nothing drifted, nothing was late, and nothing wore out."""
        return (
            not self.complaints
            and self.astray < ASTRAY
            and abs(self.drift) < DRIFT
            and self.silence < SILENCE
            and self.late == 0
            and self.longest_tick < TICK
            and self.most_writes <= self.due_writes
        )

    @property
    def years(self) -> float:
        """Of three hundred days of eight hours, until a byte is worn."""
        writes_an_hour = WRITES_EACH / SLOTS * self.rests / self.hours
        return ENDURES / writes_an_hour / (300 * 8)


class Operator:
    """Somebody who holds the machine and changes its feed while it works."""

    def __init__(self, scene: Scene) -> None:
        self._scene = scene
        self._next = 0.0  # [s]
        self._is_holding = False
        self.holds = self.feeds = 0

    def attend(self, sender: Sender) -> None:
        """Do what is due."""
        now, source = self._scene.machine.seconds, self._scene.source
        if now < self._next:
            return
        if self._is_holding:
            sender.go_on()
            self._is_holding = False
        elif source.random() < 0.3:
            sender.hold()
            self._is_holding = True
            self.holds += 1
        else:
            self._scene.wire.write(FEEDS[source.integers(len(FEEDS))])
            self.feeds += 1
        self._next = now + source.exponential(EVENTS_EACH)

    def go_away(self) -> None:
        """Leave the machine alone, at the feeds of its program."""
        if self._is_holding:
            self._scene.sender.go_on()
            self._is_holding = False
        self._scene.wire.write(FEEDS[0])


def soak(
    minutes: float,
    *,
    seed: int,
    elf: str | None = None,
    friction: float = 0.0,
    progress: Callable[[float], None] = lambda share: None,
) -> Soak:
    """Let a machine work for some minutes of its time; friction [N] of the sled on the sheet."""
    scene = Scene(seed, elf=elf, friction=friction)
    operator = Operator(scene)
    job = Job(scene.source, middle=(0.0, 0.0), reach=REACH, slowest=100)
    start, lines, astray = scene.machine.seconds, 0, list[float]()
    while scene.machine.seconds - start < 60 * minutes:
        progress((scene.machine.seconds - start) / (60 * minutes))
        drawn = job.lines(MOVES)
        scene.sender.attend = operator.attend
        lines += scene.sender.stream(drawn)
        operator.go_away()
        scene.sender.attend = lambda sender: None
        scene.sender.await_rest()
        astray.append(scene.astray())
    telemetry = latest("\n".join(scene.sender.ask("B30")), "B30")
    quarter = max(1, len(astray) // 4)
    progress(1.0)
    return Soak(
        hours=(scene.machine.seconds - start) / 3600,
        lines=lines,
        rests=len(astray),
        holds=operator.holds,
        feeds=operator.feeds,
        astray=max(astray),
        drift=float(np.mean(astray[-quarter:]) - np.mean(astray[:quarter])),
        silence=scene.wire.longest_silence,
        late=telemetry.dry,
        longest_tick=telemetry.tick_us,
        most_writes=max(scene.machine.eeprom_writes, default=0),
        due_writes=due_writes(len(astray)),
        suspected=sum(telemetry.slips),
        complaints=tuple(line for line in scene.heard if "ALARM" in line or "error" in line),
    )


def due_writes(rests: int) -> int:
    """Return how often a byte of the EEPROM may have been written after `rests` rests.

    A position takes the next of 65 slots; its byte of motion is written with it and when it is
    left.
    """
    return WRITES_EACH * ceil((rests + 1) / SLOTS)


def main(arguments: Sequence[str] | None = None) -> int:
    """Let it work, print what became of it, and return the exit code."""
    words = argparse.ArgumentParser(
        description=__doc__, epilog="Exit: 0 nothing did; 1 something did; 2 it cannot run."
    )
    words.add_argument(
        "--minutes", metavar="M", type=length, default=60.0, help="of the machine's time [60]"
    )
    words.add_argument("--seed", metavar="S", type=int, default=1, help="other jobs [1]")
    words.add_argument("--mega", metavar="ELF", help="run this program on a simulated Mega")
    wanted = words.parse_args(arguments)
    return ended(lambda: _run(wanted), name="soak.py", as_json=False)


def _run(wanted: argparse.Namespace) -> int:
    shown = Bar("the machine works", patience=0.0)
    worked = soak(wanted.minutes, seed=wanted.seed, elf=wanted.mega, progress=shown.show)
    print(as_text(worked))
    return 0 if worked.is_well else 1


def as_text(worked: Soak) -> str:
    """Return a line for each figure, then what all of it came to."""
    rows = [
        ["time of the machine", f"{60 * worked.hours:.1f} min"],
        ["lines, rests", f"{worked.lines}, {worked.rests}"],
        ["holds, changes of the feed", f"{worked.holds}, {worked.feeds}"],
        ["farthest from where it says it is", f"{worked.astray:.3f} mm"],
        ["drift from the first quarter to the last", f"{worked.drift:+z.3f} mm"],
        ["longest silence", f"{worked.silence:.2f} s"],
        ["waits for a move in the middle of another", str(worked.late)],
    ]
    rows.append(["slips of a chain that were suspected", str(worked.suspected)])
    if worked.longest_tick:
        rows.append(["longest control tick", f"{worked.longest_tick} us"])
    if worked.most_writes:
        rows.append(
            [
                "most writes of a byte of the EEPROM",
                f"{worked.most_writes}, due {worked.due_writes}",
            ]
        )
        rows.append(["until it is worn, 300 days of 8 hours a year", f"{worked.years:.0f} years"])
    said = list(worked.complaints) or [
        "Nothing drifted, nothing was late." if worked.is_well else "missed: see the figures"
    ]
    return f"{table(['what', 'measured'], rows)}\n\n{sentences(said, mark='')}"


if __name__ == "__main__":
    sys.exit(main())
