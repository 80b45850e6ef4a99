"""C++: mutants by universalmutator, each judged by the host's suites in a copy of the tree."""

import contextlib
import hashlib
import io
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

from mutants import KILLED, SAME, STILLBORN, SURVIVED, Mutant, Site, code_of, tested
from universalmutator.mutator import mutants_regexp

RULES = Path(__file__).with_name("plumb.rules")
# Lines of the preprocessor or of the compiler alone, and rows with words, which are data.
LEFT_ALONE = (r"^\s*#", r"static_assert|^\s*template |\boperator\b", r'[{(]\s*".*",|, ".*"\s*[,)}]')
COPIED = ("include", "lib", "src", "test", "tools/judge", "tools/core", "tools/vm")
LINKED = (".platformio", ".pio/libdeps")
PIO = Path(sys.executable).with_name("pio")
# No mutant falls by a warning. Each function by itself, or a test's constants would hide what a
# mutant does with other numbers. No lines for debuggers: programs are compared.
FLAGS = {"-Werror": "-w -Wno-narrowing -fno-inline", "-O2 -g1": "-O1 -g0"}


def sites(root: Path, file: Path) -> Iterator[Site]:
    """Yield each change of a file by each rule, in the file's order."""
    lines = (root / file).read_text().splitlines(keepends=True)
    with contextlib.redirect_stdout(io.StringIO()):
        changes = mutants_regexp(
            lines, [str(RULES)], ignorePatterns=LEFT_ALONE, ignoreStringOnly=True
        )
    for number, changed, *_ in changes:

        def change(number: int = number, changed: str = changed) -> str:
            return "".join([*lines[: number - 1], changed, *lines[number:]])

        yield Site(file, number, str(file), code_of(lines[number - 1]), change)


class Judge:
    """The suites of a room, the nearest first, built by PlatformIO in a copy of the tree."""

    def __init__(self, root: Path, folder: Path, suites: tuple[str, ...], file: Path):
        self.root, self.tree, self.suites = root, folder, suites
        self.program = folder / ".pio/build/native/program"
        self.copy()
        self.digests: dict[str, str] = {}
        self.usual: dict[str, float] = {}
        for suite in suites:
            if not self.builds(suite):
                sys.exit(f"{suite} does not build without any mutant.")
            passes, self.usual[suite] = self.run(None)
            if not passes:
                sys.exit(f"{suite} fails without any mutant.")
            self.digests[suite] = self.digest()

    def outcome(self, mutant: Mutant) -> str:
        """Return what becomes of a mutant."""
        file = self.tree / mutant.site.file
        outcome = SAME
        file.write_text(mutant.text)
        try:
            for suite in self.suites:
                if not self.builds(suite):
                    return STILLBORN
                if self.digest() == self.digests[suite]:
                    continue
                if not self.run(self.usual[suite])[0]:
                    return KILLED
                outcome = SURVIVED
            return outcome
        finally:
            shutil.copyfile(self.root / mutant.site.file, file)

    def copy(self) -> None:
        """Copy what the suites are built from, with other flags."""
        for part in COPIED:
            shutil.rmtree(self.tree / part, ignore_errors=True)
            shutil.copytree(self.root / part, self.tree / part)
        shutil.copy(self.root / "tools/own_flags.py", self.tree / "tools")
        for part in LINKED:
            (self.tree / part).parent.mkdir(exist_ok=True)
            if not (self.tree / part).is_symlink():
                (self.tree / part).symlink_to(self.root / part)
        options = (self.root / "platformio.ini").read_text()
        for before, after in FLAGS.items():
            options = options.replace(before, after)
        (self.tree / "platformio.ini").write_text(options)

    def builds(self, suite: str) -> bool:
        """Return whether the program of a suite builds."""
        self.program.unlink(missing_ok=True)
        command = [PIO, "test", "-e", "native", "--filter", suite, "--without-testing"]
        path = f"/usr/lib/ccache{os.pathsep}{os.environ.get('PATH', '')}"
        subprocess.run(
            command, cwd=self.tree, env={**os.environ, "PATH": path}, capture_output=True
        )
        return self.program.is_file()

    def run(self, usual: float | None) -> tuple[bool, float]:
        """Return whether the program's tests pass, and their time."""
        return tested([self.program], self.tree, {**os.environ, "GTEST_FAIL_FAST": "1"}, usual)

    def digest(self) -> str:
        """Return a number for the program's bytes."""
        return hashlib.sha256(self.program.read_bytes()).hexdigest()
