"""Proposals in sentences, for every command and page that shows them."""

from __future__ import annotations

from plumb.model.plain import noun_of, plainly
from plumb.plan.proposal import CONFIRM, FIND, REREAD, SETTLE, Proposal
from plumb.text.shown import bare, worded

VERBS = {SETTLE: "settle it", CONFIRM: "confirm it", REREAD: "show it"}


def headline_of(best: Proposal) -> str:
    """What to measure, how long it takes and what to hope of it; without the full stop."""
    return f"{best.option.title}; about {best.option.minutes:.0f} minutes{_hope(best)}"


def steps_of(best: Proposal, *, is_converted: bool = False) -> list[str]:
    """What to do, and what it tells, in sentences; how a number follows from what is measured,
    unless `is_converted`: whoever asks works it out."""
    said = [*best.option.do]
    if best.parts:
        pairs = [f"{_nouns(a)} from {_nouns(b)}" for a, b in best.parts]
        said.append(f"It tells {'; '.join(pairs)}.")
    if best.option.checks and not is_converted:
        said.append(f"VALUE: {best.option.value}.")
    return said


def promise_of(proposal: Proposal) -> str:
    """What to hope of a proposal, for a table."""
    if proposal.question == FIND and proposal.rooms:
        promise = ", ".join(
            f"{noun_of(room.effect)} {bare(room.now, 1)} -> {worded(room.then, 1)}"
            for room in proposal.rooms[:2]
            if room.then < 0.9 * room.now
        )
        return promise or "no change"
    return percent(proposal.chance)


def percent(chance: float | None) -> str:
    """A chance in steps of five in a hundred: it is not known better."""
    if chance is None:
        return "-"
    near = 5 * round(20 * chance)
    return "below 5 %" if near < 5 else "above 95 %" if near > 95 else f"{near:.0f} %"


def _hope(best: Proposal) -> str:
    if best.question == FIND and best.rooms:
        first = best.rooms[0]
        noun = noun_of(first.effect)
        now, then = (worded(size, 1) for size in (first.now, first.then))
        return f". {noun[0].upper()}{noun[1:]} could hide {now} now, {then} then"
    if best.chance is None:
        return ""
    verb = VERBS.get(best.question, "")
    return f", chance to {verb} {percent(best.chance)}" if verb else ""


def _nouns(explanation: str) -> str:
    """An explanation, `effect + effect`, in a maker's words."""
    return plainly(filter(None, explanation.split(" + ")))
