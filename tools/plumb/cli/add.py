"""`plumb add`: fit the machine with more effects, and write its new settings."""

from __future__ import annotations

import argparse
from dataclasses import dataclass, replace
from pathlib import Path

from plumb.cli.addition import (
    addition_text,
    decision_verdict,
    details_text,
    numbers_text,
    short_text,
    verdict_of,
)
from plumb.cli.arguments import BOARD, add_shared, held_size
from plumb.cli.compare import panel_of
from plumb.cli.inputs import add_stated, picture_form, refuse_unfitted, stated_inputs
from plumb.cli.output import STDOUT, refuse_twins, say_failure, write_outputs
from plumb.cli.screen import (
    AUTO,
    CLIENT_OF,
    about,
    add_named,
    into_machine,
    next_step,
    print_json,
    same_inputs,
    second_round,
    sentences,
    usual_client,
)
from plumb.cli.settings import WrittenFiles, add_client, add_firmware, client_files_of, client_text
from plumb.cure.add import Addition, add
from plumb.cure.decision import Decision, decide
from plumb.cure.live_board import refuse_other_origin
from plumb.cure.machine_file import record_of, toml_of
from plumb.diary.file import FIT, fit_entry, keep
from plumb.firmware.client_files import ClientFiles
from plumb.fit.covariates import PATCH
from plumb.fit.inputs import Inputs
from plumb.model.plain import noun_of
from plumb.pictures.drawing import Panel, draw
from plumb.text.answers import in_json
from plumb.text.errors import InputError

NONE = "none"  # as an effect: the frame alone


@dataclass(frozen=True, kw_only=True)
class WrittenMachine(WrittenFiles):
    """Files of the new machine."""

    @in_json
    def unsaid(self) -> tuple[str, ...]:
        """Limits of the firmware, a sentence each."""
        return self.client.unsaid if self.client else ()


@dataclass(frozen=True, kw_only=True)
class NamedAnswer(WrittenMachine, Addition):
    """The addition of the effects that were named."""


@dataclass(frozen=True, kw_only=True)
class AutoAnswer(NamedAnswer):
    """The addition of the effects that were chosen."""

    auto: Decision


@dataclass(frozen=True, kw_only=True)
class NothingAdded(WrittenMachine):
    """Why nothing was added."""

    auto: Decision


AddAnswer = NamedAnswer | AutoAnswer | NothingAdded


def run(arguments: argparse.Namespace) -> int:
    """Fit, write, print, and return the exit code."""
    refuse_twins(arguments.output, arguments.picture)
    inputs = stated_inputs(arguments)
    refuse_other_origin(inputs)
    if not arguments.effect and not arguments.patch:
        raise InputError(
            "nothing to add: name effects with --effect, or give --effect auto, or --effect none"
        )
    if AUTO in arguments.effect:
        return _run_auto(arguments, inputs)
    if NONE in arguments.effect and len(arguments.effect) > 1:
        raise InputError("--effect none fits the frame alone; name no effects with it")
    effects = [name for name in arguments.effect if name != NONE]
    held = dict(arguments.hold)
    refuse_unfitted(inputs.checked, effects, held)
    result = add(inputs, effects=effects, held=held, patch=arguments.patch)
    files: list[str] = []
    client: ClientFiles | None = None
    if arguments.force or not result.stops:
        files, client = written(WantedFiles.by(arguments), inputs, result)
    if arguments.json:
        print_json(NamedAnswer(**vars(result), written=tuple(files), client=client))
    else:
        shown = (
            addition_text(result, result.notes, asked_patch=arguments.patch)
            if arguments.details
            else [numbers_text(result, result.notes)]
        )
        print("\n\n".join([*shown, verdict_of(result)]))
        _print_written(result, files, client, arguments)
    return int(not result.pays and arguments.effect != [NONE])


def _run_auto(arguments: argparse.Namespace, inputs: Inputs) -> int:
    if len(arguments.effect) > 1:
        raise InputError("--effect auto finds the effects itself; name no others with it")
    if arguments.hold:
        raise InputError("--effect auto finds the sizes itself; hold none with it")
    result = decide(inputs, patch=arguments.patch)
    files: list[str] = []
    client: ClientFiles | None = None
    if result.addition and (arguments.force or result.state != "impossible"):
        files, client = written(WantedFiles.by(arguments), inputs, result.addition)
    if arguments.json:
        why = NothingAdded(auto=result, written=tuple(files), client=client)
        added = result.addition
        print_json(AutoAnswer(**vars(added), **vars(why)) if added else why)
        return int(not result.done)
    shown = (
        details_text(result, is_taken=True)
        if arguments.details
        else short_text(result, with_numbers=True)
    )
    print("\n\n".join([*shown, decision_verdict(result)]))
    same = same_inputs(arguments)
    if result.addition:
        _print_written(result.addition, files, client, arguments)
    elif result.state == "read_again":
        corrected = ["add", *same, "--effect", AUTO]
        print(f"\n{next_step('When the file is corrected:', corrected)}")
    elif result.state == "measure_first":
        print(f"\n{next_step('What to measure next:', ['next', *same])}")
    return int(not result.done)


@dataclass(frozen=True)
class WantedFiles:
    """The files that are wanted of a new machine."""

    output: str | None  # the machine.toml
    picture: str | None
    client: str | None
    original: str | None  # the client's file
    firmware: str
    settings: tuple[str, ...]  # files of settings that were read; one may be the client's
    marks: tuple[str, ...]
    without: tuple[str, ...]  # names of marks that took no part

    @classmethod
    def by(cls, arguments: argparse.Namespace, **other: str | None) -> WantedFiles:
        """Return what was typed, but for what is given otherwise."""
        named = ("output", "picture", "client", "original")
        typed = {name: getattr(arguments, name, None) for name in named}
        settings = (arguments.settings, arguments.cut_with)
        return cls(
            **{**typed, **other},
            firmware=arguments.firmware,
            settings=tuple(filter(None, settings)),
            marks=tuple(arguments.marks),
            without=tuple(arguments.without),
        )


def written(
    wanted: WantedFiles, inputs: Inputs, result: Addition
) -> tuple[list[str], ClientFiles | None]:
    """Write the files; their names, and what belongs to the client."""
    client = client_files_of(
        wanted.client,
        wanted.original,
        result.settings,
        lines=wanted.output and str(Path(wanted.output).with_suffix(".nc")),
        firmware=wanted.firmware,
        originals=wanted.settings,
    )
    files = _files(wanted, inputs, result)
    refuse_twins(*files, *(client.files if client else ()))
    files |= client.files if client else {}
    original = [wanted.original] if wanted.original else []
    write_outputs(files, inputs=[*wanted.settings, *wanted.marks, *original])
    if wanted.output:
        machine, settings = Path(wanted.output).name, files[wanted.output].decode()
        entry = fit_entry(
            result, inputs, machine=machine, settings=settings, firmware=wanted.firmware
        )
        say_failure(keep(wanted.output, FIT, entry))
    return list(files), client


def _print_written(
    result: Addition, files: list[str], client: ClientFiles | None, arguments: argparse.Namespace
) -> None:
    if result.stops and not arguments.force:
        print("\nNothing is written. --force writes these numbers all the same.")
        return
    if files:
        print(f"\nWritten: {', '.join(files)}")
    if client:
        print(client_text(client))
    if arguments.output == STDOUT:
        return
    if client and arguments.output:
        print(f"\n{second_round(arguments, [arguments.output, *client.files], result.unit)}")
    elif arguments.output:
        print(f"\n{_for_the_machine(arguments)}")
    else:
        print(f"\n{next_step('Write it:', add_named(arguments, arguments.effect))}")


def _for_the_machine(arguments: argparse.Namespace) -> str:
    """Return how a machine.toml comes into the machine, where no client was named."""
    client = usual_client(arguments)
    if arguments.firmware != "plumb":
        return sentences(["Give --client: it is what brings the published firmware its numbers."])
    if client[1] == "none":
        return into_machine(arguments.output)
    is_client = Path(arguments.settings).suffix.lower() in CLIENT_OF
    original = ["--original", arguments.settings] if is_client else client[2:]
    words = ["settings", arguments.output, *client[:2], *original]
    sent = str(Path(arguments.output).with_suffix(".nc"))
    return next_step("For the machine:", [*words, "-o", sent])


def _files(wanted: WantedFiles, inputs: Inputs, result: Addition) -> dict[str, bytes]:
    """Return the machine and its picture, complete before the first is written."""
    files: dict[str, bytes] = {}
    if wanted.output:
        files[wanted.output] = toml_of(
            result,
            source=inputs.measurements.source,
            firmware=wanted.firmware,
            record=record_of(result, inputs, without=wanted.without),
        )
    if wanted.picture:
        form = picture_form(wanted.picture)
        files[wanted.picture] = fall_of(result, form=form)
    return files


def fall_of(result: Addition, *, form: str = "png") -> bytes:
    """Return the picture of how the error falls, effect by effect: as set, with the frame fitted,
    and with each effect.
    """
    added = " and ".join(_noun(step.effect) for step in result.by_effect)
    done = f"Added: {added}" if added else "Frame fitted, nothing added"
    before, after = about(result.raw.rms), about(result.after.fit_rms)
    fits = [("Frame fitted", result.before_fit)]
    fits += [(f"+ {_noun(step.effect)}", step.fit) for step in result.by_effect]
    stairs = [replace(panel_of(result.raw), title=f"As set\n{before} mm RMS")]
    stairs += [
        Panel(f"{title}\n{about(fit.rms)} mm RMS", fit.predicted, fit.errors, good=True)
        for title, fit in fits
    ]
    heading = f"{done}. From {before} to {after} mm RMS"
    return draw(stairs, heading=heading, sheet=result.settings.sheet, form=form)


def _noun(effect: str) -> str:
    return "patch" if effect == PATCH else noun_of(effect)


# The arguments of `plumb add`.

EXAMPLES = (
    "plumb add groundcontrol.ini marks.toml --effect auto -o machine.toml",
    "plumb add groundcontrol.ini marks.toml --effect none -o machine.toml",
)
EXIT = (
    "Exit: 0 done; 1 done, but the effects do not help to predict marks that the fit did not see, "
    "or auto cannot explain the marks (nothing is written for a slip); 2 an input cannot be used, "
    "and nothing was written."
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `plumb add`."""
    add_shared(parser, *BOARD)
    parser.add_argument(
        "--effect",
        metavar="NAME",
        nargs="+",
        action="extend",
        default=[],
        help="effects to fit (plumb effects lists them); auto: what plumb diagnose finds "
        "likeliest, and what every machine has; none: the frame alone. Other effects of SETTINGS "
        "stay as they are",
    )
    parser.add_argument(
        "--hold",
        metavar="NAME=SIZE",
        action="append",
        type=held_size,
        default=[],
        help="keep a parameter of these effects at a size, like chain_pitch.left=0.001; the rest "
        "is fitted",
    )
    parser.add_argument(
        "--patch",
        action="store_true",
        help="also fit a smooth map of the errors that no effect explains",
    )
    add_shared(parser, "--without", output="write the fitted machine to this file")
    add_client(parser)
    add_firmware(parser)
    add_stated(parser, sigma="tape_sigma_mm of MARKS and their scatter")
    add_shared(parser, picture="draw how the error falls")
    add_shared(parser, details="how the error falls with each effect, and more about each number")
    add_shared(parser, "--force", "--units", "--json")
