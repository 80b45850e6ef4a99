"""Writes docs/settings.md from the firmware's table: `tools/research/settings_page.py`.

With --check nothing is written; exit 1 if the page is not as it would be written.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable, Sequence

from plumb.firmware.settings import Setting, every_setting, format_value
from writer import write_pages

PAGE = "docs/settings.md"
COMMAND = "settings_page"
ANY_BUT_ZERO = 255
LAST_PUBLISHED, FIRST_OF_OURS, FIRST_EFFECT = 44, 60, 100


def main(arguments: Sequence[str] | None = None) -> int:
    """Write the page, or check it; 1 if it is stale, 2 if refused."""
    return write_pages(arguments, pages, command=COMMAND)


def pages() -> dict[str, str]:
    """Return the page by its name below the project's root."""
    return {PAGE: page(every_setting())}


def page(settings: Sequence[Setting]) -> str:
    """Return the text of docs/settings.md."""
    listed = [setting for setting in settings if setting.access == "listed"]
    published = [setting for setting in listed if setting.number <= LAST_PUBLISHED]
    ours = [setting for setting in listed if FIRST_OF_OURS <= setting.number < FIRST_EFFECT]
    effects = [setting for setting in listed if setting.number >= FIRST_EFFECT]
    hidden = [setting for setting in settings if setting.access != "listed"]
    parts = [
        HEAD.format(count=len(listed)),
        "## Published numbers",
        PUBLISHED,
        table(published, keys=True),
        "## Numbers of this firmware",
        table(ours),
        "## Effects",
        EFFECTS,
        table(effects),
        "## Numbers that are not listed",
        HIDDEN,
        table(hidden),
        "## Erasing",
        ERASING,
        "## What is kept without power",
        KEPT,
        "## Coming from the published firmware",
        COMING,
    ]
    return "\n\n".join(parts) + "\n"


def table(settings: Iterable[Setting], *, keys: bool = False) -> str:
    """Return the rows of some settings."""
    head = "| $ | name | unit | type | default | limits | takes effect |"
    head += " in the programs |" if keys else ""
    lines = [head + " what it is |", "|---" * (8 + keys) + "|"]
    for setting in settings:
        cells = [
            str(setting.number),
            f"`{setting.name}`",
            setting.unit,
            setting.kind,
            format_value(setting.usual),
            limits(setting),
            takes_effect(setting),
        ]
        if keys:
            cells.append(setting.key.replace(": ", ": `") + "`" if setting.key else "none")
        cells.append(sentence(setting))
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines)


def limits(setting: Setting) -> str:
    """Return the allowed values in words."""
    low, high = format_value(setting.low), format_value(setting.high)
    if setting.step == ANY_BUT_ZERO:
        return f"{low} to {high}, not 0"
    if setting.step > 1:
        return f"{low} to {high} in steps of {setting.step}"
    return f"{low} to {high}"


def takes_effect(setting: Setting) -> str:
    """When a new value counts, and what is worked out again."""
    if not setting.touches:
        return "at once"
    if "restart" in setting.touches:
        return "after a restart"
    return "at rest: " + ", ".join(setting.touches)


def sentence(setting: Setting) -> str:
    """Return what a setting is, and what is not as published."""
    said = setting.sentence
    if setting.number >= FIRST_EFFECT:
        said = said[0].upper() + said[1:] + "."
    if setting.change and setting.change != "new":
        said += f" *Change: {setting.change}.*"
    return said


HEAD = """\
# The settings

<!-- Written by `tools/research/settings_page.py` from src/settings_table.h. Do not edit. -->

`$$` lists the {count} settings below; `$n=value` sets a number. Values may have any number of
digits and an exponent; a whole number may be written `2.00000`. A value that cannot be right is
refused with a line that begins with `error:`, and nothing changes. What is taken is stored within a
fifth of a second, while the machine goes on.

A `$` line waits until the moves before it are done. *Takes effect* says what happens then:

| | |
|---|---|
| at once | the next line goes by the new value |
| at rest: scale | counts mean other lengths from now on; chains and z stay where they are |
| at rest: geometry | the place is worked out again: 0.7 s after the last such line, or by a move |
| at rest: loops, limits | the next move is planned and controlled by the new value |
| at rest: drives | all motors are switched off |
| at rest: cutter | spindle and laser are switched off |
| after a restart | power off and on, or the reset button |"""

PUBLISHED = """\
Number, meaning, unit and default are those of the published firmware, so GroundControl and
WebControl set them as ever. It checked no limits; here every value is checked. *In the programs*
is section and key of `groundcontrol.ini` and `webcontrol.json`."""

EFFECTS = """\
What the lab finds and adds; 0 means absent, and is the default of all, so a machine nobody has
fitted behaves as under the published firmware. `$160`, `$180` and `$181` are added to what `$37`,
`$40` and `$41` say; where both are set the machine says `Corrected twice: ...`. Limits are the
plausible range and as much again on both sides. Causes, pictures and typical sizes:
[effects.md](effects.md)."""

HIDDEN = """\
Kept like the others, but neither listed nor set by `$`: WebControl gives `$43` another meaning and
would answer a listed number. It may write `$45` (chain elasticity, 1/N) and `$46` (sled weight, N):
these set `$170` and `$62`. `$#` shows `$230` to `$253`."""

ERASING = """\
| command | settings | position | simulated motors |
|---|---|---|---|
| `$RST=$` | defaults, the numbers of this firmware and the effects too | stays | stay |
| `$RST=#` | defaults | forgotten | stay |
| `$RST=*` | defaults | forgotten | off |

Storing all defaults takes up to two seconds, in which the machine goes on. A power cut meanwhile
leaves the old settings or the defaults."""

KEPT = """\
The EEPROM holds the settings twice, each copy with a number and a CRC-32. The machine writes a
change to the first copy, then to the second, and only the bytes that differ. Power may fail in any
byte: afterwards the old settings or the new settings are there, never a mixture.

The machine keeps its position each time it comes to rest, in a ring of 65 places. A position is the
encoder counts of both chains and z, where that put the bit, and whether `$12`, `$13`, `$19` and
`$20` are still the same. Before a motor turns, a mark says that the place has been left. So the
machine knows at the next start that power was lost in motion, and says so. A cell is written twice
in 65 rests and bears 100,000 writes: 3.2 million rests, at 300 a day 29 years.

What the EEPROM holds, by address: 0 to 543 nothing (what the published firmware left is marked
invalid), 544 and 1344 the copies, 1328 and 2128 the log of `B30`, 2144 to 4093 the ring."""

COMING = """\
At the first start (motors wait 2.5 s) the machine takes over the settings of firmware 1.24 to 1.29
(version 5 of its EEPROM, with or without Z limits) and its position, all or nothing. Then it marks
them invalid there. If you flash the published firmware again, it starts with defaults and no
position, and does not trust a place that the sled left long ago. What it stores from then on is
taken over again when you come back.

Firmware 1.00 to 1.23 and the holey, optical and beta releases store other versions, which the
machine does not read. It says so. GroundControl or WebControl send their settings anyway; set the
chains once."""


if __name__ == "__main__":
    sys.exit(main())
