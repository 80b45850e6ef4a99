"""The next step: the exact command, so that it can be copied."""

from __future__ import annotations

import argparse
import os
import shlex
from collections.abc import Iterable, Sequence
from pathlib import Path

from plumb.cli.screen import console

INDENT = "  "
AUTO = "auto"  # as an effect: those that the marks prove
CLIENT_OF = {".ini": "groundcontrol", ".json": "webcontrol"}  # by the ending of its file
# What the next command has to be given again, by the name that the parser has for it.
REPEATED = {
    "--cut-with": "cut_with",
    "--controller": "controller",
    "--sigma": "sigma",
    "--without": "without",
}


def next_step(words: str, command: Sequence[str]) -> str:
    """Return what to do next, and its command below; a long command goes on after a backslash."""
    return f"{words}\n{command_text(['plumb', *command])}"


def command_text(words: Iterable[str]) -> str:
    """Return a command that a shell reads, on lines that fit the screen; an option keeps
    its value.
    """
    parts: list[str] = []
    for word in map(shlex.quote, words):
        value_of_last = parts and parts[-1].startswith("-") and " " not in parts[-1]
        if value_of_last and not word.startswith("-"):
            parts[-1] += f" {word}"
        else:
            parts.append(word)
    width = console().width - 2  # a blank and the backslash
    lines = [f"{INDENT}{parts[0]}"]
    for part in parts[1:]:
        if len(f"{lines[-1]} {part}") > width:
            lines.append(f"{2 * INDENT}{part}")
        else:
            lines[-1] += f" {part}"
    return " \\\n".join(lines)


def same_inputs(
    arguments: argparse.Namespace, *more: str, effects: Sequence[str] = (AUTO,)
) -> list[str]:
    """Return the settings, the marks (with `more` of them) and how they are read, as they were
    given.

    Checks of effects that are not fitted are left out; with "auto" any may be.
    """
    words = [arguments.settings, *arguments.marks, *more]
    for option, name in REPEATED.items():
        value = getattr(arguments, name, None)
        for each in value if isinstance(value, list) else [value]:
            if each is not None:
                words += [option, f"{each:g}" if isinstance(each, float) else str(each)]
    for name, sigma in getattr(arguments, "prior", None) or ():
        words += ["--prior", f"{name}={sigma:.12g}"]
    for check in getattr(arguments, "checked", None) or ():
        effect = check.name.rpartition(".")[0]
        if not effect or effect in effects or AUTO in effects:
            words += ["--checked", f"{check.name}={check.value:.12g}+-{check.sigma:.12g}"]
    return words


def usual_client(arguments: argparse.Namespace) -> list[str]:
    """Return the client as it was named, or as the name of the settings file tells it."""
    client = getattr(arguments, "client", None)
    if client is None:
        client = CLIENT_OF.get(Path(arguments.settings).suffix.lower())
    words = ["--client", client or "none"]
    original = getattr(arguments, "original", None)
    return [*words, "--original", original] if original else words


def add_named(arguments: argparse.Namespace, effects: Sequence[str]) -> list[str]:
    """Return the command that adds these effects and writes the files."""
    same = same_inputs(arguments, effects=effects)
    machine = free_name("machine", ".toml")
    named = ["--effect", *effects] if effects else []
    for name, size in getattr(arguments, "hold", []):
        named += ["--hold", f"{name}={size:.12g}"]
    patch = ["--patch"] if getattr(arguments, "patch", False) else []
    return ["add", *same, *named, *patch, *usual_client(arguments), "-o", machine]


def auto_words(arguments: argparse.Namespace) -> list[str]:
    """Return the command that adds what is most likely and writes the files."""
    return add_named(arguments, [AUTO])


def second_round(arguments: argparse.Namespace, files: Sequence[str]) -> str:
    """Return how to see on new marks that the new settings hold; the machine leads the files."""
    machine = files[0]
    marks, program = free_name("marks", ".toml"), free_name("grid", ".nc")
    grid = ["grid", "--settings", machine, "--marks", marks, "--output", program]
    again = ["calibrate", machine, marks, *usual_client(arguments)]
    kept = [path for path in files if Path(path).suffix in CLIENT_OF]
    if kept:
        client = CLIENT_OF[Path(kept[0]).suffix]
        again = ["calibrate", machine, marks, "--client", client, "--original", kept[0]]
    cut = next_step("See that it holds on new marks, cut with the new settings:", grid)
    return f"{cut}\n{next_step('and when they are measured:', again)}"


def free_name(stem: str, ending: str) -> str:
    """Return the first of `machine.toml`, `machine-2.toml` ... that no file has."""
    number = 1
    while True:
        name = f"{stem}{ending}" if number == 1 else f"{stem}-{number}{ending}"
        if not os.path.exists(name):
            return name
        number += 1
