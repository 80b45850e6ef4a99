"""A machine at a serial port, as a board is: its sheet, and its cable that can be pulled."""

import threading

from plumb.vm.garage import InProcessPort, VirtualOwner, hide, marks_on, random_garage, set_up
from plumb.vm.pseudo_terminal import PseudoTerminal
from plumb.vm.served_port import Pace

SPEED = 200  # times as fast as a real machine
RESTS_MS = 30_000  # in which a machine goes on, if it has its lines


class Garage:
    """The machine at its port, and its sheet."""

    def __init__(self, speed=SPEED, *, at_rest=1):
        self.owner = VirtualOwner(random_garage(hide([], millimetres=3, seed=1), 1))
        set_up(InProcessPort(self.owner.machine), self.owner.settings)
        self._mine = threading.Lock()
        # To hurry at rest costs a whole processor.
        self._at_rest = at_rest
        self.plug_in(speed)

    def plug_in(self, speed=SPEED):
        """A cable to the machine; its port may have another name than before."""
        self._terminal = PseudoTerminal(self.owner.machine)
        self.run_at(speed)
        self._is_pulled = threading.Event()
        self._clock = threading.Thread(target=self._run)
        self._clock.start()

    def run_at(self, speed):
        """Let it run this many times as fast as a real machine while it moves."""
        self._speed, self._pace = speed, Pace(speed)

    @property
    def path(self):
        return self._terminal.path

    def _run(self):
        while not self._is_pulled.is_set():
            with self._mine:
                before = self._place
                self._terminal.pass_time(self._pace.due())
            self._pace.speed = self._speed if self._place != before else self._at_rest
        self._terminal.close()

    @property
    def _place(self):
        machine = self.owner.machine
        return *(round(length, 3) for length in machine.chains), round(machine.height, 3)

    @property
    def lengths(self):
        """Tape readings of both chains, and of the bit's height [mm]."""
        with self._mine:
            return *self.owner.machine.chains, self.owner.machine.height

    @property
    def marks(self):
        """How many are on the sheet."""
        with self._mine:
            return len(marks_on(self.owner.machine.cuts()))

    def marks_at_rest(self):
        """How many there are when the machine has done all that it was sent."""
        before = None
        while self._place != before:
            before = self._place
            with self._mine:
                self._terminal.pass_time(RESTS_MS)
        return self.marks

    def pull_out(self):
        self._is_pulled.set()
        self._clock.join()
