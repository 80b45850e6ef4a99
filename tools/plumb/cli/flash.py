"""`plumb flash`: writes the firmware to the Mega by avrdude."""

import argparse
import shutil
import subprocess
from pathlib import Path

from plumb.cli.arguments import add_shared
from plumb.line.port import port_for
from plumb.text.errors import InputError

# The Mega's bootloader, as Arduino's programs address it.
BOARD = ("-p", "atmega2560", "-c", "wiring", "-b", "115200", "-D")
STORE = Path(".platformio/packages/tool-avrdude")


def run(arguments: argparse.Namespace) -> int:
    """Write it, and return the exit code."""
    port = port_for(arguments.port)
    if not Path(port).exists():
        raise InputError(
            port, "there is no such line", remedy="connect the Mega and check the name"
        )
    if not Path(arguments.hex).is_file():
        remedy = "build it with .venv/bin/pio run -e megaatmega2560"
        raise InputError(arguments.hex, "there is no such file", remedy=remedy)
    command = [_avrdude(), *BOARD, "-P", port, "-U", f"flash:w:{arguments.hex}:i"]
    done = subprocess.run(command)
    if done.returncode:
        raise InputError(
            "avrdude could not write it: close GroundControl or WebControl, check the cable, and "
            "try again"
        )
    print("Written. The machine starts again; open your client.")
    return 0


def _avrdude() -> str:
    """Return the program, from the system or PlatformIO's store."""
    stored = next(STORE.rglob("avrdude"), None) if STORE.is_dir() else None
    name = shutil.which("avrdude") or (str(stored) if stored else None)
    if not name:
        raise InputError("avrdude is missing: tools/setup installs it")
    return name


# The arguments of `plumb flash`.

EXAMPLES = (
    "plumb flash",
    "plumb flash --port /dev/ttyACM0",
)
EXIT = "Exit: 0 written; 2 no board, no firmware.hex, or avrdude refused."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `plumb flash`."""
    parser.add_argument(
        "hex",
        metavar="HEX",
        nargs="?",
        default=".pio/build/megaatmega2560/firmware.hex",
        help="the file to write [%(default)s]",
    )
    add_shared(parser, "--port")
