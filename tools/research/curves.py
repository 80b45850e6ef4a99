"""One move on the virtual machine as curves: `tools/research/curves.py PICTURE`."""

from __future__ import annotations

import re
import sys
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from plumb.pictures.scale import saved
from plumb.pictures.sheet import BAD, GOOD, INK
from plumb.text.files import write_whole
from scene import Scene

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Array = np.ndarray
MOVES = ("G0 X0 Y0", "G1 X60 Y0 F800", "G1 X60 Y40", "G2 X20 Y40 I-20 J0 F600")
STEP, SECONDS = 10, 18.0  # [ms] between two looks, [s] that are looked at
PER_COUNT = 63.5 / 8113.73  # [mm] of chain
REPORT = re.compile(r"<\w+,MPos:(-?[\d.]+),(-?[\d.]+),[^>]*>\s*\[PE:(-?[\d.]+),(-?[\d.]+)")
SIDES = ("left", "right")


@dataclass(frozen=True)
class Curves:
    """What an onlooker sees of a move, by time."""

    seconds: Array  # (n,)
    sled: Array  # (n, 2) [mm] as the judge hangs it
    chains: Array  # (n, 2) [mm] by the encoders, from the start
    duties: Array  # (n, 2) -255 to 255; positive winds in
    reports: Array  # (m, 5) [s, mm, mm, mm, mm]: set-point x, y; error of each chain


def curves() -> Curves:
    """Record a line, a corner and an arc."""
    scene = Scene(0)
    scene.send(MOVES[:1])
    machine, start = scene.machine, scene.machine.seconds
    counts = [machine.count(side) for side in SIDES]
    machine.send("".join(f"{line}\n" for line in MOVES[1:]).encode())
    rows, reports, text = [], [], ""
    while machine.seconds - start < SECONDS:
        machine.advance(STEP)
        now = machine.seconds - start
        paid = [PER_COUNT * (machine.count(side) - counts[i]) for i, side in enumerate(SIDES)]
        rows.append((now, *machine.sled, *paid, *(machine.duty(side) for side in SIDES)))
        text += machine.take_said().decode()
        match = REPORT.search(text)
        if match:
            reports.append((now, *map(float, match.groups())))
            text = text[match.end() :]
    seen = np.array(rows)
    return Curves(seen[:, 0], seen[:, 1:3], seen[:, 3:5], seen[:, 5:7], np.array(reports))


def drawn(seen: Curves) -> bytes:
    """Return the picture, a panel for each stage between the program and the bit."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(9, 9), layout="constrained")
    place, chains, errors, duties = figure.subplots(4, 1, sharex=True)
    for i, (name, colour) in enumerate((("x", GOOD), ("y", BAD))):
        place.plot(seen.seconds, seen.sled[:, i], color=colour, label=f"{name} of the bit")
        dots = {"color": colour, "markersize": 3.5}
        place.plot(seen.reports[:, 0], seen.reports[:, 1 + i], "o", label=f"{name} asked", **dots)
    for i, (side, colour) in enumerate(zip(SIDES, (GOOD, BAD), strict=True)):
        chains.plot(seen.seconds, seen.chains[:, i], color=colour, label=side)
        errors.plot(seen.reports[:, 0], seen.reports[:, 3 + i], "o-", color=colour, label=side)
        duties.plot(seen.seconds, seen.duties[:, i], color=colour, linewidth=0.8, label=side)
    _title(place, "set-point (dots, as reported) and sled (lines, by the judge), mm")
    _title(chains, "chain paid out by the encoders, mm")
    _title(errors, "chain behind its set-point, as reported, mm")
    _title(duties, "duty, 255ths; positive winds in")
    duties.set_xlabel("s")
    return saved(figure, "png")


def _title(axis: Axes, text: str) -> None:
    axis.set_title(text, loc="left", fontsize=10, color=INK)
    axis.grid(alpha=0.3)
    # Above the panel, where no curve runs.
    axis.legend(fontsize=8, ncol=4, loc="lower right", bbox_to_anchor=(1, 0.98), frameon=False)


if __name__ == "__main__":
    write_whole(sys.argv[1], drawn(curves()))
