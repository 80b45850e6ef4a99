"""Where a further touch tells most: there the accounts that are still open expect other errors.

Each account says what the machine would show with the bit in a hole elsewhere. A slip says it by
its links alone; a moved sheet as far as the touches have shown how it lies.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from plumb.model.predict import FOUND, Array, lengths
from plumb.model.ranks import greatest
from plumb.recovery.slip import LINK, OTHER, POSES, SHEET, Account, SlipFinding, pose_slopes
from plumb.recovery.touched import Point, places_with
from plumb.settings.machine import MachineSettings

COLUMNS, ROWS = 9, 5  # places that are asked for
EDGE = 200.0  # [mm] of the sheet that they leave free
RIVALS = 4  # accounts that are held against the likeliest


@dataclass(frozen=True)
class _Expected:
    """What an account expects of a touch at each place."""

    error: Array  # (m, 2) [mm] hole - place by the machine's chains
    covariance: Array  # (m, 2, 2) [mm^2]


def next_hole(settings: MachineSettings, finding: SlipFinding) -> Point | None:
    """The place [mm] where a hole would tell most; None where no sled hangs."""
    spots = _spots(settings)
    best, *rivals = [_expected(settings, finding, each, spots) for each in _open(finding)]
    tells = np.zeros(len(spots))
    for account, rival in zip(_open(finding)[1:], rivals, strict=True):
        tells += account.odds * _gain(best, rival)
    tells = np.where(np.isfinite(tells), tells, -1.0)
    if not len(spots) or tells.max() <= 0:
        return None
    x, y = spots[greatest(tells)].tolist()
    return round(x), round(y)


def _open(finding: SlipFinding) -> list[Account]:
    """The likeliest accounts that expect something; the likeliest first."""
    kinds = [each for each in finding.accounts if each.kind != OTHER]
    return kinds[: RIVALS + 1]


def _spots(settings: MachineSettings) -> Array:
    """Places (m, 2) [mm] over the sheet where the sled can hang."""
    across, up = settings.sheet_width / 2 - EDGE, settings.sheet_height / 2 - EDGE
    spots = np.array(
        [(x, y) for y in np.linspace(up, -up, ROWS) for x in np.linspace(-across, across, COLUMNS)]
    )
    _, outcome = lengths(settings.as_plumb_model(), spots)
    hanging: Array = spots[outcome == FOUND]
    return hanging


def _expected(
    settings: MachineSettings, finding: SlipFinding, account: Account, spots: Array
) -> _Expected:
    """What an account expects at places, after these touches."""
    slip = LINK * np.array(account.links, dtype=float)
    chains, _ = lengths(settings.as_plumb_model(), spots)
    jump = spots - places_with(settings, chains - slip)
    noise = finding.sigma**2
    still = np.broadcast_to(noise * np.eye(2), (len(spots), 2, 2))
    if account.kind != SHEET:
        return _Expected(jump, still)
    holes = np.array([touch.hole for touch in finding.touches], dtype=float).reshape(-1, 2)
    shift, turn, _ = POSES[-1]
    prior = np.diag([shift**2, shift**2, turn**2])
    seen, there = pose_slopes(holes), pose_slopes(spots).reshape(-1, 2, 3)
    gain = prior @ seen.T @ np.linalg.inv(seen @ prior @ seen.T + noise * np.eye(holes.size))
    pose, left = gain @ finding.errors.ravel(), prior - gain @ seen @ prior
    return _Expected(jump + there @ pose, still + there @ left @ there.transpose(0, 2, 1))


def _gain(true: _Expected, rival: _Expected) -> Array:
    """By how much (m,) a touch usually lowers the log odds of a rival, if the first is true."""
    apart = (rival.error - true.error)[:, :, None]
    both = np.linalg.solve(rival.covariance, true.covariance)
    distance = (apart.transpose(0, 2, 1) @ np.linalg.solve(rival.covariance, apart))[:, 0, 0]
    trace = np.trace(both, axis1=1, axis2=2)
    gain: Array = 0.5 * (trace + distance - 2 - np.log(np.linalg.det(both)))
    return gain
