"""Mutation testing: changes the code, one place at a time, and sees whether a test falls."""

import argparse
import random
import sys
import time

from ledger import Ledger, reasons, score, state_of
from mutants import SURVIVED, Mutant, Verdict
from rooms import FOLDER, ROOMS, ROOT, Room


def options() -> argparse.Namespace:
    """The command line."""
    parser = argparse.ArgumentParser(prog="tools/mutation/run", description=__doc__)
    parser.add_argument(
        "room", nargs="*", help=f"of {', '.join(each.name for each in ROOMS)}; all if none is named"
    )
    parser.add_argument(
        "--sample", type=int, metavar="N", help="so many mutants of each room, not all"
    )
    parser.add_argument(
        "--seed", type=int, default=1, metavar="S", help="another sample (default 1)"
    )
    parser.add_argument(
        "--at", default="", metavar="PART", help="only places (file:line:) with this in their name"
    )
    parser.add_argument(
        "--survivors",
        action="store_true",
        help="only those that survived the last run, with tests of now",
    )
    parser.add_argument(
        "--quick",
        action="store_true",
        help="only mutants that one build can hold, only quick tests, equivalents stay in",
    )
    parser.add_argument("--list", action="store_true", help="print the mutants, try none")
    return parser.parse_args()


def main() -> None:
    """Rooms one by one; exit 1 if a mutant survives without a reason."""
    asked = options()
    unknown = set(asked.room) - {room.name for room in ROOMS}
    if unknown:
        sys.exit(f"No room is called {', '.join(sorted(unknown))}; see --help for their names.")
    chosen = [room for room in ROOMS if not asked.room or room.name in asked.room]
    survivors = sum(run(room, asked) for room in chosen)
    sys.exit(survivors > 0)


def run(room: Room, asked: argparse.Namespace) -> int:
    """Judges the mutants of a room that have no verdict yet, prints its score; the survivors."""
    judge = room.open(asked.quick)
    mutants = sample(judge.mutants(), asked)
    if asked.list:
        print(*mutants, sep="\n")
        return 0
    state = state_of(ROOT, room.watched)
    ledger = Ledger(FOLDER / f"{room.name.replace('/', '_')}.json", state)
    waiting = waiting_in(ledger, mutants, asked.survivors)
    progress = Progress(room.name, len(waiting))

    def tell(mutant: Mutant, verdict: Verdict) -> None:
        ledger.note(mutant, verdict)
        progress.step(mutant, verdict)

    if waiting:
        judge.judge(waiting, tell)
    judged = {each: ledger.verdicts[each.key] for each in mutants if each.key in ledger.verdicts}
    result = score(room.name, judged, reasons(ROOT / "tools/mutation/reasons"))
    print(*result.survivors, result, sep="\n", flush=True)
    return len(result.survivors)


def waiting_in(ledger: Ledger, mutants: list[Mutant], only_survivors: bool) -> list[Mutant]:
    """The mutants to try now; verdicts on another state of the tree are void."""
    if only_survivors:
        return [each for each in mutants if is_survivor(ledger, each)]
    if not ledger.is_same:
        ledger.start_anew()
    return [each for each in mutants if each.key not in ledger.verdicts]


def is_survivor(ledger: Ledger, mutant: Mutant) -> bool:
    """Whether the last run let a mutant live."""
    verdict = ledger.verdicts.get(mutant.key)
    return verdict is not None and verdict.outcome == SURVIVED


def sample(mutants: list[Mutant], asked: argparse.Namespace) -> list[Mutant]:
    """All mutants that are asked for, or as many of them, by the seed."""
    wanted = [each for each in mutants if asked.at in f"{each.file}:{each.line}:"]
    if asked.sample is None or asked.sample >= len(wanted):
        return wanted
    taken = set(random.Random(asked.seed).sample(range(len(wanted)), asked.sample))
    return [each for index, each in enumerate(wanted) if index in taken]


class Progress:
    """One line for each mutant, with how many are left and how long it took so far."""

    def __init__(self, room: str, number: int):
        self.room, self.number, self.done, self.begun = room, number, 0, time.monotonic()
        print(f"{room}: {number} mutants to try", flush=True)

    def step(self, mutant: Mutant, verdict: Verdict) -> None:
        """One more is judged."""
        self.done += 1
        seconds = time.monotonic() - self.begun
        print(
            f"[{self.done}/{self.number} {seconds:.0f} s] {verdict.outcome} {mutant}",
            file=sys.stderr,
            flush=True,
        )


if __name__ == "__main__":
    main()
