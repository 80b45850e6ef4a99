"""The command line: `plumb COMMAND ...`; prints, and returns 0 done, 1 bad news, 2 refused.

The file of a command is loaded when that command is asked for, so help and refusals come at once.
"""

from __future__ import annotations

import argparse
import os
import re
import signal
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from difflib import get_close_matches
from importlib import import_module as loaded
from itertools import takewhile
from textwrap import wrap
from typing import Any, NoReturn

from plumb.cli.output import ended, results_of
from plumb.text.errors import InputError

DESCRIPTION = "Find and cure the errors of a hanging CNC: grid, cut, measure, then calibrate."
EPILOG = "Lengths are mm, forces N, angles rad. plumb COMMAND --help explains each command."
NO_OPTION, NO_ARGUMENT = "there is no option", "there is no argument"

# In the order of `plumb --help`. To add a command, write its file and give it a line.
GROUPS: Mapping[str, Mapping[str, str]] = {
    "first day": {
        "lab": "open the lab in your browser: measure, see why the machine errs, and cure it",
        "flash": "write the firmware to the Mega",
        "reach": "show which part of the sheet a machine can use",
    },
    "calibrate": {
        "grid": "write the G-code for a grid of calibration marks",
        "calibrate": "turn marks into new settings, or say what to measure first",
        "compare": "show how far the marks lie from where the settings predict them",
        "diagnose": "say which effects the settings lack, and how likely each is",
        "next": "say what to measure next, how long it takes, and how likely it is to help",
        "add": "fit the frame and the named effects to the marks, and write the new settings",
        "settings": "show a fitted machine as a table, or write it as $ lines and a client's file",
        "report": "write all that the marks say as a page to read, print and keep",
    },
    "job": {
        "check": "run a program dry: what is wrong, how long it takes, how well the parts will fit",
        "send": "send a program, a line of G-code or a machine's numbers to the machine",
        "resume": "write a program that goes on with a job after a halt",
    },
    "trouble": {
        "read": "read the machine's numbers and where its sled is",
        "recover": "keep holes as home marks, and bring a lost position back by them",
    },
    "engineers": {
        "vm": "start a virtual machine with a serial port, as if a board were plugged in",
        "practice": "find an effect that is hidden in a virtual machine",
        "effects": "list the effects: what each does, its units, and what looks like it",
        "inverse": "turn places into chain lengths",
        "forward": "turn chain lengths into places",
    },
}
COMMANDS: Mapping[str, str] = {
    name: said for group in GROUPS.values() for name, said in group.items()
}
# Commands that are gone, and what to use instead.
GONE: Mapping[str, str] = {
    "bench": "tools/rates/run in Plumb's sources plays the same boards",
    "demo": "plumb practice start FOLDER hides an effect in a virtual machine for you to find",
    "diary": "plumb lab shows the diary, and diary.jsonl is plain text",
    "gap": "measure the motor gap with a tape, and give it by --checked motor_gap=VALUE+-1mm",
    "guide": "plumb lab has it",
    "home": "plumb recover does it, with the same options",
    "preview": "plumb grid --settings FILE --details says it",
    "recheck": "plumb calibrate says whether marks that were cut with fitted settings hold",
    "slip": "plumb recover --at sets the chains by a home mark, whichever slipped",
    "telemetry": "plumb send says at the end of a program what deserves a look; docs/trouble.md "
    "explains an answer to B30",
}


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command and return its exit code."""
    words = list(sys.argv[1:] if arguments is None else arguments) or ["--help"]
    return ended(lambda: _run(words), name="plumb", as_json="--json" in words)


def _run(arguments: Sequence[str]) -> int:
    # The lab's matrices are small: threads of the linear algebra only wait for each other.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    parsed = build_parser(arguments).parse_args(arguments)
    run: Callable[[argparse.Namespace], int] = loaded(f"plumb.cli.{parsed.command}").run
    # Until here it ends the program at once: numpy would call an interruption a broken library.
    if signal.getsignal(signal.SIGINT) is signal.SIG_DFL:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    with results_of(parsed):
        return run(parsed)


def build_parser(arguments: Sequence[str] = tuple(COMMANDS)) -> Parser:
    """Return the parser for these arguments: of the command that they name, or else of all
    commands.
    """
    parser = Parser(
        prog="plumb", description=DESCRIPTION, epilog=EPILOG, allow_abbrev=False, groups=GROUPS
    )
    parser.add_argument("--version", action=Version, help="show the version and exit")
    commands = parser.add_subparsers(metavar="COMMAND", required=True, dest="command")
    for name, said in COMMANDS.items():
        subparser = commands.add_parser(
            name,
            help=said,
            description=f"{said[0].upper()}{said[1:]}.",
            allow_abbrev=False,
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )
        if name in arguments:
            command = loaded(f"plumb.cli.{name}")
            subparser.epilog = "\n".join(
                [
                    "examples:",
                    *(f"  {example}" for example in command.EXAMPLES),
                    "",
                    *wrap(command.EXIT, 79),
                ]
            )
            command.add_arguments(subparser)
    return parser


class Parser(argparse.ArgumentParser):
    """Complains like every other refusal, and knows the nearest word for a wrong word.

    groups: titles for the help, each with the names of its commands.
    """

    def __init__(
        self, *arguments: Any, groups: Mapping[str, Iterable[str]] | None = None, **named: Any
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
        for title, names in self.groups.items():
            formatter.start_section(title)
            formatter.add_arguments([helps[name] for name in names])
            formatter.end_section()
        formatter.start_section("options")
        formatter.add_arguments(action for action in self._actions if action is not commands)
        formatter.end_section()
        formatter.add_text(self.epilog)
        return formatter.format_help()

    def error(self, message: str) -> NoReturn:
        """Refuse the command line."""
        raise InputError(f"{' '.join(message.split())}; see {self.prog} --help")

    def parse_known_args(  # type: ignore[override]  # two overloads that are not used here
        self, args: Sequence[str] | None = None, namespace: argparse.Namespace | None = None
    ) -> tuple[argparse.Namespace, list[str]]:
        """Parse, and refuse here what is not known: the parser of a command knows its options.

        An unknown option comes first: what stands behind it would be taken for an argument.
        """
        words = sys.argv[1:] if args is None else args
        for word in takewhile(self._is_own, words):
            name = word.partition("=")[0]
            if name.startswith("--") and name not in self._option_string_actions:
                self._refuse(NO_OPTION, name)
        parsed, extra = super().parse_known_args(args, namespace)
        if extra:
            unknown = next((word for word in extra if word.startswith("-")), extra[0])
            self._refuse(NO_OPTION if unknown.startswith("-") else NO_ARGUMENT, unknown)
        return parsed, extra

    def _is_own(self, word: str) -> bool:
        """Whether this parser reads the word, and what may follow: no command and no `--` yet."""
        return word != "--" and (word.startswith("-") or not self.groups)

    def _refuse(self, why: str, word: str) -> NoReturn:
        known = [each for each in self._option_string_actions if each.startswith("--")]
        name = word.partition("=")[0]
        near = meant(name, known, begin="--")
        raise InputError(f"{why} {name} here{near}; see {self.prog} --help")

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        """Refuse a word that is no choice, with the nearest choice."""
        if action.choices is None or value in action.choices:
            return
        choices = [str(choice) for choice in action.choices]
        if isinstance(action, argparse._SubParsersAction):
            if value in GONE:
                raise InputError(f"there is no command '{value}' any more: {GONE[value]}")
            raise InputError(
                f"there is no command '{value}'{meant(value, choices)}; see plumb --help"
            )
        hint = meant(str(value), choices) or f"; give {', '.join(choices)}"
        raise argparse.ArgumentError(action, f"'{value}' is not known{hint}")


def meant(word: str, known: Iterable[str], *, begin: str = "") -> str:
    """`; did you mean ...?` with the nearest known word, or nothing; `begin`: how all words begin,
    which makes none of them nearer.
    """
    named = [each.removeprefix(begin) for each in known]
    near = get_close_matches(word.removeprefix(begin).lower(), named, 1)
    return f"; did you mean {begin}{near[0]}?" if near else ""


class Version(argparse.Action):
    """Prints the version of the package, which is looked up only then."""

    def __init__(self, option_strings: Sequence[str], dest: str, help: str) -> None:
        super().__init__(option_strings, dest=argparse.SUPPRESS, nargs=0, help=help)

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        """Print it and stop."""
        version = loaded("plumb.text.compiled").version()
        print(f"{parser.prog} {version}")
        parser.exit()


if __name__ == "__main__":
    sys.exit(main())
