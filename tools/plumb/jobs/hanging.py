"""What the chains bear along a job: where it leaves the reach, the pulls and the give."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from plumb.jobs.moves import Moves, Samples
from plumb.model.predict import CANNOT_HANG, REACH_WORDS, USABLE, Codes, reach
from plumb.model.ranks import greatest
from plumb.model.reach import with_soft_chains
from plumb.settings.machine import MachineSettings

CELL = 4.0  # [mm] reach hardly changes over it


@dataclass(frozen=True)
class BadReach:
    """Cuts at places that are not usable."""

    verdict: str  # as `plumb reach` says it
    lines: int
    first: int  # line
    share: float  # of the cut places


@dataclass(frozen=True)
class Hanging:
    """Pulls and give along the cuts of a job."""

    verdict: Codes  # (k,) USABLE ... of each sample
    tension: tuple[float, float]  # [N] slackest and tightest chain
    give: float  # [mm/N] where the sled gives most
    give_line: int
    bad: tuple[BadReach, ...]
    assumed: tuple[str, ...]


def hanging_along(
    settings: MachineSettings, moves: Moves, samples: Samples, limits: Mapping[str, float]
) -> Hanging | None:
    """What hangs along the cuts; None where nothing is cut."""
    cut = moves.cut[samples.move]
    if not cut.any():
        return None
    machine, assumed = with_soft_chains(settings.as_plumb_model())
    cells, back = np.unique(np.round(samples.places / CELL), axis=0, return_inverse=True)
    there = reach(machine, cells * CELL, **limits)
    back = back.reshape(-1)
    verdict = there.verdict[back]
    hangs = cut & (verdict != CANNOT_HANG)
    tension, give = there.tension[back], np.where(hangs, there.give[back], -1.0)
    softest = greatest(give)
    lines = moves["line"][samples.move].astype(int)
    pulls = (0.0, 0.0)
    if hangs.any():
        pulls = float(tension[hangs].min()), float(tension[hangs].max())
    bad = []
    for number, word in enumerate(REACH_WORDS):
        those = cut & (verdict == number)
        if number != USABLE and those.any():
            hit = np.unique(lines[those])
            bad.append(BadReach(word, len(hit), int(hit[0]), float(those.sum() / cut.sum())))
    return Hanging(
        verdict, pulls, max(float(give[softest]), 0.0), int(lines[softest]), tuple(bad), assumed
    )
