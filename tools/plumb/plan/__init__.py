"""What to measure next, and what a plan could tell apart before any hole is drilled."""

from plumb.plan.proposal import Next, Proposal, propose

__all__ = ["Next", "Proposal", "propose"]
