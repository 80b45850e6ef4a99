"""The tape: where the marks on a sheet are, with the noise of its reader."""

import tomllib
from collections.abc import Sequence

import numpy as np
from scipy.optimize import linear_sum_assignment
from scipy.spatial.distance import cdist

from plumb._vm import VirtualMachine
from plumb.vm.garage import Garage

Array = np.ndarray
Cut = tuple[int, float, float, float, float]
Target = tuple[float, float]  # [mm] from the sheet's corner, as two forms write it alike
BLANK = "# measured = [ , ]"
DIMPLE = 3.0  # [mm] a plunge that went farther sideways is a line, not a mark


def marks_on(cuts: Sequence[Cut]) -> Array:
    """Return where the bit went deepest at each plunge (n, 2) [mm], in the order of the plunges.

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
        # Where marks are [mm], by target, and by form in the order in which the forms were read.
        self._rounds: list[dict[Target, Array]] = []

    def lay(self, garage: Garage, source: np.random.Generator) -> None:
        """Another sheet, whose readings draw their noise from another source."""
        self._source = source
        self.garage, self._read, self._rounds = garage, 0, []

    def pass_over(self, machine: VirtualMachine) -> None:
        """Leave the marks that were cut so far, so that all are cut again."""
        self._read = len(marks_on(machine.cuts()))

    def fill(self, form: str, machine: VirtualMachine) -> str:
        """Return a form with the marks that were cut since the last form; ValueError if it waits
        for more or fewer.
        """
        places = marks_on(machine.cuts())
        new, self._read = places[self._read :], len(places)
        sheet = self.garage.settings.sheet
        seen = self.garage.read(new)
        read = seen + self._noise * self._source.standard_normal(seen.shape)
        order = order_of(form, read, sheet=sheet)
        first: dict[Target, Array] = {}
        for (_, target), i in zip(_waiting(form), order, strict=True):
            first.setdefault(_as_key(target), seen[i])
        self._rounds.append(first)
        return filled_form(form, read, sheet=sheet)

    def fill_again(self, form: str) -> str:
        """Return a form whose marks are on this sheet already and were read before: each is read
        again.

        A target that was cut in several rounds has a name in each, in their order. Raises
        ValueError for a mark that this tape has not read.
        """
        corner = np.array(self.garage.settings.sheet) / 2
        names: dict[Target, list[str]] = {}
        for name, target in _waiting(form):
            key = _as_key(target)
            here = names.setdefault(key, [])
            if name not in here:
                here.append(name)
            rounds = [first[key] for first in self._rounds if key in first]
            if len(rounds) < len(here):
                raise ValueError(
                    f"the tape has read no mark {name} on this sheet of the virtual machine: "
                    "type what yours says"
                )
            place = rounds[here.index(name)]
            read = place + self._noise * self._source.standard_normal(2)
            x, y = read * (1, -1) + corner
            form = form.replace(BLANK, f"measured = [{x:.1f}, {y:.1f}]", 1)
        return form

    def fill_when_cut(self, form: str, machine: VirtualMachine) -> str | None:
        """Return the same, once the sheet has all the marks of the form and the bit is out
        of it.
        """
        waiting = len(marks_on(machine.cuts())) - self._read
        if waiting < form.count(BLANK) or machine.height <= 0:
            return None
        return self.fill(form, machine)


def filled_form(form: str, readings: Array, *, sheet: tuple[float, float]) -> str:
    """Return the form that `plumb grid` or `plumb next` wrote, with readings (n, 2) [mm from mid
    sheet].

    The form counts from the sheet's top left corner, y down. Each reading goes to the mark that it
    belongs to. Raises ValueError unless there is a reading for each mark.
    """
    for x, y in _from_corner(readings, sheet)[order_of(form, readings, sheet=sheet)]:
        form = form.replace(BLANK, f"measured = [{x:.1f}, {y:.1f}]", 1)
    return form


def order_of(form: str, readings: Array, *, sheet: tuple[float, float]) -> Array:
    """Return which reading belongs to each mark of a form, so that all together lie as near as can
    be.
    """
    targets = np.array([target for _, target in _waiting(form)]).reshape(-1, 2)
    if len(targets) != len(readings):
        raise ValueError(
            f"the form waits for {len(targets)} marks, and the sheet has {len(readings)}"
        )
    _, order = linear_sum_assignment(cdist(targets, _from_corner(readings, sheet)))
    chosen: Array = order
    return chosen


def _from_corner(readings: Array, sheet: tuple[float, float]) -> Array:
    corner: Array = (readings * (1, -1) + (sheet[0] / 2, sheet[1] / 2)).reshape(-1, 2)
    return corner


def _as_key(target: Array) -> Target:
    """Return a target as all forms write it: `plumb grid` to 0.01 mm, `plumb next` to 0.001 mm."""
    return round(float(target[0]), 1) + 0.0, round(float(target[1]), 1) + 0.0


def _waiting(form: str) -> list[tuple[str, Array]]:
    """Return names and targets [mm] of the marks that wait for a reading."""
    marks = tomllib.loads(form).get("mark", [])
    return [(each["name"], np.array(each["target"])) for each in marks if "measured" not in each]
