"""Contents of docs/effects.md and its pictures: the registry."""

from __future__ import annotations

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
from plumb.pictures.drawing import Panel, draw
from template import filled

PAGE = "docs/effects.md"
PICTURES = "docs/pictures/effects"
DRAWN_COLUMNS, DRAWN_ROWS = 9, 5


def pages() -> dict[str, str]:
    """Return the page by its name below the project's root."""
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
    return {PAGE: text}


def pictures() -> dict[str, bytes]:
    """Return the picture of each effect by its name below the project's root."""
    showings = every_showing()
    return {
        f"{PICTURES}/{effect['name']}.png": draw(
            [_panel(case) for case in showings[effect["name"]]], sheet=SHEET
        )
        for effect in every_effect()
    }


def _panel(case: Showing) -> Panel:
    """Return the shape that an effect draws; all that marks do, where they only shift and turn."""
    drawn, whole = case.field_on(DRAWN_COLUMNS, DRAWN_ROWS), case.field
    if not whole.has_shape:
        said = f"{case.label_with_size}: no shape, {_sizes(whole.raw)}"
        return Panel(said, drawn.sent, drawn.raw)
    said = f"{case.label_with_size}: {_sizes(whole.shape)}; {rms(whole.raw):.2f} as it is"
    return Panel(said, drawn.sent, drawn.shape)


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
