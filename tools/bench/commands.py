"""Commands of compilers and simulators, and programs that are compiled for the computer at hand."""

import fcntl
import os
import subprocess
from collections.abc import Sequence
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


class ToolError(Exception):
    """A compiler or the simulator refused."""


def output(*command: str | Path, folder: Path = ROOT) -> str:
    """Return what a command prints, run in a folder; a ToolError with its first complaint if it
    fails.
    """
    environment = {**os.environ, "PLATFORMIO_DISABLE_UPGRADE_CHECK": "true"}
    try:
        done = subprocess.run(command, capture_output=True, text=True, env=environment, cwd=folder)
    except FileNotFoundError:
        raise ToolError(f"{command[0]} is missing; run tools/setup") from None
    if done.returncode:
        said = (done.stderr + done.stdout).splitlines()
        why = next((line for line in said if "error" in line.lower()), *said[-1:])
        raise ToolError(f"{Path(command[0]).name}: {why}" if said else f"{command[0]} failed")
    return done.stdout.strip()


def compiled(
    program: Path,
    sources: Sequence[str | Path],
    *,
    options: Sequence[str | Path] = (),
    libraries: Sequence[str] = (),
    folder: Path = ROOT,
) -> Path:
    """Links a program from C++ files, each compiled by itself, so that a compiler's cache can help.

    The names of files and folders are from `folder`.
    """
    objects = program.with_name(f"{program.name}.parts")
    objects.mkdir(parents=True, exist_ok=True)
    parts = [objects / f"{i}_{Path(source).stem}.o" for i, source in enumerate(sources)]
    with (objects / "turn").open("w") as turn:
        # Tests and the bench may build the same program at the same time.
        fcntl.flock(turn, fcntl.LOCK_EX)
        for source, part in zip(sources, parts, strict=True):
            output("g++", "-std=c++17", *options, "-c", source, "-o", part, folder=folder)
        linked = objects / "linked"
        output("g++", *parts, *libraries, "-o", linked)
        # Whoever runs the program meanwhile has the old one or the new one, and never half of it.
        linked.replace(program)
    return program
