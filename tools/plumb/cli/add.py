"""`plumb add`: fit the machine with more effects, and write its new settings."""

from __future__ import annotations

import argparse
from dataclasses import replace
from typing import Any

from plumb.cli.add_text import PATCH_WARNING, as_text, auto_text, turn_sentence
from plumb.cli.compare import panel_of, score_json
from plumb.cli.files import (
    inputs_of,
    picture_form,
    refuse_twins,
    write_outputs,
)
from plumb.cli.text import about, print_json, sentences
from plumb.cure.add import Addition, Parameter, Quality, add, priors_with
from plumb.cure.auto import AutoAddition, add_auto, without_marks
from plumb.fit.inputs import Inputs
from plumb.fit.patch import PATCH
from plumb.model.catalogue import is_sketch
from plumb.pictures.sheet import Panel, draw
from plumb.settings.files import changed_ini, groundcontrol_changes, machine_toml
from plumb.text.errors import InputError, refusal


def run(arguments: argparse.Namespace) -> int:
    """Fit, write, print, and return the exit code."""
    refuse_twins(arguments.output, arguments.groundcontrol, arguments.picture)
    inputs = inputs_of(arguments)
    if arguments.without:
        marks = without_marks(inputs.measurements, arguments.without)
        inputs = replace(inputs, measurements=marks)
    inputs = replace(inputs, priors=priors_with(arguments.prior), sigma=arguments.sigma)
    if not arguments.effect and not arguments.patch:
        raise InputError("nothing to add: name effects with --effect, or give --effect auto")
    if "auto" in arguments.effect:
        return _run_auto(arguments, inputs)
    result = add(inputs, effects=arguments.effect, patch=arguments.patch)
    files, unsaid = _written(arguments, inputs, result)
    if arguments.json:
        print_json({**as_json(result), "written": files, "unsaid": unsaid})
    else:
        print(as_text(result, asked_patch=arguments.patch))
        _print_written(files, unsaid)
    return int(not result.pays)


def _run_auto(arguments: argparse.Namespace, inputs: Inputs) -> int:
    if len(arguments.effect) > 1:
        raise InputError("--effect auto finds the effects itself; name no others with it")
    result = add_auto(inputs, patch=arguments.patch)
    files: list[str] = []
    unsaid: list[str] = []
    if result.addition:
        files, unsaid = _written(arguments, inputs, result.addition)
    if arguments.json:
        addition = as_json(result.addition) if result.addition else {}
        print_json({**addition, "auto": auto_json(result), "written": files, "unsaid": unsaid})
    else:
        print(auto_text(result))
        _print_written(files, unsaid)
    return int(not result.done)


def _written(
    arguments: argparse.Namespace, inputs: Inputs, result: Addition
) -> tuple[list[str], list[str]]:
    """Write the files; their names, and what the groundcontrol.ini cannot hold."""
    _refuse_sketches(arguments, result)
    files = _files(arguments, inputs, result)
    read = [arguments.settings, *arguments.marks]
    read += [arguments.cut_with] if arguments.cut_with else []
    write_outputs(files, inputs=read)
    return list(files), unsaid_of(result) if arguments.groundcontrol else []


def _refuse_sketches(arguments: argparse.Namespace, result: Addition) -> None:
    """Refuse to write settings without a sketch that was fitted with them."""
    for name in filter(is_sketch, result.after_fit.lab_effects):
        for option, path in (
            ("-o", arguments.output),
            ("--groundcontrol", arguments.groundcontrol),
        ):
            if path:
                raise InputError(
                    f"{option} {path}: {name} is a sketch, which no firmware has; write it in C++ "
                    f"first (docs/new-effect.md), or leave {option} away to look at the fit"
                )


def _print_written(files: list[str], unsaid: list[str]) -> None:
    if files:
        print(f"\nWritten: {', '.join(files)}")
    if unsaid:
        print("\nWhat the published firmware cannot do with the groundcontrol.ini:")
        print(sentences(unsaid))


def _files(arguments: argparse.Namespace, inputs: Inputs, result: Addition) -> dict[str, bytes]:
    """All files to write, complete before the first is written."""
    files: dict[str, bytes] = {}
    if arguments.output:
        files[arguments.output] = toml_of(result, source=inputs.measurements.source)
    if arguments.groundcontrol:
        original = next(
            (
                path
                for path, read in (
                    (arguments.settings, inputs.settings),
                    (arguments.cut_with, inputs.cut_with),
                )
                if read and path.lower().endswith(".ini")
            ),
            None,
        )
        if original is None:
            raise refusal(
                arguments.groundcontrol,
                "needs a groundcontrol.ini whose other keys it keeps",
                remedy="give it as SETTINGS or with --cut-with",
            )
        files[arguments.groundcontrol] = ini_of(result, original)
    if arguments.picture:
        form = picture_form(arguments.picture)
        drawn = draw(panels_of(result), sheet=result.settings.sheet, form=form)
        files[arguments.picture] = drawn
    return files


def toml_of(result: Addition, *, source: str) -> bytes:
    """The new machine as the bytes of a machine.toml."""
    lines = [
        f"Fitted to {source}: {result.after.fit_rms:.2f} mm RMS "
        f"(priced {result.after.priced_rms:.2f}, left out {result.after.left_out_rms:.2f}), "
        f"{result.raw.rms:.2f} mm before.",
        turn_sentence(result),
        *result.cures,
        *([f"{PATCH}: {PATCH_WARNING}"] if PATCH in result.effects_added else []),
        *result.warnings,
    ]
    return machine_toml(result.settings, comment="\n".join(lines)).encode()


def ini_of(result: Addition, original: str) -> bytes:
    """The new machine as far as a groundcontrol.ini can hold it."""
    return changed_ini(original, groundcontrol_changes(result.settings).values)


def unsaid_of(result: Addition) -> list[str]:
    """What a groundcontrol.ini cannot hold."""
    return [loss.sentence for loss in groundcontrol_changes(result.settings).unsaid]


def panels_of(result: Addition) -> list[Panel]:
    """Before and after as panels of a picture."""
    after = result.after
    return [
        panel_of(result.raw, when="Before"),
        Panel(
            title=f"After: {about(after.fit_rms)} mm RMS, worst {about(after.worst)} mm",
            predicted=result.after_fit.predicted,
            errors=result.after_fit.errors,
            good=True,
        ),
    ]


def as_json(addition: Addition) -> dict[str, Any]:
    """The addition by the names of the interface."""
    return {
        "raw": {
            "rms_mm": addition.raw.rms,
            "worst_mm": addition.raw.worst,
            "shape_rms_mm": addition.raw.shape_rms,
        },
        "before": _quality_json(addition.before),
        "after": _quality_json(addition.after),
        "steps": [
            {"effect": step.effect, "only_fit": step.only_fit, **_quality_json(step.quality)}
            for step in addition.steps
        ],
        "parameters": [_parameter_json(parameter) for parameter in addition.parameters],
        "effects_added": addition.effects_added,
        "effects": addition.settings.effects,
        "lab_effects": addition.after_fit.lab_effects,
        "cures": addition.cures,
        "frame": addition.settings.frame,
        "sheet_rotation": addition.after_fit.sheet_rotation,
        "sheet_rise_mm": addition.sheet_rise,
        "sigma_mm": addition.after_fit.sigma,
        "sigma_from": addition.sigma_from,
        "benchmark": {
            "before": score_json(addition.raw.benchmark),
            "after": score_json(addition.benchmark_after),
        },
        "warnings": addition.warnings,
    }


def auto_json(result: AutoAddition) -> dict[str, Any]:
    """How the effects were chosen."""
    return {
        "verdict": result.diagnosis.verdict,
        "chosen": result.chosen,
        "rivals": result.rivals,
        "slips": [slip.name for slip in result.diagnosis.slips],
        "reason": result.reason,
        "settled_by": result.settled_by,
        "patch_offer_mm": result.offer,
    }


def _quality_json(quality: Quality) -> dict[str, Any]:
    return {
        "fit_rms_mm": quality.fit_rms,
        "priced_rms_mm": quality.priced_rms,
        "left_out_rms_mm": quality.left_out_rms,
        "worst_mm": quality.worst,
        "shape_rms_mm": quality.shape_rms,
    }


def _parameter_json(parameter: Parameter) -> dict[str, Any]:
    return {
        "name": parameter.name,
        "value": parameter.value,
        "low": parameter.low,
        "high": parameter.high,
        "unit": parameter.unit,
        "before": parameter.before,
        "prior_sigma": parameter.prior_sigma,
        "possible": parameter.plausible_range.limits,
        "plausible": parameter.plausible,
    }
