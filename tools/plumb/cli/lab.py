"""`plumb lab`: the lab in the browser, served on this computer alone."""

from __future__ import annotations

import argparse
from pathlib import Path

from plumb.lab.server import serve


def run(arguments: argparse.Namespace) -> int:
    """Serve until Ctrl-C, and return the exit code."""
    print("The lab is at this address; Ctrl-C ends it.", flush=True)
    serve(
        Path(arguments.folder),
        port=arguments.port,
        browser=not arguments.no_browser,
        say=lambda url: print(url, flush=True),
    )
    return 0
