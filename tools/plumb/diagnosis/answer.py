"""The answer of a diagnosis: what the marks prove, and what they do not."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from plumb.diagnosis.left_open import LeftOpen
from plumb.diagnosis.noise import Noise
from plumb.diagnosis.sizes import Room, Size
from plumb.diagnosis.slip_cause import Slip

VERDICTS = ("nothing_provable", "one_suspect", "cannot_tell", "not_in_library", "slip")


@dataclass(frozen=True)
class Ranked:
    """An effect of the library by itself."""

    effect: str
    gain: float  # drop of chi-square when it is added to the frame and all is refitted
    surprise: float  # -log of the chance of that gain from noise: the order of the ranking
    sizes: tuple[Size, ...]
    rms_after: float  # [mm]
    hidden_share: float | None

    @property
    def plausible(self) -> bool:
        """Whether a real machine can have these sizes."""
        return all(size.plausible for size in self.sizes)


@dataclass(frozen=True)
class Together:
    """An explanation that stood its test: one effect, or several that act at once."""

    effects: tuple[str, ...]
    sizes: Mapping[str, tuple[Size, ...]]
    rms_after: float  # [mm]
    share: float | None = None  # how likely it is among all accounts, where they were weighed

    @property
    def possible(self) -> bool:
        """Whether the intervals of all sizes reach what a real machine may have."""
        return all(size.possible for sizes in self.sizes.values() for size in sizes)

    def explained_share(self, rms_before: float) -> float:
        """Share of the squared error that the frame leaves [mm RMS] and this takes away."""
        return max(0.0, 1 - (self.rms_after / rms_before) ** 2) if rms_before else 0.0


@dataclass(frozen=True)
class Diagnosis:
    """What the marks prove, and what they do not."""

    verdict: str  # one of VERDICTS
    noise: Noise
    limit: float  # of the gate: the surprise that noise hardly ever exceeds (gain.LEVEL)
    rms_before: float  # [mm] with the frame fitted
    explanations: tuple[Together, ...]  # best first
    differences: Mapping[tuple[int, int], float]  # [mm] RMS between two explanations' marks
    ranking: tuple[Ranked, ...]
    library_fits: bool  # whether all effects of the library at once could draw the marks
    chance: float  # that as many effects at once would explain what none of them made
    to_add: tuple[str, ...]  # effects to go on with: the first explanation, or the best at hand
    slips: tuple[Slip, ...]
    could_hide: tuple[Room, ...]
    left_open: LeftOpen  # of the machine's errors all over the sheet
    warnings: tuple[str, ...]
    disagreements: tuple[str, ...] = ()  # rounds, or halves of the sheet, that do not go together

    @property
    def suspects(self) -> tuple[str, ...]:
        """The effects in the explanations, best first."""
        names = (name for together in self.explanations for name in together.effects)
        return tuple(dict.fromkeys(names))
