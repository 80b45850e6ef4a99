"""The door of the command `plumb`: Ctrl-C ends it quietly, also while its modules load."""

import signal
import sys

if signal.getsignal(signal.SIGINT) is not signal.SIG_IGN:  # as in the background of a shell
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def start() -> int:
    """Run the command that the words of the command line name; return its exit code."""
    from plumb.cli.main import main

    return main()


if __name__ == "__main__":
    sys.exit(start())
