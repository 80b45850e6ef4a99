"""Every effect of the library by itself, what explains most first."""

from __future__ import annotations

from plumb.diagnosis.answer import Ranked
from plumb.diagnosis.clean import CleanReadings
from plumb.diagnosis.sizes import hidden_share, sizes_of
from plumb.diagnosis.suspects import evidence
from plumb.model.ranks import ranked


def rank(readings: CleanReadings) -> tuple[Ranked, ...]:
    """All effects, by how surprising it would be if noise alone gained as much."""
    frame, noise = readings.frame, readings.noise
    effects = [
        Ranked(
            effect=name,
            gain=max(frame.cost - single.cost, 0.0),
            surprise=evidence(single, frame, noise),
            sizes=sizes_of(single, name, noise),
            rms_after=single.rms,
            hidden_share=hidden_share(frame, name),
        )
        for name, single in readings.singles.items()
    ]
    return tuple(ranked(effects, lambda effect: -effect.surprise))
