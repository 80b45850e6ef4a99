"""The firmware's telemetry line, an answer to B30: read and judged.

docs/telemetry.md describes the fields.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass

from plumb.text.errors import to_do

LINE = re.compile(r"\[Telemetry\|([^\]\n]*)\]")
LEAST_SUPPLY_V = 4.5
CHAINS = ("left", "right")
STARTS = ("usual", "brown-out", "watchdog")


@dataclass(frozen=True)
class Slip:
    """A moment in which a chain may have slipped."""

    chain: str  # of CHAINS
    place: tuple[int, int]  # [mm] where the sled was sent then
    seconds_ago: int


@dataclass(frozen=True)
class Telemetry:
    """Findings in an answer to B30 that an owner may have to look at.

    How far a motor fell behind is no matter: the feed yields, and the machine says so.
    """

    dry: int  # how often no set-point was there in the middle of a move
    tick_us: int  # longest control tick
    illegal: tuple[int, int, int]  # encoder steps in which both channels changed: left, right, z
    least_supply_v: float
    eeprom_worn: bool
    start: str  # of STARTS
    slips: tuple[int, int] = (0, 0)  # how often left and right may have slipped since power-on
    last_slip: Slip | None = None  # None: none, or the firmware does not watch for slips


def telemetry_in(text: str) -> Telemetry | None:
    """Return the last telemetry line of a text; None if it has none or the last is damaged."""
    lines = LINE.findall(text)
    try:
        return _read(dict(field.split(":", 1) for field in lines[-1].split("|")))
    except (IndexError, KeyError, ValueError):
        return None


def _read(fields: dict[str, str]) -> Telemetry:
    """Return the fields of a line; a KeyError or ValueError if one is missing or no number."""
    left_illegal, right_illegal, z_illegal = (int(n) for n in fields["illegal"].split(","))
    _, least = (float(number) for number in fields["supply"].split(","))
    if fields["eeprom"] not in ("ok", "writing", "worn") or fields["start"] not in STARTS:
        raise ValueError
    slips, last_slip = _slips(fields)
    return Telemetry(
        dry=int(fields["dry"]),
        tick_us=int(fields["tick"]),
        illegal=(left_illegal, right_illegal, z_illegal),
        least_supply_v=least,
        eeprom_worn=fields["eeprom"] == "worn",
        start=fields["start"],
        slips=slips,
        last_slip=last_slip,
    )


def _slips(fields: dict[str, str]) -> tuple[tuple[int, int], Slip | None]:
    """Return how often each chain may have slipped, and the last time."""
    if "slips" not in fields:
        return (0, 0), None
    left, right = (int(number) for number in fields["slips"].split(","))
    chain, x, y, ago = fields["slipped"].split(",")
    if chain not in (*CHAINS, "none"):
        raise ValueError
    last = None if chain == "none" else Slip(chain, (int(x), int(y)), int(ago))
    return (left, right), last


def slip_suspicion(telemetry: Telemetry) -> str | None:
    """Return which chain an owner should look at because it may have slipped, and where; or
    None.
    """
    last = telemetry.last_slip
    if last is None:
        return None
    left, right = telemetry.slips
    chains = "both chains" if left and right else f"the {last.chain} chain"
    times = left + right
    often = "once" if times == 1 else f"{times} times"
    x, y = last.place
    return (
        f"Look at {chains}: a motor's load fell away for a moment, {often} since power-on, the "
        f"last time on the {last.chain} near x {x}, y {y} mm, {ago(last.seconds_ago)} ago. A chain "
        "that slips does that. Drive to a hole that the machine made. If the bit misses it, "
        + to_do("plumb recover --at sets the chains right.", page="set the chains again.")
    )


def ago(seconds: int) -> str:
    """Return a time in its largest unit."""
    for name, length in (("hour", 3600), ("minute", 60)):
        if seconds >= length:
            count = seconds // length
            return f"{count} {name}{'s' if count > 1 else ''}"
    return f"{seconds} s"


def warnings(telemetry: Telemetry, *, rate_hz: int) -> Iterator[str]:
    """Yield what an owner should look at, a sentence each; `rate_hz` is $69."""
    if telemetry.dry:
        yield (
            f"The motors waited for the next set-point {telemetry.dry} times during a move. "
            "Use longer moves or fewer effects."
        )
    if telemetry.tick_us > 1e6 / rate_hz / 2:
        yield (
            f"A control tick took {telemetry.tick_us} us of {1e6 / rate_hz:.0f} us. "
            "Set $69 to 100, or use fewer effects."
        )
    for axis, steps in zip(("left chain", "right chain", "z axis"), telemetry.illegal, strict=True):
        if steps:
            yield (
                f"The encoder of the {axis} made {steps} illegal steps since power-on. "
                "Check its plug, and keep its cable away from the router's."
            )
    if telemetry.least_supply_v < LEAST_SUPPLY_V:
        yield (
            f"The Mega's 5 V fell to {telemetry.least_supply_v:.2f} V. "
            "Check its plug and USB cable."
        )
    if telemetry.eeprom_worn:
        yield (
            "The EEPROM no longer keeps what is written. Note your settings ($$), "
            "then change the board."
        )
    suspicion = slip_suspicion(telemetry)
    if suspicion:
        yield suspicion
    if telemetry.start == "brown-out":
        yield "The Mega started because its 5 V broke down. Check its plug and USB cable."
    if telemetry.start == "watchdog":
        yield "The Mega started because the firmware hung. Please report what was running."
