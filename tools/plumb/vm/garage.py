"""A machine in its garage: what is true of it, and what its owner believes."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from math import cos, sin

import numpy as np

from plumb._vm import VirtualMachine as VirtualMachine
from plumb.bench import judge
from plumb.bench.boards import plan, size_for
from plumb.bench.causes import MAKER, SLED, Cause, Hidden, causes_of
from plumb.bench.hiding import REAL
from plumb.bench.judged_board import shape_error
from plumb.model.predict import judged
from plumb.settings.machine import MachineSettings
from plumb.text.errors import InputError, to_do
from plumb.text.values import refuse_unknown

Array = np.ndarray
GAP_SIGMA, POSE_SIGMA, TURN_SIGMA = 3.0, 5.0, 0.002  # [mm, mm, rad] how far a frame is off
STOP_SIGMA = 0.3  # [mm] by which a sheet lies otherwise on the same stops
FRICTION = 3.0  # [N] of any sled on its sheet
SHIELD = 2  # v1.2, as most machines have it
EXTENDED = 1651.0  # [mm] of both chains when they were laid over the sprockets


@dataclass(frozen=True)
class Garage:
    """Truth of a machine and of the sheet on it."""

    hidden: Hidden
    motor_gap: float = MAKER.motor_gap  # [mm]
    motor_height: float = MAKER.motor_height  # [mm]
    sheet_center: tuple[float, float] = (0.0, 0.0)  # [mm] of the sheet from where it should lie
    sheet_turn: float = 0.0  # [rad] counter-clockwise
    friction: float = FRICTION  # [N]
    seed: int = 0  # of the motors
    settings: MachineSettings = field(default_factory=lambda: MAKER)  # what the owner believes

    @property
    def numbers(self) -> dict[str, float]:
        """The judge's numbers of the machine."""
        true = {"motor_gap": self.motor_gap, "motor_height": self.motor_height}
        maker = replace(MAKER, feed=self.settings.feed)
        return {**judged(maker), **true, **self.hidden.numbers}

    @property
    def motors_above_sheet(self) -> float:
        """[mm] Height of the motors over the middle of the sheet as it lies."""
        middle = np.array([[0.0, self.numbers["motor_height"]]])
        return float(self.on_sheet(middle)[0, 1])

    def machine(
        self, *, elf: str | None = None, bootloader: bytes = b"", shield: int = SHIELD
    ) -> VirtualMachine:
        """Return the machine with an empty memory, its chains laid, without power; `bootloader`:
        the bytes of what a simulated Mega starts first; `shield`: N of v1.N.

        InputError where the simulated Mega cannot run `elf`, or was not there when the lab was
        built.
        """
        try:
            return VirtualMachine(
                self.numbers,
                friction=self.friction + self.hidden.drag,
                seed=self.seed,
                paid_out=EXTENDED,
                elf=elf,
                bootloader=bootloader,
                over_top=self.settings.feed == "top",
                shield=shield,
            )
        except RuntimeError as error:
            raise InputError(str(error)) from None

    def on_sheet(self, places: Array) -> Array:
        """Return places (n, 2) [mm] of the sled as the sheet has them, from its middle."""
        turn = self.sheet_turn
        back = np.array([[cos(turn), sin(turn)], [-sin(turn), cos(turn)]])
        turned: Array = (places - np.array(self.sheet_center)) @ back.T
        return turned

    def read(self, places: Array) -> Array:
        """Return what a perfect tape reads (n, 2) [mm] of marks that were cut with the sled at
        places.
        """
        moved = places + astray(self.hidden, places, self.seed)
        return self.hidden.read(self.on_sheet(moved))


def random_garage(hidden: Hidden, seed: int, *, feed: str = "top") -> Garage:
    """Return a garage whose frame and sheet lie off by chance; `feed` as in MachineSettings."""
    source = np.random.default_rng(seed)
    gap, height, x, y, turn = source.standard_normal(5)
    return Garage(
        hidden,
        motor_gap=MAKER.motor_gap + GAP_SIGMA * gap,
        motor_height=MAKER.motor_height + POSE_SIGMA * height,
        sheet_center=(POSE_SIGMA * x, POSE_SIGMA * y),
        sheet_turn=TURN_SIGMA * turn,
        seed=1 + seed,
        settings=replace(MAKER, feed=feed),
    )


def with_new_sheet(garage: Garage, seed: int, *, raised: float = 0.0) -> Garage:
    """Return the same machine with another sheet on the same stops, its right end `raised` [mm]."""
    x, y, turn = np.random.default_rng(seed).standard_normal(3)
    was_x, was_y = garage.sheet_center
    return replace(
        garage,
        sheet_center=(was_x + STOP_SIGMA * x, was_y + STOP_SIGMA * y),
        sheet_turn=garage.sheet_turn + (raised + STOP_SIGMA * turn) / garage.settings.sheet_width,
    )


# What is hidden in a virtual machine: effects by name, or one that is drawn.

RANDOM = "random"
BOARD = plan(5, 5)  # on which an effect moves marks by this many millimetres RMS


def hide(names: Sequence[str], *, millimetres: float, seed: int) -> Hidden:
    """Effects that move marks by so much RMS each, before a frame is refitted.

    The name `random` draws one that real machines have. Raises InputError for an unknown name.
    """
    known = sorted({cause.effect for cause in REAL})
    try:
        refuse_unknown([name for name in names if name != RANDOM], known)
    except ValueError as error:
        raise InputError(to_do("--hide", page="hidden:") + f" {error}") from None
    source = np.random.default_rng([seed, 11])
    causes = [_drawn(source) if name == RANDOM else _one_of(name, source) for name in names]
    return Hidden(tuple((cause, size_for(cause, BOARD, millimetres)) for cause in causes))


def astray(hidden: Hidden, places: Array, seed: int) -> Array:
    """Return how far (n, 2) [mm] the sled is off at places by what the library has no word for."""
    field = hidden.field(BOARD.targets, np.random.default_rng([seed, 13]))
    return field(places) if field else np.zeros_like(places)


def described(hidden: Hidden) -> str:
    """Return what is hidden, in a few words."""
    said = [f"{cause.effect} ({cause.label})" for cause, _ in hidden.causes]
    said += [f"a {hidden.outside}, which no effect explains"] if hidden.outside else []
    return " and ".join(said) or "nothing"


def _drawn(source: np.random.Generator) -> Cause:
    """Return one that the firmware can correct; a wrong tape would stay wrong on the next sheet."""
    effects = sorted({cause.effect for cause in REAL if not (cause.skew or cause.strain)})
    return _one_of(effects[source.integers(len(effects))], source)


def _one_of(effect: str, source: np.random.Generator) -> Cause:
    """Return one of the directions that an effect has."""
    several = [cause for cause in causes_of(effect) if cause in REAL]
    return several[source.integers(len(several))]


# What settings leave at the sled all over the sheet.


def sled_error(garage: Garage, settings: MachineSettings) -> float:
    """Return the error of a garage's machine with these settings. Nothing rubs: no setting knows of
    it.
    """
    weight = garage.numbers.get("sled_weight", SLED)

    def landed(chains: Array) -> Array:
        weights = np.full(len(chains), weight)
        still = np.zeros_like(chains)
        return garage.read(judge.places(garage.numbers, chains, pushes=still, weights=weights))

    return shape_error(settings, landed)
