"""What C++ and Python share: a mutant, its outcome, the sample, the reasons of survivors."""

import json
import random
import resource
import subprocess
import tomllib
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

HANGS = 10  # times the usual time of a processor, after which tests count as fallen
LEAST = 3  # [s]
PATIENCE = 4  # times that on the clock: other work may have the processor, or nothing happens
MEMORY = 8 << 30  # [B] of the tests
KILLED, SURVIVED, SAME, STILLBORN = "killed", "survived", "same program", "does not compile"


@dataclass(frozen=True)
class Site:
    """A change that can be made at a line; `change` gives the whole text with it."""

    file: Path  # from the root, like all paths here
    line: int
    scope: str  # the function in Python, which a move to another file keeps; the file in C++
    original: str
    change: Callable[[], str]


@dataclass(frozen=True)
class Mutant:
    """A site with its change made, as people read it."""

    site: Site
    changed: str
    text: str

    @property
    def key(self) -> tuple[str, str, str]:
        """Its name, which stays when other lines change."""
        return self.site.scope, self.site.original, self.changed

    def __str__(self) -> str:
        place = f"{self.site.file}:{self.site.line}"
        return f"{place}: {self.site.original}  ->  {self.changed}"


def code_of(line: str) -> str:
    """Return a line without the comment of C++ at its end."""
    return line.partition("  //")[0].strip()


def mutant_of(site: Site, root: Path) -> Mutant:
    """Return the mutant at a site."""
    text, before = site.change(), (root / site.file).read_text().splitlines()
    pairs = zip(before, text.splitlines(), strict=False)
    changed = next((code_of(after) for line, after in pairs if line != after), site.original)
    return Mutant(site, changed, text)


def sampled(sites: list[Site], number: int | None, seed: int) -> list[Site]:
    """Return as many sites as asked for, by the seed and in their order; all without a number."""
    if number is None or number >= len(sites):
        return sites
    taken = sorted(random.Random(seed).sample(range(len(sites)), number))
    return [sites[index] for index in taken]


def recalled(sites: list[Site], saved: Path, root: Path, outcome: str) -> Iterator[Mutant]:
    """Yield the mutants of a saved sample that the tree still has; with an outcome, only those of
    it.
    """
    rows = json.loads(saved.read_text())
    wanted = Counter(tuple(row["key"]) for row in rows if outcome in (row["outcome"], ""))
    lines = {key[:2] for key in wanted}
    for site in sites:
        if (site.scope, site.original) in lines:
            mutant = mutant_of(site, root)
            if wanted[mutant.key] > 0:
                wanted[mutant.key] -= 1
                yield mutant


def save(path: Path, judged: dict[Mutant, str]) -> None:
    """Write the mutants and their outcomes."""
    rows = [
        {"key": mutant.key, "place": str(mutant), "outcome": outcome}
        for mutant, outcome in judged.items()
    ]
    path.write_text(json.dumps(rows, indent=1) + "\n")


def reasons(folder: Path) -> dict[tuple[str, str], str]:
    """Why the mutants of a line may survive, by file and line; from one TOML file a room."""
    return {
        (file, row["original"]): row["reason"]
        for path in sorted(folder.glob("*.toml"))
        for file, rows in tomllib.loads(path.read_text()).items()
        for row in rows
    }


def summary(room: str, judged: dict[Mutant, str], why: dict[tuple[str, str], str]) -> list[str]:
    """Return a line for each survivor without a reason, and the share of mutants that fall."""
    counts = Counter(judged.values())
    survivors = [mutant for mutant, outcome in judged.items() if outcome == SURVIVED]
    open_ones = [each for each in survivors if (str(each.site.file), each.site.original) not in why]
    counted = counts[KILLED] + len(open_ones)
    share = counts[KILLED] / counted if counted else 1
    return [
        *map(str, open_ones),
        f"{room}: {share:.1%} of {counted} mutants fall; {len(open_ones)} survive, "
        f"{len(survivors) - len(open_ones)} more at lines with a reason; "
        f"{counts[SAME]} make the same program, {counts[STILLBORN]} do not compile",
    ]


def tested(
    command: list, folder: Path, environment: dict[str, str], usual: float | None
) -> tuple[bool, float]:
    """Return whether tests pass, and their time of a processor [s]; a usual time bounds it."""
    most = int(HANGS * usual) + LEAST if usual else resource.RLIM_INFINITY
    patience = PATIENCE * most if usual else None

    def bound() -> None:
        resource.setrlimit(resource.RLIMIT_CPU, (most, most))
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    options = {"cwd": folder, "env": environment, "timeout": patience, "capture_output": True}
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    try:
        done = subprocess.run(command, preexec_fn=bound, **options)
    except subprocess.TimeoutExpired:
        return False, 0.0
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return done.returncode == 0, after.ru_utime - before.ru_utime
