"""Jobs that nobody planned: lines of G-code drawn by chance."""

from __future__ import annotations

from collections.abc import Iterator
from math import cos, pi, sin

import numpy as np

Source = np.random.Generator
REACH = (250.0, 150.0)  # [mm] to either side of the place where a job begins
DEPTH, SAFE = -3.0, 2.0  # [mm] of the bit


class Job:
    """Draws lines around a place; each kind of move that a client's files have."""

    def __init__(
        self,
        source: Source,
        *,
        middle: tuple[float, float] = (0.0, 88.66),
        reach: tuple[float, float] = REACH,
        slowest: float = 300.0,
    ) -> None:
        """middle and reach [mm] of the places it goes to; slowest feed [mm/min]."""
        self._source, self._middle, self._reach = source, middle, reach
        self._slowest = slowest
        self._at = middle

    def lines(self, moves: int) -> list[str]:
        """Return as many moves, from where the last ended; the first begin in the middle."""
        kinds = (self._line, self._line, self._jog, self._arc, self._curve, self._drill, self._rest)
        drawn = ["G21 G90", self._to("G0", *self._at)]
        for _ in range(moves):
            drawn += kinds[self._source.integers(len(kinds))]()
        return drawn

    def _draw(self, low: float, high: float) -> float:
        return float(self._source.uniform(low, high))

    def _place(self) -> tuple[float, float]:
        (x, y), (width, height) = self._middle, self._reach
        return x + self._draw(-width, width), y + self._draw(-height, height)

    def _feed(self) -> str:
        return f"F{self._draw(self._slowest, 900):.0f}"

    def _to(self, code: str, x: float, y: float, rest: str = "") -> str:
        self._at = (round(x, 3), round(y, 3))
        return f"{code} X{x:.3f} Y{y:.3f}{rest}"

    def _near(self, most: float) -> tuple[float, float]:
        """Return a place on the way to another, `most` [mm] away."""
        goal = self._place()
        dx, dy = goal[0] - self._at[0], goal[1] - self._at[1]
        share = min(1.0, most / max(1e-6, float(np.hypot(dx, dy))))
        return self._at[0] + share * dx, self._at[1] + share * dy

    def _line(self) -> Iterator[str]:
        yield self._to("G1", *self._near(120), f" {self._feed()}")

    def _jog(self) -> Iterator[str]:
        yield self._to("G0", *self._near(80))

    def _arc(self) -> Iterator[str]:
        """Yield a part of a circle or all of it, back towards the middle."""
        radius, turn = self._draw(3, 30), self._draw(0.3, 2 * pi)
        from_middle = np.subtract(self._at, self._middle)
        start = float(np.arctan2(from_middle[1], from_middle[0]))
        x, y = self._at[0] - radius * cos(start), self._at[1] - radius * sin(start)
        code, sense = (("G3", 1), ("G2", -1))[self._source.integers(2)]
        end = start + sense * turn
        centre = f" I{x - self._at[0]:.3f} J{y - self._at[1]:.3f} {self._feed()}"
        yield self._to(code, x + radius * cos(end), y + radius * sin(end), centre)

    def _curve(self) -> Iterator[str]:
        """Short lines, as a drawing program makes them."""
        radius, step = self._draw(5, 25), self._draw(0.02, 0.1)
        x, y = self._near(20)
        yield self._to("G1", x, y, f" {self._feed()}")
        for part in range(self._source.integers(5, 40)):
            angle = part * step
            yield self._to("G1", x + radius * sin(angle), y + radius * (1 - cos(angle)))

    def _drill(self) -> Iterator[str]:
        yield f"G1 Z{self._draw(DEPTH, -0.5):.2f} F{self._draw(20, 60):.0f}"
        if self._source.random() < 0.5:
            yield self._to("G1", *self._near(30), f" {self._feed()}")
        yield f"G0 Z{SAFE * self._source.random():.2f}"

    def _rest(self) -> Iterator[str]:
        yield f"G4 P{self._draw(0, 800):.0f}"
