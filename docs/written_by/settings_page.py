"""Contents of docs/settings.md: the firmware's table."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby

from plumb.firmware.settings import Setting, every_setting, format_value
from template import filled

PAGE = "docs/settings.md"
ANY_BUT_ZERO = 255
LAST_PUBLISHED, FIRST_OF_OURS, FIRST_EFFECT = 44, 60, 100


def pages() -> dict[str, str]:
    """Return the page by its name below the project's root."""
    return {PAGE: page(every_setting())}


def page(settings: Sequence[Setting]) -> str:
    """Return the text of docs/settings.md."""
    listed = [setting for setting in settings if setting.access == "listed"]
    return filled(
        "settings.md",
        published=[setting for setting in listed if setting.number <= LAST_PUBLISHED],
        own=[setting for setting in listed if FIRST_OF_OURS <= setting.number < FIRST_EFFECT],
        count=len(listed),
        hidden=[setting for setting in settings if setting.access != "listed"],
        rows=rows,
        in_programs=in_programs,
        defaults=lambda row: _distinct([format_value(each.usual) for each in row]),
        limits=lambda row: ", ".join(dict.fromkeys(map(limits, row))),
        takes_effect=takes_effect,
        sentence=sentence,
    )


def rows(settings: Sequence[Setting]) -> list[list[Setting]]:
    """Return the rows of a table: neighbours with the same sentence share one."""

    def said(setting: Setting) -> tuple[str, ...]:
        return (setting.sentence, setting.unit, takes_effect(setting))

    return [list(alike) for _, alike in groupby(settings, key=said)]


def in_programs(row: Sequence[Setting]) -> str:
    """Return section and keys of a row in the clients' files; the section once."""
    said = [each.key.replace(": ", ": `") + "`" if each.key else "none" for each in row]
    section = said[0].partition("`")[0]
    return _distinct([said[0], *(each.removeprefix(section) for each in said[1:])])


def limits(setting: Setting) -> str:
    """Return the allowed values in words."""
    words = f"{format_value(setting.low)} to {format_value(setting.high)}"
    if setting.step == ANY_BUT_ZERO:
        return f"{words}, not 0"
    return f"{words} in steps of {setting.step}" if setting.step > 1 else words


def takes_effect(setting: Setting) -> str:
    """When a new value counts, and what is worked out again."""
    if not setting.touches:
        return "at once"
    if "restart" in setting.touches:
        return "after a restart"
    return ", ".join(setting.touches)


def sentence(setting: Setting) -> str:
    """Return what a setting is, and what is not as published."""
    said = setting.sentence
    if setting.number >= FIRST_EFFECT:
        said = said[0].upper() + said[1:] + "."
    if setting.change and setting.change != "new":
        said += f" *Change: {setting.change}.*"
    return said


def _distinct(words: Sequence[str]) -> str:
    return words[0] if len(set(words)) == 1 else ", ".join(words)
