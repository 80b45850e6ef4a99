#!/usr/bin/env python3
"""Writes the G-code for a grid of calibration marks; needs Python 3.9 and nothing else.

The same program as `plumb grid`, without installing anything: only the folders plumb/grid and
plumb/text next to this file must be there.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from plumb.grid.command import main

if __name__ == "__main__":
    sys.exit(main())
