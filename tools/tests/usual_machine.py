"""A virtual machine without errors for tests, and how any is switched on."""

import numpy as np
from plumb.hidden import MAKER
from plumb.line.sender import Sender
from plumb.model.predict import judged, lengths
from plumb.vm.garage import InProcessPort, VirtualMachine, set_up


def usual_machine(**how) -> VirtualMachine:
    """A machine as its maker believes it, the bit in the middle of the sheet."""
    chains, _ = lengths(MAKER, np.zeros((1, 2)))
    return VirtualMachine(judged(MAKER), paid_out=float(chains[0, 0]), **how)


def switched_on(machine, settings=None, **how) -> Sender:
    """Power on; the numbers of these settings, if any, go to the machine."""
    port = InProcessPort(machine)
    if settings:
        set_up(port, settings)
        return Sender(port, **how)
    machine.start()
    sender = Sender(port, **how)
    sender.await_start()
    return sender


def declaration(machine) -> str:
    """The line that tells the machine which chains it has paid out."""
    left, right = machine.chains
    return f"B06 L{left:.4f} R{right:.4f}"
