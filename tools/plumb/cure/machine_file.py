"""The machine.toml of a fitted machine: its numbers, below what the fit says of them."""

from __future__ import annotations

from dataclasses import replace

from plumb.cure.add import Addition
from plumb.fit.patch import PATCH
from plumb.settings.files import machine_toml, published_machine
from plumb.settings.fit_record import FitRecord
from plumb.text.shown import worded

PATCH_WARNING = (
    "It is no physics: a smooth map that holds for this machine, sled and sheet as they are, and "
    "only where marks were measured."
)


def toml_of(
    result: Addition,
    *,
    source: str,
    firmware: str = "plumb",
    record: FitRecord | None = None,
) -> bytes:
    """The new machine as the bytes of a machine.toml, with the formula of its firmware."""
    ours = replace(result.settings, fitted=record)
    settings = published_machine(ours) if firmware == "published" else ours
    lines = [
        f"Fitted to {source}: {result.after.fit_rms:.2f} mm RMS "
        f"(counted for the numbers fitted {result.after.priced_rms:.2f}, checked on marks not used "
        f"{result.after.left_out_rms:.2f}), {result.raw.rms:.2f} mm before.",
        *turn_sentences(result),
        *result.cures,
        *([f"{PATCH}: {PATCH_WARNING}"] if PATCH in result.effects_added else []),
        *result.warnings,
    ]
    return machine_toml(settings, comment="\n".join(lines)).encode()


def turn_sentences(result: Addition) -> list[str]:
    """What to do about the sheet's rotation, if the marks prove it."""
    if not result.after_fit.proves_sheet_rotation:
        return []
    rise = result.sheet_rise
    which = "raise" if rise > 0 else "lower"
    return [
        f"no setting holds the sheet's rotation: {which} its right end by {worded(abs(rise))} over "
        f"its width of {worded(result.settings.sheet_width, 0)}"
    ]
