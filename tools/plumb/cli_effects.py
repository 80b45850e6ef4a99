"""`plumb effects`: the library of effects, with units, usual values and look-alikes."""

from __future__ import annotations

import argparse

from plumb.cli_files import add_json
from plumb.cli_text import number, print_json, sentences, table
from plumb.predict import library

HELP = "the library of effects: what each does, its units, and what looks like it"
EXIT = "Exit: 0 done."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb effects`."""
    add_json(parser)


def run(arguments: argparse.Namespace) -> int:
    """Print the library."""
    effects = library()
    if arguments.json:
        print_json({"effects": effects})
        return 0
    print(f"{len(effects)} effects can be added to the machine, in the order they are applied.")
    for effect in effects:
        print(f"\n{effect['name']}")
        for label, fact in (
            ("what it is", effect["summary"]),
            ("what it does", effect["pattern"]),
            ("looks like", effect["look_alikes"]),
            ("to be sure", effect["remedy"]),
        ):
            print(sentences([fact], mark=f"  {label:<14}"))
        rows = [
            [
                f"  {own['name']}",
                number(own["typical"]),
                f"{number(own['low'])} .. {number(own['high'])}",
                own["unit"],
                f"${own['setting']}",
            ]
            for own in effect["parameters"]
        ]
        print(table(["  parameter", "usual", "possible", "unit", "setting"], rows))
    return 0
