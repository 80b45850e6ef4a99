"""The faults: what happens to a machine in the middle of its job, and what nobody could notice."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from job import Job
from plumb.vm.garage import SHIELD
from scene import AXES, START, Scene

Story = Callable[[Scene], Iterator[float | None]]


MOVES = 8


def any_job(scene: Scene) -> list[str]:
    """Return moves of every kind."""
    return Job(scene.source).lines(MOVES)


def writing_job(scene: Scene) -> list[str]:
    """Return lines that write settings, and keep positions while a relay's spindle starts and
    stops.
    """
    lines = ["$17=2"]
    for value in scene.source.integers(400, 1199, size=3):
        x = scene.source.uniform(-40, 40)
        lines += [f"$9={value}", f"G1 X{x:.2f} F800", "M3", "M5"]
    return lines


def drilling_job(scene: Scene) -> list[str]:
    """Return the bit goes up and down."""
    depths = scene.source.uniform(-6, 3, size=6)
    return [f"G1 Z{depth:.2f} F{scene.source.uniform(15, 55):.0f}" for depth in depths]


def slow_job(scene: Scene) -> list[str]:
    """Return moves at feeds from a crawl to the fastest."""
    return Job(scene.source, slowest=15).lines(4)


@dataclass(frozen=True)
class Fault:
    """A fault, as a story: what happens, with pauses [ms]."""

    name: str
    story: Story
    job: Callable[[Scene], list[str]] = any_job
    before: Callable[[Scene], None] | None = None  # what is wrong when the job begins
    when: tuple[float, float] = (0.02, 0.98)  # share of the job's time in which it strikes
    times: int = 1  # machines for each that is asked for
    caught_by: str = ""  # who notices what the machine cannot
    shield: int = SHIELD  # N of v1.N


def power_cut(scene: Scene) -> Iterator[float | None]:
    """Yield the plug is pulled."""
    scene.cut_power()
    yield 500


def cut_at_a_byte(scene: Scene) -> Iterator[float | None]:
    """Power goes while a byte of the EEPROM is written: of a setting, a mark, a position."""
    start, byte = sum(scene.machine.eeprom_writes), scene.seed % BYTES
    while sum(scene.machine.eeprom_writes) - start <= byte:
        yield None
    scene.machine.advance(int(scene.source.integers(4)))
    scene.cut_power()
    yield 500


def motors_cut(scene: Scene) -> Iterator[float | None]:
    """Yield the motors' supply goes; the processor lives on USB."""
    scene.machine.set_motor_supply(0)
    yield 3000
    scene.machine.set_motor_supply(12)


def sag(scene: Scene) -> Iterator[float | None]:
    """Yield the motors' supply sags for a while."""
    scene.machine.set_motor_supply(scene.source.uniform(5, 10))
    yield scene.source.uniform(300, 5000)
    scene.machine.set_motor_supply(12)


def board_sag(scene: Scene) -> Iterator[float | None]:
    """Yield the processor's supply sags for a while, not so far that it stops."""
    scene.machine.set_board_supply(scene.source.uniform(4.0, 4.25))
    yield scene.source.uniform(1000, 4000)
    scene.machine.set_board_supply(5)


def wire_fault(fault: str, *, axes: tuple[str, ...] = AXES[:2]) -> Story:
    """Return a wire of an axis comes off, and stays off."""

    def story(scene: Scene) -> Iterator[float | None]:
        axis = axes[scene.source.integers(len(axes))]
        scene.machine.set_wire(axis, fault, True)
        yield 0

    return story


def nothing(scene: Scene) -> Iterator[float | None]:
    """Yield all is well."""
    yield 0


def mend(scene: Scene) -> None:
    """Somebody puts wires, supplies and line right."""
    scene.wire.spoil = None
    for axis in AXES:
        for fault in WIRE_FAULTS:
            scene.machine.set_wire(axis, fault, False)
    scene.machine.set_motor_supply(12)
    scene.machine.set_board_supply(5)


def edges_lost(scene: Scene) -> Iterator[float | None]:
    """Edges of an encoder come in pairs: nobody can tell which way."""
    scene.machine.miss_edges(scene.axis, int(scene.source.integers(1, 400)))
    yield 0


def wired_wrong(fault: str) -> Callable[[Scene], None]:
    """Return a wire is wrong when the job begins."""
    return lambda scene: scene.machine.set_wire(scene.axis, fault, True)


def blocked_for_a_while(scene: Scene) -> Iterator[float | None]:
    """Something holds a motor, and lets it go."""
    scene.machine.set_wire(scene.axis, "blocked", True)
    yield scene.source.uniform(20, 1500)
    scene.machine.set_wire(scene.axis, "blocked", False)


def late(scene: Scene) -> Iterator[float | None]:
    """Yield the main program is late."""
    scene.machine.delay_program(int(scene.source.integers(50, 3000)))
    yield 4000


def line_reset(scene: Scene) -> Iterator[float | None]:
    """Another program opens the line, and the board starts again."""
    scene.machine.stop()
    yield 1000


def given_up(characters: bytes) -> Story:
    """Return the client ends the job in the middle."""

    def story(scene: Scene) -> Iterator[float | None]:
        scene.machine.send(characters)
        scene.give_up()
        yield 0

    return story


def character_becomes(others: Callable[[Scene, bytes], bytes]) -> Story:
    """Return a character of the next line arrives as others."""

    def story(scene: Scene) -> Iterator[float | None]:
        def spoil(line: bytes) -> bytes:
            place = int(scene.source.integers(len(line)))
            return line[:place] + others(scene, line[place : place + 1]) + line[place + 1 :]

        scene.wire.spoil = spoil
        yield 0

    return story


def noise(scene: Scene) -> Iterator[float | None]:
    """Yield a burst of noise between two characters."""
    scene.machine.send(scene.source.bytes(int(scene.source.integers(1, 40))))
    yield 0


def tooth(scene: Scene) -> Iterator[float | None]:
    """Yield a chain climbs over a tooth of its sprocket as that turns."""
    scene.machine.climb(scene.axis)
    yield 0


def pulled_without_power(scene: Scene) -> None:
    """Somebody pulls a chain through while the power is off."""
    scene.machine.stop()
    scene.machine.slip(scene.axis, scene.source.uniform(2, 30))
    scene.machine.start()
    scene.listen(START)


def bracket(scene: Scene) -> Iterator[float | None]:
    """Yield a motor's bracket slips on the beam."""
    scene.machine.set("motor_gap", 2978.4 - scene.source.uniform(2, 10))
    yield 0


def beam(scene: Scene) -> Iterator[float | None]:
    """Yield the beam settles for the rest of the job."""
    scene.machine.creep("motor_height", -0.2)
    yield 0


WIRE_FAULTS = (
    "motor_reversed",
    "motor_unplugged",
    "encoder_reversed",
    "encoder_unplugged",
    "channel_lost",
    "blocked",
    "driver_complains",
)
BYTES = 150  # that writing_job() has written; the EEPROM takes 3.4 ms for each

AT_ONCE = (0.0, 0.0)
FAULTS = (
    Fault("power cut in mid-move", power_cut),
    # Twenty tries reach each byte.
    Fault("power cut at a byte of the EEPROM", cut_at_a_byte, writing_job, when=AT_ONCE, times=8),
    Fault("12 V gone, processor on USB", motors_cut),
    Fault("12 V sags to 5 to 10 V", sag),
    Fault("5 V sags below 4.3 V", board_sag),
    Fault("main program late by 0.05 to 3 s", late),
    Fault("encoder edges lost", edges_lost),
    Fault("encoder unplugged", wire_fault("encoder_unplugged"), slow_job),
    Fault("channel of an encoder lost", wire_fault("channel_lost"), slow_job),
    Fault("encoder of z unplugged", wire_fault("encoder_unplugged", axes=("z",)), drilling_job),
    Fault("motor unplugged", wire_fault("motor_unplugged")),
    Fault("motor blocked", wire_fault("blocked")),
    Fault("motor of z blocked", wire_fault("blocked", axes=("z",)), drilling_job),
    Fault("motor blocked for 0.02 to 1.5 s", blocked_for_a_while),
    Fault("driver too hot: it complains and lets go", wire_fault("driver_complains"), shield=3),
    Fault("motor wired in reverse", nothing, before=wired_wrong("motor_reversed"), when=AT_ONCE),
    Fault(
        "encoder wired in reverse", nothing, before=wired_wrong("encoder_reversed"), when=AT_ONCE
    ),
    Fault("client opens the line again", line_reset),
    Fault("ctrl-X", given_up(b"\x18")),
    Fault("Stop", given_up(b"!\n")),
    Fault("character lost", character_becomes(lambda scene, old: b"")),
    Fault("character doubled", character_becomes(lambda scene, old: old + old)),
    Fault("character wrong", character_becomes(lambda scene, old: scene.source.bytes(1))),
    Fault("burst of noise on the line", noise),
)
UNSEEN = (
    Fault(
        "chain climbs a tooth",
        tooth,
        caught_by="a suspicion in B30, often; its mark at 12 o'clock (B08); plumb slip",
    ),
    Fault(
        "chain pulled while the power is off",
        nothing,
        before=pulled_without_power,
        caught_by="its mark at 12 o'clock (B08); plumb slip",
    ),
    Fault("bracket of a motor slips", bracket, caught_by="plumb diagnose: the frame"),
    Fault("beam creeps by 0.2 mm/s", beam, caught_by="plumb diagnose: the frame"),
)
