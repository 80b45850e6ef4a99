"""`plumb vm`: a virtual machine that clients open like a board."""

import argparse
import struct
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from rich.live import Live

from plumb.cli.arguments import add_shared, length, positive
from plumb.cli.screen import console, print_json
from plumb.firmware.hex_file import hex_bytes
from plumb.line.sender import Sender
from plumb.settings.machine import MachineSettings
from plumb.text.errors import InputError
from plumb.text.files import read_bytes, read_text, write_whole
from plumb.vm.garage import (
    Garage,
    VirtualMachine,
    VmPicture,
    described,
    hide,
    random_garage,
    set_up,
)
from plumb.vm.owner import InProcessPort
from plumb.vm.served_port import BOOTLOADER, Pace, ServedPort
from plumb.vm.socket_port import ANY, SocketPort
from plumb.vm.tape import BLANK, Tape

EEPROM_BYTES = 4096
TRAVELS = struct.Struct("<3d")  # behind them: the left chain, the right chain, z [mm]
SAVE_EVERY, LOOK_EVERY = 1.0, 0.1  # [s] of this computer's time


@dataclass(frozen=True)
class VmAnswer:
    """Port for a client; printed as soon as the machine is there."""

    port: str | None  # None: with --preload no machine starts
    preload: str | None  # None: without --preload
    hidden: str | None  # None: without --reveal


def run(arguments: argparse.Namespace) -> int:
    """Start it, serve until Ctrl-C, and return the exit code."""
    if arguments.preload:
        from plumb.vm.pseudo_terminal import preload

        library = preload()
        print_json(VmAnswer(None, library, None)) if arguments.json else print(library)
        return 0
    tape_form = _form(arguments)
    hidden = hide(arguments.hide, millimetres=arguments.size, seed=arguments.seed)
    garage = random_garage(hidden, arguments.seed, feed=arguments.feed)
    tape = Tape(garage, np.random.default_rng([arguments.seed, 5]), noise=arguments.noise)
    if tape_form:
        tape.get_ready(tape_form)
    said = described(hidden) if arguments.reveal else None

    def announce(port: str) -> None:
        if arguments.json:
            print_json(VmAnswer(port, None, said))
        else:
            _announce(port)

    def look(machine: VirtualMachine) -> None:
        _fill(tape, machine, tape_form, arguments.readings)

    serve(garage, arguments, look, announce)
    if said and not arguments.json:
        print(f"Hidden was: {said}.")
    return 0


def _announce(port: str) -> None:
    print(f"The machine is at {port}. Ctrl-C ends it.", flush=True)


def serve(
    garage: Garage,
    arguments: argparse.Namespace,
    look: Callable[[VirtualMachine], None],
    announce: Callable[[str], None] = _announce,
) -> int:
    """Serve the machine of a garage until Ctrl-C, and return the exit code; `look` is called all
    the time, `announce` once with the machine's port."""
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
        announce(str(port.link or port.path))
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


def _form(arguments: argparse.Namespace) -> str:
    if bool(arguments.form) != bool(arguments.readings):
        raise InputError("--form and --readings go together: which form, and where it goes filled")
    text = read_text(arguments.form) if arguments.form else ""
    if arguments.form and BLANK not in text:
        raise InputError(arguments.form, "waits for no reading", remedy="give a form of plumb grid")
    return text


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
        machine.start()
        sender = Sender(InProcessPort(machine))
        sender.await_start()
        set_up(sender, settings)
        # Until all is in the EEPROM.
        machine.advance(10_000)
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
    picture, screen = VmPicture(machine), console()
    saved = looked = start
    memory = b""
    with Live(picture, console=screen, refresh_per_second=5, transient=True) as live:
        if not screen.is_terminal:
            live.stop()
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


def _fill(tape: Tape, machine: VirtualMachine, form: str, readings: str | None) -> None:
    """Write the filled form as soon as the sheet has all its marks."""
    if not form or not readings or Path(readings).exists():
        return
    text = tape.fill_when_cut(form, machine)
    if text:
        write_whole(readings, text.encode())


def _save(content: bytes, path: str | None) -> None:
    if path:
        write_whole(path, content)


# The arguments of `plumb vm`.

FEEDS = ("top", "bottom")
EXAMPLES = (
    "plumb vm --link maslow",
    "plumb vm --link maslow --speed 10",
)
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
    _add_brain(parser)
    parser.add_argument(
        "--form",
        metavar="FORM",
        help="a form that plumb grid wrote: a tape fills it in once all its marks are cut",
    )
    parser.add_argument("--readings", metavar="FILE", help="write the filled form to this file")
    parser.add_argument(
        "--noise",
        metavar="MM",
        type=length,
        default=0.4,
        help="noise of the tape's readings [%(default)g]",
    )
    add_shared(parser, "--json")


def _add_brain(parser: argparse.ArgumentParser) -> None:
    """Add the options for what runs, how fast, and what clients need for its port."""
    parser.add_argument(
        "--mega",
        metavar="ELF",
        help="run this flashed program on a simulated Mega, not the firmware built for the PC",
    )
    parser.add_argument(
        "--bootloader",
        metavar="HEX",
        help="what the simulated Mega starts first, so that plumb flash can write its port",
    )
    add_pace(parser)
    parser.add_argument(
        "--preload",
        action="store_true",
        help="print the library that a client needs for this port (LD_PRELOAD), and end",
    )


def add_pace(parser: argparse.ArgumentParser, when: str = "") -> None:
    """Add the options --speed and --seconds; `when` says when they count."""
    parser.add_argument(
        "--speed",
        metavar="N",
        type=positive,
        default=1.0,
        help=f"{when}how many times as fast as real time [%(default)g]",
    )
    parser.add_argument("--seconds", metavar="S", type=positive, help=f"{when}end after S seconds")
