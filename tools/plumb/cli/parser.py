"""A parser that complains on a single line, and says what was probably meant."""

from __future__ import annotations

import argparse
import re
from collections.abc import Iterable, Mapping, Sequence
from difflib import get_close_matches
from importlib import import_module
from typing import Any, NoReturn

from plumb.text.errors import InputError

# How the help calls arguments that are names of files.
FILES = ("SETTINGS", "JOB", "MARKS", "PLAN", "FILE", "INI", "LOG")


class Parser(argparse.ArgumentParser):
    """Complains like every other refusal, and knows the nearest word for a wrong word.

    groups: titles for the help, each with the names of its commands.
    """

    def __init__(
        self, *arguments: Any, groups: Mapping[str, Sequence[str]] | None = None, **named: Any
    ) -> None:
        super().__init__(*arguments, **named)
        self.groups = groups or {}
        # No option begins with a digit, so what does is a value: -650,-7 as well as -650.
        self._negative_number_matcher = re.compile(r"-\.?\d")

    def format_help(self) -> str:
        """Return the help, with the commands in their groups."""
        if not self.groups:
            return super().format_help()
        formatter = self._get_formatter()
        formatter.add_usage(self.usage, self._actions, self._mutually_exclusive_groups)
        formatter.add_text(self.description)
        commands = next(a for a in self._actions if isinstance(a, argparse._SubParsersAction))
        helps = {each.dest: each for each in commands._choices_actions}
        known = {name for names in self.groups.values() for name in names}
        others = [name for name in helps if name not in known]
        for title, names in {**self.groups, "others": others}.items():
            formatter.start_section(title)
            formatter.add_arguments([helps[name] for name in names if name in helps])
            formatter.end_section()
        formatter.start_section("options")
        formatter.add_arguments(action for action in self._actions if action is not commands)
        formatter.end_section()
        formatter.add_text(self.epilog)
        return formatter.format_help()

    def error(self, message: str) -> NoReturn:
        """Refuse the command line."""
        raise InputError(f"{' '.join(message.split())}; see {self.prog} --help")

    def parse_known_args(  # type: ignore[override]  # two overloads that nobody here uses
        self, args: Sequence[str] | None = None, namespace: argparse.Namespace | None = None
    ) -> tuple[argparse.Namespace, list[str]]:
        """Parse, and refuse here what is not known: the parser of a command knows its options."""
        parsed, extra = super().parse_known_args(args, namespace)
        if extra:
            unknown = next((word for word in extra if word.startswith("-")), extra[0])
            name = unknown.partition("=")[0]
            known = [word for word in self._option_string_actions if word.startswith("--")]
            what = "option" if name.startswith("-") else "argument"
            raise InputError(
                f"there is no {what} {name} here{meant(name, known)}; see {self.prog} --help"
            )
        return parsed, extra

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        """Refuse a word that is no choice, with the nearest choice."""
        if action.choices is None or value in action.choices:
            return
        choices = [str(choice) for choice in action.choices]
        if isinstance(action, argparse._SubParsersAction):
            raise InputError(
                f"there is no command '{value}'{meant(value, choices)}; see plumb --help"
            )
        hint = meant(str(value), choices) or f"; give {', '.join(choices)}"
        raise argparse.ArgumentError(action, f"'{value}' is not known{hint}")


def meant(word: str, known: Iterable[str]) -> str:
    """`; did you mean ...?` with the nearest known word, or nothing."""
    near = get_close_matches(word.lower(), list(known), 1)
    return f"; did you mean {near[0]}?" if near else ""


class Version(argparse.Action):
    """Prints the version of the package, which is looked up only then."""

    def __init__(self, option_strings: Sequence[str], dest: str, help: str) -> None:
        super().__init__(option_strings, dest=argparse.SUPPRESS, nargs=0, help=help)

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        """Print it and stop."""
        version = import_module("importlib.metadata").version("plumb")
        print(f"{parser.prog} {version}")
        parser.exit()


class Completion(argparse.Action):
    """Prints what makes a shell complete commands, options and files."""

    def __init__(self, option_strings: Sequence[str], dest: str, help: str) -> None:
        shells = ("bash", "zsh", "tcsh")
        super().__init__(option_strings, dest=argparse.SUPPRESS, choices=shells, help=help)

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: Any,
        option_string: str | None = None,
    ) -> None:
        """Print it and stop."""
        shtab = import_module("shtab")
        _complete_files(parser, shtab.FILE)
        print(shtab.complete(parser, values))
        parser.exit()


def _complete_files(parser: argparse.ArgumentParser, how: object) -> None:
    """Let arguments that are names of files be completed so, in the commands too."""
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            for command in action.choices.values():
                _complete_files(command, how)
        elif action.metavar in FILES:
            vars(action)["complete"] = how
