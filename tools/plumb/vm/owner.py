"""The owner of a virtual machine: cuts marks, reads them with a tape, sends new numbers.

The owner knows what an owner can know: the settings, the sheet's edges and the tape. What is true
of the machine is the garage's.
"""

from __future__ import annotations

import time
from collections.abc import Sequence

import numpy as np

from plumb._vm import VirtualMachine
from plumb.bench.causes import CHAIN
from plumb.diagnosis import Checked
from plumb.firmware.client_files import gcode
from plumb.firmware.settings import CLIENT_NUMBERS, firmware_numbers
from plumb.line.sender import Sender
from plumb.model.lab_effects import LAB_EFFECTS
from plumb.plan.case import PlannedCheck
from plumb.settings.machine import MachineSettings
from plumb.vm.garage import EXTENDED, Garage, with_new_sheet
from plumb.vm.tape import Tape

# The number by which the lab knows friction: of the effect that drags a sled.
FRICTION_NAME = next(each.parameter for each in LAB_EFFECTS if each.hidden_as == "drag")


class VirtualOwner:
    """Somebody with a garage, a machine and a tape."""

    def __init__(self, garage: Garage, *, noise: float = 0.4) -> None:
        """noise [mm] of the tape."""
        self.garage = garage
        self.settings = garage.settings
        self._sheets = 1  # that lay on this machine so far
        self.machine: VirtualMachine = garage.machine()
        self._source = np.random.default_rng([garage.seed, 5])
        self.tape = Tape(garage, self._source, noise=noise)

    def weigh_down(self, weight: float) -> None:
        """Let as much hang on the sled as gives it that weight [N] by what the owner knows."""
        usual = self.garage.numbers["sled_weight"]
        self.machine.set("sled_weight", usual * weight / self.settings.sled_weight)

    def check(self, checks: Sequence[PlannedCheck]) -> list[Checked]:
        """Return numbers measured directly, each with its error."""
        return [
            Checked(
                check.name,
                true_value(self.garage, check.name)
                + check.sigma * float(self._source.standard_normal()),
                check.sigma,
            )
            for check in checks
        ]

    def lay_next_sheet(self, *, raised: float) -> None:
        """Take the sheet off and lay another on the same stops, the right stop `raised` [mm]; each
        lies a little otherwise than those before."""
        seed = self.garage.seed + self._sheets
        self.garage = with_new_sheet(self.garage, seed, raised=raised)
        self.machine.replace_sheet()
        self.tape.lay(self.garage, np.random.default_rng([seed, 5]))
        self._sheets += 1


def true_value(garage: Garage, name: str) -> float:
    """Return what a perfect measurement of a number of the frame or of an effect would find."""
    if name == "motor_height":
        return garage.motors_above_sheet
    if "." not in name:
        return float(garage.numbers[name])
    hidden = {
        f"{cause.effect}.{parameter}": value
        for cause, size in garage.hidden.causes
        for parameter, value in cause.sizes(size).items()
    }
    always = garage.friction if name == FRICTION_NAME else 0.0
    return float(hidden.get(name, CHAIN.get(name, 0.0))) + always


# A line to a virtual machine in the same program: no waiting, its time runs as fast as it can.

MOMENT = 50  # [ms] that pass while somebody listens


class InProcessPort:
    """The serial line of a virtual machine that runs."""

    def __init__(self, machine: VirtualMachine) -> None:
        self.machine = machine

    def write(self, characters: bytes) -> None:
        """Put characters on the line."""
        self.machine.send(characters)

    def read(self) -> bytes:
        """Return what came in a moment of the machine's time."""
        self.machine.advance(MOMENT)
        return self.machine.take_said()

    def seconds(self) -> float:
        """Return the machine's time."""
        return self.machine.seconds

    def close(self) -> None:
        """Do nothing: there is nothing to let go of."""


SETTLING = 10_000  # [ms] until all that was sent is in the EEPROM, and the motors are off


def set_up(port: InProcessPort, settings: MachineSettings) -> None:
    """Power on; the owner's numbers and the lengths of the chains are sent, as on the first day."""
    port.machine.start()
    sender = Sender(port)
    sender.await_start()
    lines = gcode(firmware_numbers(settings)).decode().splitlines()
    client = [f"${number}={value:g}" for number, value in CLIENT_NUMBERS.items()]
    sender.stream([*client, *lines, f"B06 L{EXTENDED:g} R{EXTENDED:g}", "G10 Z0"])
    port.machine.advance(SETTLING)


# A line to a virtual machine in the same program, whose time runs with this computer's.

SLEEP = 0.002  # [s] shorter waits are saved up


class PacedPort(InProcessPort):
    """The serial line of a virtual machine: real time at rest, `speed` times as fast at work."""

    def __init__(self, machine: VirtualMachine, *, speed: float) -> None:
        super().__init__(machine)
        self.speed = speed
        self.works = False
        self._due = time.monotonic()

    def read(self) -> bytes:
        """Return what came in a moment of the machine's time."""
        said = super().read()
        self._due += MOMENT / 1000 / (self.speed if self.works else 1.0)
        now = time.monotonic()
        if self._due - now > SLEEP:
            time.sleep(self._due - now)
        # A computer that is too slow falls behind; it never hurries afterwards.
        self._due = max(self._due, now)
        return said
