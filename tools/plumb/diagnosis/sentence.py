"""The last step of a diagnosis: its verdict in one sentence for people."""

from __future__ import annotations

from plumb.diagnosis.answer import Diagnosis
from plumb.model.plain import nouns_of
from plumb.text.shown import bare, worded

SHOWN = 8  # explanations that a sentence names; a Diagnosis holds all


def verdict_sentence(diagnosis: Diagnosis) -> str:
    """The verdict in one sentence."""
    return _SENTENCES[diagnosis.verdict](diagnosis)


def _slip(diagnosis: Diagnosis) -> str:
    names = ", ".join(dict.fromkeys(slip.name for slip in diagnosis.slips))
    which = "One reading disagrees" if len(diagnosis.slips) == 1 else "Some readings disagree"
    against = {slip.against for slip in diagnosis.slips}
    what = against.pop() if len(against) == 1 else "every explanation or with their repeats"
    what = "their repeats" if what == "its repeats" and len(diagnosis.slips) > 1 else what
    return f"{which} with {what}: look at {names} again before anything else."


def _nothing_provable(diagnosis: Diagnosis) -> str:
    return f"Nothing is provable: {_error_left(diagnosis)}, and noise alone could look like that."


def _not_in_library(diagnosis: Diagnosis) -> str:
    left = _error_left(diagnosis)
    if not diagnosis.explanations:
        more = " (unless more than three act at once)" if diagnosis.library_fits else ""
        return (
            f"No effect of the library explains these marks, alone or up to three together{more}: "
            f"{left}, more than noise."
        )
    least = min(len(explanation.effects) for explanation in diagnosis.explanations)
    suspects = _suspects(diagnosis)
    kind = "one effect" if least == 1 else f"{least} effects at once"
    return (
        f"No single effect of the library explains these marks as it should ({left}). "
        f"{suspects[0].upper()}{suspects[1:]} would, but that proves nothing: on these marks "
        f"{kind} would explain {100 * diagnosis.chance:.0f} % of all smooth errors of this size "
        "that none of them made. More marks tell."
    )


def _one_suspect(diagnosis: Diagnosis) -> str:
    if not _any_possible(diagnosis):
        return _impossible(diagnosis)
    first = diagnosis.explanations[0]
    single = len(first.effects) == 1
    who = f"{'One suspect' if single else 'Several effects at once'}: {_suspects(diagnosis)}"
    before, after = diagnosis.rms_before, first.rms_after
    return f"{who}. The error falls from {bare(before)} to {worded(after)} RMS."


def _cannot_tell(diagnosis: Diagnosis) -> str:
    if not _any_possible(diagnosis):
        return _impossible(diagnosis)
    if diagnosis.explanations[0].share is not None:
        return _most_likely(diagnosis)
    more = len(diagnosis.explanations) - SHOWN
    others = f" or {more} more" if more > 0 else ""
    return (
        f"Something is missing ({_error_left(diagnosis)}), but the marks cannot tell which: "
        f"{_suspects(diagnosis)}{others}."
    )


def _most_likely(diagnosis: Diagnosis) -> str:
    """The likeliest account with its odds against all others, and the next with theirs."""
    first, second = diagnosis.explanations[:2]
    more = len(diagnosis.explanations) - 2
    others = f", and {more} more" if more else ""
    return (
        f"Something is missing ({_error_left(diagnosis)}). Most likely it is "
        f"{nouns_of(first.effects)} (odds {odds_words(first.share)}); next, "
        f"{nouns_of(second.effects)} (odds {odds_words(second.share)}){others}."
    )


def odds_words(share: float | None) -> str:
    """How likely something is, as odds against all else."""
    if share is None:
        return "not weighed"
    odds = share / max(1 - share, 1e-3)
    return f"{odds:.0f} to 1" if odds >= 1 else f"1 to {1 / max(odds, 1e-3):.0f}"


def _impossible(diagnosis: Diagnosis) -> str:
    return (
        f"Something is missing ({_error_left(diagnosis)}), but only sizes that no real machine has "
        f"would explain it: {_suspects(diagnosis)}. Look for another cause first."
    )


def _any_possible(diagnosis: Diagnosis) -> bool:
    return any(explanation.possible for explanation in diagnosis.explanations)


def _error_left(diagnosis: Diagnosis) -> str:
    return f"{worded(diagnosis.rms_before)} RMS are left with the frame fitted"


def _suspects(diagnosis: Diagnosis) -> str:
    shown = diagnosis.explanations[:SHOWN]
    *others, last = [nouns_of(explanation.effects) for explanation in shown]
    return f"{'; '.join(others)}; or {last}" if others else last


_SENTENCES = {
    "slip": _slip,
    "nothing_provable": _nothing_provable,
    "not_in_library": _not_in_library,
    "one_suspect": _one_suspect,
    "cannot_tell": _cannot_tell,
}
