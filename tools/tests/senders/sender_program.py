"""The state that any sender shows."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Shown:
    """The machine as the sender shows it."""

    state: str  # Idle, Run, Jog, Hold, Alarm, Check
    place: tuple[float, float, float]  # [mm] of the machine
    work: tuple[float, float, float]  # [mm] in the work's coordinates
    feed: float  # [mm/min] that it makes
    overrides: tuple[int, int, int]  # [%] feed, rapids, spindle
