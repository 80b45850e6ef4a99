"""Findings of clang-format, ruff, shellcheck and codespell; `--fix` rewrites C++ and Python."""

import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import tree

TOOLS = Path(sys.executable).parent
CONCISE = ["--output-format", "concise"]


# A step of setup gets its variables from the script that sources it: SC2154.
SHELLCHECK = ["shellcheck", "-s", "bash", "-e", "SC2154", "-f", "gcc"]
# Words that codespell takes for misspelled others.
SPELLED_RIGHTLY = "statics,fro"
CAMEL_CASE = r"\b[a-z]+[A-Z]\w*"
PROSE = {".md", ".py", ".ts", ".tsx", ".css", ".sh", ".ini", ".toml", *tree.CXX}


def violations(root: Path) -> Iterator[str]:
    """Yield the first place in each file at which one of the programs would change something."""
    cxx, python = both_kinds(root)
    if cxx:
        yield from first_in_each_file([*clang_format(), "--dry-run", "--Werror", *cxx], root)
    if python:
        yield from first_in_each_file([*ruff("check"), *CONCISE, *python], root)
        yield from first_in_each_file([*ruff("format"), "--check", *CONCISE, *python], root)
    files = tree.own_files(root)
    if scripts := [path for path in files if tree.is_shell(path)]:
        yield from first_in_each_file([*SHELLCHECK, *scripts], root)
    # Tests misspell words to see them refused.
    prose = [
        path
        for path in files
        if path.suffix in PROSE and "tests" not in path.relative_to(root).parts
    ]
    if prose:
        codespell = [TOOLS / "codespell", "-L", SPELLED_RIGHTLY, "--ignore-regex", CAMEL_CASE]
        yield from first_in_each_file([*codespell, *prose], root)


def fix(root: Path) -> None:
    """Rewrites all files in the house's format."""
    cxx, python = both_kinds(root)
    if cxx:
        subprocess.run([*clang_format(), "-i", *cxx], check=True)
    if python:
        subprocess.run([*ruff("check"), "--fix", "--exit-zero", *python], check=True)
        subprocess.run([*ruff("format"), *python], check=True)


def both_kinds(root: Path) -> tuple[list[Path], list[Path]]:
    """Return the project's C++ files and its Python files."""
    files = tree.own_files(root)
    return [f for f in files if f.suffix in tree.CXX], [f for f in files if tree.is_python(f)]


def clang_format() -> list:
    """Return the formatter of the .venv with the project's style."""
    return [TOOLS / "clang-format", f"--style=file:{tree.ROOT / '.clang-format'}"]


def ruff(verb: str) -> list:
    """Return the linter (`check`) or the formatter (`format`) of the .venv."""
    return [TOOLS / "ruff", verb, "--no-cache", "--config", tree.ROOT / "pyproject.toml"]


def first_in_each_file(command: list, root: Path) -> Iterator[str]:
    """Yield the first line about each file that a failing command prints, else its last words."""
    done = subprocess.run(command, cwd=root, capture_output=True, text=True)
    if not done.returncode:
        return
    lines = (done.stdout + done.stderr).strip().replace(f"{root}/", "").splitlines()
    first: dict[str, str] = {}
    for line in lines:
        place = re.match(r"(\S+?):\d+:(?:\d+:)? ", line)
        if place:
            first.setdefault(place[1], line)
    yield from first.values() or lines[-1:] or [f"{command[0]} failed"]


if __name__ == "__main__":
    if sys.argv[1:] == ["--fix"]:
        fix(tree.ROOT)
    else:
        tree.run(
            violations,
            "formatting: clang-format, ruff, shellcheck and codespell have nothing to say",
        )
