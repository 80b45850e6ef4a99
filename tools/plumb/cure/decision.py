"""The decision on what to write, and the machine.toml that is written."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from math import hypot
from pathlib import Path
from typing import Annotated

from plumb.cure.add import WEIGHTS, Addition, Note, Parameter, TooFewError, add
from plumb.diagnosis.diagnosis import Diagnosis, Verdict, diagnose
from plumb.diagnosis.expected_error import RivalError, expected_error, rival_error
from plumb.fit.compare import PATCH
from plumb.fit.inputs import Inputs
from plumb.fit.observations import POSE_AXES, ZERO_AXES
from plumb.marks.read import Round
from plumb.model.catalogue import parameter_names, place_of
from plumb.model.plain import ranked
from plumb.settings import FRAME_FIELDS, FitRecord, FittedBoard, machine_toml, published_machine
from plumb.text.answers import Internal, among, in_json, key, part
from plumb.text.errors import said_by

# The decision on what to write.
#
# The diagnosis says what the marks prove. Here it is decided what follows for the machine: a
# reading is looked at again; the settings are good and stay; new numbers are better, and by how
# much; or something is measured first.


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


# The machine.toml of a fitted machine: its numbers, below what the fit says of them.


PATCH_WARNING = (
    "It is not physics: a smooth map that holds for this machine, sled and sheet as they are, and "
    "only where marks were measured."
)


def toml_of(
    result: Addition, *, source: str, firmware: str = "plumb", record: FitRecord | None = None
) -> bytes:
    """Return the new machine as the bytes of a machine.toml, with the formula of its firmware."""
    ours = replace(result.settings, fitted=record)
    settings = published_machine(ours) if firmware == "published" else ours
    lines = [
        f"Fitted to {source}: {result.after.fit_rms:.2f} mm RMS "
        f"({result.after.left_out_rms:.2f} checked on marks not used), "
        f"{result.raw.rms:.2f} mm before.",
        *result.by_hand,
        *([f"{PATCH}: {PATCH_WARNING}"] if PATCH in result.effects_added else []),
        *result.warnings,
    ]
    return machine_toml(settings, comment="\n".join(lines)).encode()


# What a new machine.toml keeps of the fit that gave its numbers.


def record_of(result: Addition, inputs: Inputs, *, without: Sequence[str] = ()) -> FitRecord:
    """Return the fit as its machine.toml keeps it; `without` names the marks that took no part."""
    fitted = result.after_fit
    unknowns = {estimate.name: estimate.value for estimate in fitted.estimates}
    return FitRecord(
        start_rms=result.raw.rms,
        rms=result.after.fit_rms,
        priced_rms=result.after.corrected_rms,
        left_out_rms=result.after.left_out_rms,
        sheet_rotation=fitted.sheet_rotation,
        effects=result.effects_added,
        without=tuple(without),
        lab_effects={name: dict(sizes) for name, sizes in fitted.lab_effects.items()},
        boards=tuple(_board(each, unknowns, inputs) for each in inputs.measurements.rounds),
    )


def _board(file_round: Round, unknowns: dict[str, float], inputs: Inputs) -> FittedBoard:
    sheet, zero = f"sheet{file_round.sheet_group + 1}", f"zero{file_round.zero_group + 1}"
    x, y, rotation = (unknowns.get(f"{sheet}.{axis}", 0.0) for axis in POSE_AXES)
    left, right = (unknowns.get(f"{zero}.{axis}", 0.0) for axis in ZERO_AXES)
    in_force = file_round.cut_with or inputs.cut_with or inputs.settings
    return FittedBoard(
        marks=file_round.name or Path(inputs.measurements.source).name,
        digest=file_round.digest,
        cut_with=replace(in_force, fitted=None),
        sheet=(x, y, rotation),
        zeros=(left, right),
    )


# A correction number by number: what each would become, and the fit with those accepted alone.


@dataclass(frozen=True)
class Correction:
    """All numbers fitted, and what is left when only the accepted are changed."""

    whole: Addition
    accepted: Addition | None  # None: nothing is accepted, so nothing changes
    effects: tuple[str, ...] = ()  # fitted for what is accepted, if that is not all of it
    held: Mapping[str, float] = field(default_factory=dict)  # parameters of these effects
    fixed: tuple[str, ...] = ()  # numbers of the frame that stay

    @property
    def numbers(self) -> tuple[Parameter, ...]:
        """The numbers that a setting holds."""
        return tuple(number for number in self.whole.parameters if has_setting(number.name))


def has_setting(name: str) -> bool:
    """Return whether a setting of the machine holds a number; sheets, tapes and zeros have none."""
    effect, _, _ = name.rpartition(".")
    if not effect:
        return name in FRAME_FIELDS
    return bool(parameter_names(effect)) and place_of(effect) == "firmware"


def correct(decision: Decision, accepted: Collection[str]) -> Correction:
    """Fit frame and chosen effects; then again with every number that is not accepted held as it
    is. Raises InputError as add() does.
    """
    inputs, effects = decision.inputs, decision.chosen
    whole = decision.addition or add(inputs, effects=effects, noise=decision.diagnosis.noise)
    names = [number.name for number in whole.parameters if has_setting(number.name)]
    free = [name for name in names if name in accepted]
    if not free:
        return Correction(whole, None)
    if len(free) == len(names):
        return Correction(whole, whole)
    held_frame = {name: 0.0 for name in FRAME_FIELDS if name in names and name not in free}
    wanted = [effect for effect in effects if _is_wanted(effect, free)]
    settings = inputs.model_and_observations()[0]
    held = {
        name: settings.effect(*name.split("."))
        for effect in wanted
        for name in parameter_names(effect)
        if has_setting(name) and name not in free
    }
    some = replace(inputs, priors={**inputs.priors, **held_frame})
    made = add(some, effects=wanted, held=held)
    return Correction(whole, made, tuple(wanted), held, tuple(held_frame))


def _is_wanted(effect: str, free: Sequence[str]) -> bool:
    """Return whether an effect has an accepted number, or belongs to no setting and is fitted
    anyhow.
    """
    names = parameter_names(effect)
    return any(name in free for name in names) or not any(map(has_setting, names))
