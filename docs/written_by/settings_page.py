"""Contents of docs/settings.md: the firmware's table."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import groupby

from plumb.firmware.settings import Setting, every_setting, format_value
from template import filled

PAGE = "docs/settings.md"
ANY_BUT_ZERO = 255
FEW = 4  # names that a row lists
LAST_PUBLISHED, FIRST_OF_OURS, FIRST_EFFECT = 44, 60, 100


@dataclass(frozen=True)
class Row:
    """Settings that one sentence describes."""

    settings: Sequence[Setting]

    @property
    def first(self) -> Setting:
        """The setting that speaks for all."""
        return self.settings[0]

    @property
    def numbers(self) -> str:
        """Their `$` numbers."""
        numbers = [str(each.number) for each in self.settings]
        return f"{numbers[0]} to {numbers[-1]}" if len(numbers) > 1 else numbers[0]

    @property
    def names(self) -> str:
        """Their names: all, or the first and the last of many."""
        names = [f"`{each.name}`" for each in self.settings]
        return ", ".join(names) if len(names) <= FEW else f"{names[0]} to {names[-1]}"

    @property
    def defaults(self) -> str:
        """Their defaults in order; once if they are the same."""
        return _distinct([format_value(each.usual) for each in self.settings])

    @property
    def limits(self) -> str:
        """What they may be."""
        return ", ".join(dict.fromkeys(limits(each) for each in self.settings))

    @property
    def keys(self) -> str:
        """Their keys in the clients' files."""
        section = self.first.key.partition(": ")[0]
        keys = [in_programs(each).removeprefix(f"{section}: ") for each in self.settings]
        return _distinct([in_programs(self.first), *keys[1:]])


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
        takes_effect=takes_effect,
        sentence=sentence,
    )


def rows(settings: Sequence[Setting]) -> list[Row]:
    """Return the rows of a table: neighbours with the same sentence share one."""

    def said(setting: Setting) -> tuple[str, ...]:
        return (setting.sentence, setting.unit, takes_effect(setting))

    return [Row(list(alike)) for _, alike in groupby(settings, key=said)]


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


def in_programs(setting: Setting) -> str:
    """Return section and key of a setting in the clients' files."""
    return setting.key.replace(": ", ": `") + "`" if setting.key else "none"


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
