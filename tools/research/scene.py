"""A machine on its stage, the client at its line, and what a fault can get hold of."""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import cache

import numpy as np
from plumb.bench.causes import Hidden
from plumb.line.sender import RefusedError, Sender
from plumb.text.errors import InputError
from plumb.vm.garage import SHIELD, Garage, VirtualMachine, set_up
from strike import LineLostError, Strike, Wire

Array = np.ndarray
AXES = ("left", "right", "z")
EVENING = 10_000  # [ms] until all is in the EEPROM
ANSWER, START = 1500, 3500  # [ms] in which a machine has said what it has to say
LONGEST = 60_000  # [ms] that a machine may take until it stands
PATIENCE = 150.0  # [s] until the operator presses Stop, because the job does not end
STANDS = 1e-4  # [mm] in a tenth of a second
# With these words the machine says that it does not know its place.
LOST = re.compile("Position Lost|not known")
SETTING = re.compile(r"^\$(\d+)=(\S+)", re.MULTILINE)


class Scene:
    """A machine whose sled is at rest, and the client that sends it a job."""

    def __init__(
        self, seed: int, *, elf: str | None = None, friction: float = 0.0, shield: int = SHIELD
    ) -> None:
        """friction [N] of the sled on the sheet."""
        self.seed = seed
        self.source = np.random.default_rng([seed, 17])
        garage = garage_of(1 + seed, friction=friction)
        self.machine: VirtualMachine = garage.machine(elf=elf, shield=shield)
        self.machine.eeprom = memory_of_the_evening()
        self.machine.start()
        self.axis = AXES[self.source.integers(2)]
        self.heard = list[str]()
        self.wire = Wire(self.machine)
        self.sender = Sender(self.wire, said=self.heard.append)
        self.sender.await_start()

    def cut_power(self) -> None:
        """At any moment, also in the middle of a byte of the EEPROM."""
        self.machine.cut_power(int(self.source.integers(256)))

    def give_up(self) -> None:
        """Stop sending the client's job."""
        self.wire.patience = 0.0

    def send(self, lines: Sequence[str], strike: Strike | None = None) -> bool:
        """Send a job as far as the machine lets it; whether it went to its end."""
        self.wire.strike = strike
        self.wire.patience = self.machine.seconds + PATIENCE
        try:
            self.sender.stream(lines)
            self.sender.await_rest()
        except RefusedError as error:
            self.heard.append(str(error))
        except (InputError, LineLostError):
            pass
        else:
            return True
        finally:
            self.wire.patience = float("inf")
        return False

    def settle(self) -> None:
        """Let time pass until the sled stands and no motor is driven."""
        for _ in range(LONGEST // 100):
            before = self.machine.sled
            self.listen(100)
            driven = any(self.machine.duty(axis) for axis in AXES)
            if not driven and np.hypot(*np.subtract(before, self.machine.sled)) < STANDS:
                return

    def listen(self, milliseconds: int) -> list[str]:
        """Return what the machine says meanwhile that is no report and no answer."""
        since = len(self.heard)
        for _ in range(milliseconds // 20):
            try:
                self.sender.listen()
            except LineLostError:
                continue
        return self.heard[since:]

    def is_sure_when_stopped(self) -> bool:
        """Return whether the machine, asked to stop, says nothing against its place."""
        if not self.machine.is_running:
            return False
        self.machine.send(b"!\n")
        return not any(LOST.search(line) for line in self.listen(ANSWER))

    def is_sure_after_restart(self) -> bool:
        """Return the same when the power goes at rest, and comes again."""
        self.machine.stop()
        self.sender = Sender(self.wire, said=self.heard.append)
        self.machine.start()
        return not any(LOST.search(line) for line in self.listen(START))

    def astray(self) -> float:
        """[mm] from where the machine says that its bit is to where it is, z included."""
        status = self.sender.status
        if status is None:
            raise RuntimeError("the machine has not reported yet")
        true = (*self.machine.sled, self.machine.height)
        return float(np.max(np.abs(np.subtract(status.place, true))))

    def settings(self) -> dict[str, str]:
        """Return what the machine answers to `$$`."""
        return dict(SETTING.findall("\n".join(self.sender.ask("$$"))))


def garage_of(seed: int, *, friction: float = 0.0) -> Garage:
    """Return a frame as the settings say, and a sled that does not rub: only the fault is wrong."""
    return Garage(Hidden(), friction=friction, seed=seed)


@cache
def memory_of_the_evening() -> bytes:
    """Return the EEPROM of a machine that knows its settings, and chains that have not
    moved since.
    """
    garage = garage_of(0)
    machine = garage.machine()
    machine.start()
    sender = Sender(Wire(machine))
    sender.await_start()
    set_up(sender, garage.settings)
    machine.advance(EVENING)
    return bytes(machine.eeprom)
