"""The tape: where the marks on a sheet are, with the noise of whoever reads it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from plumb._vm import VirtualMachine
from plumb.vm.garage import Garage

Array = np.ndarray
Cut = tuple[int, float, float, float, float]
DIMPLE = 3.0  # [mm] a plunge that went farther sideways is a line, not a mark


def marks_on(cuts: Sequence[Cut]) -> Array:
    """Where the bit went deepest at each plunge (n, 2) [mm], in the order of the plunges.

    Plunges that went on sideways are no marks.
    """
    places = []
    for plunge in dict.fromkeys(cut[0] for cut in cuts):
        rows = np.array([cut[1:] for cut in cuts if cut[0] == plunge])
        if np.ptp(rows[:, 1:3], axis=0).max() < DIMPLE:
            places.append(rows[np.argmax(rows[:, 3]), 1:3])
    return np.array(places).reshape(-1, 2)


def read_with_tape(
    machine: VirtualMachine, garage: Garage, source: np.random.Generator, *, noise: float
) -> Array:
    """All marks on the sheet (n, 2) [mm from its middle] as a tape reads them; noise [mm]."""
    places = garage.hidden.read(garage.on_sheet(marks_on(machine.cuts())))
    read: Array = places + noise * source.standard_normal(places.shape)
    return read


def filled_form(form: str, readings: Array, *, sheet: tuple[float, float]) -> str:
    """The form that `plumb grid` wrote, with readings (n, 2) [mm from mid sheet] in its order.

    The form counts from the sheet's top left corner, y down. Raises ValueError unless there is a
    reading for each mark.
    """
    blanks = form.count(BLANK)
    if blanks != len(readings):
        raise ValueError(f"the form waits for {blanks} marks, and the sheet has {len(readings)}")
    for x, y in readings:
        across, down = sheet[0] / 2 + x, sheet[1] / 2 - y
        form = form.replace(BLANK, f"measured = [{across:.1f}, {down:.1f}]", 1)
    return form


BLANK = "# measured = [ , ]"
