"""Contents of docs/effects.md and its pictures: the registry."""

from __future__ import annotations

from collections.abc import Sequence

from fields import Picture, drawing
from fingerprints import (
    COLUMNS,
    FRAME_STEPS,
    ROWS,
    SHEET,
    Array,
    Showing,
    Showings,
    every_showing,
    look_alikes,
    worst,
)
from plumb.fit.observations import rms
from plumb.model.catalogue import NO_FIRMWARE, empirical_effects, every_effect
from template import filled

PAGE = "docs/effects.md"
PICTURES = "docs/pictures/effects"
DRAWN_COLUMNS, DRAWN_ROWS = 9, 5


def pages() -> dict[str, str]:
    """Return the page and each picture by its name below the project's root."""
    effects, showings = every_effect(), every_showing()
    text = filled(
        "effects.md",
        effects=effects,
        patches=empirical_effects(),
        showings=showings,
        no_firmware=NO_FIRMWARE,
        columns=COLUMNS,
        rows=ROWS,
        frame_steps=FRAME_STEPS,
        alike=lambda name: alike(name, showings),
        largest=lambda several: f"{max(map(worst, several)):.1f}",
    )
    drawn = {picture_name(each["name"]): each["name"] for each in effects}
    return {PAGE: text} | {at: picture(name, showings[name]) for at, name in drawn.items()}


def picture_name(effect: str) -> str:
    """Return where an effect's picture lies below the project's root."""
    return f"{PICTURES}/{effect}.svg"


def picture(effect: str, cases: Sequence[Showing]) -> str:
    """Return the fingerprint: for each case what marks do, and the shape that is left of it."""
    rows = []
    for case in cases:
        drawn = case.field_on(DRAWN_COLUMNS, DRAWN_ROWS)
        grid = (DRAWN_ROWS, DRAWN_COLUMNS, 2)
        sent, raw, shape = (places.reshape(grid) for places in (drawn.sent, drawn.raw, drawn.shape))
        left = Picture(f"as it is: {_sizes(case.field.raw)}", sent, raw)
        right = Picture(f"its shape: {_sizes(case.field.shape)}", sent, shape)
        if not case.field.has_shape:
            right = Picture("its shape", sent, None, "no shape: all marks shift and turn together")
        rows.append((case.label_with_size, (left, right)))
    return drawing(f"{effect}: what it does to marks on the sheet", rows, sheet=SHEET)


def alike(name: str, showings: Showings) -> str:
    """Return the computed look-alikes in words."""
    nearest = look_alikes(name, showings)
    if nearest:
        return ", ".join(f"`{other}` {cosine + 0.0:.2f}" for other, cosine in nearest)
    shapeless = [
        f"`{other}`"
        for other, cases in showings.items()
        if other != name and not any(case.field.has_shape for case in cases)
    ]
    others = " and ".join([*shapeless, "`sheet_rotation`"])
    return f"it has no shape, so everything that shifts and turns the sheet: {others}"


def _sizes(errors: Array) -> str:
    return f"{rms(errors):.2f} mm RMS, worst {worst(errors):.2f}"
