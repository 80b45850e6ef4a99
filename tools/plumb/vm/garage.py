"""A machine in its garage: what is true of it, and what its owner believes."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from math import cos, sin

import numpy as np

from plumb._vm import VirtualMachine
from plumb.bench.causes import MAKER, Hidden
from plumb.firmware.client_files import gcode
from plumb.firmware.settings import CLIENT_NUMBERS, firmware_numbers
from plumb.line.sender import Sender
from plumb.model.predict import judged
from plumb.settings.machine import MachineSettings
from plumb.text.errors import InputError
from plumb.vm.hiding import astray

__all__ = ["Garage", "VirtualMachine", "random_garage", "set_up", "with_new_sheet"]

Array = np.ndarray
GAP_SIGMA, POSE_SIGMA, TURN_SIGMA = 3.0, 5.0, 0.002  # [mm, mm, rad] how far a frame is off
STOP_SIGMA = 0.3  # [mm] by which a sheet lies otherwise on the same stops
FRICTION = 3.0  # [N] of any sled on its sheet
SHIELD = 2  # v1.2, as most machines have it
EXTENDED = 1651.0  # [mm] of both chains when they were laid over the sprockets


@dataclass(frozen=True)
class Garage:
    """What is true of a machine and of the sheet on it."""

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

    def machine(self, *, elf: str | None = None, shield: int = SHIELD) -> VirtualMachine:
        """The machine with an empty memory, its chains laid, without power; `shield`: N of v1.N.

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
                over_top=self.settings.feed == "top",
                shield=shield,
            )
        except RuntimeError as error:
            raise InputError(str(error)) from None

    def on_sheet(self, places: Array) -> Array:
        """Places (n, 2) [mm] of the sled as the sheet has them, from its middle."""
        turn = self.sheet_turn
        back = np.array([[cos(turn), sin(turn)], [-sin(turn), cos(turn)]])
        turned: Array = (places - np.array(self.sheet_center)) @ back.T
        return turned

    def read(self, places: Array) -> Array:
        """What a perfect tape reads (n, 2) [mm] of marks that were cut with the sled at places."""
        moved = places + astray(self.hidden, places, self.seed)
        return self.hidden.read(self.on_sheet(moved))


def random_garage(hidden: Hidden, seed: int, *, feed: str = "top") -> Garage:
    """A garage whose frame and sheet lie off by chance; `feed` as in MachineSettings."""
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
    """The same machine with another sheet on the same stops, its right end `raised` [mm]."""
    x, y, turn = np.random.default_rng(seed).standard_normal(3)
    was_x, was_y = garage.sheet_center
    return replace(
        garage,
        sheet_center=(was_x + STOP_SIGMA * x, was_y + STOP_SIGMA * y),
        sheet_turn=garage.sheet_turn + (raised + STOP_SIGMA * turn) / garage.settings.sheet_width,
    )


def set_up(sender: Sender, settings: MachineSettings) -> None:
    """Send the owner's numbers and the lengths of the chains, as on the first day."""
    lines = gcode(firmware_numbers(settings)).decode().splitlines()
    client = [f"${number}={value:g}" for number, value in CLIENT_NUMBERS.items()]
    sender.stream([*client, *lines, f"B06 L{EXTENDED:g} R{EXTENDED:g}", "G10 Z0"])
