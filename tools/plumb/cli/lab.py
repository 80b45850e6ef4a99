"""`plumb lab`: the lab in the browser, on this computer and, if it is shared, on phones."""

import argparse
from pathlib import Path

from plumb.lab.routes.phones import Sharing
from plumb.lab.server import serve


def run(arguments: argparse.Namespace) -> int:
    """Serve until Ctrl-C, and return the exit code."""
    serve(
        Path(arguments.folder),
        port=arguments.port,
        browser=not arguments.no_browser,
        sharing=arguments.share or "no",
        say=lambda url: print(url, flush=True),
    )
    return 0


# The arguments of `plumb lab`.

EXAMPLES = ("plumb lab my-maslow", "plumb lab my-maslow --share --no-browser")
EXIT = "Exit: 0 ended with Ctrl-C; 2 it cannot be started."
PORT = 8450


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `plumb lab`."""
    parser.add_argument(
        "folder", metavar="FOLDER", nargs="?", default=".", help="where the work is kept [.]"
    )
    parser.add_argument(
        "--port",
        metavar="N",
        type=port,
        default=PORT,
        help="listen on this port; 0: any [%(default)s]",
    )
    parser.add_argument(
        "--no-browser", action="store_true", help="print the address, open no browser"
    )
    parser.add_argument(
        "--share",
        metavar="move",
        type=sharing,
        nargs="?",
        const="hands",
        help="let phones on this network pair by a PIN: they can look, type readings, hold and "
        "stop; move: they can also move the machine, without being allowed at the computer",
    )


def sharing(text: str) -> Sharing:
    """Return how much a phone may do."""
    rights: dict[str, Sharing] = {"hands": "hands", "move": "move"}
    if text in rights:
        return rights[text]
    hint = f"name the folder first: plumb lab {text} --share"
    raise argparse.ArgumentTypeError(f"'{text}' is neither hands nor move; {hint}")


def port(text: str) -> int:
    """Return the number of a port."""
    number = int(text)
    if not 0 <= number <= 65535:
        raise ValueError
    return number
