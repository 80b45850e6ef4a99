"""`plumb diagnose`: which effects the settings miss, and how likely each is by the marks."""

import argparse
from dataclasses import dataclass

from plumb.cli.arguments import BOARD, add_shared, add_stated, stated_inputs
from plumb.cli.screen import headline, in_text, print_json, what_follows
from plumb.diagnosis import diagnose
from plumb.plan import propose
from plumb.words import verdict as words
from plumb.words.proposals import ProposalInWords, in_words
from plumb.words.states import STATES


@dataclass(frozen=True, kw_only=True)
class DiagnosisAnswer(words.DiagnosisInWords):
    """The diagnosis, and what to measure next."""

    next: tuple[ProposalInWords, ...]


def run(arguments: argparse.Namespace) -> int:
    """Diagnose, print, and return the exit code."""
    inputs = stated_inputs(arguments)
    diagnosis = diagnose(inputs)
    follows = STATES[diagnosis.state]
    if arguments.json:
        proposals = in_words(propose(diagnosis, inputs)).proposals
        print_json(DiagnosisAnswer(**vars(diagnosis), next=proposals))
    else:
        said = words.full(diagnosis) if arguments.details else words.short(diagnosis)
        verdict = headline(words.sentence(diagnosis), follows.kind)
        after = what_follows(follows, arguments, ["diagnose"])
        print("\n\n".join([*in_text(said), verdict, after]))
    return follows.code


# The arguments of `plumb diagnose`.

EXAMPLES = (
    "plumb diagnose groundcontrol.ini marks.toml",
    "plumb diagnose groundcontrol.ini marks.toml --checked sled_weight=98+-2",
)
EXIT = (
    "Exit: 0 done; 1 done, but no new numbers follow yet: a mark should be measured again, the "
    "marks do not reach over the sheet, no effect of the library explains them, or one in a size "
    "that no machine has; 2 an input cannot be used."
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `plumb diagnose`."""
    add_shared(parser, *BOARD)
    add_stated(parser, sigma="tape_sigma_mm of MARKS and their scatter")
    add_shared(parser, "--units")
    add_shared(
        parser, details="all explanations with their sizes, and what these marks cannot show"
    )
    add_shared(parser, "--json")
