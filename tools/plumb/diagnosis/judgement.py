"""The verdict: what stands its tests, and what to go on with."""

from __future__ import annotations

from dataclasses import dataclass

from plumb.diagnosis.clean import CleanReadings
from plumb.diagnosis.explanation import Explanation
from plumb.diagnosis.gain import Search
from plumb.diagnosis.imitation import BELIEVABLE
from plumb.diagnosis.likeliest import likeliest
from plumb.diagnosis.misfit import LEVEL as MISFIT_LEVEL
from plumb.diagnosis.misfit import misfit_chance
from plumb.diagnosis.suspects import Survivor, Suspects, best_at_hand, find_suspects
from plumb.diagnosis.weighing import left_out

EVEN = 0.5  # chance of a field of no effect beyond which it is likelier than all else


@dataclass(frozen=True)
class Judgement:
    """The verdict and the suspects that it rests on."""

    verdict: str  # one of answer.VERDICTS
    suspects: Suspects
    to_add: tuple[str, ...]  # effects to go on with
    shares: tuple[float, ...] = ()  # how likely each explanation is among all, where it was weighed

    @property
    def explanations(self) -> tuple[Explanation, ...]:
        """Those that stood their tests, best first."""
        return tuple(survivor.explanation for survivor in self.suspects.survivors)

    @property
    def none_possible(self) -> bool:
        """Whether something stood, but only with sizes that no real machine has."""
        survivors = self.suspects.survivors
        return bool(survivors) and not any(survivor.possible for survivor in survivors)


def judge(readings: CleanReadings, gate: Search) -> Judgement:
    """A slip comes first, then the gate, then the suspects."""
    if readings.slips:
        return Judgement("slip", Suspects((), True), ())
    if not gate.proved:
        return _without_proof(readings)
    if left_out(readings.frame):
        # What every machine has acts next to whatever else does: single effects say little.
        likely = _likely(readings, EVEN)
        if likely:
            return likely
    felt = [readings.singles[name] for name in readings.felt]
    suspects = find_suspects(readings.frame, felt, readings.felt, readings.noise)
    if suspects.believable:
        verdict = "one_suspect" if len(suspects.survivors) == 1 else "cannot_tell"
        return Judgement(verdict, suspects, _to_add(readings, suspects))
    nothing = Judgement("not_in_library", suspects, _to_add(readings, suspects))
    return _likely(readings, BELIEVABLE) or nothing


def _likely(readings: CleanReadings, most: float) -> Judgement | None:
    """The likeliest accounts; None if none fits, or if a field of no effect is likelier than
    `most`."""
    answer = likeliest(readings.frame, readings.felt, readings.noise)
    if not answer.accounts or answer.field_chance > most:
        return None
    if not any(account.explanation.effects for account in answer.accounts):
        return Judgement("nothing_provable", Suspects((), True), ())
    survivors = tuple(Survivor(account.explanation, True) for account in answer.accounts)
    return Judgement(
        "one_suspect" if len(survivors) == 1 else "cannot_tell",
        Suspects(survivors, True),
        survivors[0].explanation.effects,
        tuple(account.share for account in answer.accounts),
    )


def _without_proof(readings: CleanReadings) -> Judgement:
    """No effect adds more than noise would: either nothing is there, or nothing in the library."""
    missing = misfit_chance(readings.frame, readings.noise) <= MISFIT_LEVEL
    suspects = Suspects((), not missing)
    if not missing:
        return Judgement("nothing_provable", suspects, ())
    return Judgement("not_in_library", suspects, _to_add(readings, suspects))


def _to_add(readings: CleanReadings, suspects: Suspects) -> tuple[str, ...]:
    """The best explanation, or the effects that come nearest where none stands."""
    if suspects.survivors:
        return suspects.survivors[0].explanation.effects
    return best_at_hand(readings.frame, readings.felt)
