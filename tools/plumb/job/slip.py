"""Did a chain slip on its sprocket? Whole links against a moved sheet and plain noise.

A chain slips by whole links of 6.35 mm, so a slip is one of few patterns. A moved sheet is any
shift and turn. Each account is weighed by how likely it makes what was touched, times how often
it happens: a sheet that could lie anywhere explains any two marks a little, a slip explains only
its pattern, but that well.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import scipy

from plumb.job.home import (
    TOUCH_SIGMA,
    HomeTouch,
    Point,
    are_apart,
    believed_chains,
    places_with,
)
from plumb.model.plain import greatest, ranked
from plumb.model.predict import FOUND, Array, lengths
from plumb.settings.machine import MachineSettings

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
) -> SlipFinding:
    """Weigh what may have happened to the chains since the marks were made.

    fixed: the marks are on the frame, so no sheet could move. sigma [mm] of a coordinate of a
    touch, if it is known better. Raises InputError.
    """
    # A hole that the machine made by these settings is as good as a touch: what the settings do
    # not know moves hole and bit alike.
    used = sigma or TOUCH_SIGMA
    believed = believed_chains(settings, touches)
    holes = np.array([touch.hole for touch in touches], dtype=float).reshape(-1, 2)
    counts = [(left, right) for left in COUNTS for right in COUNTS]
    slipped = believed + LINK * np.array(counts, dtype=float)[:, None]
    errors = {
        links: holes - where
        for links, where in zip(counts, places_with(settings, slipped), strict=True)
    }
    accounts = _weighed(errors, holes, used, fixed)
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
    )


def _weighed(
    errors: dict[Links, Array], holes: Array, sigma: float, fixed: bool
) -> tuple[SlipAccount, ...]:
    """Return all accounts with their odds, the likeliest first."""
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
    return tuple(SlipAccount(*key, odds=float(np.exp(totals[key] - whole))) for key in likeliest)


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
