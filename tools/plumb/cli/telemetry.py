"""`plumb telemetry`: what the firmware says of itself, in plain words."""

from __future__ import annotations

import argparse
from dataclasses import dataclass

from plumb.cli.arguments import add_json, file
from plumb.cli.screen import print_json, sentences, table
from plumb.firmware.telemetry import EVENTS, Telemetry, latest, warnings
from plumb.text.files import read_text


@dataclass(frozen=True)
class WatchedTelemetry(Telemetry):
    """The figures, and what to look at."""

    warnings: tuple[str, ...] = ()


def history(telemetry: Telemetry) -> str:
    """Return how often each kind of event has happened since the board was new."""
    if telemetry.total_events == 0:
        return "never any"
    counts = zip(telemetry.events, EVENTS.values(), strict=True)
    return ", ".join(f"{count} {plural(name, count)}" for count, name in counts)


def last_event(telemetry: Telemetry) -> str:
    """Return the last event and its place in the order."""
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
    said = tuple(warnings(telemetry, limit_mm=arguments.limit, rate_hz=arguments.rate))
    if arguments.json:
        print_json(WatchedTelemetry(**vars(telemetry), warnings=said))
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


# The arguments of `plumb telemetry`.

EXAMPLES = (
    "plumb telemetry client.log",
    "plumb telemetry client.log --limit 1",
)
EXIT = "Exit: 0 done and all is well, 1 something to look at, 2 the log cannot be used."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `plumb telemetry`."""
    parser.add_argument(
        "log",
        metavar="LOG",
        type=file,
        help="a text with a [Telemetry|...] line; the last such line counts",
    )
    parser.add_argument(
        "--limit",
        type=float,
        default=2.0,
        metavar="MM",
        help="the machine's $42, the limit of the following error [2]",
    )
    parser.add_argument(
        "--rate",
        type=int,
        default=100,
        choices=(100, 200),
        help="the machine's $69, the rate of the control tick [100]",
    )
    add_json(parser)
