"""Writes docs/effects.md and its pictures from the registry: `tools/research/effects_page.py`.

With --check nothing is written; exit 1 if a page or a picture is not as it would be written.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from typing import Any

from fingerprints import (
    COLUMNS,
    FRAME_STEPS,
    ROWS,
    SHEET,
    Array,
    Field,
    Fields,
    Showing,
    every_field,
    field_of,
    label_with_size,
    look_alikes,
    worst,
)
from plumb.fit.observations import rms
from plumb.model.catalogue import NO_FIRMWARE, empirical_effects, every_effect
from plumb.pictures.fingerprints import Picture, drawing
from writer import write_pages

PAGE = "docs/effects.md"
PICTURES = "docs/pictures/effects"
DRAWN_COLUMNS, DRAWN_ROWS = 9, 5
_FRAME_NUMBERS = ", ".join(f"`{name}`" for name in FRAME_STEPS)


def main(arguments: Sequence[str] | None = None) -> int:
    """Write the page and its pictures, or check them; 1 if they are stale, 2 if refused."""
    return write_pages(arguments, pages, command="effects_page", pictures=PICTURES)


def pages() -> dict[str, str]:
    """Return the page and each picture by its name below the project's root."""
    effects, fields = every_effect(), every_field()
    texts = {PAGE: page(effects, fields)}
    for effect in effects:
        texts[picture_name(effect["name"])] = picture(effect["name"], fields[effect["name"]])
    return texts


def picture_name(effect: str) -> str:
    """Return where an effect's picture lies below the project's root."""
    return f"{PICTURES}/{effect}.svg"


def picture(effect: str, cases: Sequence[tuple[Showing, Field]]) -> str:
    """Return the fingerprint: for each case what marks do, and the shape that is left of it."""
    rows = []
    for case, whole in cases:
        drawn = field_of(case, columns=DRAWN_COLUMNS, rows=DRAWN_ROWS)
        grid = (DRAWN_ROWS, DRAWN_COLUMNS, 2)
        sent, raw, shape = (places.reshape(grid) for places in (drawn.sent, drawn.raw, drawn.shape))
        left = Picture(f"as it is: {_sizes(whole.raw)}", sent, raw)
        right = Picture(f"its shape: {_sizes(whole.shape)}", sent, shape)
        if not whole.has_shape:
            right = Picture("its shape", sent, None, "no shape: all marks shift and turn together")
        rows.append((label_with_size(case), (left, right)))
    return drawing(f"{effect}: what it does to marks on the sheet", rows, sheet=SHEET)


def page(effects: Sequence[Mapping[str, Any]], fields: Fields) -> str:
    """Return the text of docs/effects.md."""
    parts = [HEAD, table_of_all(effects, fields), "## How to read this page", READING]
    parts += [section(effect, fields) for effect in effects]
    parts += [no_cause(patch) for patch in empirical_effects()]
    return "\n\n".join(parts) + "\n"


HEAD = f"""\
# The effects

<!-- Written by `tools/research/effects_page.py` from the registry. Do not edit this page. -->

An effect moves the sled, or its marks, away from where they should be. Effects of the *firmware*
have settings, and the machine undoes them. Effects of the *lab* act on what you measure:
{NO_FIRMWARE}. The lab fits them, names the cure, and keeps them out of the settings.
Worst: the largest error on the sheet while the effect has its typical size and the settings
do not know it."""

READING = f"""\
Numbers hold for the default machine (motors 2978.4 mm apart, sled of 97.9 N) with sag and stretch
at their typical sizes. A single effect has its typical size, and the settings do not know it.
{COLUMNS} x {ROWS} marks lie up to 1150 mm to both sides and 550 mm above and below the middle of a
2438.4 x 1219.2 mm sheet.

- **As it is**: where marks land, or are read, against where they were sent.
- **Shape**: what is left after the best shift and turn of all marks together. Only the shape makes
  parts the wrong size; the rest moves the job on the sheet.
- **RMS** and **worst**: of the lengths of all errors.
- **Pictures**: a circle is where a mark was sent, its arrow points to where it lands, many times
  too long. A thin line joins the tips of a row: that is how a straight row of cuts would bend.
  The scale differs from sheet to sheet.
- **Look-alikes** are computed: the cosine of the angle between two shapes, for the nearest of an
  effect's parameters. 1 is the same shape, -1 the same with the other sign, 0 nothing in
  common. Beyond 0.9 either way, marks on a single sheet hardly tell two causes apart.
  An effect is compared with these numbers of the frame too: {_FRAME_NUMBERS}."""


def table_of_all(effects: Sequence[Mapping[str, Any]], fields: Fields) -> str:
    """Return all effects with their settings and largest typical error."""
    lines = ["| effect | settings | worst, mm | worst of its shape, mm | firmware or lab |"]
    lines.append("|---|---|---|---|---|")
    for effect in effects:
        cases_fields = [field for _, field in fields[effect["name"]]]
        numbers = [p["setting"] for p in effect["parameters"] if p["setting"] is not None]
        settings = ", ".join(f"${number}" for number in numbers) or "none"
        raw = max(worst(field.raw) for field in cases_fields)
        shape = max(worst(field.shape) for field in cases_fields)
        name = effect["name"]
        lines.append(
            f"| [{name}](#{name}) | {settings} | {raw:.1f} | {shape:.1f} | {effect['where']} |"
        )
    return "\n".join(lines)


def section(effect: Mapping[str, Any], fields: Fields) -> str:
    """Return everything about an effect."""
    name = effect["name"]
    lab = f" ({effect['where']}: {NO_FIRMWARE})" if effect["where"] == "lab" else ""
    return "\n\n".join(
        [
            f"## {name}",
            f"**Cause{lab}**: {effect['summary']}.",
            f"**What it does**: {effect['pattern']}.",
            _parameters(effect),
            _size_table(fields[name]),
            f"![{name}: arrows over the sheet](pictures/effects/{name}.svg)",
            f"**Look-alikes**: {_alike(name, fields)}. In words: {effect['look_alikes']}.",
            f"**To be sure, or to cure it**: {effect['remedy']}.",
        ]
    )


def no_cause(patch: Mapping[str, Any]) -> str:
    """Return what the firmware can apply though it is no effect."""
    parameters = patch["parameters"]
    return "\n\n".join(
        [
            f"## {patch['name']}",
            f"**No cause, and never a suspect**: {patch['summary'].partition(': ')[2]}. "
            f"`plumb add --patch` fits it, knowingly; {patch['remedy']}.",
            f"Its {len(parameters)} numbers ({_range(parameters)}, {parameters[0]['unit']}) are "
            "the sizes of smooth terms over the sheet, for the left chain and for the right: "
            f"{_names(parameters)}. Each x or y is a degree in that direction.",
        ]
    )


def _range(parameters: Sequence[Mapping[str, Any]]) -> str:
    return f"${parameters[0]['setting']} to ${parameters[-1]['setting']}"


def _names(parameters: Sequence[Mapping[str, Any]]) -> str:
    return ", ".join(f"`{parameter['name']}`" for parameter in parameters)


def _parameters(effect: Mapping[str, Any]) -> str:
    lines = ["| parameter | unit | setting | plausible | typical | what it is |"]
    lines.append("|---|---|---|---|---|---|")
    for parameter in effect["parameters"]:
        setting = "none" if parameter["setting"] is None else f"${parameter['setting']}"
        plausible = f"{parameter['low']:g} to {parameter['high']:g}"
        lines.append(
            f"| `{parameter['name']}` | {parameter['unit']} | {setting} | {plausible} | "
            f"{parameter['typical']:g} | {parameter['summary']} |"
        )
    return "\n".join(lines)


def _size_table(cases: Sequence[tuple[Showing, Field]]) -> str:
    lines = ["| typical size | RMS, mm | worst, mm | shape RMS, mm | shape worst, mm |"]
    lines.append("|---|---|---|---|---|")
    for case, field in cases:
        sizes = (rms(field.raw), worst(field.raw), rms(field.shape), worst(field.shape))
        numbers = " | ".join(f"{size:.2f}" for size in sizes)
        lines.append(f"| {label_with_size(case)} | {numbers} |")
    return "\n".join(lines)


def _alike(name: str, fields: Fields) -> str:
    """Return the computed look-alikes in words."""
    nearest = look_alikes(name, fields)
    if nearest:
        return ", ".join(f"`{alike.name}` {alike.cosine + 0.0:.2f}" for alike in nearest)
    shapeless = [
        f"`{other}`"
        for other, cases in fields.items()
        if other != name and not any(field.has_shape for _, field in cases)
    ]
    others = " and ".join([*shapeless, "`sheet_rotation`"])
    return f"it has no shape, so everything that shifts and turns the sheet: {others}"


def _sizes(errors: Array) -> str:
    return f"{rms(errors):.2f} mm RMS, worst {worst(errors):.2f}"


if __name__ == "__main__":
    sys.exit(main())
