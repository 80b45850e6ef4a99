"""`plumb add`: fit the machine with more effects, and write its new settings."""

from __future__ import annotations

import argparse
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated

from plumb.cli.arguments import (
    BOARD,
    add_shared,
    add_stated,
    held_size,
    refuse_unfitted,
    stated_inputs,
)
from plumb.cli.drawing import Panel, draw, panel_of, picture_form
from plumb.cli.output import STDOUT, refuse_twins, say_failure, write_outputs
from plumb.cli.screen import (
    AUTO,
    CLIENT_OF,
    add_named,
    headline,
    in_text,
    into_machine,
    next_step,
    print_json,
    second_round,
    sentences,
    usual_client,
    what_follows,
)
from plumb.cli.settings import WrittenFiles, add_client, add_firmware, client_files_of, client_text
from plumb.cure.add import Addition, add, refuse_other_origin
from plumb.cure.decision import decide, record_of, toml_of
from plumb.diary.file import FIT, fit_entry, keep
from plumb.fit.inputs import Inputs
from plumb.model.plain import noun_of
from plumb.text.answers import meant
from plumb.text.errors import InputError
from plumb.text.values import Unit
from plumb.words import Kind, Part
from plumb.words import decision as words
from plumb.words.comparison import about
from plumb.words.states import STATES

NONE = "none"  # as an effect: the frame alone


@dataclass(frozen=True, kw_only=True)
class Added(WrittenFiles, Addition):
    """The addition of effects."""

    auto: Annotated[words.DecisionInWords | None, meant("Null: the effects were named.")] = None


@dataclass(frozen=True, kw_only=True)
class NothingAdded(WrittenFiles):
    """Why nothing was added."""

    auto: words.DecisionInWords


AddAnswer = Added | NothingAdded


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
    files = _allowed(arguments, inputs, result)
    if arguments.json:
        print_json(Added(**vars(result), **vars(files)))
    else:
        said = words.numbers(result, result.notes)
        if arguments.details:
            said = words.everything(result, result.notes, asked_patch=arguments.patch)
        _print(said, words.of_named(result), _ending(arguments, result, files))
    return int(not result.pays and arguments.effect != [NONE])


def _run_auto(arguments: argparse.Namespace, inputs: Inputs) -> int:
    if len(arguments.effect) > 1:
        raise InputError("--effect auto finds the effects itself; name no others with it")
    if arguments.hold:
        raise InputError("--effect auto finds the sizes itself; hold none with it")
    decision = decide(inputs, patch=arguments.patch)
    added, follows = decision.addition, STATES[decision.state]
    files = _allowed(arguments, inputs, added) if added else WrittenFiles()
    if arguments.json:
        why = NothingAdded(auto=words.in_words(decision), **vars(files))
        print_json(Added(**vars(added), **vars(why)) if added else why)
    else:
        said = words.full(decision) if arguments.details else words.short(decision)
        after = [what_follows(follows, arguments, ["add"], "--effect", AUTO)]
        after = _ending(arguments, added, files) if added else after
        _print(said, (words.headline(decision), follows.kind), after)
    return follows.code


def _print(said: list[Part], verdict: tuple[str, Kind], after: list[str]) -> None:
    print("\n\n".join([*in_text(said), headline(*verdict), *after]))


def _allowed(arguments: argparse.Namespace, inputs: Inputs, result: Addition) -> WrittenFiles:
    """Write the files that were asked for, if nothing speaks against the numbers."""
    if result.stops and not arguments.force:
        return WrittenFiles()
    return written(arguments, inputs, result)


def written(
    arguments: argparse.Namespace, inputs: Inputs, result: Addition, **usual: str | None
) -> WrittenFiles:
    """Write the machine, its picture and what belongs to its client, all or none; `usual` holds
    what was not typed.
    """
    given = {**vars(arguments), **usual}
    output, picture, original = given["output"], given.get("picture"), given["original"]
    settings = [*filter(None, [arguments.settings, arguments.cut_with])]
    client = client_files_of(
        given["client"],
        original,
        result.settings,
        lines=output and str(Path(output).with_suffix(".nc")),
        firmware=arguments.firmware,
        originals=settings,
    )
    files: dict[str, bytes] = {}
    if output:
        files[output] = toml_of(
            result,
            source=inputs.measurements.source,
            firmware=arguments.firmware,
            record=record_of(result, inputs, without=arguments.without),
        )
    if picture:
        files[picture] = fall_of(result, form=picture_form(picture))
    refuse_twins(*files, *(client.files if client else ()))
    files |= client.files if client else {}
    write_outputs(files, inputs=[*settings, *arguments.marks, *filter(None, [original])])
    if output:
        machine, text, firmware = Path(output).name, files[output].decode(), arguments.firmware
        entry = fit_entry(result, inputs, machine=machine, settings=text, firmware=firmware)
        say_failure(keep(output, FIT, entry))
    return WrittenFiles(written=tuple(files), client=client)


def _ending(arguments: argparse.Namespace, result: Addition, files: WrittenFiles) -> list[str]:
    """Return what was written, and what the owner does now."""
    if result.stops and not arguments.force:
        return ["Nothing is written. --force writes these numbers all the same."]
    if arguments.output:
        return after_writing(arguments, files, result.unit)
    drawn = [f"Written: {', '.join(files.written)}"] if files.written else []
    return [*drawn, next_step("Write it:", add_named(arguments, arguments.effect))]


def after_writing(arguments: argparse.Namespace, files: WrittenFiles, unit: Unit) -> list[str]:
    """Return which files a new machine has, and what the owner does with them."""
    machine, client = files.written[0], files.client
    said = sentences([f"Written: {', '.join(files.written)}"], mark="")
    if machine == STDOUT:
        return [said]
    if client:
        named = [machine, *client.files]
        return [f"{said}\n{client_text(client)}", second_round(arguments, named, unit)]
    usual = usual_client(arguments)
    if arguments.firmware != "plumb":
        why = "Give --client: it is what brings the published firmware its numbers."
        return [said, sentences([why])]
    if usual[1] == "none":
        return [said, into_machine(machine), second_round(arguments, [machine], unit)]
    is_client = Path(arguments.settings).suffix.lower() in CLIENT_OF
    original = ["--original", arguments.settings] if is_client else usual[2:]
    command = ["settings", machine, *usual[:2], *original]
    sent = str(Path(machine).with_suffix(".nc"))
    return [said, next_step("For the machine:", [*command, "-o", sent])]


def fall_of(result: Addition, *, form: str = "png") -> bytes:
    """Return the picture of how the error falls, effect by effect: as set, with the frame fitted,
    and with each effect.
    """
    fits = [("Frame fitted", result.before.fit)]
    fits += [(f"+ {noun_of(step.effect)}", step.fit) for step in result.by_effect]
    stairs = [replace(panel_of(result.raw), title=_titled("As set", result.raw.rms))]
    stairs += [
        Panel(_titled(title, fit.rms), fit.predicted, fit.errors, good=True) for title, fit in fits
    ]
    return draw(
        stairs, heading=words.picture_heading(result), sheet=result.settings.sheet, form=form
    )


def _titled(title: str, rms: float) -> str:
    return f"{title}\n{about(rms)} mm RMS"


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
