"""Whether check marks are where the settings promise them, in a sentence for people."""

from __future__ import annotations

from plumb.diagnosis.check_marks import Check
from plumb.text.shown import bare, worded


def check_sentence(checked: Check) -> str:
    """What was promised, what was measured, and what follows."""
    off = ", ".join(bare(mark.off) for mark in checked.marks)
    promised = worded(max(mark.promised for mark in checked.marks))
    measured = f"Promised: within {promised}. Measured: off by {off}."
    if checked.holds:
        return f"{measured} The settings hold."
    far = " and ".join(mark.name for mark in checked.marks if not mark.is_within)
    which = f"mark {far}" if far else "both marks together"
    return (
        f"{measured} More than noise, at {which}: read it again. If it stays, the settings miss "
        "something, or the machine has changed."
    )
