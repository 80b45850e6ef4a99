"""`plumb compare`: how far the marks lie from where the settings predict them."""

import argparse

from plumb.cli.arguments import BOARD, add_shared, inputs_of
from plumb.cli.drawing import draw, panel_of, picture_form
from plumb.cli.output import write_outputs
from plumb.cli.screen import headline, in_text, next_step, print_json, same_inputs
from plumb.fit.compare import compare
from plumb.words.comparison import conclusion, full, short
from plumb.words.states import KINDS


def run(arguments: argparse.Namespace) -> int:
    """Compare, print, and return the exit code."""
    inputs = inputs_of(arguments)
    comparison = compare(inputs)
    if arguments.picture:
        form = picture_form(arguments.picture)
        panels = [panel_of(comparison)]
        drawn = draw(panels, sheet=inputs.settings.sheet, form=form)
        write_outputs({arguments.picture: drawn}, inputs=[arguments.settings, *arguments.marks])
    if arguments.json:
        print_json(comparison)
    else:
        facts = (full if arguments.details else short)(comparison, inputs)
        verdict = headline(conclusion(comparison, inputs.unit), KINDS[comparison.state])
        following = next_step("What is missing:", ["calibrate", *same_inputs(arguments)])
        print("\n\n".join([*in_text(facts), verdict, following]))
    return 0


# The arguments of `plumb compare`.

EXAMPLES = (
    "plumb compare groundcontrol.ini marks.toml",
    "plumb compare groundcontrol.ini marks.toml --picture errors.png",
)
EXIT = "Exit: 0 done; 2 an input cannot be used."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `plumb compare`."""
    add_shared(parser, *BOARD, "--units")
    add_shared(parser, picture="draw the errors")
    add_shared(parser, details="every mark, the chains, and how the sheet would have to move")
    add_shared(parser, "--force", "--json")
