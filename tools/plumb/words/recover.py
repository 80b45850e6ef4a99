"""Where is the sled, did a chain slip? Touched holes and home marks in words."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from plumb.job.home import (
    CANNOT_TELL,
    LINK,
    NOTHING,
    OTHER,
    SHEET,
    SLIP,
    HomeFit,
    HomeMark,
    HomeTouch,
    Point,
    SlipAccount,
    SlipFinding,
    lost_sign,
    place_of,
    repair_program,
)
from plumb.settings.machine import MachineSettings
from plumb.text.answers import Internal, in_json, part
from plumb.text.values import Unit
from plumb.words import Kind, Part, Rows, Sentences

KINDS: Mapping[str, Kind] = {
    NOTHING: "good",
    SHEET: "good",
    CANNOT_TELL: "open",
    SLIP: "bad",
    OTHER: "bad",
}
SIDES = ("left", "right")
SHOWN = 4  # accounts
SURE, LEAST = 0.999, 1e-4  # odds beyond which no more digits are said, and that are shown


@dataclass(frozen=True)
class SlipTouch(HomeTouch):
    """A touched mark, its errors and the chains that the machine believes there [mm]."""

    error: list[float]  # of the hole, by the machine's chains
    left: list[float]  # of it after the likeliest account
    chains: list[float]


@dataclass(frozen=True)
class SlipAnswer:
    """Verdict on the chains, and the repair."""

    finding: Internal[SlipFinding]
    written: list[str]
    touch_next: Point | None  # where a hole would tell most
    unit: Internal[Unit]

    verdict = part("finding.verdict", str)
    accounts = part("finding.accounts", tuple[SlipAccount, ...], "The likeliest first.")
    sigma_mm = part("finding.sigma", float)

    @in_json
    def sentence(self) -> str:
        """The verdict in a sentence."""
        best, unit = self.finding.best, self.unit
        if self.verdict == SLIP:
            both = 0 not in best.links
            slipped = "both slipped on their sprockets" if both else "it slipped on its sprocket"
            return f"{_longer(best, unit)}: {slipped}."
        worst = unit.worded(float(np.hypot(*self.finding.errors.T).max()))
        return {
            NOTHING: "No chain slipped: each hole is within "
            f"{worst} of where the machine shows it.",
            SHEET: "No chain slipped: the sheet has moved, or another sheet is on the machine.",
            OTHER: f"No slip and no moved sheet explains errors of up to {worst}: check that each "
            "hole is the hole that you mean, the settings, and whether a motor or a beam has "
            "moved.",
            CANNOT_TELL: f"These touches cannot tell; the likeliest is: {_account(best)}.",
        }[self.verdict]

    @in_json
    def touches(self) -> list[SlipTouch]:
        """The touched marks."""
        found = self.finding
        numbers = (each.tolist() for each in (found.errors, found.left, found.believed))
        return [
            SlipTouch(**vars(touch), error=error, left=left, chains=chains)
            for touch, error, left, chains in zip(found.touches, *numbers, strict=True)
        ]

    @in_json
    def lines(self) -> list[str]:
        """The repair, if there is something to repair."""
        return repair_lines(self.finding)

    @property
    def tables(self) -> list[Part]:
        """Each touch, and what may have happened."""
        unit = self.unit
        touches = [
            [
                touch.name,
                *(_pair(map(unit.bare, place, (1, 1))) for place in (touch.hole, touch.shown)),
                *(_pair(map(unit.signed, error)) for error in (touch.error, touch.left)),
            ]
            for touch in self.touches
        ]
        heads = ["touch", f"hole [{unit.name}]", "shown", "error", "left by the likeliest"]
        likely = [each for each in self.accounts[:SHOWN] if each.odds >= LEAST]
        odds = [[_account(each), _percent(each.odds)] for each in likely]
        return [Rows(heads, touches), Rows(["what may have happened", "odds"], odds)]

    @property
    def to_do(self) -> str:
        """What to do now; empty where nothing is to be done."""
        unit = self.unit
        if self.verdict == SLIP:
            there = self.finding.touches[-1]
            return (
                f"Leave the bit in the hole of touch {there.name}, where the machine shows "
                f"{_place(there.shown, unit)}, and send the line that says how long the chains "
                f"are: {self.lines[-1]}. Then look why the chain could slip: a worn sprocket, a "
                "slack chain, a sled that hung."
            )
        if self.verdict != CANNOT_TELL:
            return ""
        where = "far from these"
        if further := self.touch_next:
            near = _pair(map(unit.bare, further, (0, 0)))
            where = f"near {near}, where the likeliest accounts differ most"
        return f"Touch another hole {where}, and give all touches."


def repair_lines(finding: SlipFinding) -> list[str]:
    """Return the repair, if there is something to repair."""
    if finding.verdict != SLIP:
        return []
    where = f"the hole of touch {finding.touches[-1].name}"
    return repair_program(finding.true_chains, where=where)


def _longer(account: SlipAccount, unit: Unit) -> str:
    """Return which chain is how much longer or shorter."""
    joined = " and ".join(
        f"the {side} chain is {abs(count)} link{'s' if abs(count) > 1 else ''} "
        f"({unit.worded(abs(count) * LINK)}) {'longer' if count > 0 else 'shorter'}"
        for side, count in zip(SIDES, account.links, strict=True)
        if count
    )
    return f"{joined[0].upper()}{joined[1:]} than the machine believes"


def _account(account: SlipAccount) -> str:
    """Return an account in a few words."""
    links = [f"{side} {n:+d}" for side, n in zip(SIDES, account.links, strict=True) if n]
    return {
        NOTHING: "nothing but noise",
        SLIP: f"a slip, links: {', '.join(links)}",
        SHEET: "the sheet has moved",
        OTHER: "something else",
    }[account.kind]


def _percent(odds: float) -> str:
    """Odds for people; what is not quite certain does not look it."""
    return f"{100 * odds:.3g} %" if odds < SURE else f"> {100 * SURE:g} %"


# Home marks.


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


def asked_signs(touches: Sequence[HomeTouch]) -> list[str]:
    """Return a question about each touch that seems to have lost a minus sign."""
    return [
        f"Touch {touch.name}: has {name} lost its sign? The other sign lies near the hole."
        for touch in touches
        if (name := lost_sign(touch))
    ]


def _pair(both: Iterable[str]) -> str:
    return ", ".join(both)


def _place(place: Sequence[float], unit: Unit) -> str:
    return _pair(map(unit.bare, place))


def _chains(mark: HomeMark) -> str:
    """Return both chains as the machine takes them, in mm whatever lengths are shown in."""
    return f"L{mark.chains[0]:.3f} R{mark.chains[1]:.3f}"
