"""Mutation testing: changes the code, one place at a time, and sees whether a test falls."""

import argparse
import sys
import time
from pathlib import Path

from mutants import SURVIVED, Mutant, mutant_of, reasons, recalled, sampled, save, summary
from rooms import FOLDER, ROOMS, ROOT, Room


def options() -> argparse.Namespace:
    """The command line."""
    parser = argparse.ArgumentParser(prog="tools/mutation/run", description=__doc__)
    parser.add_argument("room", choices=[room.name for room in ROOMS], metavar="ROOM",
                        help=f"one of {', '.join(room.name for room in ROOMS)}")  # fmt: skip
    parser.add_argument("--sample", type=int, metavar="N", help="so many mutants, not all")
    parser.add_argument("--seed", type=int, default=1, metavar="S", help="another sample")
    parser.add_argument("--at", default="", metavar="PART", help="only places like file:line:")
    parser.add_argument("--save", type=Path, metavar="FILE", help="write mutants and outcomes")
    parser.add_argument("--again", type=Path, metavar="FILE", help="judge a saved sample again")
    parser.add_argument("--survivors", action="store_true", help="of those only the survivors")
    parser.add_argument("--list", action="store_true", help="print the mutants, try none")
    return parser.parse_args()


def main() -> None:
    """Judges mutants of a room and prints its score; exit 1 if one survives without a reason."""
    asked = options()
    room = next(room for room in ROOMS if room.name == asked.room)
    mutants = mutants_of(room, asked)
    if asked.list:
        print(*mutants, sep="\n")
        return
    *survivors, score = summary(
        room.name, judged(room, mutants, asked.save), reasons(ROOT / "tools/mutation/reasons")
    )
    print(*survivors, score, sep="\n")
    sys.exit(bool(survivors))


def mutants_of(room: Room, asked: argparse.Namespace) -> list[Mutant]:
    """The mutants that are asked for."""
    sites = [site for file in room.files() for site in room.language.sites(ROOT, file)]
    sites = [site for site in sites if asked.at in f"{site.file}:{site.line}:"]
    if asked.again:
        return list(recalled(sites, asked.again, ROOT, SURVIVED if asked.survivors else ""))
    return [mutant_of(site, ROOT) for site in sampled(sites, asked.sample, asked.seed)]


def judged(room: Room, mutants: list[Mutant], kept: Path | None) -> dict[Mutant, str]:
    """The outcome of each mutant, printed and kept as it comes."""
    begun, outcomes = time.monotonic(), {}
    if mutants:
        folder = FOLDER / room.name.replace("/", "_")
        judge = room.language.Judge(ROOT, folder, room.tests, mutants[0].site.file)
    for number, mutant in enumerate(mutants, 1):
        outcomes[mutant] = judge.outcome(mutant)
        seconds = time.monotonic() - begun
        progress = f"[{number}/{len(mutants)} {seconds:.0f} s] {outcomes[mutant]} {mutant}"
        print(progress, file=sys.stderr, flush=True)
        if kept:
            save(kept, outcomes)
    return outcomes


if __name__ == "__main__":
    main()
