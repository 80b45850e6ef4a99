"""The `plumb` command that does the same as a screen, with every choice that counts there."""

from __future__ import annotations

import shlex
from collections.abc import Collection, Mapping

from plumb.fit.problem import PRIORS
from plumb.lab.choices import Choices
from plumb.lab.known import stated


def command(*words: str) -> str:
    """A command as a shell reads it."""
    return shlex.join(["plumb", *words])


def known_words(
    choices: Choices, *, effects: Collection[str] | None = None, held: Collection[str] = ()
) -> list[str]:
    """What the owner knows, as far as a fit of these effects takes it; None: any effect."""
    known = stated(choices)
    words = []
    for check in known.checked:
        effect = check.name.rpartition(".")[0]
        if (effects is None or not effect or effect in effects) and check.name not in held:
            words += ["--checked", f"{check.name}={check.value:.12g}+-{check.sigma:.12g}"]
    return [*prior_words(known.priors), *words]


def prior_words(priors: Mapping[str, float], usual: Mapping[str, float] = PRIORS) -> list[str]:
    """How far numbers of the frame may be wrong, where it is not as usual."""
    words = []
    for name, sigma in priors.items():
        if usual.get(name) != sigma:
            words += ["--prior", f"{name}={sigma:.12g}"]
    return words


def unit_words(choices: Choices, typed: str = "mm") -> list[str]:
    """The chosen unit, unless the command shows it by itself: the unit in which it was typed."""
    return ["--units", choices.units] if choices.units != typed else []
