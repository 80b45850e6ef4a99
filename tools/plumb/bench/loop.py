"""The loop: what `plumb next` proposes is measured on the same board, round after round."""

from __future__ import annotations

from dataclasses import dataclass, replace

from plumb.bench.boards import BoardCut
from plumb.bench.owner import BoardOwner
from plumb.diagnosis import Checked, Diagnosis, diagnose
from plumb.fit.inputs import Inputs
from plumb.plan import Proposal, propose
from plumb.settings.machine import MachineSettings


@dataclass(frozen=True)
class Followed:
    """A board with all that was measured of it, and what the lab then says."""

    board: BoardCut
    diagnosis: Diagnosis
    checked: tuple[Checked, ...] = ()
    done: tuple[str, ...] = ()  # titles of the proposals that were carried out
    readings: int = 0  # of marks, beyond those of the first board

    def inputs(self, settings: MachineSettings) -> Inputs:
        """What the lab knows of a machine with these settings."""
        return Inputs(settings, self.board.measurements, checked=self.checked)


def followed(
    board: BoardCut, settings: MachineSettings, owner: BoardOwner, *, rounds: int
) -> Followed:
    """The board after some rounds, in each of which the best proposal is carried out."""
    loop = Followed(board, diagnose(Inputs(settings, board.measurements)))
    for _ in range(rounds):
        for proposal in propose(loop.diagnosis, loop.inputs(settings)).proposals:
            more = _carried_out(loop, proposal, owner)
            if more:
                loop = replace(more, diagnosis=diagnose(more.inputs(settings)))
                break
    return loop


def _carried_out(loop: Followed, proposal: Proposal, owner: BoardOwner) -> Followed | None:
    """The board with a proposal measured, not yet diagnosed; None for what was done before, and
    for what this owner's sled cannot reach."""
    option = proposal.option
    if option.title in loop.done or not (len(option.visits) or option.checks):
        return None
    try:
        board = owner.with_marks(loop.board, option.visits)
    except ValueError:
        return None
    return replace(
        loop,
        board=board,
        checked=(*loop.checked, *owner.checked(board, option.checks)),
        done=(*loop.done, option.title),
        readings=loop.readings + len(option.visits),
    )
