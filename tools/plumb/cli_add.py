"""`plumb add`: fit the machine with more effects, and write its new settings."""

from __future__ import annotations

import argparse
import math
from typing import Any

from plumb.add import Addition, Parameter, Quality, add, priors_with
from plumb.catalogue import effect_names
from plumb.cli_compare import panel_of, score_json
from plumb.cli_files import (
    Inputs,
    add_json,
    add_marks,
    inputs_of,
    length,
    picture_form,
    refuse_twins,
    write_outputs,
)
from plumb.cli_text import about, millimetres, number, print_json, sentences, table
from plumb.errors import InputError, refusal
from plumb.picture import Panel, draw
from plumb.settings_file import changed_ini, groundcontrol_changes, machine_toml

HELP = "fit the frame and the named effects to the marks, and write the new settings"
EXIT = (
    "Exit: 0 done; 1 done, but marks left out of the fit are not predicted better than without the "
    "effects; 2 an input cannot be used, and nothing was written."
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb add`."""
    add_marks(parser)
    parser.add_argument(
        "--effect",
        metavar="NAME",
        nargs="+",
        action="extend",
        required=True,
        help=f"effects to fit, after the marks: {', '.join(effect_names())}; those that SETTINGS "
        "have and that are not named stay as they are",
    )
    parser.add_argument("-o", "--output", metavar="FILE", help="write the machine.toml")
    parser.add_argument(
        "--groundcontrol",
        metavar="FILE",
        help="also write a groundcontrol.ini: other keys as they were in SETTINGS or --cut-with",
    )
    parser.add_argument(
        "--prior",
        metavar="NAME=SIGMA",
        action="append",
        type=prior,
        default=[],
        help="how far (one sigma; mm, N, rad) a stated number may be wrong; 0 holds it",
    )
    parser.add_argument(
        "--sigma",
        metavar="MM",
        type=length,
        help="reading error of one coordinate [tape_sigma_mm of MARKS, else from the residuals]",
    )
    parser.add_argument("--picture", metavar="FILE", help="draw before and after: .png, .svg, .pdf")
    add_json(parser)


def prior(text: str) -> tuple[str, float]:
    """One NAME=SIGMA."""
    name, separator, value = text.partition("=")
    try:
        sigma = float(value)
    except ValueError:
        sigma = -1.0
    if not (separator and math.isfinite(sigma) and sigma >= 0):
        raise argparse.ArgumentTypeError(f"'{text}' is not NAME=SIGMA, like motor_gap=1.5")
    return name, sigma


def run(arguments: argparse.Namespace) -> int:
    """Fit, write, print, and return the exit code."""
    if "auto" in arguments.effect:
        raise InputError(
            "--effect auto is not built yet; name the effects yourself, of "
            f"{', '.join(effect_names())}"
        )
    refuse_twins(arguments.output, arguments.groundcontrol, arguments.picture)
    inputs = inputs_of(arguments)
    result = add(
        inputs.settings,
        inputs.measurements,
        effects=arguments.effect,
        cut_with=inputs.cut_with,
        controller=arguments.controller,
        priors=priors_with(arguments.prior),
        sigma=arguments.sigma,
    )
    files = _files(arguments, inputs, result)
    read = [arguments.settings, *arguments.marks]
    read += [arguments.cut_with] if arguments.cut_with else []
    write_outputs(files, inputs=read)
    unsaid = unsaid_of(result) if arguments.groundcontrol else []
    if arguments.json:
        print_json({**as_json(result), "written": list(files), "unsaid": unsaid})
    else:
        print(as_text(result))
        if files:
            print(f"\nWritten: {', '.join(files)}")
        if unsaid:
            print("\nWhat the published firmware cannot do with the groundcontrol.ini:")
            print(sentences(unsaid))
    return int(not result.pays)


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
                remedy="give one as SETTINGS or with --cut-with",
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
        *result.warnings,
    ]
    return machine_toml(result.settings, comment="\n".join(lines)).encode()


def ini_of(result: Addition, original: str) -> bytes:
    """The new machine as far as a groundcontrol.ini can hold it."""
    return changed_ini(original, groundcontrol_changes(result.settings).values)


def unsaid_of(result: Addition) -> list[str]:
    """What a groundcontrol.ini cannot hold."""
    return [one.sentence for one in groundcontrol_changes(result.settings).unsaid]


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


def as_json(result: Addition) -> dict[str, Any]:
    """The addition by the names of the interface."""
    return {
        "raw": {
            "rms_mm": result.raw.rms,
            "worst_mm": result.raw.worst,
            "shape_rms_mm": result.raw.shape_rms,
        },
        "before": _quality_json(result.before),
        "after": _quality_json(result.after),
        "parameters": [_parameter_json(one) for one in result.parameters],
        "effects_added": result.effects_added,
        "effects": result.settings.effects,
        "lab_effects": result.after_fit.lab_effects,
        "cures": result.cures,
        "frame": result.settings.frame,
        "sheet_rotation": result.after_fit.sheet_rotation,
        "sheet_rise_mm": result.sheet_rise,
        "sigma_mm": result.after_fit.sigma,
        "sigma_from": result.after_fit.sigma_from,
        "benchmark": {
            "before": score_json(result.raw.benchmark),
            "after": score_json(result.benchmark_after),
        },
        "warnings": result.warnings,
    }


def _quality_json(quality: Quality) -> dict[str, Any]:
    return {
        "fit_rms_mm": quality.fit_rms,
        "priced_rms_mm": quality.priced_rms,
        "left_out_rms_mm": quality.left_out_rms,
        "worst_mm": quality.worst,
        "shape_rms_mm": quality.shape_rms,
    }


def _parameter_json(one: Parameter) -> dict[str, Any]:
    return {
        "name": one.name,
        "value": one.value,
        "low": one.low,
        "high": one.high,
        "unit": one.unit,
        "before": one.before,
        "prior_sigma": one.prior_sigma,
        "possible": [one.possible_low, one.possible_high],
        "plausible": one.plausible,
    }


def as_text(result: Addition) -> str:
    """The addition for people, its conclusion first."""
    raw, before, after = result.raw, result.before, result.after
    verdict = "better" if result.pays else "NOT better"
    first = (
        f"From {raw.rms:.2f} to {after.fit_rms:.2f} mm RMS; marks left out of the fit are "
        f"predicted {verdict} with the effects ({before.left_out_rms:.2f} to "
        f"{after.left_out_rms:.2f} mm)."
    )
    parts = [sentences([first], mark=""), _quality_table(result), _parameter_table(result)]
    if result.benchmark_after:
        parts.insert(1, _benchmark_sentence(result))
    sigma = result.after_fit
    origin = "as stated" if sigma.sigma_from == "stated" else "from the residuals"
    parts.append(
        "Priced: scaled up for the numbers the fit took from the data. Left out: each mark "
        "predicted\nby a fit that did not see it. Intervals: 95 %, for a reading error of "
        f"{sigma.sigma:.2f} mm ({origin})."
    )
    parts.append(sentences([turn_sentence(result), *result.cures, *result.warnings]))
    return "\n\n".join(parts)


def _benchmark_sentence(result: Addition) -> str:
    """The community's score before, and what to expect of the next cut."""
    said = (
        f"Calibration Benchmark Score: {result.raw.benchmark} as cut; {result.benchmark_after} to "
        "expect when it is cut again with the new settings, if nothing else changes."
    )
    return sentences([said], mark="")


def turn_sentence(result: Addition) -> str:
    """What to do about the sheet's rotation."""
    rise = result.sheet_rise
    which = "raise" if rise > 0 else "lower"
    return (
        f"no setting holds the sheet's rotation: {which} its right end by {abs(rise):.2f} mm over "
        f"its width of {result.settings.sheet_width:.0f} mm"
    )


def _quality_table(result: Addition) -> str:
    raw = result.raw
    rows = [["as the settings are", raw.rms, None, None, raw.worst, raw.shape_rms]]
    for name, own in (("frame fitted", result.before), ("with the effects", result.after)):
        rows.append([name, own.fit_rms, own.priced_rms, own.left_out_rms, own.worst, own.shape_rms])
    header = ["error in mm", "RMS", "priced", "left out", "worst", "shape"]
    return table(header, [[name, *map(millimetres, values)] for name, *values in rows])


def _parameter_table(result: Addition) -> str:
    rows = []
    for one in result.parameters:
        trusted = "free" if one.prior_sigma is None else number(one.prior_sigma)
        rows.append(
            [
                one.name,
                number(one.value),
                f"{number(one.low)} .. {number(one.high)}",
                number(one.before),
                trusted,
                one.unit,
                "" if one.plausible else "impossible",
            ]
        )
    return table(["number", "value", "interval", "before", "trusted to", "unit", ""], rows)
