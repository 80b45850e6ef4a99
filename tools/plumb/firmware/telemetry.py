"""The firmware's telemetry line: read from what a client logged, and judged.

docs/telemetry.md describes the fields.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated

from plumb.text.answers import among, meant
from plumb.text.errors import InputError, to_do

LINE = re.compile(r"\[Telemetry\|([^\]\n]*)\]")
LEAST_SUPPLY_V = 4.5
CHAINS = ("left", "right")
STARTS = ("usual", "brown-out", "watchdog")
# Kinds of events in the order of their counts, and how an owner hears of them.
EVENTS = {
    "brown-out": "brown-out",
    "watchdog": "hang",
    "supply": "low supply",
    "driver": "driver error",
}


@dataclass(frozen=True)
class Slip:
    """A moment in which a chain may have slipped."""

    chain: Annotated[str, among(CHAINS)]
    place: tuple[int, int]  # [mm] where the sled was sent then
    seconds_ago: int


@dataclass(frozen=True)
class Telemetry:
    """An answer to B30. Chains first: left, right, then z."""

    error_mm: Annotated[
        tuple[float, float, float], meant("Largest distance from the set-points: left, right, z.")
    ]
    dry: int  # how often no set-point was there in the middle of a move
    tick_us: int  # longest control tick
    illegal: tuple[int, int, int]  # encoder steps in which both channels changed
    supply_v: float
    least_supply_v: float
    eeprom_worn: bool
    start: Annotated[str, among(STARTS)]
    events: tuple[int, ...]  # how often each of EVENTS has happened, ever
    last_event: str  # one of EVENTS, or "none"
    total_events: int  # place of the last event in their order
    slips: Annotated[
        tuple[int, int], meant("How often left and right may have slipped since power-on.")
    ] = (0, 0)
    last_slip: Annotated[
        Slip | None, meant("null: none, or the firmware does not watch for slips.")
    ] = None


def latest(text: str, path: str) -> Telemetry:
    """Return the last telemetry line of a log; an InputError that names `path` if there is none."""
    lines = LINE.findall(text)
    if not lines:
        raise InputError(f"{path}: no [Telemetry|...] line; send B30 and save the client's log")
    telemetry = telemetry_in(text)
    if telemetry is None:
        raise InputError(
            f"{path}: the last telemetry line is damaged: [Telemetry|{lines[-1]}]; send B30 again"
        )
    return telemetry


def telemetry_in(text: str) -> Telemetry | None:
    """Return the last telemetry line of a text; None if it has none or the last is damaged."""
    lines = LINE.findall(text)
    try:
        return _read(dict(field.split(":", 1) for field in lines[-1].split("|")))
    except (IndexError, KeyError, ValueError):
        return None


def _read(fields: dict[str, str]) -> Telemetry:
    """Return the fields of a line; a KeyError or ValueError if one is missing or no number."""
    left, right, z = (float(number) for number in fields["error"].split(","))
    left_illegal, right_illegal, z_illegal = (int(n) for n in fields["illegal"].split(","))
    supply, least = (float(number) for number in fields["supply"].split(","))
    events = tuple(int(number) for number in fields["events"].split(","))
    last_event, total_events = fields["last"].split(",")
    if fields["eeprom"] not in ("ok", "worn") or fields["start"] not in STARTS:
        raise ValueError
    if len(events) != len(EVENTS) or last_event not in (*EVENTS, "none"):
        raise ValueError
    slips, last_slip = _slips(fields)
    return Telemetry(
        error_mm=(left, right, z),
        dry=int(fields["dry"]),
        tick_us=int(fields["tick"]),
        illegal=(left_illegal, right_illegal, z_illegal),
        supply_v=supply,
        least_supply_v=least,
        eeprom_worn=fields["eeprom"] == "worn",
        start=fields["start"],
        events=events,
        last_event=last_event,
        total_events=int(total_events),
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
        "that slips does that. Touch two holes, and ask "
        + to_do("plumb slip.", page="whether they are where they were.")
    )


def ago(seconds: int) -> str:
    """Return a time in its largest unit."""
    for name, length in (("hour", 3600), ("minute", 60)):
        if seconds >= length:
            count = seconds // length
            return f"{count} {name}{'s' if count > 1 else ''}"
    return f"{seconds} s"


def warnings(telemetry: Telemetry, *, limit_mm: float, rate_hz: int) -> Iterator[str]:
    """Yield what an owner should look at, a sentence each; `limit_mm` is $42, `rate_hz` is $69."""
    axes = ("left chain", "right chain", "z axis")
    for axis, error in zip(axes, telemetry.error_mm, strict=True):
        if error > limit_mm / 2:
            yield (
                f"The {axis} fell {error:.2f} mm behind; {limit_mm:g} mm stops the machine ($42). "
                "Its motor is short of power, or its gains are off."
            )
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
    for axis, steps in zip(axes, telemetry.illegal, strict=True):
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
