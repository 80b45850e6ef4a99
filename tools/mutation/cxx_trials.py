"""Which tests reach a mutant, and whether one of them falls."""

import os
import resource
import subprocess
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

SHORT = 0.2  # [s] of tests that are played first, together
LEAST_LIMIT = 3.0  # [s]
TIMES_LIMIT = 10  # times as long as it takes without a mutant, and it is taken to hang


@dataclass
class Suite:
    """A built suite: how long each test takes [s], and which mutants it reaches."""

    name: str
    program: Path
    seconds: dict[str, float] = field(default_factory=dict)
    reached: dict[str, set[int]] = field(default_factory=dict)
    files: dict[str, Path] = field(default_factory=dict)

    def record(self, tree: Path) -> None:
        """Plays the suite once without a mutant. A suite that fails then can judge nothing."""
        notes = self.program.parent / f"{self.name}.reach"
        done = play(self.program, tree, {"PLUMB_REACH": str(notes)}, None)
        if done.returncode:
            raise RuntimeError(f"{self.name} fails without any mutant:\n{done.stdout[-2000:]}")
        self.seconds.clear()
        self.reached.clear()
        for line in notes.read_text().splitlines():
            test, file, ms, *numbers = line.split()
            self.files[test] = Path(f"/{file}".rpartition("/tree/")[2])
            self.reached.setdefault(test, set()).update(map(int, numbers))
            if test != "*":
                self.seconds[test] = int(ms) / 1000

    def tests(self, patience: float) -> list[str]:
        """The tests that take no longer than `patience` [s], the fastest first."""
        tests = [test for test in self.seconds if self.seconds[test] <= patience]
        return sorted(tests, key=lambda test: self.seconds[test])

    def tests_of(self, mutant: int, patience: float) -> list[str]:
        """Those that reach a mutant; all if it is reached before any test."""
        everywhere = mutant in self.reached.get("*", ())
        return [test for test in self.tests(patience) if everywhere or mutant in self.reached[test]]

    def files_of(self, mutant: int) -> set[Path]:
        """The sources of the tests that reach a mutant, from the root."""
        return {self.files[test] for test in self.seconds if mutant in self.reached[test]}

    def fallen(self, tree: Path, tests: list[str], mutant: int = 0) -> str:
        """The first of these tests that falls, "hangs", "crashes" or nothing."""
        for batch in batches(tests, self.seconds):
            limit = LEAST_LIMIT + TIMES_LIMIT * sum(self.seconds[test] for test in batch)
            environment = {
                "PLUMB_MUTANT": str(mutant),
                "GTEST_FILTER": ":".join(batch),
                "GTEST_FAIL_FAST": "1",
            }
            try:
                done = play(self.program, tree, environment, limit)
            except subprocess.TimeoutExpired:
                return "hangs"
            if done.returncode:
                return first_failure(done.stdout)
        return ""


def first_failure(output: str) -> str:
    """The first test that GoogleTest names as failed; a program that ended before that crashed."""
    for line in output.splitlines():
        words = line.partition("[  FAILED  ] ")[2].replace(",", " ").split()
        if words and "." in words[0]:
            return words[0]
    return "crashes"


def batches(tests: list[str], seconds: dict[str, float]) -> Iterator[list[str]]:
    """The quick tests in one run, the others in another."""
    quick, spent = [], 0.0
    for test in tests:
        spent += seconds[test]
        if spent > SHORT and quick:
            break
        quick.append(test)
    if quick:
        yield quick
    if tests[len(quick) :]:
        yield tests[len(quick) :]


def play(program: Path, tree: Path, variables: dict[str, str], limit: float | None):
    """Runs a suite; a mutant that asks for all memory is stopped, too."""
    return subprocess.run(
        [str(program)],
        cwd=tree,
        env={**os.environ, **variables},
        preexec_fn=bound_memory,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
        errors="replace",
        timeout=limit,
    )


def bound_memory() -> None:
    """4 GB at most, and no core file of a crash."""
    resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
