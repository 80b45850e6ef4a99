"""What goes into the diary: a fit with its marks and numbers, numbers sent, programs sent."""

from __future__ import annotations

from collections.abc import Mapping
from hashlib import sha256
from importlib.metadata import version
from typing import Any

from plumb.cure.add import Addition, Parameter
from plumb.fit.inputs import Inputs

FIT, NUMBERS, PROGRAM = "fit", "numbers", "program"
RECHECK, SLIP, HOME = "recheck", "slip", "home"


def fit_entry(
    result: Addition, inputs: Inputs, *, machine: str, settings: str, firmware: str = "plumb"
) -> dict[str, Any]:
    """A fit: the new settings (text of the file `machine`), marks, errors, numbers and how well
    they are known together. mm, N, rad."""
    fitted = result.after_fit
    return {
        "plumb": version("plumb"),
        "machine": machine,
        "settings": settings,
        "firmware": firmware,
        "marks_files": [each.name for each in inputs.measurements.rounds],
        "before_mm": result.raw.rms,
        "rms_mm": result.after.fit_rms,
        "priced_mm": result.after.priced_rms,
        "left_out_mm": result.after.left_out_rms,
        "worst_mm": result.after.worst,
        "sigma_mm": fitted.sigma,
        "marks": _marks(result, inputs),
        "distances": _distances(result, inputs),
        "numbers": [_number(parameter) for parameter in result.parameters],
        "effects": list(result.effects_added),
        # Of all unknowns, in the units of their numbers: what a later recheck has to allow for.
        "unknowns": [estimate.name for estimate in fitted.estimates],
        "covariance": fitted.covariance.tolist(),
    }


def numbers_entry(
    machine: str,
    lines: list[str],
    *,
    changed: Mapping[int, tuple[float, float]],
    firmware: str,
    kept: str,
    back: bool = False,
) -> dict[str, Any]:
    """Numbers that a machine holds now: the `$` lines sent, and old and new value of each change;
    `kept` is the file with all that were replaced; `back`: it had them before `machine`."""
    return {
        "plumb": version("plumb"),
        "machine": machine,
        "lines": lines,
        "changed": {f"${number}": list(both) for number, both in changed.items()},
        "firmware": firmware,
        "kept": kept,
        "back": back,
    }


def program_entry(name: str, lines: list[str], *, whole: bool) -> dict[str, Any]:
    """A program that was sent; whole: False if it was stopped or refused."""
    text = "\n".join(lines)
    return {
        "program": name,
        "sha256": sha256(text.encode()).hexdigest(),
        "lines": len(lines),
        "whole": whole,
    }


def _marks(result: Addition, inputs: Inputs) -> list[dict[str, Any]]:
    readings, fitted = inputs.measurements.readings, result.after_fit
    return [
        {
            "name": mark.name,
            "file": inputs.measurements.rounds[mark.round].name,
            "target": list(mark.target),
            "measured": list(measured),
            "predicted": list(predicted),
            "error": list(error),
        }
        for (mark, measured), predicted, error in zip(
            readings, fitted.predicted.tolist(), fitted.errors.tolist(), strict=True
        )
    ]


def _distances(result: Addition, inputs: Inputs) -> list[dict[str, Any]]:
    return [
        {"between": list(distance.between), "mm": distance.length, "error_mm": error}
        for distance, error in zip(
            inputs.measurements.distances, result.after_fit.distance_errors.tolist(), strict=True
        )
    ]


def _number(parameter: Parameter) -> dict[str, Any]:
    names = ("name", "value", "low", "high", "unit", "before")
    return {name: getattr(parameter, name) for name in names}
