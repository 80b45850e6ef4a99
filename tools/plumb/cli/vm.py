"""`plumb vm`: a virtual machine that clients open like a board."""

import argparse
import struct
import sys
import time
from collections.abc import Callable
from pathlib import Path

from plumb.cli.arguments import length, positive
from plumb.line.bootloader import hex_bytes
from plumb.settings import MachineSettings
from plumb.text.errors import InputError
from plumb.text.files import read_bytes, write_whole
from plumb.vm.garage import (
    Garage,
    InProcessPort,
    VirtualMachine,
    described,
    hide,
    random_garage,
    set_up,
)
from plumb.vm.served_port import ANY, BOOTLOADER, Pace, ServedPort, SocketPort

EEPROM_BYTES = 4096
TRAVELS = struct.Struct("<3d")  # behind them: the left chain, the right chain, z [mm]
SAVE_EVERY, LOOK_EVERY = 1.0, 0.1  # [s] of this computer's time


def run(arguments: argparse.Namespace) -> int:
    """Start it, serve until Ctrl-C, and return the exit code."""
    if arguments.preload:
        from plumb.vm.pseudo_terminal import preload

        print(preload())
        return 0
    hidden = hide(arguments.hide, millimetres=arguments.size, seed=arguments.seed)
    garage = random_garage(hidden, arguments.seed, feed=arguments.feed)
    serve(garage, arguments, lambda machine: None)
    if arguments.reveal:
        print(f"Hidden was: {described(hidden)}.")
    return 0


def serve(
    garage: Garage, arguments: argparse.Namespace, look: Callable[[VirtualMachine], None]
) -> int:
    """Serve the machine of a garage until Ctrl-C, and return the exit code; `look` is called all
    the time."""
    bootloader = getattr(arguments, "bootloader", None)
    if bootloader and not arguments.mega:
        raise InputError("--bootloader needs a program for the simulated Mega: give --mega too")
    machine = garage.machine(
        elf=arguments.mega, bootloader=hex_bytes(bootloader) if bootloader else b""
    )
    _wake(machine, garage.settings, arguments)
    boot_time = 0 if bootloader else BOOTLOADER
    port = _port(machine, boot_time, arguments.link)
    try:
        print(f"The machine is at {port.link or port.path}. Ctrl-C ends it.", flush=True)
        _serve(port, arguments, lambda: look(machine))
    except KeyboardInterrupt:
        pass
    finally:
        port.close()
        machine.stop()
        _save(_memory(machine), arguments.eeprom)
    return 0


def _port(machine: VirtualMachine, boot_time: int, link: str | None) -> ServedPort:
    """Return a machine's port, under its name. A machine whose name is taken leaves no trace."""
    if sys.platform != "linux" or (link or "").startswith("socket:"):
        return SocketPort(machine, link or ANY, boot_time=boot_time)
    from plumb.vm.pseudo_terminal import PseudoTerminal  # which can be watched on Linux alone

    terminal = PseudoTerminal(machine, boot_time=boot_time)
    if link:
        try:
            terminal.link_as(link)
        except InputError:
            terminal.close()
            raise
    return terminal


def _wake(
    machine: VirtualMachine, settings: MachineSettings, arguments: argparse.Namespace
) -> None:
    """Give the machine the memory of its last evening, its sled where it hung."""
    if arguments.eeprom and Path(arguments.eeprom).exists():
        content = read_bytes(arguments.eeprom)
        if len(content) not in (EEPROM_BYTES, EEPROM_BYTES + TRAVELS.size):
            raise InputError(arguments.eeprom, f"is not a memory file of {EEPROM_BYTES} bytes")
        machine.eeprom = content[:EEPROM_BYTES]
        if content[EEPROM_BYTES:]:
            _hang(machine, content[EEPROM_BYTES:])
    elif not arguments.fresh:
        set_up(InProcessPort(machine), settings)
        machine.stop()


def _memory(machine: VirtualMachine) -> bytes:
    """Return what a machine keeps until its next start: its EEPROM, and how its sled hangs."""
    return machine.eeprom + TRAVELS.pack(*machine.chains, machine.height)


def _hang(machine: VirtualMachine, state: bytes) -> None:
    """Hang the sled as it hung at the end of the last run."""
    now = (*machine.chains, machine.height)
    for axis, travel, was in zip(("left", "right", "z"), now, TRAVELS.unpack(state), strict=True):
        machine.slip(axis, was - travel)


def _serve(port: ServedPort, arguments: argparse.Namespace, look: Callable[[], None]) -> None:
    machine, pace, start = port.machine, Pace(arguments.speed), time.monotonic()
    machine.start()
    saved = looked = start
    memory = b""
    while not arguments.seconds or time.monotonic() - start < arguments.seconds:
        port.pass_time(pace.due())
        now = time.monotonic()
        if now - looked > LOOK_EVERY:
            look()
            looked = now
        if now - saved > SAVE_EVERY:
            if _memory(machine) != memory:
                memory = _memory(machine)
                _save(memory, arguments.eeprom)
            saved = now


def _save(content: bytes, path: str | None) -> None:
    if path:
        write_whole(path, content)


# The arguments of `plumb vm`.

FEEDS = ("top", "bottom")
EXAMPLES = ("plumb vm --link maslow", "plumb vm --link maslow --speed 10")
EXIT = "Exit: 0 ended with Ctrl-C or after --seconds; 2 it cannot be started."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `plumb vm`."""
    parser.add_argument(
        "--link", metavar="PATH", help="a name for the port, as ./maslow or socket://localhost:7000"
    )
    parser.add_argument(
        "--hide",
        metavar="EFFECT",
        nargs="+",
        default=[],
        help="effects that this machine has and its settings do not know; random draws an effect",
    )
    parser.add_argument(
        "--size",
        metavar="MM",
        type=length,
        default=3.0,
        help="how far each effect moves the marks, RMS [%(default)g]",
    )
    parser.add_argument(
        "--seed",
        metavar="N",
        type=int,
        default=0,
        help="draws frame, sheet, motors and the random effect [%(default)s]",
    )
    parser.add_argument(
        "--feed",
        choices=FEEDS,
        default="top",
        help="where the chains leave the sprockets: over the top, or off the bottom [%(default)s]",
    )
    parser.add_argument("--reveal", action="store_true", help="say at the end what was hidden")
    parser.add_argument(
        "--eeprom",
        metavar="FILE",
        help="keep the board's memory, and where the sled hangs, in this file from run to run",
    )
    parser.add_argument(
        "--fresh",
        action="store_true",
        help="begin with an empty memory: no settings, no chain lengths",
    )
    add_brain(parser)
    parser.add_argument(
        "--bootloader",
        metavar="HEX",
        help="what the simulated Mega starts first, so that plumb flash can write its port",
    )
    parser.add_argument(
        "--preload",
        action="store_true",
        help="print the library that a client needs for this port (LD_PRELOAD), and end",
    )


def add_brain(parser: argparse.ArgumentParser, when: str = "") -> None:
    """Add the options for what runs and how fast; `when` says when they count."""
    parser.add_argument(
        "--mega",
        metavar="ELF",
        help=f"{when}run this flashed program on a simulated Mega, not the firmware built for the "
        "PC",
    )
    parser.add_argument(
        "--speed",
        metavar="N",
        type=positive,
        default=1.0,
        help=f"{when}how many times as fast as real time [%(default)g]",
    )
    parser.add_argument("--seconds", metavar="S", type=positive, help=f"{when}end after S seconds")
