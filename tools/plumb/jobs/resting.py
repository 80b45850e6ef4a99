"""Whether a job ends so high on the sheet that the sled may sink without its motors."""

from __future__ import annotations

import numpy as np

from plumb.jobs.dry_run import Done
from plumb.jobs.findings import SINKS, Finding
from plumb.model.predict import CANNOT_HANG, reach
from plumb.model.reach import with_soft_chains
from plumb.settings.machine import MachineSettings

# Motors that rest are switched off, and the friction of their gears holds the chains: 1.5 Nm at a
# sprocket of 10.1 mm, or 148 N. It is known to 30 %, so some gears hold no more than this.
WEAK_GEARS = 104.0  # [N]


def ends_too_high(settings: MachineSettings, done: Done) -> tuple[Finding, ...]:
    """The end of a program, if a chain pulls there more than weak gears hold.

    In a pause and in a dwell the motors keep their power.
    """
    moves = done.moves.only(done.moves.over_sheet)
    if not len(moves):
        return ()
    x, y = float(moves["to_x"][-1]), float(moves["to_y"][-1])
    there = reach(with_soft_chains(settings.as_plumb_model())[0], np.array([[x, y]]))
    pull = float(there.tension.max())
    if there.verdict[0] == CANNOT_HANG or pull <= WEAK_GEARS:
        return ()
    says = (
        f"the program ends at X{x:.2f} Y{y:.2f}, where the sled may sink when its motors let go: "
        f"a chain pulls with {pull:.0f} N, and some gears hold no more than {WEAK_GEARS:.0f} N"
    )
    return (Finding(int(moves["line"][-1]), SINKS, says),)
