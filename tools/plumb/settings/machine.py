"""The settings of a machine: its frame, its effects, and what only published formulas need.

Lengths in mm, forces in N, in the machine frame (origin in the middle of the sheet, y up).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, NamedTuple, TypedDict

from plumb.settings.published import (
    ELASTICITY,
    TUNED,
    effects_said_by,
    present,
    usual_effects,
)
from plumb.text.errors import InputError

if TYPE_CHECKING:
    from plumb.settings.fit_record import FitRecord

GRAVITY = 9.81  # [N/kg]
SLED_WEIGHT = 97.9  # [N] 22 pounds, the published default
CHAIN_WEIGHT = 0.00137293  # [N/mm] 0.14 kg/m, the published data of #25 chain
HOLEY_CHAIN_WEIGHT = 0.001372  # [N/mm] as the catenary release rounds it
SPROCKET_RADIUS = 10 * 6.35 / (2 * math.pi)  # [mm] ten teeth of 6.35 mm
FEEDS = ("top", "bottom")


class Frame(TypedDict):
    """The seven numbers that every machine has [mm, N]; docs/words.md says what each is."""

    motor_gap: float
    motor_height: float
    motor_center_x: float
    rotation_radius: float
    sprocket_radius: float
    sled_weight: float
    chain_weight: float


FRAME_FIELDS = tuple(Frame.__annotations__)


@dataclass(frozen=True)
class PublishedSettings:
    """What only the formulas of the published firmware need, in its units."""

    chain_sag_correction: float = 0.0  # $37 [1e-12/mm^2]
    left_tolerance: float = 0.0  # $40 [percent] positive: the chain is longer than nominal
    right_tolerance: float = 0.0  # $41 [percent]
    chain_elasticity: float | None = None  # $45 [1/N]; None: not in the file
    holey_sled_weight: float | None = None  # $46 [N]; zero or less switches the catenary off
    chain_length: float = 3360.0  # $10 [mm] bound of its search for the position
    top_beam_tilt: float = 0.0  # [degrees] read, but used neither by stock nor by holey

    @property
    def catenary(self) -> tuple[float, float] | None:
        """Sled weight [N] and chain elasticity [1/N] of the catenary release; None: switched off.

        Raises InputError if the file did not say them: its firmware and its client differ in
        their defaults, so guessing would shift the marks by millimetres.
        """
        if self.holey_sled_weight is not None and self.holey_sled_weight <= 0:
            return None
        if self.holey_sled_weight is None or self.chain_elasticity is None:
            name, unit = (
                ("sledWeight", "$46, N")
                if self.holey_sled_weight is None
                else ("chainElasticity", "$45, 1/N")
            )
            raise InputError(
                f"settings for controller holey: {name} ({unit}) is missing; add it to the "
                "settings as the machine reports it"
            )
        return self.holey_sled_weight, self.chain_elasticity


class SettingsFile(NamedTuple):
    """The file that settings were read from."""

    name: str
    sha256: str


@dataclass(frozen=True)
class MachineSettings:
    """A machine: frame [mm, N], effects by name, and whose formula the controller uses."""

    motor_gap: float  # [mm] between sprocket centres
    motor_height: float  # [mm] sprocket centres above the middle of the sheet
    rotation_radius: float  # [mm] from the bit to where the chain ends
    sheet_width: float  # [mm]
    sheet_height: float  # [mm]
    feed: str  # "top": the chain leaves over the sprocket; "bottom": under it
    motor_center_x: float = 0.0  # [mm] middle between the sprockets, right of the sheet's middle
    sprocket_radius: float = SPROCKET_RADIUS  # [mm]
    sled_weight: float = SLED_WEIGHT  # [N]
    chain_weight: float = CHAIN_WEIGHT  # [N/mm]
    controller: str = "plumb"  # "stock", "holey" or "plumb"
    effects: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    published: PublishedSettings = PublishedSettings()
    # How the numbers came about; no part of the machine.
    file: SettingsFile | None = field(default=None, compare=False, repr=False)
    fitted: FitRecord | None = field(default=None, compare=False, repr=False)

    @property
    def sheet(self) -> tuple[float, float]:
        """Width and height of the sheet [mm]."""
        return self.sheet_width, self.sheet_height

    @property
    def motor_offset(self) -> float:
        """Sprocket centres above the sheet's top edge [mm], as the published programs count."""
        return self.motor_height - self.sheet_height / 2

    @property
    def frame(self) -> dict[str, float]:
        """The seven numbers of the frame by name [mm, N]."""
        return {name: getattr(self, name) for name in FRAME_FIELDS}

    def effect(self, name: str, parameter: str) -> float:
        """A parameter of an effect; an effect that is not named is absent, so zero."""
        return self.effects.get(name, {}).get(parameter, 0.0)

    def as_plumb_model(self, *, controller: str | None = None) -> MachineSettings:
        """The machine on which the controller would be right, in our frame and effects;
        effects that are named already stay as they are."""
        whose = controller or self.controller
        if whose == "plumb":
            return self if self.controller == "plumb" else replace(self, controller="plumb")
        published = self.published
        numbers = {number: getattr(published, name) for number, name in TUNED.items()}
        sled_weight, chain_weight = self.sled_weight, self.chain_weight
        catenary = published.catenary if whose == "holey" else None
        derived = effects_said_by(numbers)
        if catenary:
            sled_weight, chain_weight = catenary[0], HOLEY_CHAIN_WEIGHT
            frame = {**self.frame, "sled_weight": sled_weight, "chain_weight": chain_weight}
            derived |= usual_effects(frame) | effects_said_by({ELASTICITY: catenary[1]})
        left, right = published.left_tolerance / 100, published.right_tolerance / 100
        return replace(
            self,
            controller="plumb",
            sled_weight=sled_weight,
            chain_weight=chain_weight,
            rotation_radius=self.rotation_radius / radius_in_published(left, right),
            effects={**present(derived), **self.effects},
            published=PublishedSettings(),
        )


def frame_of(values: Mapping[str, float]) -> Frame:
    """The frame among numbers by name; what else there is does not matter."""
    return Frame(
        motor_gap=values["motor_gap"],
        motor_height=values["motor_height"],
        motor_center_x=values["motor_center_x"],
        rotation_radius=values["rotation_radius"],
        sprocket_radius=values["sprocket_radius"],
        sled_weight=values["sled_weight"],
        chain_weight=values["chain_weight"],
    )


def radius_in_published(left: float, right: float) -> float:
    """The published rotation radius over the true radius, for two chain pitch strains.

    The published formula divides the whole straight part L by (1 + e), although its last piece, the
    radius R, is no chain: L/(1+e) - R' equals (L-R)/(1+e) if R' = R/(1+e). Both sides
    share a single R', so the mean remains; each is off by half of R times the strains' difference.
    """
    return (1 / (1 + left) + 1 / (1 + right)) / 2
