"""The tape: where the marks on a sheet are, with the noise of whoever reads it."""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np
from scipy.optimize import linear_sum_assignment
from scipy.spatial.distance import cdist

from plumb._vm import VirtualMachine
from plumb.vm.garage import Garage

Array = np.ndarray
Cut = tuple[int, float, float, float, float]
BLANK = "# measured = [ , ]"
NUMBER = re.compile(r"-?[\d.]+")
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


class Tape:
    """Somebody who reads marks on a garage's sheet."""

    def __init__(self, garage: Garage, source: np.random.Generator, *, noise: float) -> None:
        """noise [mm] of a coordinate."""
        self.garage, self._source, self._noise = garage, source, noise
        self._read = 0  # marks on this sheet that were read already

    def lay(self, garage: Garage) -> None:
        """Another sheet."""
        self.garage, self._read = garage, 0

    def fill(self, form: str, machine: VirtualMachine) -> str:
        """A form with the marks that were cut since the last one; ValueError if it waits for more
        or fewer."""
        places = marks_on(machine.cuts())
        new, self._read = places[self._read :], len(places)
        seen = self.garage.hidden.read(self.garage.on_sheet(new))
        read = seen + self._noise * self._source.standard_normal(seen.shape)
        return filled_form(form, read, sheet=self.garage.settings.sheet)

    def fill_when_cut(self, form: str, machine: VirtualMachine) -> str | None:
        """The same, once the sheet has all the marks of the form and the bit is out of it."""
        waiting = len(marks_on(machine.cuts())) - self._read
        if waiting < form.count(BLANK) or machine.height <= 0:
            return None
        return self.fill(form, machine)


def filled_form(form: str, readings: Array, *, sheet: tuple[float, float]) -> str:
    """The form that `plumb grid` or `plumb next` wrote, with readings (n, 2) [mm from mid sheet].

    The form counts from the sheet's top left corner, y down. Each reading goes to the mark that it
    belongs to, so that all together lie as near as can be. Raises ValueError unless there is a
    reading for each mark.
    """
    targets = _waiting_targets(form)
    if len(targets) != len(readings):
        raise ValueError(
            f"the form waits for {len(targets)} marks, and the sheet has {len(readings)}"
        )
    corner = np.array([sheet[0] / 2, sheet[1] / 2])
    read = (readings * (1, -1) + corner).reshape(-1, 2)
    _, order = linear_sum_assignment(cdist(targets, read))
    for x, y in read[order]:
        form = form.replace(BLANK, f"measured = [{x:.1f}, {y:.1f}]", 1)
    return form


def _waiting_targets(form: str) -> Array:
    """Targets (n, 2) [mm] of the marks that wait for a reading."""
    target, waiting = "", []
    for line in form.splitlines():
        if line.startswith("target = "):
            target = line
        elif line == BLANK:
            waiting.append([float(number) for number in NUMBER.findall(target)])
    return np.array(waiting).reshape(-1, 2)
