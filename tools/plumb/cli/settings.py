"""`plumb settings`: a fitted machine as lines for our firmware, with what its client needs."""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from typing import Annotated

from plumb.cli.arguments import add_force, add_json, add_settings
from plumb.cli.client import add_client, client_files_of, client_text, typed_json
from plumb.cli.output import write_outputs
from plumb.cli.screen import print_json, table
from plumb.cli.steps import next_step
from plumb.firmware.client_files import gcode
from plumb.firmware.settings import Number, firmware_numbers
from plumb.fit.inputs import settings_in
from plumb.text.answers import meant
from plumb.text.errors import InputError


@dataclass(frozen=True)
class SettingLines:
    """A machine as its firmware holds it."""

    settings: tuple[Number, ...]
    written: tuple[str, ...]
    typed: Annotated[
        dict[str, str], meant("What the owner types into the client, by `section: key`.")
    ]


def run(arguments: argparse.Namespace) -> int:
    """Convert, write or print, and return the exit code."""
    settings = settings_in(arguments.settings)
    if settings.controller != "plumb":
        raise InputError(
            arguments.settings,
            "holds the published numbers, which GroundControl or WebControl sends",
            remedy="give a machine.toml that plumb add wrote for our firmware",
        )
    numbers = firmware_numbers(settings)
    _refuse_lines_alone(arguments)
    content = gcode(numbers) if arguments.to == "gcode" else _table(numbers).encode()
    printed = arguments.client == "none" and not arguments.output
    client = None if printed else client_files_of(arguments, settings, lines=arguments.output)
    files = client.files if client else {}
    if arguments.output:
        files = {arguments.output: content} | files
        write_outputs(files, inputs=[arguments.settings, *filter(None, [arguments.original])])
    if arguments.json:
        print_json(SettingLines(numbers, tuple(files), typed_json(client)))
    elif arguments.output:
        print(f"Written: {', '.join(files)}")
        if client:
            print(client_text(client))
    else:
        print(content.decode(), end="")
        if arguments.to == "table":
            print(f"\n{next_step('For the machine:', _to_gcode(arguments.settings))}")
    return 0


def _to_gcode(machine: str) -> list[str]:
    kept = ["--client", "groundcontrol", "--original", "groundcontrol.ini"]
    return ["settings", machine, "--to", "gcode", *kept, "-o", "machine.nc"]


def _refuse_lines_alone(arguments: argparse.Namespace) -> None:
    """Refuse lines without a client: a client that carries some corrections too would
    double them.
    """
    if arguments.to == "gcode" and arguments.client is None:
        raise InputError(
            "--to gcode needs --client: GroundControl and WebControl send their own corrections "
            "each time they connect, and the machine would apply them twice; give --client "
            "groundcontrol --original groundcontrol.ini, --client webcontrol, or --client none"
        )
    if arguments.to == "table" and arguments.client:
        raise InputError("--client goes with --to gcode: a table sets no machine")


def _table(numbers: tuple[Number, ...]) -> str:
    rows = [[f"${row.number}", row.name, row.text, row.unit] for row in numbers]
    return table(["number", "name", "value", "unit"], rows, left=2, words=[-1]) + "\n"


# The arguments of `plumb settings`.

FORMS = ("gcode", "table")
EXAMPLES = (
    "plumb settings machine.toml",
    "plumb settings machine.toml --client groundcontrol --original groundcontrol.ini",
)
EXIT = "Exit: 0 done; 2 an input cannot be used, and nothing was written."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `plumb settings`."""
    add_settings(parser)
    parser.add_argument("--to", choices=FORMS, default="table", help="what to write [%(default)s]")
    add_client(parser)
    parser.add_argument(
        "-o", "--output", metavar="FILE", help="write to this file, not to the screen"
    )
    add_force(parser)
    add_json(parser)
