"""`plumb read`: the machine's numbers, and where its sled is."""

from __future__ import annotations

import argparse
from typing import Any

from plumb.cli.output import write_outputs
from plumb.cli.screen import table
from plumb.cli.text import print_json
from plumb.firmware.settings import every_setting, machine_of
from plumb.line.memory import read_numbers
from plumb.line.sender import Sender, Status
from plumb.line.serial_port import SerialPort, port_for
from plumb.settings.files import machine_toml
from plumb.text.errors import InputError

WIDTH, HEIGHT = 0, 1  # $-numbers of the sheet
FIRST_EFFECT = 100  # from here on zero means that the machine does without


def run(arguments: argparse.Namespace) -> int:
    """Read, write or print, and return the exit code."""
    port = SerialPort(port_for(arguments.port))
    try:
        sender = Sender(port)
        sender.await_start()
        numbers, status = read_numbers(sender), sender.status
    finally:
        port.close()
    written = []
    if arguments.output:
        write_outputs({arguments.output: _toml(numbers)}, inputs=[])
        written = [arguments.output]
    if arguments.json:
        print_json(_json(numbers, status, written))
        return 0
    print(_table(numbers))
    if status:
        print("\nThe sled is at x {:.2f}, y {:.2f}, the bit at z {:.2f} mm.".format(*status.place))
    if written:
        print(f"Written: {arguments.output}")
    return 0


def _toml(numbers: dict[int, float]) -> bytes:
    known = {row.number for row in every_setting() if row.access == "listed"}
    listed = {number: value for number, value in numbers.items() if number in known}
    try:
        machine = machine_of(listed, sheet=(numbers[WIDTH], numbers[HEIGHT]))
    except (KeyError, ValueError) as error:
        raise InputError(f"the machine's numbers make no machine: {error}") from None
    return machine_toml(machine).encode()


def _json(numbers: dict[int, float], status: Status | None, written: list[str]) -> dict[str, Any]:
    return {
        "settings": {f"${number}": value for number, value in numbers.items()},
        "place": status.place if status else None,
        "written": written,
    }


def _table(numbers: dict[int, float]) -> str:
    names = {row.number: row for row in every_setting()}
    rows = [
        [
            f"${number}",
            names[number].name if number in names else "",
            f"{value:g}",
            names[number].unit if number in names else "",
        ]
        for number, value in numbers.items()
        if value or number < FIRST_EFFECT
    ]
    return table(["number", "name", "value", "unit"], rows)
