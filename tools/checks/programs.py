"""Every program that a script, a tool or a test calls comes from a package that setup names."""

import re
import shutil
import subprocess
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import calls
import tree

PACKAGES = "tools/setup_steps/debian_packages.txt"
GROUPS = ("lab", "all", "base")


@dataclass(frozen=True)
class Package:
    """One row of the list: a Debian package and what it is there for."""

    line: int
    name: str
    group: str
    programs: tuple[str, ...]


def violations(root: Path) -> Iterator[str]:
    """Yield each program without a package, each row that is wrong or useless, one line each."""
    packages, mistakes = read_packages(root)
    yield from mistakes
    brought = {program for package in packages for program in package.programs}
    called = called_programs(root)
    for program, place in sorted(called.items()):
        if program not in brought:
            yield f"{place}: calls {program}, which no package in {PACKAGES} brings"
    for package in packages:
        for program in package.programs:
            if program not in called:
                yield f"{PACKAGES}:{package.line}: nothing calls {program} of {package.name}"
        yield from wrong_programs(package)


def called_programs(root: Path) -> dict[str, str]:
    """Return each program that the project calls, with the first place that does."""
    files = tree.own_files(root)
    functions = frozenset().union(
        *(calls.functions_of(tree.text_of(path)) for path in files if tree.is_shell(path))
    )
    called = {}
    for path in files:
        for line, program in calls.programs_in(path, tree.text_of(path), functions):
            called.setdefault(program, f"{path.relative_to(root)}:{line}")
    return called


def read_packages(root: Path) -> tuple[list[Package], list[str]]:
    """Return the rows of the list, and one line for each row that cannot be read."""
    packages, mistakes = [], []
    for number, text in enumerate(tree.text_of(root / PACKAGES).splitlines(), 1):
        if not text.strip() or text.startswith("#"):
            continue
        fields = [field.strip() for field in text.split("|")]
        if len(fields) != 4 or fields[1] not in GROUPS or not fields[3]:
            mistakes.append(
                f"{PACKAGES}:{number}: write package | lab, all or base | programs | why"
            )
            continue
        programs = () if fields[2] == "-" else tuple(fields[2].split())
        packages.append(Package(number, fields[0], fields[1], programs))
    return packages, mistakes


def wrong_programs(package: Package) -> Iterator[str]:
    """Yield the programs of a row that its package, where it is installed, does not bring."""
    files = files_of(package.name)
    for program in package.programs if files else ():
        # A link that Debian keeps for several versions, like g++ or awk, belongs to no package.
        places = {f"{folder}/{program}" for folder in ("/bin", "/usr/bin", "/sbin", "/usr/sbin")}
        if not places & files:
            yield f"{PACKAGES}:{package.line}: {package.name} does not bring {program}"


def files_of(package: str) -> set[str]:
    """Return the files of an installed package and of those it stands for; empty where that is
    unknown.
    """
    if not shutil.which("dpkg-query"):
        return set()
    done = subprocess.run(["dpkg-query", "-L", package], capture_output=True, text=True)
    files = set(done.stdout.split("\n")) if not done.returncode else set()
    needs = subprocess.run(
        ["dpkg-query", "-W", "-f", "${Pre-Depends}, ${Depends}", package],
        capture_output=True,
        text=True,
    )
    for name in re.findall(r"(?:^|, )([a-z0-9][a-z0-9+.-]*)", needs.stdout) if files else ():
        done = subprocess.run(["dpkg-query", "-L", name], capture_output=True, text=True)
        files |= set(done.stdout.split("\n"))
    return files


if __name__ == "__main__":
    tree.run(violations, "programs: a package brings each program that is called")
