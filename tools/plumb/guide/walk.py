"""Walks through the steps: what is done is passed over, what is left is taken up again."""

from __future__ import annotations

from collections.abc import Collection

from plumb.guide.steps import STEPS, Step, Visit
from plumb.guide.talk import LeftError


def walk(visit: Visit, *, first: str = "") -> bool:
    """Take the steps in order, from `first` or from the step that is open; whether all are done."""
    names = [step.name for step in STEPS]
    begin = names.index(first) if first else 0
    try:
        for step in STEPS[begin:]:
            if step.name in visit.progress.done and step.name != first:
                continue
            number = names.index(step.name) + 1
            visit.talk.say(f"\n{number} of {len(STEPS)}  {step.title}")
            if not take(visit, step):
                visit.talk.say(f"This step is still open: {step.title}")
                return False
    except LeftError:
        visit.progress.save()
        visit.talk.say("The guide stays where it is; run it again to go on.")
        return False
    return True


def take(visit: Visit, step: Step) -> bool:
    """Take a step, and keep that it is done. Raises LeftError if the owner leaves it."""
    done = step.run(visit)
    if done:
        visit.progress.finish(step.name)
    return done


def open_step(done: Collection[str]) -> str:
    """The name of the first step that is not done; empty if all are."""
    return next((step.name for step in STEPS if step.name not in done), "")
