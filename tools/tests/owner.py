"""Two owners on trial: the first carries out what is proposed, the second just cuts more marks.

The owner is whoever can answer: a made-up machine in the tests and the bench.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from plumb.diagnosis import Checked, Diagnosis, diagnose
from plumb.fit.inputs import Inputs
from plumb.marks.read import Measurements
from plumb.model.catalogue import effect_names
from plumb.plan.case import Check
from plumb.plan.options import Option
from plumb.plan.planned_visits import Visits
from plumb.plan.proposal import Proposal, propose
from plumb.settings.machine import MachineSettings

MEASUREMENTS = 4  # marks and checks together


class Owner(Protocol):
    """Who measures a machine."""

    def measured(self, *several: Visits) -> Measurements:
        """The marks of groups of visits; a group reads the same whatever follows it."""

    def checked(self, checks: Sequence[Check]) -> list[Checked]:
        """What direct measurements find."""


@dataclass(frozen=True)
class Measured:
    """How a board was judged, and what was measured for it."""

    diagnosis: Diagnosis
    done: tuple[Proposal, ...]

    def right(self, effect: str) -> bool:
        """Whether the effect comes first."""
        return self.diagnosis.suspects[:1] == (effect,)

    def settled(self, effect: str) -> bool:
        """Whether the effect alone is left."""
        return self.diagnosis.verdict == "one_suspect" and self.diagnosis.suspects == (effect,)

    @property
    def left(self) -> int:
        """Explanations that stand; every effect where nothing is proved or known."""
        return len(self.diagnosis.explanations) or len(effect_names())


def cost(option: Option) -> int:
    """How many measurements an option is: its marks, and one for a check."""
    return len(option.visits) + (1 if option.checks else 0)


def proposed(
    owner: Owner,
    settings: MachineSettings,
    first: Visits,
    *,
    most: int = MEASUREMENTS,
    with_checks: bool = True,
) -> Measured:
    """The owner carries out the best proposals, one after the other, until the measurements are
    used up; one suspect that is left over early is put to the proof."""
    visits = [first]
    checked: list[Checked] = []
    done: list[Proposal] = []
    while True:
        board = owner.measured(*visits)
        diagnosis = diagnose(Inputs(settings, board, checked=checked))
        room = most - sum(cost(proposal.option) for proposal in done)
        if not room:
            return Measured(diagnosis, tuple(done))
        answer = propose(diagnosis, Inputs(settings, board, checked=checked))
        fitting = [
            proposal
            for proposal in answer.proposals
            if 0 < cost(proposal.option) <= room
            and (with_checks or not proposal.option.checks)
            and proposal.option.title not in {earlier.option.title for earlier in done}
        ]
        if not fitting:
            return Measured(diagnosis, tuple(done))
        best = fitting[0]
        done.append(best)
        if len(best.option.visits):
            visits.append(best.option.visits)
        checked += owner.checked(best.option.checks)


def blind(owner: Owner, settings: MachineSettings, first: Visits, more: Visits) -> Measured:
    """The owner cuts more marks, wherever."""
    return Measured(diagnose(Inputs(settings, owner.measured(first, more))), ())
