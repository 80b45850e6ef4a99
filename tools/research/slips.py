"""Does the firmware suspect a chain that slips while it cuts, and only then?

`tools/research/slips.py 10 --hours 12` prints the table of docs/telemetry.md, `--mega ELF`
asks the flashed program. A sled goes along a chain; in the middle of its way the chain climbs over
a tooth. Then hours of work by chance, in which no chain slips.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from plumb.bench.causes import MAKER
from plumb.firmware.telemetry import CHAINS, Telemetry, latest
from scene import Scene
from soak import soak
from strike import Strike

PLACES = ((0.0, 350.0), (0.0, 0.0), (-700.0, -350.0), (700.0, -350.0), (-700.0, 250.0))  # [mm]
FEEDS = (150.0, 400.0, 900.0)  # [mm/min]
LINK = 6.35  # [mm]
WAY = 100.0  # [mm] of a line
STRUCK_AFTER = 0.45  # of the line
FRICTION = 3.0  # [N] of any sled
TENSIONS = (0.0, 30.0, 50.0, 70.0, 90.0, 1000.0)  # [N] borders of the rows


@dataclass(frozen=True)
class SlipTry:
    """A line along a chain, and what the firmware suspected."""

    feed: float  # [mm/min]
    winds_in: bool
    tension: float  # [N] of the chain before it slipped
    named: int  # how often that chain was suspected
    other: int  # and the other


def lines_along(chain: str, place: tuple[float, float], winds_in: bool) -> tuple[str, str]:
    """Return places where a line through `place` along a chain begins and ends."""
    motor = np.array([(-0.5 if chain == "left" else 0.5) * MAKER.motor_gap, MAKER.motor_height])
    way = motor - place
    half = 0.5 * WAY * way / np.hypot(*way) * (1 if winds_in else -1)
    begin, end = place - half, place + half
    return f"X{begin[0]:.2f} Y{begin[1]:.2f}", f"X{end[0]:.2f} Y{end[1]:.2f}"


def tried(
    scene: Scene, chain: str, place: tuple[float, float], feed: float, *, winds_in: bool
) -> SlipTry:
    """Let a chain slip on the way through a place."""
    machine, side = scene.machine, CHAINS.index(chain)
    begin, end = lines_along(chain, place, winds_in)
    scene.send([f"G0 {begin}", "G4 P300"])
    before = telemetry_of(scene).slips
    tensions = list[float]()

    def story() -> Iterator[float | None]:
        tensions.append(machine.tensions[side])
        machine.climb(chain)
        yield 0

    scene.send(
        [f"G1 {end} F{feed:g}", "G4 P300"],
        Strike(story(), machine.seconds + STRUCK_AFTER * WAY / feed * 60),
    )
    machine.slip(chain, -LINK)  # somebody lays the chain back
    seen = np.subtract(telemetry_of(scene).slips, before) % 256
    return SlipTry(feed, winds_in, tensions[0], int(seen[side]), int(seen[1 - side]))


def telemetry_of(scene: Scene) -> Telemetry:
    """Return what the machine answers to B30."""
    return latest("\n".join(scene.sender.ask("B30")), "B30")


def tries(
    seeds: Sequence[int], *, feeds: Sequence[float] = FEEDS, elf: str | None = None
) -> Iterator[SlipTry]:
    """Yield each chain, place, feed and direction on machines with these numbers."""
    for seed in seeds:
        scene = Scene(seed, elf=elf, friction=FRICTION)
        for chain in CHAINS:
            for place in PLACES:
                for feed in feeds:
                    for winds_in in (True, False):
                        yield tried(scene, chain, place, feed, winds_in=winds_in)


def table(done: Sequence[SlipTry]) -> str:
    """Return how often the slipping chain was suspected, by tension and feed."""
    head = ["tension, N", *(f"{feed:g} mm/min" for feed in FEEDS), "the other chain"]
    rows = [head, ["---"] * len(head)]
    for low, high in pairwise(TENSIONS):
        there = [each for each in done if low <= each.tension < high]
        if not there:
            continue
        by_feed = [[each.named for each in there if each.feed == feed] for feed in FEEDS]
        shares = [
            f"{np.count_nonzero(named)} of {len(named)}" if named else "–" for named in by_feed
        ]
        name = f"{low:g} to {high:g}" if high < TENSIONS[-1] else f"over {low:g}"
        rows.append([name, *shares, str(sum(each.other for each in there))])
    return "\n".join("| " + " | ".join(row) + " |" for row in rows)


def false_suspicions(hours: float, *, seeds: Sequence[int]) -> tuple[int, float]:
    """Suspicions in some hours of work on each machine, and the hours in all."""
    worked = [soak(60 * hours, seed=seed, friction=FRICTION) for seed in seeds]
    return sum(each.suspected for each in worked), sum(each.hours for each in worked)


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description="Chains that slip, and what is suspected.")
    parser.add_argument("machines", type=int)
    parser.add_argument("--first", type=int, default=1, help="number of the first machine [1]")
    parser.add_argument("--feed", type=float, help="[mm/min] this feed alone, one of the table's")
    parser.add_argument("--hours", type=int, default=0, help="of work without a slip [0]")
    parser.add_argument("--mega", metavar="ELF", help="run the flashed program")
    given = parser.parse_args()
    seeds = range(given.first, given.first + given.machines)
    feeds = [given.feed] if given.feed else FEEDS
    print(table(list(tries(seeds, feeds=feeds, elf=given.mega))))
    if given.hours:
        count, hours = false_suspicions(1, seeds=range(given.first, given.first + given.hours))
        print(f"\n{count} suspicions in {hours:.1f} hours of work without a slip")


if __name__ == "__main__":
    main()
