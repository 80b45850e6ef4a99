"""The motor gap by B11 on virtual machines: `tools/research/gap_tables.py` prints the tables."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from plumb.bench.causes import MAKER
from plumb.model.predict import MotorGap, judged, motor_gap
from plumb.vm.garage import VirtualMachine

MACHINES = 24
OTHERS = 36  # more machines with motors off by up to 30 %
LONG = 20.0  # [s] the T of B11 that leaves time for three pulls
SECONDS = (3.0, 4.5, 15.0)  # the T of GroundControl's button, and two that are longer
SAID = re.compile(r"\[Measure: ([\d.]+)\]")
PULLS = re.compile(r"spread ([\d.]+) mm, (\d) pull")
NEWTONS = 100.0  # a flex is stated for this pull


@dataclass(frozen=True)
class Frame:
    """A machine whose gap is measured."""

    gap: float  # [mm]
    flex: float  # [mm per 100 N] by which both motors together come closer
    seed: int  # of its motors; 0: as they are meant to be
    volts: float  # of its supply
    slack: float  # [mm] of the chain when it is hooked


@dataclass(frozen=True)
class Trial:
    """What was found of a frame."""

    frame: Frame
    pull: float  # [N] that truly remained
    by_force: MotorGap  # with the stated pull
    by_drop: MotorGap  # with the pull from the chain's drop
    pulls: int  # 0: the chain was not tight yet
    spread: float  # [mm] of the pulls

    @property
    def force_error(self) -> float:
        """[mm]"""
        return self.by_force.gap - self.frame.gap

    @property
    def drop_error(self) -> float:
        """[mm]"""
        return self.by_drop.gap - self.frame.gap


def frames(count: int = MACHINES) -> list[Frame]:
    """Frames by chance. The first half has nominal motors, the others are off by up to 30 %."""
    source = np.random.default_rng(5)
    return [
        Frame(
            gap=float(source.uniform(2900, 3700)),
            flex=float(source.uniform(0, 2.5)),
            seed=0 if i < count // 2 else i,
            volts=float(source.uniform(10.5, 13)),
            slack=float(source.uniform(2, 15)),
        )
        for i in range(count)
    ]


def trial(frame: Frame, drop_error: float, *, seconds: float = LONG) -> Trial:
    """Try it: hook the chain, pull it with B11, read its length, and take its drop with a ruler.

    seconds: the T of B11.
    """
    give = frame.flex / NEWTONS / 2
    numbers = judged(MAKER) | {"motor_gap": frame.gap, "left.inward": give, "right.inward": give}
    # The chains must reach the middle of the sheet before the left chain is hooked.
    machine = VirtualMachine(numbers, seed=frame.seed, paid_out=frame.gap * 0.57)
    machine.hook_across("left", frame.slack)
    machine.set_motor_supply(frame.volts)
    machine.start()
    machine.advance(3000)
    left, right = machine.chains
    for line, milliseconds in (
        (f"B06 L{left:.3f} R{right:.3f}", 1000),
        ("$42=2000", 500),
        (f"B11 S255 T{seconds:g} L", int(1000 * seconds) + 500),
        ("B10 L", 500),
    ):
        machine.send(line.encode() + b"\n")
        machine.advance(milliseconds)
    heard = machine.take_said().decode()
    said, pulls = SAID.search(heard), PULLS.search(heard)
    if said is None:
        raise RuntimeError("the machine did not say the chain's length")
    lengths, weight = [float(said[1])], numbers["left.weight"]
    pull, drop = machine.across
    by_force = motor_gap(lengths, chain_weight=weight, flex=frame.flex)
    by_drop = motor_gap(lengths, chain_weight=weight, flex=frame.flex, drop=drop + drop_error)
    spread, count = (float(pulls[1]), int(pulls[2])) if pulls else (0.0, 0)
    return Trial(frame, pull, by_force, by_drop, count, spread)


def trials(chosen: Sequence[Frame], *, seconds: float = LONG) -> list[Trial]:
    """Return all these frames, each drop read to a millimetre."""
    source = np.random.default_rng(6)
    return [trial(frame, float(source.uniform(-1, 1)), seconds=seconds) for frame in chosen]


def row(each: Trial) -> str:
    """Return a machine's line of the table."""
    frame, force, drop = each.frame, each.by_force, each.by_drop
    motors = f"seed {frame.seed}" if frame.seed else "nominal"
    return (
        f"| {frame.gap:.2f} | {frame.flex:.2f} | {motors} | {frame.volts:.1f} | {each.pull:.0f} | "
        f"{each.force_error:+z.2f} ± {force.interval:.2f} | {drop.gap:.2f} | "
        f"{each.drop_error:+z.2f} ± {drop.interval:.2f} |"
    )


def machines_table(done: Sequence[Trial]) -> str:
    """Return a line for each machine."""
    heads = "| gap | flex | motors | supply | pull | error by force | found by drop | error |"
    return "\n".join([heads, "|---|---|---|---|---|---|---|---|", *map(row, done)])


def sizes(errors: Sequence[float]) -> str:
    """RMS and worst of errors."""
    rms = float(np.sqrt(np.mean(np.square(errors))))
    return f"{rms:.2f} | {max(map(abs, errors)):.2f}"


def within(
    done: Sequence[Trial], error: Callable[[Trial], float], half: Callable[[Trial], float]
) -> int:
    """Return how many errors lie within their interval."""
    return sum(abs(error(each)) <= half(each) for each in done)


def kinds_table(kinds: Mapping[str, Sequence[Trial]]) -> str:
    """Return a line for each kind of motors."""
    lines = [
        "| motors | pull | by force: RMS | worst | in interval "
        "| by drop: RMS | worst | in interval |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for name, done in kinds.items():
        pulls = [each.pull for each in done]
        force = within(done, lambda each: each.force_error, lambda each: each.by_force.interval)
        drop = within(done, lambda each: each.drop_error, lambda each: each.by_drop.interval)
        lines.append(
            f"| {name} | {min(pulls):.0f} to {max(pulls):.0f} "
            f"| {sizes([each.force_error for each in done])} | {force} of {len(done)} "
            f"| {sizes([each.drop_error for each in done])} | {drop} of {len(done)} |"
        )
    return "\n".join(lines)


def pulls_table(done: Mapping[float, Sequence[Trial]]) -> str:
    """Return a line for each T and each number of pulls that fitted into it."""
    lines = [
        "| T | pulls | machines | slack | largest spread | by force: RMS | worst |",
        "|---|---|---|---|---|---|---|",
    ]
    for seconds, tried in done.items():
        for count in sorted({each.pulls for each in tried}):
            some = [each for each in tried if each.pulls == count]
            slack = [each.frame.slack for each in some]
            spread = f"{max(each.spread for each in some):.2f}" if count > 1 else "–"
            errors = sizes([each.force_error for each in some]) if count else "– | –"
            lines.append(
                f"| {seconds:g} | {count} | {len(some)} | {min(slack):.0f} to {max(slack):.0f} "
                f"| {spread} | {errors} |"
            )
    return "\n".join(lines)


def tables() -> tuple[str, str, str]:
    """Return what docs/commands/gap.md shows: each machine, each kind of motors, each T."""
    usual = frames()
    done = trials(usual)
    kinds = {
        "nominal": [each for each in done if not each.frame.seed],
        "off by up to 30 %": [each for each in done if each.frame.seed],
        "off, others": trials(frames(2 * OTHERS)[OTHERS:]),
    }
    by_seconds = {seconds: trials(usual, seconds=seconds) for seconds in SECONDS}
    return machines_table(done), kinds_table(kinds), pulls_table(by_seconds)


def main() -> None:
    """Print the tables."""
    print("\n\n".join(tables()))


if __name__ == "__main__":
    main()
