"""`plumb check`: runs a program dry, and says what to expect of it."""

import argparse
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from plumb.cli import screen
from plumb.cli.arguments import PROGRAM, add_shared, file, inputs_of, length, picture_form, unit_of
from plumb.cli.output import refuse_twins, say_failure, write_outputs
from plumb.cli.screen import bar, free_name, in_text, next_step, print_json
from plumb.cure.add import refuse_other_origin
from plumb.fit.inputs import Inputs, settings_in
from plumb.job.check import CheckedJob, check_job
from plumb.job.dry_run import comment_of, outline_of, program_in
from plumb.job.fixes import FixedLine, fixed, has_habit
from plumb.job.resume import JobMachine
from plumb.job.wood import Tools
from plumb.pictures.drawing import BAD as WRONG
from plumb.pictures.drawing import GOOD as CUT
from plumb.pictures.drawing import NOWHERE, QUIET, Corners, Dot, Panel, Ways, draw, shades_of
from plumb.settings.machine import MachineSettings
from plumb.text.values import Unit
from plumb.words.job import JobAnswer, all_of, changes_said, colours, headline, runs_here
from plumb.words.states import KINDS

NAMED = 30  # parts that get their number in the picture


def run(arguments: argparse.Namespace) -> int:
    """Check, draw, print, and return the exit code."""
    refuse_twins(arguments.picture, arguments.outline, arguments.fix)
    form = picture_form(arguments.picture) if arguments.picture else ""
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
    if arguments.picture:
        files[arguments.picture] = _picture(checked, settings, arguments.job, unit, form=form)
    if arguments.outline:
        outline = outline_of(checked.over_sheet, checked.samples, name=Path(arguments.job).name)
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


def _picture(
    checked: CheckedJob, settings: MachineSettings, name: str, unit: Unit, *, form: str
) -> bytes:
    """Return the whole sheet with the job on it, and below it the job from near."""
    sheet = sheet_of(checked, settings, name)
    near = replace(sheet, title="From near", view=near_view(checked))
    panels = [replace(sheet, dots=()), near]
    words = [colours(checked.piece, unit)]
    return draw(panels, sheet=settings.sheet, words=words, columns=1, form=form)


def sheet_of(checked: CheckedJob, settings: MachineSettings, name: str) -> Panel:
    """Return the sheet with the job: its ways by their kind, its parts by number, its depth."""
    over_sheet, samples, piece = checked.over_sheet, checked.samples, checked.piece
    ways = np.split(samples.places, np.flatnonzero(np.diff(samples.move)) + 1)
    spoiled = {line for finding in checked.findings if finding.is_wrong for line in finding.lines}
    bad = np.isin(over_sheet["line"], list(spoiled))
    if checked.hanging is not None:
        # Above the sheet the sled may pass where it could not cut.
        passing = checked.hanging.unusable
        bad[passing] |= over_sheet.cut[passing]
    kinds = np.where(bad, "bad", np.where(over_sheet.cut, "cut", "rapid"))
    of = {
        kind: [way for way, each in zip(ways, kinds, strict=True) if each == kind]
        for kind in ("rapid", "cut", "bad")
    }
    labels = [
        Dot((part.low[0] + part.high[0]) / 2, (part.low[1] + part.high[1]) / 2, f"{i}", size=0)
        for i, part in enumerate(checked.parts[:NAMED], start=1)
    ]
    # Straight down is no line from above.
    down = [way[0] for way in of["bad"] if np.ptp(way, axis=0).max() < POINT]
    dots = [Dot(x, y, colour=WRONG) for x, y in down]
    return Panel(
        title=headline(checked, Path(name).name),
        good=checked.is_good,
        ways=[
            Ways(of["rapid"], QUIET, 0.6, "--"),
            Ways(of["cut"], CUT, 0.7),
            Ways(of["bad"], WRONG, 2.4),
        ],
        dots=[*labels, *dots],
        shades=shades_of(-piece.heights / (piece.deepest or 1.0)) if piece else None,
        shaded=_corners(piece.corners) if piece else NOWHERE,
    )


POINT, LEAST, FREE = 0.1, 20.0, 0.08  # [mm] of a way, of wood from near; of the job's size


def near_view(checked: CheckedJob) -> Corners:
    """Return what of the sheet is shown from near: the job with a little around it."""
    piece = checked.piece
    cut = checked.samples.places[checked.over_sheet.cut[checked.samples.move]]
    places = np.vstack([cut if len(cut) else np.zeros((1, 2)), piece.corners if piece else cut])
    low, high = places.min(axis=0), places.max(axis=0)
    half = np.maximum((high - low) / 2 * (1 + 2 * FREE), LEAST / 2)
    # No flatter than a quarter, and no higher than it is wide.
    half = np.maximum(half, [half[1], half[0] / 4])
    return _corners(np.array([(low + high) / 2 - half, (low + high) / 2 + half]))


def _corners(corners: np.ndarray) -> Corners:
    (left, low), (right, high) = corners.tolist()
    return (left, low), (right, high)


# The arguments of `plumb check`.

EXAMPLES = (
    "plumb check pocket.nc machine.toml",
    "plumb check pocket.nc machine.toml --marks marks.toml --picture job.png",
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
    add_shared(parser, picture="draw the job on its sheet, shaded by depth")
    parser.add_argument(
        "--outline",
        metavar="FILE",
        help="write a program that goes round the job, slowly, with the bit above the sheet",
    )
    parser.add_argument(
        "--fix",
        metavar="FILE",
        help="write a program that cuts the same on this machine, and list what was changed",
    )
    add_shared(parser, "--force", "--units", "--json")
