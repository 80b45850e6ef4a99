"""A correction number by number: what each would become, and the fit with those accepted alone."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace

from plumb.cure.add import Addition, Parameter, add
from plumb.fit.inputs import Inputs
from plumb.model.catalogue import parameter_names, place_of
from plumb.settings.machine import FRAME_FIELDS


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
    """Whether a setting of the machine holds a number; sheets, tapes and zeros have none."""
    effect, _, _ = name.rpartition(".")
    if not effect:
        return name in FRAME_FIELDS
    return bool(parameter_names(effect)) and place_of(effect) == "firmware"


def correct(inputs: Inputs, effects: Sequence[str], accepted: Collection[str]) -> Correction:
    """Fit frame and effects; then again with every number that is not accepted held as it is.

    Raises InputError as add() does.
    """
    whole = add(inputs, effects=effects)
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
    """Whether an effect has an accepted number, or belongs to no setting and is fitted anyhow."""
    names = parameter_names(effect)
    return any(name in free for name in names) or not any(map(has_setting, names))
