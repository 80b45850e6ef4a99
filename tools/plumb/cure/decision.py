"""The decision on what to write.

The diagnosis says what the marks prove. Here it is decided what follows for the machine: a reading
is looked at again; the settings are good and stay; new numbers are better, and by how much; or
something is measured first.
"""

from dataclasses import dataclass, replace
from functools import partial
from math import hypot
from typing import Annotated

from plumb.cure.add import WEIGHTS, Addition, Note, add
from plumb.cure.live_board import TooFewError
from plumb.diagnosis.answer import Diagnosis, Verdict
from plumb.diagnosis.diagnosis import diagnose
from plumb.diagnosis.expected_error import RivalError, expected_error, rival_error
from plumb.fit.inputs import Inputs
from plumb.model.plain import ranked
from plumb.text.answers import Internal, among, in_json, key, part
from plumb.text.errors import said_by

AS_GOOD = 0.95  # of an error at marks left out, below which another is clearly less
# Where two effects or more act, others hide behind them that the marks do not ask for, and so does
# what no effect draws. On 205 boards of the judge with such a verdict 1.44 times as much came as
# the explanations leave open.
HIDDEN_BESIDE = 1.4
STATES = (
    "read_again",
    "measure_first",  # too few marks, or not over the sheet: nothing is fitted
    "good",
    "impossible",
    "unknown_cause",
    "cannot_tell",
    "better",
)


@dataclass(frozen=True)
class Decision:
    """Decision on what to write."""

    diagnosis: Internal[Diagnosis]
    inputs: Internal[Inputs]  # with what is usual of the sizes that were added
    chosen: tuple[str, ...] = ()  # effects added: those asked for, then what every machine has
    # None: nothing is fitted to a wrong reading, to too few marks, or where all is well
    addition: Internal[Addition | None] = None
    offer: Annotated[
        tuple[float, float] | None,
        key("patch_offer_mm", "Error on marks left out, without a patch and with it."),
    ] = None
    apart: RivalError | None = None  # where rivals would cut elsewhere by more than the noise
    refused: Internal[str] = ""  # why the marks cannot settle the numbers

    verdict = part("diagnosis.verdict", Verdict)

    @in_json
    def rivals(self) -> tuple[tuple[str, ...], ...]:
        """Explanations that the marks allow as well."""
        if self.addition is None or self.verdict == "not_in_library":
            return ()
        return tuple(each.effects for each in self.diagnosis.explanations[1:])

    @in_json
    def state(self) -> Annotated[str, among(STATES)]:
        """Result for the machine."""
        if self.addition is None:
            return "measure_first" if self.refused else self.diagnosis.state
        if self.addition.stops:
            return "impossible"
        if not self.is_explained:
            return "unknown_cause"
        return "cannot_tell" if self.rivals else "better"

    @in_json
    def notes(self) -> tuple[Note, ...]:
        """Notes on the new numbers, the heaviest first."""
        notes = list(self.addition.notes) if self.addition else []
        if self.apart:
            notes.append(Note("promise", self.apart.sentence))
        if self.expected_mm is not None and not self.rivals:
            expected = self.inputs.unit.worded(self.expected_mm)
            notes.append(Note("promise", f"Over the sheet expect errors of {expected} RMS."))
        notes += [Note("doubt", slip.sentence) for slip in self.diagnosis.outliers]
        return tuple(ranked(notes, lambda note: WEIGHTS.index(note.weight)))

    @in_json
    def slips(self) -> tuple[str, ...]:
        """Names of the readings that are wrong."""
        return tuple(slip.name for slip in self.diagnosis.outliers)

    @property
    def is_explained(self) -> bool:
        """Whether the library explains what the new numbers change."""
        is_named = self.diagnosis.is_finding and bool(self.chosen)
        return self.verdict != "not_in_library" or is_named

    @property
    def is_settled(self) -> bool:
        """Whether nothing is left that the marks could decide."""
        return self.state in ("better", "good")

    @property
    def asks_for_more(self) -> bool:
        """Whether something is to be measured first."""
        return self.state in ("measure_first", "unknown_cause", "cannot_tell")

    @property
    def done(self) -> bool:
        """Whether the marks ask for nothing more once the chosen effects are there."""
        return self.is_settled or self.state == "cannot_tell"

    @property
    def expected_mm(self) -> float | None:
        """The error to expect over the sheet [mm RMS] of the settings to go on with, and of what
        no effect draws; None where nothing is to be cut yet.
        """
        if not self.done:
            return None
        expected = expected_error(self.diagnosis.best, self.diagnosis.rivals)
        if self.verdict == "not_in_library":
            return hypot(expected, self.diagnosis.pattern_mm)
        return expected * (HIDDEN_BESIDE if len(self.diagnosis.likely) > 1 else 1.0)


def decide(inputs: Inputs, *, patch: bool = False, diagnosis: Diagnosis | None = None) -> Decision:
    """Diagnose the marks and fit the likeliest account, with what every machine has and the
    settings leave out; nothing where the settings are as good as the marks can show. `diagnosis` is
    that of these inputs, if it is known.

    Where the library has no account, the nearest is added if marks left out are predicted better
    with it: to leave out a large effect because a small effect is unknown would help nobody. What
    every machine has is not added to it where it predicts them worse. A residual patch is offered
    then, and added only if `patch` asks for it. Raises InputError as diagnose() and add() do.
    """
    diagnosis = diagnosis or diagnose(inputs)
    inputs = replace(inputs, checked=(*inputs.checked, *diagnosis.usual))
    decision = Decision(diagnosis, inputs)
    if diagnosis.state in ("read_again", "measure_first", "good"):
        return decision
    # The noise is that of the diagnosis: what is usual would count twice in another posterior.
    fitted = partial(add, inputs, noise=diagnosis.noise)
    chosen = diagnosis.to_add
    try:
        addition = fitted(effects=chosen)
    except TooFewError as error:
        return replace(decision, refused=said_by(error))
    if diagnosis.verdict != "not_in_library":
        fits = diagnosis.fits
        apart = rival_error(fits, diagnosis.noise.sigma) if len(fits) > 1 else None
        return replace(decision, chosen=chosen, addition=addition, apart=apart)
    bare = fitted(effects=diagnosis.likely)
    if bare.after.left_out_rms < AS_GOOD * addition.after.left_out_rms:
        chosen, addition = diagnosis.likely, bare
    if not addition.pays:
        chosen, addition = (), fitted(effects=())
    patched = fitted(effects=chosen, patch=True)
    offer = addition.after.left_out_rms, patched.after.left_out_rms
    return replace(decision, chosen=chosen, addition=patched if patch else addition, offer=offer)
