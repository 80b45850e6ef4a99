"""Shared code of the checks: the project's files, and the report of violations."""

import os
import re
import sys
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

import pathspec

ROOT = Path(__file__).resolve().parents[2]
CXX = {".h", ".hpp", ".cpp"}
NOT_CODE = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.DOTALL)
# What tools/page/make writes; a test of the lab makes it again and compares.
BUILT = ("tools/plumb/lab/page", "tools/page/src/api/schema.ts")


def own_files(root: Path) -> list[Path]:
    """Files below `root` that belong to the project: all that its .gitignore does not name.

    It needs no git, so a downloaded archive of the project can be checked as well.
    """
    listed = root / ".gitignore"
    ignored = pathspec.GitIgnoreSpec.from_lines(
        text_of(listed).splitlines() if listed.is_file() else []
    )
    files = []
    for folder, folders, names in os.walk(root):
        here = Path(folder).relative_to(root)
        # What is ignored is not entered: .venv alone holds more files than the project.
        folders[:] = [
            name
            for name in folders
            if name != ".git" and not ignored.match_file(f"{(here / name).as_posix()}/")
        ]
        files += [
            root / here / name for name in names if not ignored.match_file((here / name).as_posix())
        ]
    built = [root / name for name in BUILT]
    return sorted(
        path
        for path in files
        if path.is_file() and not any(path.is_relative_to(each) for each in built)
    )


def text_of(path: Path) -> str:
    """Return the text of a file; empty if it is none."""
    try:
        return path.read_text(encoding="utf-8")
    except UnicodeDecodeError:
        return ""


def cxx_code(root: Path) -> Iterator[tuple[Path, str]]:
    """Yield the name and the code of each C++ file, without the words of comments and strings."""
    for path in own_files(root):
        if path.suffix in CXX:
            code = NOT_CODE.sub(lambda match: "\n" * match[0].count("\n"), text_of(path))
            yield path.relative_to(root), code


def is_python(path: Path) -> bool:
    """Return whether a file is Python, by its name or its first line."""
    return path.suffix == ".py" or first_line(path).endswith("python3")


def is_shell(path: Path) -> bool:
    """Return whether a file is a shell script, by its name or its first line."""
    return path.suffix == ".sh" or first_line(path).endswith("bash")


def first_line(path: Path) -> str:
    """Return the line that names the interpreter, or nothing."""
    line = text_of(path).partition("\n")[0] if not path.suffix else ""
    return line if line.startswith("#!") else ""


def run(find: Callable[[Path], Iterable[str]], good: str) -> None:
    """Print what `find` finds in the project and exits 1, or prints `good`.

    An argument on the command line names another folder.
    """
    root = Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else ROOT
    violations = list(find(root))
    print(*violations or [good], sep="\n")
    sys.exit(bool(violations))
