"""Mutants of C++, judged by the host's suites."""

import dataclasses
import math
from collections import Counter
from collections.abc import Callable, Iterable
from pathlib import Path

import cxx_sites
from cxx_build import Build
from cxx_schema import mutated, shown, with_switches
from cxx_sites import Site
from cxx_trials import Suite
from mutants import EQUIVALENT, KILLED, STILLBORN, SURVIVED, Mutant, Verdict

QUICK_TEST = 0.3  # [s]
UNREACHED = "no test reaches it"
MOST_ROUNDS = 12  # of builds until all that is left compiles


class CxxRoom:
    """The mutants of some files, and the suites that judge them, the nearest first."""

    def __init__(
        self, root: Path, files: list[Path], make_build: Callable[[], Build], is_quick: bool
    ):
        self.root, self.files, self.make_build = root, files, make_build
        self.is_quick = is_quick
        self.patience = QUICK_TEST if is_quick else math.inf
        self.texts = {path: (root / path).read_bytes() for path in files}
        self.words = {}
        self.sites: dict[Mutant, tuple[Path, Site]] = {}
        for path in files:
            sites, self.words[path] = cxx_sites.read(self.texts[path])
            self._name(path, sites)

    def mutants(self) -> list[Mutant]:
        """All of them, in the files' order."""
        return list(self.sites)

    def judge(self, mutants: Iterable[Mutant], tell: Callable[[Mutant, Verdict], None]) -> None:
        """Tries each mutant and tells what became of it."""
        self.build = self.make_build()
        self.users: dict[Path, list[Path]] = {}
        self.digests: dict[Path, str] = {}
        self.suites = [Suite(name, self.build.program(name)) for name in self.build.layout.suites]
        numbers = {number: mutant for number, mutant in enumerate(mutants, 1)}
        chosen, alone = self._switched(numbers)
        for suite in self.suites:
            suite.record(self.build.tree)
        for number, mutant in chosen.items():
            tell(mutant, self._checked(mutant, self._by_switch(number), number))
        for mutant in [] if self.is_quick else alone:
            tell(mutant, self._checked(mutant, self._by_build(mutant)))

    def _name(self, path: Path, sites: list[Site]) -> None:
        seen: Counter = Counter()
        for site in sites:
            original, changed = shown(self.texts[path], site)
            twin = seen[original, changed]
            seen[original, changed] += 1
            self.sites[Mutant(str(path), site.line, original, changed, twin)] = (path, site)

    def _switched(self, numbers: dict[int, Mutant]) -> tuple[dict[int, Mutant], list[Mutant]]:
        """Builds the suites with all mutants that one build can hold; those, and the others."""
        chosen = {n: m for n, m in numbers.items() if not self.sites[m][1].is_constant}
        for _ in range(MOST_ROUNDS):
            self._put(chosen)
            output = self.build.make(list(self.build.layout.suites))
            if not output:
                break
            places = self.build.errors(output)
            refused = self._at(chosen, places["error"]) or self._at(chosen, places["note"])
            if not refused:
                raise RuntimeError(f"The suites do not build:\n{output[-3000:]}")
            chosen = {n: m for n, m in chosen.items() if n not in refused}
        else:
            raise RuntimeError(
                f"The suites do not build after {MOST_ROUNDS} rounds:\n{output[-3000:]}"
            )
        return chosen, [mutant for number, mutant in numbers.items() if number not in chosen]

    def _put(self, chosen: dict[int, Mutant]) -> None:
        for path, text in self.texts.items():
            sites = {n: self.sites[m][1] for n, m in chosen.items() if self.sites[m][0] == path}
            self.build.put(path, with_switches(text, sites, self.words[path]))

    def _at(self, chosen: dict[int, Mutant], places: list[tuple[Path, int]]) -> set[int]:
        """Mutants at some lines."""
        at = set(places)
        return {
            number
            for number, mutant in chosen.items()
            for path, site in [self.sites[mutant]]
            if any(
                (path, line) in at
                for line in range(self._first_line(path, site), site.last_line + 1)
            )
        }

    def _first_line(self, path: Path, site: Site) -> int:
        return self.texts[path].count(b"\n", 0, site.start) + 1

    def _by_switch(self, number: int) -> Verdict:
        """The verdict of the tests that reach a mutant."""
        reached = False
        for suite in self.suites:
            tests = suite.tests_of(number, self.patience)
            reached = reached or bool(tests)
            fallen = suite.fallen(self.build.tree, tests, number)
            if fallen:
                return Verdict(KILLED, f"{suite.name} {fallen}")
        return Verdict(SURVIVED, "" if reached else UNREACHED)

    def _by_build(self, mutant: Mutant) -> Verdict:
        """The verdict on a mutant that needs a separate build: constants of the compiler."""
        path, site = self.sites[mutant]
        changed = mutated(self.texts[path], site)
        for suite in self.suites:
            self.build.put(path, changed)
            output = self.build.make([suite.name])
            if output:
                return Verdict(STILLBORN)
            fallen = suite.fallen(self.build.tree, suite.tests(self.patience))
            if fallen:
                return Verdict(KILLED, f"{suite.name} {fallen}")
        return Verdict(SURVIVED)

    def _checked(self, mutant: Mutant, verdict: Verdict, number: int = 0) -> Verdict:
        """A survivor of which every object is that of the original is none.

        A template that no test reaches is in no object, which says nothing about its mutants.
        """
        if verdict.outcome != SURVIVED or verdict.by == UNREACHED or self.is_quick:
            return verdict
        path, site = self.sites[mutant]
        changed = mutated(self.texts[path], site)
        for source in self._users(path, number):
            if source not in self.digests:
                self.digests[source] = self.build.digest(source)
            if self.build.digest(source, (path, changed)) != self.digests[source]:
                return verdict
        return dataclasses.replace(verdict, outcome=EQUIVALENT)

    def _users(self, path: Path, number: int) -> list[Path]:
        """Sources that read a file, those first of which a test reaches the mutant."""
        if path not in self.users:
            self.users[path] = self.build.users(path)
        near = {file for suite in self.suites for file in suite.files_of(number)}
        return sorted(self.users[path], key=lambda source: source not in near)
