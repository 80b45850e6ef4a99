"""Practice: a virtual machine with a secret in a folder, and what an answer to it is worth.

The file of the secret holds the number from which a machine is drawn, not what it hides.
"""

import json
import math
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass
from pathlib import Path

from pydantic.dataclasses import dataclass as pydantic_dataclass

from plumb.model.catalogue import empirical_effects
from plumb.model.plain import plainly
from plumb.settings import MachineSettings
from plumb.text.answers import in_json
from plumb.text.errors import InputError, to_do
from plumb.text.files import read_text
from plumb.vm.garage import RANDOM, Garage, described, hide, random_garage, sled_error

SECRET = "practice.json"
LISTED = 1e-5  # to which a machine lists its numbers
MACHINES = 1_000_000  # that can be drawn


@pydantic_dataclass(frozen=True)
class Secret:
    """The seed, size and effects of a machine drawn by `plumb vm --hide`."""

    seed: int
    millimetres: float = 3.0  # RMS by which what is hidden moves marks
    hides: tuple[str, ...] = (RANDOM,)

    @property
    def garage(self) -> Garage:
        """The machine, with what it hides."""
        hidden = hide(self.hides, millimetres=self.millimetres, seed=self.seed)
        return random_garage(hidden, self.seed)

    @property
    def text(self) -> str:
        """The text of its file."""
        return json.dumps(asdict(self)) + "\n"


def secret_in(folder: Path) -> Secret:
    """Read the secret of a folder. Raises InputError if there is none."""
    path = folder / SECRET
    if not path.exists():
        begin = to_do(f"begin: plumb practice start {folder}", page="start a virtual machine")
        raise InputError(folder, "holds no secret", remedy=begin)
    try:
        return Secret(**json.loads(read_text(path)))
    except (ValueError, TypeError):
        raise InputError(path, "is not a secret", remedy="begin in a new folder") from None


@dataclass(frozen=True)
class Score:
    """Hidden effects, and the worth of an answer: errors of the sled all over the sheet [mm]."""

    hidden: str
    named: tuple[str, ...]  # effects that were hidden and claimed
    false: tuple[str, ...]  # claims of what is not there
    missed: tuple[str, ...]  # effects that were hidden and not claimed
    before_mm: float  # RMS of the sled all over the sheet, by the settings as they were
    after_mm: float | None  # by the answer; None where a place is out of its reach

    @in_json
    def sentence(self) -> str:
        """Effects named, missed, and claimed though they are not there."""
        parts = []
        if self.named:
            parts.append(f"You found {plainly(self.named)}.")
        if self.missed:
            parts.append(f"You missed {plainly(self.missed)}.")
        if self.false:
            parts.append(f"You added {plainly(self.false)}, which is not there.")
        return " ".join(parts) or "You added no effect."

    def after(self, shown: Callable[[float], str]) -> str:
        """Return the error by the answer as lengths are shown."""
        return "out of reach" if self.after_mm is None else shown(self.after_mm)


def score(secret: Secret, answer: MachineSettings) -> Score:
    """Compare settings with the machine as it is."""
    garage = secret.garage
    hidden, claims = garage.hidden, claims_of(garage.settings, answer)
    after = sled_error(garage, answer)
    return Score(
        described(hidden),
        tuple(name for name in claims if name in hidden.effects),
        tuple(name for name in claims if name not in hidden.effects),
        tuple(name for name in hidden.effects if name not in claims),
        sled_error(garage, garage.settings),
        after if math.isfinite(after) else None,
    )


def _agree(one: Mapping[str, float], other: Mapping[str, float]) -> bool:
    """Return whether numbers are the same, as far as a machine lists them."""
    return one.keys() == other.keys() and all(
        math.isclose(one[name], other[name], rel_tol=LISTED) for name in one
    )


def claims_of(believed: MachineSettings, answer: MachineSettings) -> tuple[str, ...]:
    """Return the effects whose numbers are not what they were, patches aside."""
    patches = {effect["name"] for effect in empirical_effects()}
    named = [
        name
        for name in (*believed.effects, *answer.effects)
        if name not in patches
        and not _agree(answer.effects.get(name, {}), believed.effects.get(name, {}))
    ]
    return tuple(dict.fromkeys(named))
