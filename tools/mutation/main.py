"""Mutation testing: changes the code, one place at a time, and sees whether a test falls."""

import argparse
import sys
import time
from pathlib import Path

import cxx
import python
from mutants import SURVIVED, Mutant, mutant_of, reasons, recalled, sampled, save, summary

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / ".build/mutation"
# What judges a room, the nearest first; a room of the lab that is not here has its room of tests.
TESTS = {
    "lib/Kinematics": ("test_kinematics", "test_effects"),
    "lib/Motion": ("test_motion", "test_control"),
    "lib/GCode": ("test_gcode",),
    "lib/Settings": ("test_settings",),
    "src/machine": ("test_machine", "test_control", "test_dialogues"),
    "tools/plumb/diary": ("tools/tests/diary", "tools/tests/cli/test_diary_and_recheck.py"),
    "tools/plumb/job": ("tools/tests/job", "tools/tests/cli/test_slip_and_home.py"),
}


def options() -> argparse.Namespace:
    """Return the command line."""
    parser = argparse.ArgumentParser(prog="tools/mutation/run", description=__doc__)
    parser.add_argument("room", help="a folder or a file, like lib/Motion or tools/plumb/fit")
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
    room = asked.room.rstrip("/")
    mutants = mutants_of(room, asked)
    if asked.list or not mutants:
        print(*mutants or [f"{room} has no such mutant"], sep="\n")
        sys.exit(not mutants)
    outcomes = judged(room, mutants, asked.save)
    *survivors, score = summary(room, outcomes, reasons(ROOT / "tools/mutation/reasons"))
    print(*survivors, score, sep="\n")
    sys.exit(bool(survivors))


def files_of(room: str) -> list[Path]:
    """Return the sources of a room, from the root."""
    place = ROOT / room
    files = [path for path in place.rglob("*") if path.suffix in (".py", ".h", ".cpp")]
    return sorted(path.relative_to(ROOT) for path in files or [place])


def tests_of(room: str) -> tuple[str, ...]:
    """Return the suites or tests that judge a room."""
    named = [tests for name, tests in TESTS.items() if Path(room).is_relative_to(name)]
    return named[0] if named else (f"tools/tests/{Path(room).parts[2]}",)


def mutants_of(room: str, asked: argparse.Namespace) -> list[Mutant]:
    """Return the mutants that are asked for."""
    sites = [
        site
        for file in files_of(room)
        for site in (python if file.suffix == ".py" else cxx).sites(ROOT, file)
        if asked.at in f"{file}:{site.line}:"
    ]
    if asked.again:
        return list(recalled(sites, asked.again, ROOT, SURVIVED if asked.survivors else ""))
    return [mutant_of(site, ROOT) for site in sampled(sites, asked.sample, asked.seed)]


def judged(room: str, mutants: list[Mutant], kept: Path | None) -> dict[Mutant, str]:
    """Return the outcome of each mutant, printed and kept as it comes."""
    begun, outcomes = time.monotonic(), {}
    file, folder = mutants[0].site.file, FOLDER / room.replace("/", "_")
    judge = (python if file.suffix == ".py" else cxx).Judge(ROOT, folder, tests_of(room), file)
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
