"""`plumb effects`: the library of effects, with units, usual values and look-alikes."""

import argparse
from collections import Counter
from dataclasses import dataclass

from plumb.cli.arguments import add_shared
from plumb.cli.screen import next_step, number, print_json, sentences, table
from plumb.model.catalogue import NO_FIRMWARE, empirical_effects, every_effect, label
from plumb.model.predict import EffectWords


@dataclass(frozen=True)
class Library:
    """The effects that can be fitted."""

    effects: list[EffectWords]


def run(arguments: argparse.Namespace) -> int:
    """Print the library."""
    effects = every_effect()
    if arguments.json:
        print_json(Library(effects))
        return 0
    count = Counter(effect["where"] for effect in effects)
    first = (
        f"{count['firmware']} effects can be added to the machine, in the order they are applied; "
        f"then {count['lab']} of the lab, which act on what is measured: {NO_FIRMWARE}."
    )
    print(sentences([first], mark=""))
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
                f"  {parameter['name']}",
                number(parameter["typical"]),
                f"{number(parameter['low'])} .. {number(parameter['high'])}",
                parameter["unit"],
                "none" if parameter["setting"] is None else f"${parameter['setting']}",
            ]
            for parameter in effect["parameters"]
        ]
        print(table(["  parameter", "usual", "possible", "unit", "setting"], rows))
    for patch in empirical_effects():
        low, high = (patch["parameters"][i]["setting"] for i in (0, -1))
        print(f"\n{patch['name']} (${low} to ${high}): no cause, and never a suspect (--patch)")
        print(sentences([patch["summary"], patch["remedy"]], mark="  "))
    measured = ["calibrate", "groundcontrol.ini", "marks.toml"]
    print(f"\n{next_step('Which of them your machine has, by its marks:', measured)}")
    return 0


# The arguments of `plumb effects`.

EXAMPLES = ("plumb effects", "plumb effects --json")
EXIT = "Exit: 0 done."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `plumb effects`."""
    add_shared(parser, "--json")
