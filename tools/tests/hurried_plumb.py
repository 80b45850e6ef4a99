"""`plumb` for tests: machines run ten times as fast or more, and so do waits for their rest."""

import sys

from plumb.cli.main import main
from plumb.line.sender import Watch

SPEED = 10  # times real time

if __name__ == "__main__":
    Watch.speed = SPEED
    sys.exit(main(sys.argv[1:]))
