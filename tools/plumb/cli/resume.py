"""`plumb resume`: writes a program that goes on with a job after a halt."""

import argparse
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from plumb.cli.arguments import PROGRAM, add_shared, count, place, unit_of
from plumb.cli.output import STDOUT, say_failure, write_outputs
from plumb.cli.screen import in_text, next_step, print_json
from plumb.fit.inputs import settings_in
from plumb.job.dry_run import comment_of, program_in
from plumb.job.resume import JobMachine, resume_at_line, resume_at_place
from plumb.text.answers import key
from plumb.text.errors import InputError
from plumb.words.job import goes_on


@dataclass(frozen=True)
class ResumeAnswer:
    """Where a job goes on."""

    line: int  # of the job, which is done first
    begins: Annotated[tuple[float, float, float], key("begins_mm")]  # of the machine
    passes: tuple[int, ...]  # lines that cut where the job goes on in the middle of a cut
    written: tuple[str, ...]


def run(arguments: argparse.Namespace) -> int:
    """Write the program, say how it begins, and return the exit code."""
    if arguments.line is None and arguments.at is None:
        raise InputError("say where to go on: --line N, --at X,Y, or both")
    machine = JobMachine(
        settings_in(arguments.settings), (*arguments.start, 0.0), dict(arguments.set)
    )
    lines = program_in(arguments.job, say=say_failure)
    if arguments.at is None:
        resumed = resume_at_line(machine, lines, arguments.line)
    else:
        resumed = resume_at_place(machine, lines, arguments.at, arguments.line)
    name = Path(arguments.job).name
    title = f"(plumb: {comment_of(name)} from line {resumed.first} on)"
    content = "\n".join([title, *resumed.lines, ""]).encode()
    inputs = [arguments.job, arguments.settings]
    write_outputs({arguments.output: content}, inputs=inputs)
    if arguments.json:
        passes = resumed.entry.passes if resumed.entry else ()
        print_json(ResumeAnswer(resumed.first, resumed.begins, passes, (arguments.output,)))
        return 0
    print(*in_text([goes_on(resumed, name, unit_of(arguments))]))
    if arguments.output != STDOUT:
        check = ["check", arguments.output, arguments.settings]
        print(f"\n{next_step('Look at it before you send it:', check)}")
    return 0


# The arguments of `plumb resume`.

EXAMPLES = (
    "plumb resume pocket.nc machine.toml -o rest.nc",
    "plumb resume pocket.nc machine.toml --line 120 -o rest.nc",
)
EXIT = "Exit: 0 done; 2 an input cannot be used."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `plumb resume`."""
    add_shared(parser, *PROGRAM)
    parser.add_argument(
        "--line",
        metavar="N",
        type=count,
        help="go on at this line, from the last place before it where the bit was out of the wood",
    )
    parser.add_argument(
        "--at",
        metavar="X,Y",
        type=place,
        help="go on in the middle of the cut that passes here, mm from the middle of the sheet; "
        "of several passes the first, or that of --line",
    )
    add_shared(parser, output="the program [the standard output]")
    parser.set_defaults(output=STDOUT)
    add_shared(parser, "--force", "--units", "--json")
