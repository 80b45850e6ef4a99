"""The report's next step: what follows from the verdict, or what to measure."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from plumb.model.plain import plainly
from plumb.plan import Proposal
from plumb.plan.planned_visits import Visits
from plumb.plan.proposal_text import headline_of, promise_of, steps_of
from plumb.report.findings import Findings
from plumb.report.maps import plan_map

MOST_OTHERS = 5


@dataclass(frozen=True)
class Command:
    """A command with what it is for."""

    words: str
    command: str


@dataclass(frozen=True)
class Other:
    """Another measurement that would help."""

    title: str
    minutes: str
    promise: str


@dataclass(frozen=True)
class NextStep:
    """What to do now, and what to measure if more is to be known."""

    headline: str
    measure: str
    steps: tuple[str, ...]
    picture: str  # of new marks; empty: none
    commands: tuple[Command, ...]
    others: tuple[Other, ...]


def next_step_of(findings: Findings, commands: Sequence[Command]) -> NextStep:
    """What the verdict asks for first."""
    best = findings.advice.proposals[0] if findings.advice.proposals else None
    return NextStep(
        headline=_headline(findings, best),
        measure=headline_of(best) if best else "",
        steps=tuple(steps_of(best)) if best else (),
        picture=_picture(findings, best.option.visits) if best else "",
        commands=tuple(commands),
        others=tuple(
            Other(each.option.title, f"{each.option.minutes:.0f}", promise_of(each))
            for each in findings.advice.proposals[1 : MOST_OTHERS + 1]
        ),
    )


def _headline(findings: Findings, best: Proposal | None) -> str:
    diagnosis, chosen = findings.diagnosis, findings.auto.chosen
    if diagnosis.verdict == "slip":
        names = ", ".join(dict.fromkeys(slip.name for slip in diagnosis.slips))
        return f"read {names} again, and correct the file."
    if diagnosis.verdict == "one_suspect" and chosen:
        return f"add {plainly(chosen)}, then cut new marks to see that it holds."
    if diagnosis.verdict == "nothing_provable" and findings.auto.addition:
        return "use the fitted frame, then cut new marks to see that it holds."
    if best is None:
        return "nothing that can be proposed would tell more."
    return f"{headline_of(best)}."


def _picture(findings: Findings, visits: Visits) -> str:
    if not len(visits):
        return ""
    sheet = findings.inputs.settings.sheet
    return plan_map(visits.targets, np.asarray(findings.rows.targets), sheet=sheet, name="plan")
