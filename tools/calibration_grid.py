#!/usr/bin/env python3
"""Write the G-code for a grid of calibration marks on the usual machine: an 8 x 4 ft sheet.

It needs Python 3.9, plumb/grid.py and the folder plumb/text next to this file, and nothing else.
`plumb grid` does the same for the settings of a machine, and writes a form for the readings too.
"""

import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from plumb.grid import PRESETS, GridError, PlainMachine, program


def main() -> int:
    """Write the G-code to a file that is not there yet, or to the standard output."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--preset", choices=PRESETS, default="fifteen", help="[%(default)s]")
    parser.add_argument("--margin", type=float, metavar="MM", help="outer marks to the edge")
    parser.add_argument("--output", type=Path, metavar="FILE", help="a new file [standard output]")
    wanted = parser.parse_args()
    grid = PRESETS[wanted.preset]
    grid = grid if wanted.margin is None else grid._replace(margin=wanted.margin)
    try:
        text = program(grid, PlainMachine())
        if wanted.output is None:
            print(text, end="")
        else:
            with wanted.output.open("x") as file:
                file.write(text)
    except (GridError, OSError) as error:
        print(f"calibration_grid: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
