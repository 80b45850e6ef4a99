"""`plumb calibrate`: from marks to new settings in one go, or to what has to be measured first."""

from __future__ import annotations

import argparse
from dataclasses import replace

from plumb.cli import add as add_command
from plumb.cli import compare as compare_command
from plumb.cli import diagnose as diagnose_command
from plumb.cli.calibrate_text import Round, as_text, sentence
from plumb.cli.checked import with_stated
from plumb.cli.client import typed_json
from plumb.cli.files import inputs_of
from plumb.cli.screen import bar
from plumb.cli.steps import free_name, usual_client
from plumb.cli.text import print_json
from plumb.cure.auto import add_auto, without_marks
from plumb.cure.origin import refuse_other_origin
from plumb.firmware.client_files import ClientFiles
from plumb.fit.compare import compare
from plumb.fit.inputs import Inputs
from plumb.plan import propose


def run(arguments: argparse.Namespace) -> int:
    """Compare, diagnose, add or propose, write, print, and return the exit code."""
    inputs = _inputs(arguments)
    refuse_other_origin(inputs)
    this = round_of(inputs)
    files, client = _written(arguments, inputs, this)
    if arguments.json:
        print_json(
            {
                "sentence": sentence(this),
                "done": this.done,
                "comparison": compare_command.as_json(this.comparison),
                "diagnosis": diagnose_command.as_json(this.result.diagnosis),
                "addition": add_command.as_json(this.result.addition)
                if this.result.addition
                else None,
                "next": [
                    diagnose_command.proposal_json(proposal)
                    for proposal in (this.advice.proposals if this.advice else ())
                ],
                "written": files,
                "steps": client.steps if client else (),
                "typed": typed_json(client),
            }
        )
    else:
        print(as_text(this, arguments, files, client, inputs))
    return int(not this.done)


def _inputs(arguments: argparse.Namespace) -> Inputs:
    inputs = inputs_of(arguments)
    if arguments.without:
        marks = without_marks(inputs.measurements, arguments.without)
        inputs = replace(inputs, measurements=marks)
    return with_stated(inputs, arguments)


def round_of(inputs: Inputs) -> Round:
    """What the marks say, what was added by it, and what to measure first if it is open."""
    comparison = compare(
        inputs.settings,
        inputs.measurements,
        cut_with=inputs.cut_with,
        controller=inputs.controller,
    )
    this = Round(comparison, add_auto(inputs))
    if this.done:
        return this
    advice = propose(this.result.diagnosis, inputs, progress=bar("simulating"))
    return replace(this, advice=advice)


def _written(
    arguments: argparse.Namespace, inputs: Inputs, this: Round
) -> tuple[list[str], ClientFiles | None]:
    """Write the machine and what belongs to its client, if the question is settled."""
    addition = this.result.addition
    if not this.done or addition is None:
        return [], None
    client = usual_client(arguments)[1]
    asked = {
        **vars(arguments),
        "output": arguments.output or free_name("machine", ".toml"),
        # Without a client's file there is no telling what sends to the machine.
        "client": client if arguments.client or client != "none" else None,
        "picture": None,
    }
    return add_command.written(argparse.Namespace(**asked), inputs, addition)
