"""`plumb vm`: a virtual machine that clients open like a board."""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from rich.live import Live

from plumb.cli.screen import console
from plumb.line.sender import Sender
from plumb.settings.machine import MachineSettings
from plumb.text.errors import InputError, refusal
from plumb.text.files import read_bytes, read_text, write_whole
from plumb.vm.garage import VirtualMachine, random_garage, set_up
from plumb.vm.hiding import described, hide
from plumb.vm.in_process import InProcessPort
from plumb.vm.picture import VmPicture
from plumb.vm.pseudo_terminal import Pace, PseudoTerminal, preload
from plumb.vm.tape import BLANK, Tape

EEPROM_BYTES = 4096
SAVE_EVERY, LOOK_EVERY = 1.0, 0.1  # [s] of this computer's time


def run(arguments: argparse.Namespace) -> int:
    """Start it, serve until Ctrl-C, and return the exit code."""
    if arguments.preload:
        print(preload())
        return 0
    tape_form = _form(arguments)
    hidden = hide(arguments.hide, millimetres=arguments.size, seed=arguments.seed)
    garage = random_garage(hidden, arguments.seed, feed=arguments.feed)
    machine = garage.machine(elf=arguments.mega)
    _wake(machine, garage.settings, arguments)
    tape = Tape(garage, np.random.default_rng([arguments.seed, 5]), noise=arguments.noise)
    if tape_form:
        tape.get_ready(tape_form)
    terminal = _terminal(machine, arguments.link)
    try:
        print(f"The machine is at {terminal.link or terminal.path}. Ctrl-C ends it.", flush=True)
        _serve(terminal, arguments, lambda: _fill(tape, machine, tape_form, arguments.readings))
    except KeyboardInterrupt:
        pass
    finally:
        terminal.close()
        machine.stop()
        _save(machine.eeprom, arguments.eeprom)
    if arguments.reveal:
        print(f"Hidden was: {described(hidden)}.")
    return 0


def _terminal(machine: VirtualMachine, link: str | None) -> PseudoTerminal:
    """The machine's port, under its name. A machine whose name is taken leaves no trace."""
    terminal = PseudoTerminal(machine)
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
        raise refusal(arguments.form, "waits for no reading", remedy="give a form of plumb grid")
    return text


def _wake(
    machine: VirtualMachine, settings: MachineSettings, arguments: argparse.Namespace
) -> None:
    """Give the machine the memory of its last evening."""
    if arguments.eeprom and Path(arguments.eeprom).exists():
        content = read_bytes(arguments.eeprom)
        if len(content) != EEPROM_BYTES:
            raise refusal(arguments.eeprom, f"is no memory of {EEPROM_BYTES} bytes")
        machine.eeprom = content
    elif not arguments.fresh:
        machine.start()
        sender = Sender(InProcessPort(machine))
        sender.await_start()
        set_up(sender, settings)
        # Until all is in the EEPROM.
        machine.advance(10_000)
        machine.stop()


def _serve(
    terminal: PseudoTerminal, arguments: argparse.Namespace, look: Callable[[], None]
) -> None:
    machine, pace, start = terminal.machine, Pace(arguments.speed), time.monotonic()
    machine.start()
    picture, screen = VmPicture(machine), console()
    saved = looked = start
    memory = b""
    with Live(picture, console=screen, refresh_per_second=5, transient=True) as live:
        if not screen.is_terminal:
            live.stop()
        while not arguments.seconds or time.monotonic() - start < arguments.seconds:
            terminal.pass_time(pace.due())
            now = time.monotonic()
            if now - looked > LOOK_EVERY:
                look()
                looked = now
            if now - saved > SAVE_EVERY:
                if machine.eeprom != memory:
                    memory = machine.eeprom
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
