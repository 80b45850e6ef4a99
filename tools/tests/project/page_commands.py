"""The commands that pages show, and what they print; run as a script it writes that
into the pages that it is given, or into all.

In a block ```console the lines after `$ ` are commands, and below each stands what it prints, where
... stands for anything. It exits with 0, or the page shows the code by `; echo "exit $?"`. In a
block without a language the lines that begin with plumb, or with Python and a script, are commands
that answer (exit 0 or 1). The commands of a page run one after the other, in a folder with a copy
of docs/example. One that serves until Ctrl-C has a terminal of its own until the last has run.
"""

from __future__ import annotations

import atexit
import contextlib
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from preloaded import preloaded

ROOT = Path(__file__).resolve().parents[3]
EXAMPLE = ROOT / "docs/example"
BLOCK = re.compile(r"^```(\w*)\n(.*?)^```", re.DOTALL | re.MULTILINE)
PROMPT = re.compile(r"^\$ ", re.MULTILINE)
# In a block without a language: the commands that need neither a board nor a compiler.
PLAIN = re.compile(r"(?:\.venv/bin/)?plumb |python3 tools/")
PATIENCE = (
    1200  # [s] for all commands of a page; a busy computer takes five minutes for the longest
)
END = "--- end of a command, exit "
SERVES = re.compile(r"plumb (?:lab|practice start)[^&|>;]*")
SERVED = (
    "{0} > terminal.{1} 2>&1 & until grep -Eqs '[.] Ctrl-C|token=' terminal.{1}; "
    "do sleep 0.1; done; cat terminal.{1}"
)
# What the reader does after a command: he measures, and fills in the file that it wrote.
FILLED_IN = {
    "--marks marks.toml": "cp docs/example/marks.toml marks.toml",
    "--marks readings.toml": "sed -i 's/# across = .*/across = [1907, 1906, 1904]/; "
    "s/# upwards = .*/upwards = [901, 902, 901]/; s/# top_left = .*/top_left = [100, 101]/; "
    "s/# top_right = .*/top_right = [101, 101]/' readings.toml",
    "--marks more.toml": r"sed -i -E 's/^target = (\[.*\])/&\nmeasured = \1/' more.toml",
}


@dataclass(frozen=True)
class Shown:
    """A command on a page, with the output below it; None in a block without a language."""

    command: str
    output: str | None


@dataclass(frozen=True)
class Printed:
    """The output of a command, and its exit code."""

    output: str
    code: int


def commands_on(text: str) -> list[Shown]:
    """The commands of a page that can run, in their order."""
    shown: list[Shown] = []
    for language, block in BLOCK.findall(text):
        if language == "console":
            shown += [Shown(*part.split("\n", 1)) for part in PROMPT.split(block)[1:]]
        elif not language:
            shown += [Shown(line, None) for line in block.splitlines() if PLAIN.match(line)]
    return shown


def run_in(folder: Path, commands: list[str]) -> list[Printed]:
    """The output of each command, all run by one shell in a folder with the example."""
    script = "".join(
        f"{served(command, number)}\necho '{END}'$?\n{fill_in(command)}\n"
        for number, command in enumerate(commands)
    )
    if any(map(SERVES.fullmatch, commands)):
        script += "kill $(jobs -p)\n"
    shutil.copytree(EXAMPLE, folder / "docs/example")
    for file in EXAMPLE.iterdir():
        if f"--marks {file.name}" not in script:
            shutil.copy(file, folder)
    for name in ("tools", ".venv"):
        (folder / name).symlink_to(ROOT / name)
    path = os.pathsep.join(map(str, [programs(), Path(sys.executable).parent, os.environ["PATH"]]))
    done = subprocess.run(
        ["bash", "-c", script],
        cwd=folder,
        env={**os.environ, "PATH": path, "COLUMNS": "80", "BROWSER": "true"},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=PATIENCE,
    )
    parts = re.split(rf"^{END}(\d+)\n", done.stdout, flags=re.MULTILINE)
    return [Printed(*pair) for pair in zip(parts[0::2], map(int, parts[1::2]), strict=False)]


@cache
def programs() -> Path:
    """A folder with the program plumb, loaded once for all commands."""
    until_the_end = contextlib.ExitStack()
    atexit.register(until_the_end.close)
    return until_the_end.enter_context(preloaded())


def fill_in(command: str) -> str:
    """The reader's actions after a command."""
    return "; ".join(deed for part, deed in FILLED_IN.items() if part in command)


def served(command: str, number: int) -> str:
    """A command as it runs beside the others if it serves until Ctrl-C, else as it is."""
    return SERVED.format(command, number) if SERVES.fullmatch(command) else command


# What a page leaves out. More than three dots are a drawing.
LEFT_OUT = re.compile(r"(?<!\.)\.{3}(?!\.)\n?")


def shows(output: str, printed: str) -> bool:
    """Whether a page shows what is printed; ... stands for anything, also for no line."""
    begin, *parts = LEFT_OUT.split(output.rstrip())
    printed = printed.rstrip()
    if not parts or not printed.startswith(begin):
        return printed == begin
    at = len(begin)
    for part in parts[:-1]:
        found = printed.find(part, at)
        if found < 0:
            return False
        at = found + len(part)
    return printed.endswith(parts[-1]) and len(printed) - len(parts[-1]) >= at


def faults_on(text: str, folder: Path) -> list[str]:
    """Commands that a page needs and does not show."""
    shown = commands_on(text)
    faults = []
    answers = run_in(folder, [each.command for each in shown])
    for each, printed in zip(shown, answers, strict=True):
        if printed.code > (each.output is None):
            faults.append(f"$ {each.command}\nexit {printed.code}:\n{printed.output}")
        elif each.output is not None and not shows(each.output, printed.output):
            faults.append(
                f"$ {each.command}\nshown:\n{each.output}\nprinted:\n{printed.output}\n"
                f"If that is right: python {Path(__file__).relative_to(ROOT)} writes it."
            )
    return faults


def rewritten(text: str, folder: Path) -> str:
    """The page with the output as it is printed now."""
    commands = [each.command for each in commands_on(text)]
    printed = dict(zip(commands, run_in(folder, commands), strict=True))
    return BLOCK.sub(lambda block: _block(block, lambda command: printed[command].output), text)


def _block(block: re.Match[str], output_of: Callable[[str], str]) -> str:
    """A block with the output as it is printed now."""
    language, body = block[1], block[2]
    if language != "console":
        return block[0]
    parts = []
    for part in PROMPT.split(body)[1:]:
        command, _, old = part.partition("\n")
        gap = "\n" if old.endswith("\n\n") else ""
        printed = output_of(command)
        output = (old if shows(old, printed) else printed).rstrip()
        parts.append(f"$ {command}\n{output}{output and chr(10)}{gap}")
    return f"```console\n{''.join(parts)}```"


def pages() -> dict[str, str]:
    """The pages with commands, by their path from the project's folder."""
    files = (ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md")))
    texts = {str(file.relative_to(ROOT)): file.read_text(encoding="utf-8") for file in files}
    return {name: text for name, text in texts.items() if commands_on(text)}


def written(names: Sequence[str]) -> list[str]:
    """Write what commands print into the pages of these names, or all; return which changed."""
    texts = pages()
    unknown = set(names) - set(texts)
    if unknown:
        sys.exit(
            f"{', '.join(sorted(unknown))}: no page with commands; name it as docs/commands/add.md"
        )
    changed = []
    for page in names or texts:
        with tempfile.TemporaryDirectory() as folder:
            text = rewritten(texts[page], Path(folder))
        if text != texts[page]:
            (ROOT / page).write_text(text, encoding="utf-8")
            changed.append(page)
    return changed


if __name__ == "__main__":
    for page in written(sys.argv[1:]):
        print(f"{page}: written")
