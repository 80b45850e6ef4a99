"""What the owner knows of the machine, as the fit takes it: errors stated, numbers measured."""

from __future__ import annotations

import math
from dataclasses import dataclass

from plumb.cure.add import priors_with
from plumb.diagnosis import Checked
from plumb.fit.expected import WIDE, is_absurd
from plumb.lab.choices import Choices
from plumb.settings.machine import MachineSettings


@dataclass(frozen=True)
class Statements:
    """What the owner states."""

    priors: dict[str, float]
    checked: tuple[Checked, ...]


def stated(choices: Choices) -> Statements:
    """What the owner states, in the terms of the fit."""
    known = {name: number for name, number in choices.known.items() if number.sigma > 0}
    wide = [(name, WIDE[name]) for name in known if name in WIDE]
    checked = tuple(Checked(name, number.value, number.sigma) for name, number in known.items())
    return Statements(priors_with(wide), checked)


def possible(choices: Choices, settings: MachineSettings) -> Choices:
    """The choices without numbers that cannot have been measured on this machine."""
    absurd = {check.name for check in stated(choices).checked if is_absurd(check, settings)}
    known = {name: number for name, number in choices.known.items() if name not in absurd}
    return choices.model_copy(update={"known": known})


def planned_priors(choices: Choices) -> dict[str, float]:
    """How far numbers of the frame that a fit moves may be off, with what is known of them."""
    known = stated(choices)
    narrow = {
        check.name: 1 / math.hypot(1 / check.sigma, 1 / known.priors[check.name])
        for check in known.checked
        if check.name in known.priors
    }
    return {**known.priors, **narrow}


def measured_to(choices: Choices) -> dict[str, float]:
    """How far each number may be off that the owner measured."""
    return {name: number.sigma for name, number in choices.known.items() if number.sigma > 0}
