"""No real program makes the firmware suspect that a chain slips."""

import pytest
from plumb.firmware.telemetry import telemetry_in
from workshop import NAMES, Workshop, lines_of


@pytest.mark.parametrize("name", NAMES)
def test_no_program_raises_a_suspicion(name):
    workshop = Workshop()
    workshop.cut(lines_of(name))
    telemetry = telemetry_in("\n".join(workshop.sender.ask("B30")))
    assert (telemetry.slips, telemetry.last_slip) == ((0, 0), None)
