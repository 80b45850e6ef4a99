"""Adding by itself what the marks prove: the diagnosis names, the fit adds, step by step."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from pydantic import computed_field

from plumb.cure.add import Addition, add, may_be_zero
from plumb.cure.live_board import TooFewError
from plumb.diagnosis import Diagnosis, diagnose
from plumb.diagnosis.answer import Verdict
from plumb.diagnosis.expected_error import LeftOpen
from plumb.fit.inputs import Inputs
from plumb.model.catalogue import every_effect
from plumb.model.plain import noun_of, plainly
from plumb.text.answers import Internal, key, part
from plumb.text.errors import to_do
from plumb.text.values import worded


@dataclass(frozen=True)
class AutoAddition:
    """What was added without anybody naming it, and why."""

    diagnosis: Internal[Diagnosis]
    chosen: tuple[str, ...]  # effects added, what explains most first
    rivals: tuple[tuple[str, ...], ...]  # explanations that the marks allow as well
    # None: nothing is fitted to a wrong reading, or to too few marks
    addition: Internal[Addition | None]
    reason: str  # one sentence
    offer: Annotated[
        tuple[float, float] | None,
        key("patch_offer_mm", "Error on marks left out, without a patch and with it."),
    ] = None
    # How to tell the chosen from their rivals.
    settled_by: tuple[str, ...] = ()

    verdict = part("diagnosis.verdict", Verdict)

    @computed_field
    @property
    def slips(self) -> tuple[str, ...]:
        """Names of the readings that are wrong."""
        return tuple(slip.name for slip in self.diagnosis.outliers)

    @property
    def done(self) -> bool:
        """Whether nothing more is provable once the chosen effects are there."""
        if self.addition is None:
            return False
        if self.diagnosis.verdict in ("one_suspect", "cannot_tell"):
            return bool(self.chosen or self.rivals)
        return self.diagnosis.verdict == "nothing_provable"


def add_auto(
    inputs: Inputs,
    *,
    patch: bool = False,
    diagnosis: Diagnosis | None = None,
) -> AutoAddition:
    """Diagnose the marks and add the best explanation that a real machine can have. `diagnosis` is
    that of these inputs, if it is known.

    Where the library has none, the effects that come nearest are added as long as marks left out
    are predicted better with them: to leave out a large effect because a small effect is unknown
    would help nobody. A residual patch is offered, and added only if `patch` asks for it.

    An explanation has stood the test that nothing else in the library adds more to it than noise
    would; so with its effects nothing more is provable. Several of them: the first of the
    diagnosis. Raises InputError as diagnose() and add() do.
    """
    diagnosis = diagnosis or diagnose(inputs)
    if diagnosis.verdict == "slip":
        return AutoAddition(diagnosis, (), (), None, _slip_reason(diagnosis))
    if diagnosis.left_open.is_too_much:
        return AutoAddition(diagnosis, (), (), None, _open_reason(diagnosis.left_open))
    known = diagnosis.verdict != "not_in_library"
    possible = [
        explanation.effects
        for explanation in diagnosis.explanations
        if explanation.possible and known
    ]
    order = [ranked.effect for ranked in diagnosis.ranking]
    best = (possible[0] if possible else ()) if known else diagnosis.to_add
    chosen = tuple(sorted(best, key=order.index))
    try:
        chosen, addition = _added(inputs, chosen)
    except TooFewError as error:
        return AutoAddition(diagnosis, (), (), None, f"nothing was added: {error}")
    rivals = tuple(effects for effects in possible[1:] if {*effects} != {*chosen})
    if not known and chosen and not _helps(addition):
        chosen, addition = (), add(inputs, effects=())
    reason, offer = _reason(diagnosis, chosen, rivals), None
    if not known:
        patched = add(inputs, effects=chosen, patch=True)
        offer = addition.after.left_out_rms, patched.after.left_out_rms
        addition = patched if patch else addition
    settled_by = _settled_by(chosen, rivals)
    return AutoAddition(diagnosis, chosen, rivals, addition, reason, offer, settled_by)


def _added(inputs: Inputs, chosen: tuple[str, ...]) -> tuple[tuple[str, ...], Addition]:
    """Return these effects and their fit, without those that it gives an impossible size which may
    as well be zero.
    """
    addition = add(inputs, effects=chosen)
    useful = tuple(name for name in chosen if not _is_needless(name, addition))
    return (chosen, addition) if useful == chosen else _added(inputs, useful)


def _is_needless(effect: str, addition: Addition) -> bool:
    sizes = [each for each in addition.parameters if each.name.partition(".")[0] == effect]
    return all(map(may_be_zero, sizes)) and not all(each.plausible for each in sizes)


def _helps(addition: Addition) -> bool:
    """Return whether effects that do not explain all are of use: no mere fit, and of plausible
    sizes.

    The values themselves must be plausible: where physics is missing, no interval is to be trusted.
    """
    return addition.pays and all(parameter.plausible for parameter in addition.parameters)


def _settled_by(chosen: tuple[str, ...], rivals: tuple[tuple[str, ...], ...]) -> tuple[str, ...]:
    """Return how to look directly at each effect that is in some explanations only."""
    if not rivals:
        return ()
    explanations = (chosen, *rivals)
    names = dict.fromkeys(name for explanation in explanations for name in explanation)
    remedies = {effect["name"]: effect["remedy"] for effect in every_effect()}
    undecided = (
        name for name in names if not all(name in explanation for explanation in explanations)
    )
    return tuple(f"{noun_of(name)}: {remedies[name]}" for name in undecided)


def _slip_reason(diagnosis: Diagnosis) -> str:
    names = ", ".join(dict.fromkeys(slip.name for slip in diagnosis.outliers))
    return (
        f"nothing was added: look at the reading of {names} again first, and correct it "
        + to_do(
            "in the file, or leave the mark out with --without NAME",
            page="under Readings, or clear it there",
        )
    )


def _open_reason(left_open: LeftOpen) -> str:
    return (
        f"nothing was added: of the {worded(left_open.before, 1)} by which holes may be off among "
        f"each other before anything is measured, these marks leave {worded(left_open.now, 1)} "
        "open; measure marks all over the sheet, nine or more"
    )


def _reason(
    diagnosis: Diagnosis, chosen: tuple[str, ...], rivals: tuple[tuple[str, ...], ...]
) -> str:
    if diagnosis.verdict == "nothing_provable":
        return "the marks prove no effect: only the frame was fitted"
    if diagnosis.verdict == "not_in_library":
        part = f"only {plainly(chosen)}, as far as it goes," if chosen else "no effect"
        return (
            f"not all that the marks show is in the library, so {part} was added; read the worst "
            "marks again, and see " + to_do("plumb next", page="Verdict") + " for what to measure"
        )
    name = plainly(chosen)
    if rivals:
        others = ", or ".join(plainly(rival) for rival in rivals)
        asked = to_do("plumb next", page="Verdict")
        return (
            f"a choice: {name} explains the marks best, but they allow {others} as well; {asked} "
            "says what to measure to tell them apart"
        )
    if not chosen:
        tried = "; ".join(plainly(explanation.effects) for explanation in diagnosis.explanations)
        return (
            "every explanation needs sizes that no real machine has, so none was added and only "
            f"the frame was fitted ({tried}): check which settings were in force and the marks' "
            "signs"
        )
    return f"{name} explains the marks; with it nothing more is provable"
