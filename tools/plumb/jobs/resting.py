"""Where a job lets the sled rest so high on the sheet that it may sink without its motors."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from plumb.jobs.dry_run import Done
from plumb.jobs.findings import SINKS, WAITS, Finding
from plumb.model.predict import CANNOT_HANG, reach
from plumb.model.reach import with_soft_chains
from plumb.settings.machine import MachineSettings

# Motors that rest are switched off, and the friction of their gears holds the chains: 1.5 Nm at a
# sprocket of 10.1 mm, or 148 N. It is known to 30 %, so some gears hold no more than this.
WEAK_GEARS = 104.0  # [N]


def rests_too_high(
    settings: MachineSettings, done: Done, findings: Iterable[Finding]
) -> tuple[Finding, ...]:
    """Pauses of a program, and its end, where a chain pulls more than weak gears hold."""
    moves = done.moves.only(done.moves.over_sheet)
    if not len(moves):
        return ()
    lines = moves["line"].astype(int)
    pauses = [each.line for each in findings if each.kind == WAITS]
    rests = [(line, "waits", int(np.searchsorted(lines, line, "right")) - 1) for line in pauses]
    rests = [rest for rest in rests if rest[2] >= 0] + [(int(lines[-1]), "ends", len(moves) - 1)]
    rows = [row for *_, row in rests]
    places = np.stack([moves["to_x"], moves["to_y"]], axis=1)[rows]
    there = reach(with_soft_chains(settings.as_plumb_model())[0], places)
    pulls = np.where(there.verdict == CANNOT_HANG, 0.0, there.tension.max(axis=1))
    return tuple(
        Finding(
            line,
            SINKS,
            f"the program {how} at X{x:.2f} Y{y:.2f}, where the sled may sink when its motors let "
            f"go: a chain pulls with {pull:.0f} N, and some gears hold no more than "
            f"{WEAK_GEARS:.0f} N",
        )
        for (line, how, _), (x, y), pull in zip(rests, places, pulls, strict=True)
        if pull > WEAK_GEARS
    )
