"""The machine.toml of a fitted machine: its numbers, below what the fit says of them."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from plumb.cure.add import Addition, Parameter, add
from plumb.cure.decision import Decision
from plumb.fit.covariates import PATCH
from plumb.fit.inputs import Inputs
from plumb.fit.observations import POSE_AXES, ZERO_AXES
from plumb.marks.read import Round
from plumb.model.catalogue import parameter_names, place_of
from plumb.settings.files import published_machine
from plumb.settings.machine import FRAME_FIELDS
from plumb.settings.toml import FitRecord, FittedBoard, machine_toml

PATCH_WARNING = (
    "It is not physics: a smooth map that holds for this machine, sled and sheet as they are, and "
    "only where marks were measured."
)


def toml_of(
    result: Addition,
    *,
    source: str,
    firmware: str = "plumb",
    record: FitRecord | None = None,
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
