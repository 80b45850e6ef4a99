"""`plumb` for tests: machines run faster, and so do waits for their rest; plans are tried less."""

import os
import sys

from plumb.cli.main import main
from plumb.line.sender import Watch

SPEED = 10  # times real time
FEW = 8  # simulations of a plan: their number changes its chance, and not the way through the code

if __name__ == "__main__":
    Watch.speed = SPEED
    if sys.argv[1] == "lab":  # others would load the numerics for nothing
        import asked_again

        asked_again.Outlooks.__init__.__defaults__ = (FEW,)
        if asked_again.FOLDER in os.environ:
            asked_again.remember()
    sys.exit(main(sys.argv[1:]))
