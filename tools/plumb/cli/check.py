"""`plumb check`: runs a program dry, and says what to expect of it."""

import argparse
from collections.abc import Sequence
from pathlib import Path

from plumb.cli import screen
from plumb.cli.arguments import PROGRAM, add_shared, file, inputs_of, length, unit_of
from plumb.cli.output import refuse_twins, say_failure, write_outputs
from plumb.cli.screen import bar, free_name, in_text, next_step, print_json
from plumb.cure.add import refuse_other_origin
from plumb.fit.inputs import Inputs, settings_in
from plumb.job.check import CheckedJob, check_job
from plumb.job.dry_run import comment_of, outline_of, program_in
from plumb.job.fixes import FixedLine, fixed, has_habit
from plumb.job.resume import JobMachine
from plumb.job.wood import Tools
from plumb.settings import MachineSettings
from plumb.text.values import Unit
from plumb.words.job import JobAnswer, all_of, changes_said, headline, runs_here
from plumb.words.states import KINDS


def run(arguments: argparse.Namespace) -> int:
    """Check, print, and return the exit code."""
    refuse_twins(arguments.outline, arguments.fix)
    settings = settings_in(arguments.settings)
    arguments.controller = None
    lines = program_in(arguments.job, say=say_failure)
    inputs = inputs_of(arguments) if arguments.marks else None
    if inputs:
        refuse_other_origin(inputs)
    unit = inputs.unit if inputs else unit_of(arguments)
    checked = _checked(arguments, settings, lines, inputs)
    files, changes = {}, tuple[FixedLine, ...]()
    if arguments.fix:
        machine = JobMachine(settings, (*arguments.start, 0.0), dict(arguments.set))
        mended = fixed(machine, lines, checked.findings, source=arguments.job)
        changes = mended.changes
        # In front of the first line, so that each line keeps its number.
        title = runs_here(comment_of(Path(arguments.job).name))
        files[arguments.fix] = (title + "\n".join([*mended.lines, ""])).encode()
        checked = _checked(arguments, settings, mended.lines, inputs) if changes else checked
    if arguments.outline:
        outline = outline_of(checked.over_sheet, name=Path(arguments.job).name)
        files[arguments.outline] = outline.encode()
    write_outputs(files, inputs=[arguments.job, arguments.settings, *arguments.marks])
    if arguments.json:
        print_json(JobAnswer(checked, list(files), changes))
    else:
        print("\n\n".join(_text(checked, changes, arguments, unit)))
    return int(KINDS[checked.state] == "bad")


def _text(
    checked: CheckedJob, changes: Sequence[FixedLine], arguments: argparse.Namespace, unit: Unit
) -> list[str]:
    """Return what was changed, what is wrong, the job, its parts, and what to do next."""
    name, said = Path(arguments.job).name, []
    if arguments.fix:
        fixed_name = Path(arguments.fix).name
        head, lines = changes_said(changes, name, fixed_name)
        said, name = ["\n".join([head, *filter(None, in_text([lines]))])], fixed_name
    verdict = screen.headline(headline(checked, name), KINDS[checked.state])
    said += [verdict, *in_text(all_of(checked, unit))]
    if has_habit(checked.findings):
        fix = ["check", arguments.job, arguments.settings, "--fix", free_name("mended", ".nc")]
        said.append(next_step("To write an equal program that this machine runs:", fix))
    if arguments.outline:
        words = "See where it will cut, with the bit above the sheet:"
        said.append(next_step(words, ["send", arguments.outline]))
    return said


def _checked(
    arguments: argparse.Namespace,
    settings: MachineSettings,
    lines: Sequence[str],
    inputs: Inputs | None,
) -> CheckedJob:
    return check_job(
        settings,
        lines,
        inputs=inputs,
        numbers=dict(arguments.set),
        tools=Tools.of(
            lines,
            diameter=arguments.bit,
            length=arguments.bit_length,
            thickness=arguments.thickness,
        ),
        start=(*arguments.start, 0.0),
        progress=bar("running the program dry"),
    )


# The arguments of `plumb check`.

EXAMPLES = (
    "plumb check pocket.nc machine.toml",
    "plumb check pocket.nc machine.toml --marks marks.toml --outline outline.nc",
)
EXIT = "Exit: 0 nothing is wrong; 1 something is; 2 an input cannot be used."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `plumb check`."""
    add_shared(parser, *PROGRAM)
    parser.add_argument(
        "--marks",
        metavar="MARKS",
        type=file,
        action="append",
        default=[],
        help="measured marks of this machine: they tell which errors to expect of each part",
    )
    add_shared(parser, "--cut-with")
    for option, of, usual in (
        ("--bit", "diameter of the bit", "what JOB says, else 6.35"),
        ("--bit-length", "how long the bit cuts", "what JOB says"),
        ("--thickness", "how thick the sheet is", "what JOB says, else 19.05"),
    ):
        parser.add_argument(option, metavar="MM", type=length, help=f"{of} [{usual}]")
    for option, program in (
        ("--outline", "goes round the job, slowly, with the bit above the sheet"),
        ("--fix", "cuts the same on this machine, and list what was changed"),
    ):
        parser.add_argument(option, metavar="FILE", help=f"write a program that {program}")
    add_shared(parser, "--force", "--units", "--json")
