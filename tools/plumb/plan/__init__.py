"""Proposals for the next measurement, and the power of a plan before any hole is drilled."""

from plumb.plan.proposal import Next, Proposal, propose

__all__ = ["Next", "Proposal", "propose"]
