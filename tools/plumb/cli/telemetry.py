"""`plumb telemetry`: what the firmware says of itself, in plain words."""

from __future__ import annotations

import argparse
from dataclasses import asdict

from plumb.cli.screen import sentences, table
from plumb.cli.text import print_json
from plumb.firmware.telemetry import EVENTS, Telemetry, latest, warnings
from plumb.text.files import read_text


def history(telemetry: Telemetry) -> str:
    """How often each kind of event has happened since the board was new."""
    if telemetry.total_events == 0:
        return "never any"
    counts = zip(telemetry.events, EVENTS.values(), strict=True)
    return ", ".join(f"{count} {plural(name, count)}" for count, name in counts)


def last_event(telemetry: Telemetry) -> str:
    """The last event and its place in the order."""
    if telemetry.total_events == 0:
        return "none"
    return f"{EVENTS[telemetry.last_event]}, number {telemetry.total_events}"


def plural(name: str, count: int) -> str:
    """`low supply` or `low supplies`."""
    if count == 1:
        return name
    return f"{name[:-1]}ies" if name.endswith("y") else f"{name}s"


def run(arguments: argparse.Namespace) -> int:
    """Print the figures and what to look at."""
    telemetry = latest(read_text(arguments.log), arguments.log)
    said = list(warnings(telemetry, limit_mm=arguments.limit, rate_hz=arguments.rate))
    if arguments.json:
        print_json({**asdict(telemetry), "warnings": said})
        return int(bool(said))
    left, right, z = telemetry.error_mm
    rows = [
        ["farthest behind", f"left {left:.2f}  right {right:.2f}  z {z:.2f} mm"],
        ["longest control tick", f"{telemetry.tick_us} us"],
        ["waits during moves", str(telemetry.dry)],
        ["illegal encoder steps", "left {}  right {}  z {}".format(*telemetry.illegal)],
        ["supply", f"{telemetry.supply_v:.2f} V, lowest {telemetry.least_supply_v:.2f} V"],
        ["EEPROM", "worn" if telemetry.eeprom_worn else "ok"],
        ["reason of the start", telemetry.start],
        ["went wrong so far", history(telemetry)],
        ["the last of it", last_event(telemetry)],
        ["suspected slips", "left {}  right {}".format(*telemetry.slips)],
    ]
    print(table(["what", "measured"], rows, words=[-1]))
    print()
    print(sentences(said or ["All is well."]))
    return int(bool(said))
