"""`plumb effects`: the library of effects, with units, usual values and look-alikes."""

from __future__ import annotations

import argparse
from collections import Counter

from plumb.cli.files import add_json
from plumb.cli.text import number, print_json, sentences, table
from plumb.model.catalogue import NO_FIRMWARE, empirical_effects, every_effect, label

HELP = "the library of effects: what each does, its units, and what looks like it"
EXIT = "Exit: 0 done."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb effects`."""
    add_json(parser)


def run(arguments: argparse.Namespace) -> int:
    """Print the library."""
    effects = every_effect()
    if arguments.json:
        print_json({"effects": effects})
        return 0
    count = Counter(one["where"] for one in effects)
    print(
        f"{count['firmware']} effects can be added to the machine, in the order they are applied;"
    )
    print(f"then {count['lab']} of the lab, which act on what is measured: {NO_FIRMWARE}.")
    if count["sketch"]:
        print(f"Last, sketches ({count['sketch']}), which no firmware has until they are in C++.")
    for effect in effects:
        print(f"\n{label(effect['name'])}")
        for word, fact in (
            ("what it is", effect["summary"]),
            ("what it does", effect["pattern"]),
            ("looks like", effect["look_alikes"]),
            ("to be sure", effect["remedy"]),
        ):
            print(sentences([fact], mark=f"  {word:<14}"))
        rows = [
            [
                f"  {own['name']}",
                number(own["typical"]),
                f"{number(own['low'])} .. {number(own['high'])}",
                own["unit"],
                "none" if own["setting"] is None else f"${own['setting']}",
            ]
            for own in effect["parameters"]
        ]
        print(table(["  parameter", "usual", "possible", "unit", "setting"], rows))
    for one in empirical_effects():
        first, last = (one["parameters"][i]["setting"] for i in (0, -1))
        print(f"\n{one['name']} (${first} to ${last}): no cause, and never a suspect (--patch)")
        print(sentences([one["summary"], one["remedy"]], mark="  "))
    return 0
