"""A machine in its garage: what is true of it, what its owner believes, and what the tape reads."""

from __future__ import annotations

import time
import tomllib
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from math import cos, sin

import numpy as np
from scipy.optimize import linear_sum_assignment
from scipy.spatial.distance import cdist

from plumb._vm import VirtualMachine as VirtualMachine
from plumb.diagnosis import Checked
from plumb.firmware.settings import CLIENT_NUMBERS, firmware_numbers, gcode
from plumb.grid import BLANK
from plumb.hidden import (
    CHAIN,
    MAKER,
    REAL,
    SLED,
    Cause,
    Hidden,
    causes_of,
    judged_places,
    plan,
    shape_error,
    size_for,
)
from plumb.line.sender import Sender
from plumb.model.catalogue import LAB_EFFECTS
from plumb.model.predict import judged
from plumb.plan.case import PlannedCheck
from plumb.settings import MachineSettings
from plumb.text.errors import InputError, to_do
from plumb.text.values import refuse_unknown

# A machine in its garage: what is true of it, and what its owner believes.


Array = np.ndarray
GAP_SIGMA, POSE_SIGMA, TURN_SIGMA = 3.0, 5.0, 0.002  # [mm, mm, rad] how far a frame is off
STOP_SIGMA = 0.3  # [mm] by which a sheet lies otherwise on the same stops
FRICTION = 3.0  # [N] of any sled on its sheet
SHIELD = 2  # v1.2, as most machines have it
EXTENDED = 1651.0  # [mm] of both chains when they were laid over the sprockets


@dataclass(frozen=True)
class Garage:
    """Truth of a machine and of the sheet on it."""

    hidden: Hidden
    motor_gap: float = MAKER.motor_gap  # [mm]
    motor_height: float = MAKER.motor_height  # [mm]
    sheet_center: tuple[float, float] = (0.0, 0.0)  # [mm] of the sheet from where it should lie
    sheet_turn: float = 0.0  # [rad] counter-clockwise
    friction: float = FRICTION  # [N]
    seed: int = 0  # of the motors
    settings: MachineSettings = field(default_factory=lambda: MAKER)  # what the owner believes

    @property
    def numbers(self) -> dict[str, float]:
        """The judge's numbers of the machine."""
        true = {"motor_gap": self.motor_gap, "motor_height": self.motor_height}
        maker = replace(MAKER, feed=self.settings.feed)
        return {**judged(maker), **true, **self.hidden.numbers}

    def machine(
        self, *, elf: str | None = None, bootloader: bytes = b"", shield: int = SHIELD
    ) -> VirtualMachine:
        """Return the machine with an empty memory, its chains laid, without power; `bootloader`:
        the bytes of what a simulated Mega starts first; `shield`: N of v1.N.

        InputError where the simulated Mega cannot run `elf`, or was not there when the lab was
        built.
        """
        try:
            return VirtualMachine(
                self.numbers,
                friction=self.friction + self.hidden.drag,
                seed=self.seed,
                paid_out=EXTENDED,
                elf=elf,
                bootloader=bootloader,
                over_top=self.settings.feed == "top",
                shield=shield,
            )
        except RuntimeError as error:
            raise InputError(str(error)) from None

    def on_sheet(self, places: Array) -> Array:
        """Return places (n, 2) [mm] of the sled as the sheet has them, from its middle."""
        turn = self.sheet_turn
        back = np.array([[cos(turn), sin(turn)], [-sin(turn), cos(turn)]])
        turned: Array = (places - np.array(self.sheet_center)) @ back.T
        return turned

    def read(self, places: Array) -> Array:
        """Return what a perfect tape reads (n, 2) [mm] of marks that were cut with the sled at
        places.
        """
        moved = places + astray(self.hidden, places, self.seed)
        return self.hidden.read(self.on_sheet(moved))


def random_garage(hidden: Hidden, seed: int, *, feed: str = "top") -> Garage:
    """Return a garage whose frame and sheet lie off by chance; `feed` as in MachineSettings."""
    source = np.random.default_rng(seed)
    gap, height, x, y, turn = source.standard_normal(5)
    return Garage(
        hidden,
        motor_gap=MAKER.motor_gap + GAP_SIGMA * gap,
        motor_height=MAKER.motor_height + POSE_SIGMA * height,
        sheet_center=(POSE_SIGMA * x, POSE_SIGMA * y),
        sheet_turn=TURN_SIGMA * turn,
        seed=1 + seed,
        settings=replace(MAKER, feed=feed),
    )


def with_new_sheet(garage: Garage, seed: int, *, raised: float = 0.0) -> Garage:
    """Return the same machine with another sheet on the same stops, its right end `raised` [mm]."""
    x, y, turn = np.random.default_rng(seed).standard_normal(3)
    was_x, was_y = garage.sheet_center
    return replace(
        garage,
        sheet_center=(was_x + STOP_SIGMA * x, was_y + STOP_SIGMA * y),
        sheet_turn=garage.sheet_turn + (raised + STOP_SIGMA * turn) / garage.settings.sheet_width,
    )


# What is hidden in a virtual machine: effects by name, or one that is drawn.

RANDOM = "random"
BOARD = plan(5, 5)  # on which an effect moves marks by this many millimetres RMS


def hide(names: Sequence[str], *, millimetres: float, seed: int) -> Hidden:
    """Effects that move marks by so much RMS each, before a frame is refitted.

    The name `random` draws one that real machines have. Raises InputError for an unknown name.
    """
    known = sorted({cause.effect for cause in REAL})
    try:
        refuse_unknown([name for name in names if name != RANDOM], known)
    except ValueError as error:
        raise InputError(to_do("--hide", page="hidden:") + f" {error}") from None
    source = np.random.default_rng([seed, 11])
    causes = [_drawn(source) if name == RANDOM else _one_of(name, source) for name in names]
    return Hidden(tuple((cause, size_for(cause, BOARD, millimetres)) for cause in causes))


def astray(hidden: Hidden, places: Array, seed: int) -> Array:
    """Return how far (n, 2) [mm] the sled is off at places by what the library has no word for."""
    field = hidden.field(BOARD.targets, np.random.default_rng([seed, 13]))
    return field(places) if field else np.zeros_like(places)


def described(hidden: Hidden) -> str:
    """Return what is hidden, in a few words."""
    said = [f"{cause.effect} ({cause.label})" for cause, _ in hidden.causes]
    said += [f"a {hidden.outside}, which no effect explains"] if hidden.outside else []
    return " and ".join(said) or "nothing"


def _drawn(source: np.random.Generator) -> Cause:
    """Return one that the firmware can correct; a wrong tape would stay wrong on the next sheet."""
    effects = sorted({cause.effect for cause in REAL if not (cause.skew or cause.strain)})
    return _one_of(effects[source.integers(len(effects))], source)


def _one_of(effect: str, source: np.random.Generator) -> Cause:
    """Return one of the directions that an effect has."""
    several = [cause for cause in causes_of(effect) if cause in REAL]
    return several[source.integers(len(several))]


# What settings leave at the sled all over the sheet.


def sled_error(garage: Garage, settings: MachineSettings) -> float:
    """Return the error of a garage's machine with these settings. Nothing rubs: no setting knows of
    it.
    """
    weight = garage.numbers.get("sled_weight", SLED)

    def landed(chains: Array) -> Array:
        weights = np.full(len(chains), weight)
        still = np.zeros_like(chains)
        return garage.read(judged_places(garage.numbers, chains, pushes=still, weights=weights))

    return shape_error(settings, landed)


# The tape: where the marks on a sheet are, with the noise of its reader.


Cut = tuple[int, float, float, float, float]
Target = tuple[float, float]  # [mm] from the sheet's corner, as two forms write it alike
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


# The owner of a virtual machine: cuts marks, reads them with a tape, sends new numbers.
#
# The owner knows what an owner can know: the settings, the sheet's edges and the tape. What is true
# of the machine is the garage's.


# The number by which the lab knows friction: of the effect that drags a sled.
FRICTION_NAME = next(each.parameter for each in LAB_EFFECTS if each.hidden_as == "drag")


class VirtualOwner:
    """Somebody with a garage, a machine and a tape."""

    def __init__(self, garage: Garage, *, noise: float = 0.4) -> None:
        """noise [mm] of the tape."""
        self.garage = garage
        self.settings = garage.settings
        self._sheets = 1  # that lay on this machine so far
        self.machine: VirtualMachine = garage.machine()
        self._source = np.random.default_rng([garage.seed, 5])
        self.tape = Tape(garage, self._source, noise=noise)

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

    def lay_next_sheet(self, *, raised: float) -> None:
        """Take the sheet off and lay another on the same stops, the right stop `raised` [mm]; each
        lies a little otherwise than those before."""
        seed = self.garage.seed + self._sheets
        self.garage = with_new_sheet(self.garage, seed, raised=raised)
        self.machine.replace_sheet()
        self.tape.lay(self.garage, np.random.default_rng([seed, 5]))
        self._sheets += 1


def true_value(garage: Garage, name: str) -> float:
    """Return what a perfect measurement of a number of the frame or of an effect would find."""
    if name == "motor_height":
        # Over the middle of the sheet as it lies.
        return float(garage.on_sheet(np.array([[0.0, garage.numbers[name]]]))[0, 1])
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


SETTLING = 10_000  # [ms] until all that was sent is in the EEPROM, and the motors are off


def set_up(port: InProcessPort, settings: MachineSettings) -> None:
    """Power on; the owner's numbers and the lengths of the chains are sent, as on the first day."""
    port.machine.start()
    sender = Sender(port)
    sender.await_start()
    lines = gcode(firmware_numbers(settings)).decode().splitlines()
    client = [f"${number}={value:g}" for number, value in CLIENT_NUMBERS.items()]
    sender.stream([*client, *lines, f"B06 L{EXTENDED:g} R{EXTENDED:g}", "G10 Z0"])
    port.machine.advance(SETTLING)


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
