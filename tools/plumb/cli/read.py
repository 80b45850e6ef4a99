"""`plumb read`: the machine's numbers, and where its sled is."""

import argparse
from dataclasses import dataclass
from typing import Annotated

from pydantic import Field

from plumb.cli.arguments import add_shared
from plumb.cli.output import write_outputs
from plumb.cli.screen import print_json, sentences, table
from plumb.firmware.settings import called, machine_of_numbers
from plumb.firmware.telemetry import slip_suspicion, telemetry_in
from plumb.line.memory import read_numbers
from plumb.line.port import SerialPort, port_for
from plumb.line.sender import Sender, lost_place
from plumb.settings import machine_toml
from plumb.text.answers import meant

FIRST_EFFECT = 100  # from here on zero means that the machine does without


@dataclass(frozen=True)
class MachineNumbers:
    """Numbers and place of a machine."""

    settings: dict[Annotated[str, Field(pattern=r"^\$[0-9]+$")], float]
    place: Annotated[
        tuple[float, float, float] | None,
        meant("Of the sled and the bit; null where the machine does not know it."),
    ]
    lost: Annotated[
        str | None,
        meant("What the machine says of a place that it does not know; null: it knows its place."),
    ]
    written: tuple[str, ...]
    suspicion: Annotated[
        str | None,
        meant("Which chain may have slipped, and where; null: none, or the firmware does not say."),
    ]


def run(arguments: argparse.Namespace) -> int:
    """Read, write or print, and return the exit code."""
    port = SerialPort(port_for(arguments.port))
    try:
        sender = Sender(port)
        sender.await_start()
        numbers = read_numbers(sender)
        lost = lost_place(sender.greeting)
        place = sender.status.place if sender.status and not lost else None
        telemetry = telemetry_in("\n".join(sender.ask("B30")))
    finally:
        port.close()
    suspicion = slip_suspicion(telemetry) if telemetry else None
    written: tuple[str, ...] = ()
    if arguments.output:
        write_outputs(
            {arguments.output: machine_toml(machine_of_numbers(numbers)).encode()}, inputs=[]
        )
        written = (arguments.output,)
    if arguments.json:
        print_json(
            MachineNumbers(
                settings={f"${number}": value for number, value in numbers.items()},
                place=place,
                lost=lost or None,
                written=written,
                suspicion=suspicion,
            )
        )
        return 0
    print(_table(numbers))
    if place:
        print("\nThe sled is at x {:.2f}, y {:.2f}, the bit at z {:.2f} mm.".format(*place))
    if lost:
        print(f"\n{sentences(_way_back(lost), mark='')}")
    if suspicion:
        print(f"\n{sentences([suspicion])}")
    if written:
        print(f"Written: {arguments.output}")
    return 0


def _way_back(lost: str) -> list[str]:
    """Return that the machine does not know its place, in its words, and what brings it back."""
    return [
        f"The machine does not know where its sled is. It says: {lost}",
        "The way back: put the bit into a home mark and ask plumb recover --at for the line to "
        "send; or set the chains with B06 or B08. Set z with it, the bit at the sheet's face, as "
        "each command resets the board: plumb send 'B06 ...' 'G10 Z0'.",
    ]


def _table(numbers: dict[int, float]) -> str:
    shown = [item for item in numbers.items() if item[1] or item[0] < FIRST_EFFECT]
    named = [(number, value, *called(number)) for number, value in shown]
    rows = [[f"${number}", name, f"{value:g}", unit] for number, value, name, unit in named]
    return table(["number", "name", "value", "unit"], rows)


# The arguments of `plumb read`.

EXAMPLES = ("plumb read", "plumb read -o machine.toml")
EXIT = "Exit: 0 done; 2 no machine answers, or the file cannot be written."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `plumb read`."""
    add_shared(parser, "--port")
    add_shared(parser, output="write the numbers to this file, as a machine.toml")
    add_shared(parser, "--force", "--json")
