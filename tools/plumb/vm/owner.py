"""The owner of a virtual machine: cuts marks, reads them with a tape, sends new numbers.

The owner knows what an owner can know: the settings, the sheet's edges and the tape. What is true
of the machine is the garage's.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence

import numpy as np

from plumb._vm import VirtualMachine
from plumb.bench.causes import CHAIN
from plumb.diagnosis import Checked
from plumb.firmware.client_files import gcode
from plumb.firmware.settings import firmware_numbers
from plumb.grid.options import Grid
from plumb.grid.program import marks_list, program
from plumb.line.sender import Sender
from plumb.model.lab_effects import LAB_EFFECTS
from plumb.model.reach import plain_machine
from plumb.plan.case import PlannedCheck
from plumb.plan.planned_visits import Visits, marks_file, visit_lines
from plumb.settings.machine import MachineSettings
from plumb.vm.garage import Garage, set_up, with_new_sheet
from plumb.vm.tape import Tape

# The number by which the lab knows friction: of the effect that drags a sled.
FRICTION_NAME = next(each.parameter for each in LAB_EFFECTS if each.hidden_as == "drag")


class VirtualOwner:
    """Somebody with a garage, a machine and a tape."""

    def __init__(
        self,
        garage: Garage,
        *,
        noise: float = 0.4,
        slip: float = 0.0,
        elf: str | None = None,
    ) -> None:
        """noise [mm] of the tape; slip [mm] by which it reads one mark of the first sheet wrongly;
        elf: the flashed program, else the firmware for the host."""
        self.garage = garage
        self._elf = elf
        self.settings = garage.settings
        self._sheets = 1  # that lay on this machine so far
        self.machine: VirtualMachine = garage.machine(elf=elf)
        self.sender = Sender(InProcessPort(self.machine))
        self._source = np.random.default_rng([garage.seed, 5])
        self.tape = Tape(garage, self._source, noise=noise, slip=slip)

    def switch_on(self) -> None:
        """Power on; the owner's numbers go to the machine and the chains are declared."""
        self.machine.start()
        self.sender.await_start()
        set_up(self.sender, self.settings)

    def restart(self) -> None:
        """Lay the chains over the sprockets again, as on the first day; the sheet stays."""
        self.machine.stop()
        self.machine = self.garage.machine(elf=self._elf)
        self.sender = Sender(InProcessPort(self.machine))
        self.tape.begin()
        self.switch_on()

    def grid_program(self, grid: Grid) -> tuple[list[str], str]:
        """Return the G-code of a grid for this sheet, and the form for its marks."""
        machine = plain_machine(self.settings)
        return program(grid, machine).splitlines(), marks_list(grid, machine)

    def cut_grid(self, grid: Grid, *, answered: Callable[[int], None] | None = None) -> str:
        """Cut a grid and read it: the filled form."""
        lines, form = self.grid_program(grid)
        self.sender.stream(lines, answered=answered)
        return self.tape.fill(form, self.machine)

    def carry_out(self, visits: Visits) -> str:
        """Cut what `plumb next` proposes on the same sheet and read it: the filled form."""
        for lines, weight in zip(visit_lines(visits), visits.sled_weights, strict=True):
            self.weigh_down(weight)
            self.sender.stream([*lines, "G4 P1"])
        self.weigh_down(self.settings.sled_weight)
        form = marks_file(visits, sheet=self.settings.sheet, controller="plumb", said=())
        return self.tape.fill(form, self.machine)

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

    def send(self, settings: MachineSettings) -> None:
        """Send the numbers of a fitted machine; from now on it computes with them."""
        self.sender.stream(gcode(firmware_numbers(settings)).decode().splitlines())
        self.settings = settings

    def lay_new_sheet(self, seed: int, *, raised: float) -> None:
        """Take the sheet off and lay another on the same stops, the right sheet `raised` [mm]."""
        self.garage = with_new_sheet(self.garage, seed, raised=raised)
        self.machine.replace_sheet()
        self.tape.lay(self.garage, np.random.default_rng([seed, 5]))
        self._sheets += 1

    def lay_next_sheet(self, *, raised: float) -> None:
        """Lay the next sheet; each lies a little otherwise than those before."""
        self.lay_new_sheet(self.garage.seed + self._sheets, raised=raised)


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
