"""`plumb settings`: a fitted machine as lines for our firmware, or as a GroundControl file."""

from __future__ import annotations

import argparse

from plumb.cli.files import settings_in, write_outputs
from plumb.cli.text import print_json, sentences, table
from plumb.firmware.numbers import Number, firmware_numbers, groundcontrol_values
from plumb.settings.files import changed_ini
from plumb.text.errors import InputError, refusal

KEPT_BY_CLIENT = (
    "GroundControl and WebControl keep $2, $3, $8, $37, $40 and $41 themselves and send theirs "
    "when they connect: give them the file of --to groundcontrol.ini, or these numbers, too"
)


def run(arguments: argparse.Namespace) -> int:
    """Convert, write or print, and return the exit code."""
    settings = settings_in(arguments.settings)
    if settings.controller != "plumb":
        raise refusal(
            arguments.settings,
            "holds the published numbers, which GroundControl or WebControl sends",
            remedy="give the machine.toml of plumb add",
        )
    numbers = firmware_numbers(settings)
    if arguments.to == "groundcontrol.ini":
        if not (arguments.original and arguments.output):
            raise InputError("--to groundcontrol.ini needs --original INI and --output FILE")
        content = changed_ini(arguments.original, groundcontrol_values(settings))
    else:
        content = _text(numbers, arguments.to).encode()
    read = [arguments.settings, *filter(None, [arguments.original])]
    if arguments.output:
        write_outputs({arguments.output: content}, inputs=read)
    if arguments.json:
        print_json({"settings": [vars(row) for row in numbers], "written": arguments.output})
    elif arguments.output:
        print(f"Written: {arguments.output}")
        if arguments.to == "gcode":
            print(sentences([KEPT_BY_CLIENT]))
    else:
        print(content.decode(), end="")
    return 0


def _text(numbers: tuple[Number, ...], form: str) -> str:
    if form == "gcode":
        return "".join(f"{row.line}\n" for row in numbers)
    rows = [[f"${row.number}", row.name, row.text, row.unit] for row in numbers]
    return table(["number", "name", "value", "unit"], rows) + "\n"
