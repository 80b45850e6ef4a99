"""Home marks in words: what is kept, how a lost position comes back, and whether another fits."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from plumb.job.home import HomeFit, HomeMark, Point, place_of
from plumb.settings import MachineSettings
from plumb.text.answers import Internal, in_json
from plumb.text.values import Unit
from plumb.words import Part, Rows, Sentences


@dataclass(frozen=True)
class ShownMark:
    """A home mark, and where the machine shows the bit in it today [mm]."""

    name: str
    place: list[float]
    kept_place: Point  # where the machine was when it made the hole
    chains: Point
    date: str


@dataclass
class HomeAnswer:
    """Answer of the command, and the files it writes."""

    settings: Internal[MachineSettings]
    kept: Internal[dict[str, HomeMark]]
    unit: Internal[Unit]
    new: Internal[HomeMark | None] = None
    used: Internal[HomeMark | None] = None  # to restore the place
    lines: list[str] = field(default_factory=list)
    fits: list[HomeFit] = field(default_factory=list)
    written: list[str] = field(default_factory=list)

    @in_json
    def marks(self) -> list[ShownMark]:
        """All home marks."""
        shown = ((each, place_of(self.settings, each).tolist()) for each in self.kept.values())
        return [ShownMark(each.name, at, each.place, each.chains, each.date) for each, at in shown]

    @property
    def said(self) -> list[str]:
        """What to do with the mark that is new or used; nothing for a list of them."""
        if mark := self.new:
            return [
                f"Home mark {mark.name} is kept at {_place(mark.place, self.unit)}, with the "
                f"chains {_chains(mark)}.",
                "Make the hole with the program, in what cannot move: the frame, or a board on it. "
                "A hole in a sheet serves until the sheet is moved.",
            ]
        if mark := self.used:
            shown = _place(place_of(self.settings, mark).tolist(), self.unit)
            return [
                f"With the bit in home mark {mark.name}, the chains are {_chains(mark)}.",
                f"Put the bit into it, send {self.lines[-1]}, and the machine shows {shown}.",
            ]
        return []


def fit_sentence(fit: HomeFit, unit: Unit) -> str:
    """Return how well another home mark fits."""
    error = f"{_pair(map(unit.signed, fit.error))} {unit.name}"
    if fit.fits:
        return (
            f"Home mark {fit.name} fits: its hole is {error} from where the machine shows it, and "
            f"two touches by hand differ by up to {unit.worded(fit.limit)}."
        )
    left, right = fit.chains
    return (
        f"Home mark {fit.name} does not fit: its hole is {error} from where the machine shows it, "
        f"more than the {unit.worded(fit.limit)} of two touches by hand. Its chains are "
        f"{unit.signed(left)} (left) and {unit.signed(right)} {unit.name} (right) longer than the "
        "machine believes. Check that the bit was in the right holes, and that neither hole has "
        "moved."
    )


def home_marks(marks: Sequence[HomeMark], unit: Unit) -> Part:
    """Return all home marks, or that there is none."""
    if not marks:
        return Sentences(["There is no home mark yet."], "")
    rows = [[mark.name, _place(mark.place, unit), _chains(mark)] for mark in marks]
    return Rows(["home mark", f"place [{unit.name}]", "chains [mm]"], rows, words=[1, 2])


def _pair(both: Iterable[str]) -> str:
    return ", ".join(both)


def _place(place: Sequence[float], unit: Unit) -> str:
    return _pair(map(unit.bare, place))


def _chains(mark: HomeMark) -> str:
    """Return both chains as the machine takes them, in mm whatever lengths are shown in."""
    return f"L{mark.chains[0]:.3f} R{mark.chains[1]:.3f}"
