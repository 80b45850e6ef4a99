"""What a test asks of any sender, whatever its program is."""

from dataclasses import dataclass
from typing import Protocol


@dataclass(frozen=True)
class Shown:
    """The machine as the sender shows it."""

    state: str  # Idle, Run, Jog, Hold, Alarm, Check
    place: tuple[float, float, float]  # [mm] of the machine
    work: tuple[float, float, float]  # [mm] in the work's coordinates
    feed: float  # [mm/min] that it makes
    overrides: tuple[int, int, int]  # [%] feed, rapids, spindle


class SenderProgram(Protocol):
    """A sender with its buttons."""

    name: str
    lacks: frozenset[str]  # features for which it has no button

    def connect(self, port: str) -> None:
        """Open the line and wait until the sender takes the machine for a Grbl it can drive."""

    def disconnect(self) -> None:
        """Close the line."""

    def shown(self) -> Shown:
        """The newest status that it understood."""

    def heard(self) -> list[str]:
        """What it shows in its console."""

    def jog(self, way: str, feed: float) -> None:
        """Its jog button: `way` as "X10"; a sender may have a fixed feed."""

    def cancel_jog(self) -> None:
        """Let the jog button go."""

    def run(self, lines: list[str]) -> None:
        """Load a program and start it."""

    def ended(self) -> bool:
        """Whether it takes the program for done, with each line answered."""

    def hold(self) -> None:
        """Its pause button."""

    def go_on(self) -> None:
        """Its resume button."""

    def stop(self) -> None:
        """Its stop button, with all that it asks its user to press after it."""

    def change(self, what: str, percent: int) -> None:
        """Its override buttons: `what` is feed, rapids or spindle, `percent` what is wanted."""

    def say(self, line: str) -> None:
        """A line typed in its console."""

    def unlock(self) -> None:
        """Its unlock button."""

    def end(self) -> None:
        """End the program."""
