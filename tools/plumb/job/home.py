"""Where is the sled? Home marks bring a lost position back, and show whether a chain slipped."""

import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from math import dist
from pathlib import Path
from typing import Annotated

import numpy as np
import scipy
from pydantic import BeforeValidator

from plumb.grid.options import APPROACH, PLUNGE_FEED, Grid
from plumb.model.plain import greatest, ranked
from plumb.model.predict import FOUND, Array, believed_lengths, lengths, places
from plumb.settings.machine import MachineSettings
from plumb.text.answers import in_json, key
from plumb.text.errors import InputError, Source
from plumb.text.files import parsed, read_text, write_whole
from plumb.text.tables import Table, part, read_table, toml_text
from plumb.text.values import pair

# Home marks: holes whose chains are kept. With the bit in such a hole a lost position is restored.
#
# A hole that the machine made at a place was made with the chains that its settings pay out there.
# Whatever these settings do not know was in the hole too, so the same chains are right when the bit
# is back in it, also after the settings have become better.


Point = tuple[float, float]
NAME = "home.toml"
HEAD = "# Home marks of a machine, for plumb: holes, and the chains with the bit in them. mm."
HOLE_DEPTH = 2.0  # [mm] so that a bit finds its place in the hole
USUAL = Grid()  # heights and feeds, as a grid has them
SURE = 3.03  # sigmas of a coordinate: beyond this length 1 % of the errors in a plane lie


class HomeTable(Table):
    """A table [mark.NAME] of the file."""

    place: Annotated[Point, BeforeValidator(pair)]  # where the machine was when it made the hole
    chains: Annotated[Point, BeforeValidator(pair)]  # left and right paid out there
    date: str = ""
    settings: str = ""  # name of the settings' file then


class HomeMark(HomeTable):
    """A hole. mm, from the middle of the sheet, y up."""

    name: str


class HomeFile(Table):
    """The file of the home marks."""

    mark: dict[str, HomeTable] = part()


@dataclass(frozen=True)
class HomeFit:
    """The agreement of a second home mark with the first, by which the position was restored."""

    name: Annotated[str, key("mark")]
    error: Point  # [mm] of the hole, against what the machine shows with the bit in it
    chains: Point  # [mm] by which each chain is longer than the machine believes
    # [mm] within which two touches by hand agree, 99 of 100 times
    limit: Annotated[float, key("limit_mm")]

    @in_json
    def fits(self) -> bool:
        """Whether touching two holes by hand explains the error."""
        return float(np.hypot(*self.error)) <= self.limit


def home_file(settings: Source) -> Path:
    """Return where the home marks of a machine are: next to its settings."""
    return Path(settings).parent / NAME


def new_home_mark(
    settings: MachineSettings, name: str, place: Point, *, date: str = ""
) -> HomeMark:
    """Return a hole that the machine makes at a place by these settings. Raises InputError."""
    try:
        left, right = believed_lengths(settings, np.array([place], dtype=float))[0].tolist()
    except ValueError as error:
        raise InputError(f"home mark {name}: {error}") from None
    file = settings.file.name if settings.file else ""
    return HomeMark.model_construct(
        name=name, place=place, chains=(left, right), date=date, settings=file
    )


def hole_program(mark: HomeMark) -> list[str]:
    """Return the lines of a program that makes the hole of a home mark, come to as a grid comes to
    its marks.
    """
    x, y = mark.place
    return [
        f"(Plumb: the hole of home mark {mark.name})",
        "G21",
        "G90",
        f"G0 Z{USUAL.safe_height:g}",
        f"G0 X{x - APPROACH[0]:.3f} Y{y - APPROACH[1]:.3f}",
        f"G1 X{x:.3f} Y{y:.3f} F{USUAL.feed:g}",
        f"G1 Z{-HOLE_DEPTH:g} F{PLUNGE_FEED:g}",
        f"G0 Z{USUAL.safe_height:g}",
    ]


def place_of(settings: MachineSettings, mark: HomeMark) -> Array:
    """Return where the machine shows the bit in a home mark (2,) [mm], by the settings of today."""
    where: Array = places_with(settings, np.array([mark.chains], dtype=float))[0]
    if not np.isfinite(where).all():
        raise InputError(f"home mark {mark.name}: with these settings its chains lead nowhere")
    return where


def home_fit(settings: MachineSettings, mark: HomeMark, shown: Point) -> HomeFit:
    """Return how well a home mark agrees with what the machine shows of the bit in it."""
    x, y = (place_of(settings, mark) - np.array(shown)).tolist()
    believed = believed_chains(settings, [HomeTouch(mark.name, mark.place, shown)])[0]
    left, right = (np.array(mark.chains) - believed).tolist()
    # Both holes are touched, and each was made with the bit once.
    return HomeFit(mark.name, (x, y), (left, right), limit=SURE * 2**0.5 * TOUCH_SIGMA)


def read_home_marks(path: Source) -> dict[str, HomeMark]:
    """Return the home marks of a file by name; none if there is no file. Raises InputError."""
    if not Path(path).exists():
        return {}
    head = parsed(path, read_text(path), tomllib.loads, "TOML")
    marks = read_table(HomeFile, head, path).mark
    return {name: HomeMark.model_construct(name=name, **dict(each)) for name, each in marks.items()}


def write_home_marks(path: Source, marks: Mapping[str, HomeMark]) -> None:
    """Replace the file in one step; every number comes back bit for bit."""
    tables = {
        mark.name: {key: getattr(mark, key) for key in HomeTable.model_fields}
        for mark in marks.values()
    }
    notes = {f"{name}.chains": "left and right paid out" for name in marks}
    write_whole(path, f"{HEAD}\n\n{toml_text({'mark': tables}, notes)}".encode())


# Marks touched with the bit: where the hole is, and where the machine shows the bit in it.

TOUCH_SIGMA = 0.5  # [mm] of a coordinate: the bit in its hole, and the hole's place
MISREAD = 100.0  # [mm] of a touch: a slip of two links shows less
SAME = 3.0  # [mm] between two holes: a bit is wider
FAR = 50.0  # [mm] between holes from which on they are two places; nearer, they err alike


@dataclass(frozen=True)
class HomeTouch:
    """A mark with the bit in it. mm, from the middle of the sheet, y up."""

    name: str
    hole: Point  # where the mark is known to be
    shown: Point  # what the machine says of the bit in it


def refuse_repeated(touches: Sequence[HomeTouch]) -> None:
    """Raise InputError for a hole that is given twice: what it says counts once."""
    for (first, earlier), (second, later) in combinations(enumerate(touches, 1), 2):
        if dist(earlier.hole, later.hole) < SAME:
            raise InputError(
                f"touch {second} is touch {first} again; touch another hole far from it"
            )


def are_apart(touches: Sequence[HomeTouch]) -> bool:
    """Return whether two of the holes are far enough apart to be two places."""
    return any(dist(left.hole, right.hole) >= FAR for left, right in combinations(touches, 2))


def lost_sign(touch: HomeTouch) -> str:
    """Return the coordinate, x or y, whose sign was lost: the other sign shows the bit near the
    hole.
    """
    (x, y), (shown_x, shown_y) = touch.hole, touch.shown
    if dist(touch.hole, touch.shown) <= MISREAD:
        return ""
    flipped = {"x": (-shown_x, shown_y), "y": (shown_x, -shown_y)}
    near = [name for name, place in flipped.items() if dist((x, y), place) <= MISREAD]
    return near[0] if near else ""


def believed_chains(settings: MachineSettings, touches: Sequence[HomeTouch]) -> Array:
    """Return the chains (n, 2) [mm] that the machine believes at each touch. Raises InputError."""
    shown = np.array([touch.shown for touch in touches], dtype=float).reshape(-1, 2)
    try:
        return believed_lengths(settings, shown)
    except ValueError as error:
        raise InputError(f"what the machine shows cannot be: {error}") from None


def places_with(settings: MachineSettings, chains: Array) -> Array:
    """Return places (..., 2) [mm] for chains (..., 2) [mm]; NaN where no sled hangs."""
    where, outcome = places(settings.as_plumb_model(), chains.reshape(-1, 2))
    where = np.where((outcome == FOUND)[:, None], where, np.nan)
    return where.reshape(chains.shape)


def sigma_of(settings: MachineSettings, *, taped: bool) -> float:
    """Return the usual error of a coordinate of a touch [mm].

    A hole that the machine made by these settings is as good as a touch: what the settings do not
    know moves hole and bit alike. A hole that was measured with a tape is no better than what the
    fit left at marks that it did not see.
    """
    if not taped or settings.fitted is None:
        return TOUCH_SIGMA
    return max(TOUCH_SIGMA, settings.fitted.left_out_rms / 2**0.5)


def turned_back(holes: Array, turn: float) -> Array:
    """Holes (n, 2) [mm] that a tape read from the edges of a sheet, as the machine has them, if the
    sheet is turned [rad] counter-clockwise about its middle."""
    cosine, sine = np.cos(turn), np.sin(turn)
    back: Array = holes.reshape(-1, 2) @ np.array([[cosine, -sine], [sine, cosine]])
    return back


# Did a chain slip on its sprocket? Whole links against a moved sheet and plain noise.
#
# A chain slips by whole links of 6.35 mm, so a slip is one of few patterns. A moved sheet is any
# shift and turn. Each account is weighed by how likely it makes what was touched, times how often
# it happens: a sheet that could lie anywhere explains any two marks a little, a slip explains only
# its pattern, but that well.


LINK = 6.35  # [mm] of #25 chain
MOST_LINKS = 3
COUNTS = range(-MOST_LINKS, MOST_LINKS + 1)
GATE = 0.99  # of the odds: below it nothing is named

NOTHING, SLIP, SHEET, OTHER = "nothing", "slip", "sheet_moved", "other"
CANNOT_TELL = "cannot_tell"

Links = tuple[int, int]
NO_LINKS: Links = (0, 0)

# How often each happens to a user who asks; only their proportions count.
OFTEN = {NOTHING: 0.45, SLIP: 0.25, SHEET: 0.25, OTHER: 0.02}
AND_SHEET = 0.02  # of the slips the sheet has moved as well
BOTH_CHAINS = 0.2  # of the slips are of both chains
BY_COUNT = {1: 0.6, 2: 0.25, 3: 0.15}  # of the slips of a chain
# How far a sheet moves: pushed a little, or taken off and laid again. Of each x and y [mm],
# rotation [rad], and how often.
POSES = ((3.0, 0.001, 0.5), (20.0, 0.008, 0.5))
FAR_OFF = 30.0  # [mm] of a coordinate that nothing else explains


@dataclass(frozen=True)
class SlipAccount:
    """Possible course of events, and its odds among all accounts."""

    kind: str  # NOTHING, SLIP, SHEET or OTHER
    links: Links  # by how much longer left and right are than the machine believes
    odds: float


@dataclass(frozen=True)
class SlipFinding:
    """Weighed accounts, and the verdict on them."""

    verdict: str  # of the kinds, or CANNOT_TELL
    accounts: tuple[SlipAccount, ...]  # the likeliest first
    touches: tuple[HomeTouch, ...]
    errors: Array  # (n, 2) [mm] hole - place by the machine's chains
    left: Array  # (n, 2) [mm] after the likeliest account
    sigma: float  # [mm] of a coordinate
    believed: Array  # (n, 2) [mm] the chains that the machine believes at each touch
    fixed: bool  # whether the marks are on what cannot move
    log_density: float  # of the touches, over all accounts

    @property
    def best(self) -> SlipAccount:
        """The likeliest account."""
        return self.accounts[0]

    @property
    def true_chains(self) -> Array:
        """The chains [mm] left and right at the last touch, by the likeliest account."""
        chains: Array = self.believed[-1] + LINK * np.array(self.best.links)
        return chains


def find_slip(
    settings: MachineSettings,
    touches: Sequence[HomeTouch],
    *,
    sigma: float | None = None,
    fixed: bool = False,
    taped: bool = False,
) -> SlipFinding:
    """Weigh what may have happened to the chains since the marks were made.

    fixed: the marks are on the frame, so no sheet could move. taped: the places of the holes were
    read with a tape; else they are where the machine was sent when it made them. A tape reads from
    the sheet's edges: the sheet hangs as it was fitted, or was hung straight since.
    sigma [mm] of a coordinate of a touch, if it is known better. Raises InputError.
    """
    used = sigma or sigma_of(settings, taped=taped)
    fitted = settings.fitted.last_sheet_rotation if taped and settings.fitted else 0.0
    turns = (fitted, 0.0) if fitted else (0.0,)
    turned = [_finding(settings, touches, turn, used, fixed) for turn in turns]
    return ranked(turned, lambda finding: -finding.log_density)[0]


def _finding(
    settings: MachineSettings, touches: Sequence[HomeTouch], turn: float, used: float, fixed: bool
) -> SlipFinding:
    """Return what may have happened, if the sheet is turned [rad] counter-clockwise."""
    believed = believed_chains(settings, touches)
    holes = turned_back(np.array([touch.hole for touch in touches], dtype=float), turn)
    counts = [(left, right) for left in COUNTS for right in COUNTS]
    slipped = believed + LINK * np.array(counts, dtype=float)[:, None]
    errors = {
        links: holes - where
        for links, where in zip(counts, places_with(settings, slipped), strict=True)
    }
    accounts, log_density = _weighed(errors, holes, used, fixed)
    best = accounts[0]
    return SlipFinding(
        verdict=_verdict(accounts, apart=are_apart(touches), fixed=fixed),
        accounts=accounts,
        touches=tuple(touches),
        errors=errors[NO_LINKS],
        left=_left(errors[best.links], holes, best.kind, used),
        sigma=used,
        believed=believed,
        fixed=fixed,
        log_density=log_density,
    )


def _weighed(
    errors: dict[Links, Array], holes: Array, sigma: float, fixed: bool
) -> tuple[tuple[SlipAccount, ...], float]:
    """Return all accounts with their odds, the likeliest first, and how likely the touches are."""
    poses = () if fixed else POSES
    logs: dict[tuple[str, Links], list[float]] = {}

    def weigh(kind: str, links: Links, often: float, covariance: Array) -> None:
        error = errors[links].ravel()
        if np.isfinite(error).all():
            log = _log_density(error, covariance) + np.log(often)
            logs.setdefault((kind, links), []).append(log)

    noise = sigma**2 * np.eye(holes.size)
    weigh(NOTHING, NO_LINKS, OFTEN[NOTHING], noise)
    weigh(OTHER, NO_LINKS, OFTEN[OTHER], FAR_OFF**2 * np.eye(holes.size))
    for links, share in _slip_shares():
        weigh(SLIP, links, OFTEN[SLIP] * share * (1 - AND_SHEET), noise)
    for shift, turn, often in poses:
        slopes = pose_slopes(holes) * (shift, shift, turn)
        moved = noise + slopes @ slopes.T
        weigh(SHEET, NO_LINKS, OFTEN[SHEET] * often, moved)
        for links, share in _slip_shares():
            weigh(SLIP, links, OFTEN[SLIP] * share * AND_SHEET * often, moved)
    totals = {key: float(scipy.special.logsumexp(each)) for key, each in logs.items()}
    whole = float(scipy.special.logsumexp([*totals.values()]))
    likeliest = ranked(totals, lambda key: -totals[key])
    return tuple(
        SlipAccount(*key, odds=float(np.exp(totals[key] - whole))) for key in likeliest
    ), whole


def _slip_shares() -> Iterator[tuple[Links, float]]:
    """Yield each slip, and its share of all slips."""
    for links in ((left, right) for left in COUNTS for right in COUNTS):
        shares = [BY_COUNT[abs(count)] / 2 for count in links if count]
        if len(shares) == 1:
            yield links, (1 - BOTH_CHAINS) * shares[0] / 2
        elif shares:
            yield links, BOTH_CHAINS * shares[0] * shares[1]


def pose_slopes(holes: Array) -> Array:
    """Return how coordinates (2n,) of holes (n, 2) follow a sheet's x, y [mm] and rotation
    [rad].
    """
    slopes = np.zeros((*holes.shape, 3))
    slopes[:, 0, 0] = slopes[:, 1, 1] = 1
    slopes[:, 0, 2], slopes[:, 1, 2] = -holes[:, 1], holes[:, 0]
    return slopes.reshape(-1, 3)


def _log_density(error: Array, covariance: Array) -> float:
    """Return the normal log-density of a vector of this covariance."""
    _, size = np.linalg.slogdet(2 * np.pi * covariance)
    return float(-0.5 * (size + error @ np.linalg.solve(covariance, error)))


def _verdict(accounts: Sequence[SlipAccount], *, apart: bool, fixed: bool) -> str:
    """Return what may be said of it."""
    best = accounts[0]
    if best.odds < GATE:
        return CANNOT_TELL
    # At a single place any slip looks like some sheet that was shifted.
    if best.kind in (SLIP, SHEET) and not apart and not fixed:
        return CANNOT_TELL
    return best.kind


def _left(errors: Array, holes: Array, kind: str, sigma: float) -> Array:
    """Errors (n, 2) [mm] that an account leaves; a sheet is laid where it fits best."""
    if kind != SHEET:
        return errors
    slopes, widest = pose_slopes(holes), POSES[-1]
    held = np.diag([1 / widest[0] ** 2, 1 / widest[0] ** 2, 1 / widest[1] ** 2]) * sigma**2
    pose = np.linalg.solve(slopes.T @ slopes + held, slopes.T @ errors.ravel())
    left: Array = (errors.ravel() - slopes @ pose).reshape(-1, 2)
    return left


# The G-code that declares chains as they are, while the bit is in a known hole.


def chains_line(chains: Array) -> str:
    """Return the line that tells the machine how long its chains are, left and right [mm]."""
    return f"B06 L{chains[0]:.3f} R{chains[1]:.3f}"


def repair_program(chains: Array, *, where: str) -> list[str]:
    """Return the lines of a program that declares chains with the bit at a place, said in words."""
    return [f"(Plumb: only with the bit in {where}, and nothing moved since)", chains_line(chains)]


# Where a further touch tells most: there the accounts that are still open expect other errors.
#
# Each account says what the machine would show with the bit in a hole elsewhere. A slip says it by
# its links alone; a moved sheet as far as the touches have shown how it lies.

COLUMNS, ROWS = 9, 5  # places that are asked for
EDGE = 200.0  # [mm] of the sheet that they leave free
RIVALS = 4  # accounts that are held against the likeliest


@dataclass(frozen=True)
class _Expected:
    """Expected touch at each place, by an account."""

    error: Array  # (m, 2) [mm] hole - place by the machine's chains
    covariance: Array  # (m, 2, 2) [mm^2]


def next_hole(settings: MachineSettings, finding: SlipFinding) -> Point | None:
    """Return the place [mm] where a hole would tell most; None where no sled hangs."""
    spots = _spots(settings)
    best, *rivals = [_expected(settings, finding, each, spots) for each in _open(finding)]
    tells = np.zeros(len(spots))
    for account, rival in zip(_open(finding)[1:], rivals, strict=True):
        tells += account.odds * _gain(best, rival)
    tells = np.where(np.isfinite(tells), tells, -1.0)
    if not len(spots) or tells.max() <= 0:
        return None
    x, y = spots[greatest(tells)].tolist()
    return round(x), round(y)


def _open(finding: SlipFinding) -> list[SlipAccount]:
    """Return the likeliest accounts that expect something; the likeliest first."""
    kinds = [each for each in finding.accounts if each.kind != OTHER]
    return kinds[: RIVALS + 1]


def _spots(settings: MachineSettings) -> Array:
    """Return places (m, 2) [mm] over the sheet where the sled can hang."""
    across, up = settings.sheet_width / 2 - EDGE, settings.sheet_height / 2 - EDGE
    spots = np.array(
        [(x, y) for y in np.linspace(up, -up, ROWS) for x in np.linspace(-across, across, COLUMNS)]
    )
    _, outcome = lengths(settings.as_plumb_model(), spots)
    hanging: Array = spots[outcome == FOUND]
    return hanging


def _expected(
    settings: MachineSettings, finding: SlipFinding, account: SlipAccount, spots: Array
) -> _Expected:
    """Return what an account expects at places, after these touches."""
    slip = LINK * np.array(account.links, dtype=float)
    chains, _ = lengths(settings.as_plumb_model(), spots)
    jump = spots - places_with(settings, chains - slip)
    noise = finding.sigma**2
    still = np.broadcast_to(noise * np.eye(2), (len(spots), 2, 2))
    if account.kind != SHEET:
        return _Expected(jump, still)
    holes = np.array([touch.hole for touch in finding.touches], dtype=float).reshape(-1, 2)
    shift, turn, _ = POSES[-1]
    prior = np.diag([shift**2, shift**2, turn**2])
    seen, there = pose_slopes(holes), pose_slopes(spots).reshape(-1, 2, 3)
    gain = prior @ seen.T @ np.linalg.inv(seen @ prior @ seen.T + noise * np.eye(holes.size))
    pose, left = gain @ finding.errors.ravel(), prior - gain @ seen @ prior
    return _Expected(jump + there @ pose, still + there @ left @ there.transpose(0, 2, 1))


def _gain(true: _Expected, rival: _Expected) -> Array:
    """By how much (m,) a touch usually lowers the log odds of a rival, if the first is true."""
    apart = (rival.error - true.error)[:, :, None]
    both = np.linalg.solve(rival.covariance, true.covariance)
    distance = (apart.transpose(0, 2, 1) @ np.linalg.solve(rival.covariance, apart))[:, 0, 0]
    trace = np.trace(both, axis1=1, axis2=2)
    gain: Array = 0.5 * (trace + distance - 2 - np.log(np.linalg.det(both)))
    return gain
