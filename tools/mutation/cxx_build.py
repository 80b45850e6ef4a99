"""Builds of the host's suites from a copy of the tree, in which a file may hold mutants.

Ninja builds what a change of a file asks for, and no more: PlatformIO would look at everything
again for each mutant.
"""

import configparser
import hashlib
import os
import re
import shutil
import subprocess
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

HERE = Path(__file__).resolve().parent
NINJA = HERE.parents[1] / ".venv/bin/ninja"
COPIED = ("include", "lib", "src", "test", "tools/judge", "tools/core", "tools/vm")
ERROR = re.compile(r"^(\S+?):(\d+):\d+: (?:fatal )?(error|note):", re.MULTILINE)
# Compiles faster than -O2, and no test takes longer.
OPTIMISED = ["-O1", "-w"]
# Each function by itself, or a test's constants would hide what a mutant does with other numbers.
APART = ["-fno-inline"]
# A precompiled header halves the time that a suite's file takes.
RULES = """
rule object
  command = g++ -MMD -MF $out.d $flags -c $in -o $out
  depfile = $out.d
  deps = gcc
rule program
  command = g++ $in -o $out
"""


@dataclass(frozen=True)
class Layout:
    """Where files lie: each suite's folder, and the sources that every suite is linked with."""

    suites: dict[str, Path]  # relative to the root, like all paths here
    shared: tuple[Path, ...]
    includes: tuple[Path, ...]


def layout_of(root: Path, suites: list[str]) -> Layout:
    """Plumb's layout, as platformio.ini has it."""
    folders = ("lib/*/src/**", "src/machine/**", "tools/judge/reference")
    shared = [path for folder in folders for path in root.glob(f"{folder}/*.cpp")]
    includes = [
        "include",
        "src",
        *sorted(root.glob("lib/*/src")),
        "test",
        *words_after("-I", root),
    ]
    return Layout(
        {name: Path("test") / name for name in suites},
        tuple(sorted(path.relative_to(root) for path in shared)),
        tuple((root / path).relative_to(root) for path in includes),
    )


class Build:
    """A copy of the tree in `folder`, and the suites built from it."""

    def __init__(self, root: Path, folder: Path, layout: Layout, libraries: Path, flags: list[str]):
        self.root, self.folder, self.layout = root, folder.resolve(), layout
        self.tree, self.plain = self.folder / "tree", self.folder / "plain"
        self.libraries, self.flags = libraries.resolve(), flags
        self._copy()
        self._write_rules()

    def put(self, path: Path, text: bytes) -> None:
        """Writes a file of the copy; one that stays as it is keeps its time, and so its objects."""
        target = self.tree / path
        if not target.is_file() or target.read_bytes() != text:
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_bytes(text)

    def make(self, targets: list[str]) -> str:
        """Builds targets, up to the first error; what the compiler says then, else nothing."""
        done = subprocess.run(
            [NINJA, "-j", jobs(), "-C", str(self.folder), *targets],
            env=environment(),
            capture_output=True,
            text=True,
        )
        return (done.stdout + done.stderr) if done.returncode else ""

    def program(self, suite: str) -> Path:
        """The program of a suite."""
        return self.folder / suite

    def errors(self, output: str) -> dict[str, list[tuple[Path, int]]]:
        """Files of the copy, and lines, at which errors and notes of the compiler point."""
        places: dict[str, list[tuple[Path, int]]] = {"error": [], "note": []}
        for name, line, kind in ERROR.findall(output):
            path = (self.folder / name).resolve()
            if path.is_relative_to(self.tree):
                places[kind].append((path.relative_to(self.tree), int(line)))
        return places

    def users(self, path: Path) -> list[Path]:
        """Sources of which the objects depend on a file."""
        done = subprocess.run(
            [NINJA, "-C", str(self.folder), "-t", "deps"],
            env=environment(),
            capture_output=True,
            text=True,
        )
        users = []
        for block in done.stdout.split("\n\n"):
            read = [self.folder / line.strip() for line in block.splitlines()[1:]]
            sources = [
                each for each in read if each.suffix == ".cpp" and each.is_relative_to(self.tree)
            ]
            if sources and self.tree / path in read:
                users.append(sources[0].relative_to(self.tree))
        return sorted(users)

    def digest(self, source: Path, instead: tuple[Path, bytes] | None = None) -> str:
        """Of the object of a source without switches, with one file changed or none."""
        output = self.folder / "compared.o"
        output.unlink(missing_ok=True)
        framework = ["-include", "framework.h"] if source.parts[0] == "test" else []
        flags = [
            *self.flags,
            *OPTIMISED,
            *APART,
            *framework,
            f"-I{self.folder}",
            *self._include_flags(self.plain, source),
        ]
        if instead:
            original = (self.plain / instead[0]).read_bytes()
            (self.plain / instead[0]).write_bytes(instead[1])
        subprocess.run(
            ["g++", *flags, "-c", str(self.plain / source), "-o", str(output)],
            env=environment(),
            capture_output=True,
        )
        if instead:
            (self.plain / instead[0]).write_bytes(original)
        return (
            hashlib.sha256(output.read_bytes()).hexdigest()
            if output.is_file()
            else "does not compile"
        )

    def _copy(self) -> None:
        """The tree twice: a copy that is mutated, and a plain copy whose objects are compared."""
        shutil.rmtree(self.plain, ignore_errors=True)
        wanted = set()
        for part in COPIED:
            for path in (self.root / part).rglob("*"):
                if path.is_file():
                    name = path.relative_to(self.root)
                    wanted.add(name)
                    self.put(name, path.read_bytes())
                    plain = self.plain / name
                    plain.parent.mkdir(parents=True, exist_ok=True)
                    shutil.copyfile(path, plain)
        for path in list(self.tree.rglob("*")):
            if path.is_file() and path.relative_to(self.tree) not in wanted:
                path.unlink()

    def _include_flags(self, tree: Path, source: Path) -> list[str]:
        folders = [*self.layout.includes, source.parent]
        borrowed = [
            self.libraries / "googletest/googletest/include",
            self.libraries / "ArduinoEigen/ArduinoEigen",
        ]
        return [
            *(f"-I{tree / each}" for each in folders),
            *(f"-isystem{each}" for each in borrowed),
        ]

    def _write_rules(self) -> None:
        """build.ninja: objects of lib and src once, and one program for each suite."""
        self.put(Path("../switch.h"), (HERE / "switch.h").read_bytes())
        self.put(Path("../reach.cpp"), (HERE / "reach.cpp").read_bytes())
        self.put(Path("../framework.h"), b'#include <gtest/gtest.h>\n#include "switch.h"\n')
        google = self.libraries / "googletest/googletest"
        common = [*self.flags, *OPTIMISED]
        lines = [RULES]
        lines += self._object(
            "framework.h.gch", self.folder / "framework.h", [*common, "-x", "c++-header"]
        )
        lines += self._object("gtest.o", google / "src/gtest-all.cc", [*common, f"-I{google}"])
        lines += self._object("reach.o", self.folder / "reach.cpp", common)
        shared = ["gtest.o", "reach.o"]
        for source in self.layout.shared:
            shared.append(f"objects/{source}.o")
            lines += self._object(shared[-1], self.tree / source, [*common, "-include", "switch.h"])
        for suite, folder in self.layout.suites.items():
            objects = []
            for source in sorted((self.tree / folder).glob("*.cpp")):
                name = source.relative_to(self.tree)
                objects.append(f"objects/{name}.o")
                flags = [*common, "-include", "framework.h"]
                lines += self._object(objects[-1], source, flags, "framework.h.gch")
            lines.append(f"build {suite}: program {' '.join([*objects, *shared])}")
        self.put(Path("../build.ninja"), "\n".join([*lines, ""]).encode())

    def _object(self, output: str, source: Path, flags: list[str], first: str = "") -> list[str]:
        inside = source.is_relative_to(self.tree)
        name = source.relative_to(self.tree) if inside else Path("none")
        flags = [*flags, f"-I{self.folder}", *self._include_flags(self.tree, name)]
        after = f" | {first}" if first else ""
        return [f"build {output}: object {source}{after}", f"  flags = {' '.join(map(str, flags))}"]


def flags_of(root: Path) -> list[str]:
    """The flags that platformio.ini gives to host tests, but for paths and the optimiser's."""
    words = host_flags(root)
    return [word for word in words if word.startswith(("-std", "-f", "-D"))] + ["-Wno-narrowing"]


def words_after(flag: str, root: Path) -> list[str]:
    """What stands behind a flag of the host tests."""
    words = host_flags(root)
    return [word for before, word in pairwise(words) if before == flag]


def host_flags(root: Path) -> list[str]:
    """The words of the host tests' flags in platformio.ini."""
    options = configparser.ConfigParser(comment_prefixes=(";",), interpolation=None)
    options.read(root / "platformio.ini")
    return options["env:native"]["build_flags"].split()


def jobs() -> str:
    """Compilers at a time."""
    return os.environ.get("PLUMB_JOBS", "2")


def environment() -> dict[str, str]:
    """The environment with the compiler's cache, where it is installed."""
    return {**os.environ, "PATH": f"/usr/lib/ccache{os.pathsep}{os.environ.get('PATH', '')}"}
