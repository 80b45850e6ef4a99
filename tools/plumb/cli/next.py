"""`plumb next`: the most useful next measurement, with the chance that it settles the question."""

import argparse
from pathlib import Path

from plumb.cli.arguments import BOARD, add_shared, add_stated, stated_inputs
from plumb.cli.output import refuse_twins, write_outputs
from plumb.cli.screen import bar, free_name, headline, in_text, next_step, print_json, same_inputs
from plumb.diagnosis import diagnose
from plumb.fit.inputs import Inputs, settings_in, to_fill_in
from plumb.plan import Next, propose
from plumb.plan.case import Case
from plumb.plan.proposal import form_of, program_of, worth
from plumb.settings import MachineSettings
from plumb.text.errors import InputError
from plumb.words import proposals as words
from plumb.words.states import KINDS
from plumb.words.verdict import in_words


def run(arguments: argparse.Namespace) -> int:
    """Diagnose, propose, write, print, and return the exit code."""
    refuse_twins(arguments.template, arguments.output)
    inputs = stated_inputs(arguments)
    diagnosis = diagnose(inputs)
    advice = words.in_words(propose(diagnosis, inputs, progress=bar("simulating")))
    place, files = _files(arguments, advice, inputs)
    named = filter(None, [arguments.cut_with, arguments.cut_next_with])
    read = [arguments.settings, *arguments.marks, *named]
    write_outputs(files, inputs=read)
    if arguments.json:
        verdict = in_words(diagnosis)
        print_json(words.ProposalsAnswer(**vars(advice), diagnosis=verdict, written=tuple(files)))
    else:
        facts = in_text(words.other_ways(advice, place))
        chosen = advice.proposals[place - 1] if advice.proposals else None
        print("\n\n".join([*facts, *first_proposal(chosen, arguments, inputs.settings)]))
        if files:
            print(f"\nWritten: {', '.join(files)}")
    return 0


def _files(
    arguments: argparse.Namespace, advice: Next, inputs: Inputs
) -> tuple[int, dict[str, bytes]]:
    """Return the number of the proposal to show, and the files that were asked for."""
    if not (arguments.template or arguments.output):
        if arguments.choose is not None:
            raise InputError("--choose is for --marks and --output: add what you want")
        return 1, {}
    place = _chosen(advice, arguments.choose, is_cut=bool(arguments.output))
    assert advice.case, "what is proposed is proposed for a case"
    files: dict[str, bytes] = {}
    machine = inputs.cut_with or inputs.settings
    if arguments.template:
        moved_by = arguments.cut_next_with or _in_force(arguments, advice.case)
        sheet = settings_in(moved_by).sheet if moved_by else machine.sheet
        files[arguments.template] = form_of(
            advice, place, arguments.template, settings=moved_by, sheet=sheet
        )
    if arguments.output:
        files[arguments.output] = program_of(
            advice, place, arguments.output, form=arguments.template
        )
    return place, files


def _in_force(arguments: argparse.Namespace, case: Case) -> str | None:
    """Return the file of the settings that the marks there are were cut with, if it was given.

    New marks are cut before anything is changed, unless somebody says otherwise.
    """
    for path in (arguments.cut_with, arguments.settings):
        if path and settings_in(path) == case.settings:
            return str(path)
    return None


def _chosen(advice: Next, wanted: int | None, *, is_cut: bool) -> int:
    """Return the number of the proposal to cut or to fill in."""
    having = [
        i
        for i, proposal in enumerate(advice.proposals, 1)
        if (proposal.option.is_cut if is_cut else len(proposal.option.visits))
    ]
    if not having and is_cut:
        raise InputError("nothing is proposed that is cut: leave out --output")
    if not having:
        raise InputError("nothing is proposed that has marks: leave out --marks")
    place = having[0] if wanted is None else wanted
    if place not in having:
        raise InputError(
            f"--choose {place}: the proposals that {'are cut' if is_cut else 'have marks'} are "
            f"{', '.join(map(str, having))}"
        )
    return place


def first_proposal(
    best: words.ProposalInWords | None, arguments: argparse.Namespace, settings: MachineSettings
) -> list[str]:
    """Return what to measure, how, and the commands after it."""
    first = headline(words.headline(best), KINDS[worth(best)])
    if best is None:
        return [first]
    steps = in_text([words.to_read(best, best.steps, settings)])
    return [f"{first}\n{steps[0]}", after(best, arguments, settings)]


def after(
    best: words.ProposalInWords, arguments: argparse.Namespace, settings: MachineSettings
) -> str:
    """Return the commands after the measurement."""
    said = words.when_measured(best, Path(arguments.marks[-1]).name)
    checks = [
        word
        for check in best.option.checks
        for word in ("--checked", to_fill_in(check.name, check.sigma, settings, best.unit))
    ]
    if checks or not len(best.option.visits):
        return next_step(said, ["calibrate", *same_inputs(arguments), *checks])
    written: str | None = getattr(arguments, "template", None)
    form = written or free_name("more", ".toml")
    then = next_step(said, ["calibrate", *same_inputs(arguments, form)])
    if written:
        return then
    cut = free_name("more", ".nc")
    asked = ["next", *same_inputs(arguments), "--marks", form, "--output", cut]
    return f"{next_step('Cut them by a program, and fill in a form:', asked)}\n{then}"


# The arguments of `plumb next`.

EXAMPLES = (
    "plumb next groundcontrol.ini marks.toml",
    "plumb next groundcontrol.ini marks.toml --choose 2 --output next.nc --marks next.toml",
)
EXIT = "Exit: 0 done; 2 an input cannot be used, and nothing was written."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `plumb next`."""
    add_shared(parser, *BOARD)
    add_stated(parser, sigma="as plumb diagnose takes it")
    parser.add_argument(
        "--choose",
        metavar="N",
        type=int,
        help="the number of the proposal for --marks and --output [the best that has them]",
    )
    parser.add_argument(
        "--marks", dest="template", metavar="FILE", help="write a marks.toml to fill in"
    )
    parser.add_argument(
        "--output", metavar="FILE", help="write the G-code that cuts the proposed marks"
    )
    parser.add_argument(
        "--cut-next-with",
        metavar="SETTINGS",
        help="the settings that the machine has now, if they are not those of MARKS; the form "
        "names them",
    )
    add_shared(parser, "--force", "--units", "--json")
