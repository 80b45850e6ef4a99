"""`plumb flash`: writes the firmware to the Mega, and says what was on it before and is now."""

import argparse
import shutil

from plumb.cli.arguments import add_shared
from plumb.cli.screen import bar, sentences
from plumb.line.bootloader import firmware_on, hex_file, program_in, write_program
from plumb.line.port import port_for
from plumb.line.sender import WRONG
from plumb.text.errors import InputError


def run(arguments: argparse.Namespace) -> int:
    """Write it, and return the exit code."""
    file = hex_file(arguments.hex)
    program_in(file)  # refused before the board is touched
    port = port_for(arguments.port)
    before, _ = firmware_on(port)
    print(f"On the board: {before or 'no firmware that answers'}.", flush=True)
    write_program(port, file, bar(f"writing {file.name}"), avrdude=shutil.which("avrdude"))
    now, greeting = firmware_on(port)
    if not now:
        raise InputError(
            port, "the program was written, but does not answer", remedy="reset the board"
        )
    print(f"Written and read back. Now: {now}.")
    if odd := [line for line in greeting if line.startswith(WRONG)]:
        print(sentences(odd))
    return 0


# The arguments of `plumb flash`.

EXAMPLES = ("plumb flash", "plumb flash --port /dev/ttyACM0")
EXIT = "Exit: 0 written and read back; 2 no board, no file, or the board did not take it."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `plumb flash`."""
    parser.add_argument(
        "hex",
        metavar="HEX",
        nargs="?",
        help="the file to write [what PlatformIO built here, else what came with plumb]",
    )
    add_shared(parser, "--port")
