"""The manual page of `plumb`, in roff, from the parsers of all commands."""

from __future__ import annotations

import argparse
from collections.abc import Iterator


def manual(parser: argparse.ArgumentParser) -> str:
    """Return the page; `man -l` shows it."""
    commands = next(
        action for action in parser._actions if isinstance(action, argparse._SubParsersAction)
    )
    lines = [
        ".TH PLUMB 1",
        ".SH NAME",
        f"plumb \\- {_plain(str(parser.description))}",
        ".SH SYNOPSIS",
        ".B plumb",
        "COMMAND ...",
        ".SH DESCRIPTION",
        _plain(str(parser.epilog)),
        ".SH COMMANDS",
    ]
    for name, command in commands.choices.items():
        lines += [f".SS plumb {name}", _plain(str(command.description))]
        lines += [line for action in command._actions for line in _argument(action)]
        lines += [".nf", _plain(str(command.epilog)), ".fi"]
    return "\n".join(lines)


def _argument(action: argparse.Action) -> Iterator[str]:
    """Yield the name of an argument, and what it does."""
    value = action.metavar or ("" if action.nargs == 0 else action.dest.upper())
    value = " ".join(value) if isinstance(value, tuple) else value
    names = ", ".join(f"{option} {value}".strip() for option in action.option_strings) or value
    yield ".TP"
    yield f".B {_plain(names)}"
    yield _plain(str(action.help or "") % {**vars(action), "prog": "plumb"})


def _plain(text: str) -> str:
    """Return a text that roff takes as it stands."""
    escaped = text.replace("\\", "\\e").replace("-", "\\-")
    return "\n".join(
        f"\\&{line}" if line[:1] in (".", "'") else line for line in escaped.split("\n")
    )
