"""An ini file as lines: what it says, and the same lines with single values replaced.

The published programs write these files with Python's ConfigParser (keys in lower case, values
that may hold a percent sign or run on over indented lines), so its rules are followed.
"""

import re
from dataclasses import dataclass, replace

from plumb.text.errors import InputError, Source, naming
from plumb.text.files import text_bytes
from plumb.text.values import number_in

_ENTRY = re.compile(r"\s*(?P<key>[^=:\s][^=:]*?)\s*[=:][ \t]*(?P<value>.*?)\s*")
_SECTION = re.compile(r"\s*\[(?P<name>[^]]+)\]\s*([#;].*)?")


@dataclass(frozen=True)
class IniEntry:
    """One `key = value` of an ini file, the first of its lines counted from 1."""

    section: str
    key: str
    value: str
    line: int
    at: tuple[int, int] = (0, 0)  # where the value begins and ends in that line

    @property
    def place(self) -> str:
        """Line, section and key, as an error message names them."""
        return f"line {self.line}, [{self.section}] {self.key}"


@dataclass(frozen=True)
class IniText:
    """The lines of an ini file with their endings, and its entries."""

    source: str
    lines: tuple[str, ...]
    entries: tuple[IniEntry, ...]

    @property
    def sections(self) -> tuple[str, ...]:
        """Names of the sections, in the order of the file."""
        headers = [_SECTION.fullmatch(_bare(line)) for line in self.lines]
        return tuple(dict.fromkeys(match["name"] for match in headers if match))

    def find(self, key: str, *, section: str) -> IniEntry | None:
        """Return the entry of that key, case ignored; a single entry in another section is
        accepted.
        """
        same = [entry for entry in self.entries if entry.key.lower() == key.lower()]
        here = [entry for entry in same if entry.section.lower() == section.lower()]
        if here:
            return here[0]
        if len(same) > 1:
            names = " and ".join(f"[{entry.section}]" for entry in same)
            raise InputError(
                self.source,
                f"{key} appears in {names}",
                place=same[0].place,
                remedy=f"keep the entry in [{section}]",
            )
        return same[0] if same else None

    def needed(self, key: str, *, section: str) -> IniEntry:
        """Return the entry of that key, or raise InputError."""
        entry = self.find(key, section=section)
        if entry is None:
            remedy = f"add {key} = ... below [{section}]"
            raise InputError(self.source, f"{key} is missing in [{section}]", remedy=remedy)
        return entry

    def number(self, key: str, *, section: str) -> float:
        """Return the number of that key, or raise InputError."""
        entry = self.needed(key, section=section)
        with naming(self.source, entry.place):
            return number_in(entry.value)


def read_ini(path: Source) -> IniText:
    """Return the ini file at a path; bytes that are not UTF-8 survive as surrogates."""
    return parse_ini(text_bytes(path).decode("utf-8", "surrogateescape"), source=str(path))


def parse_ini(text: str, *, source: str) -> IniText:
    """Return the entries of an ini text; duplicates, and lines that are nothing, are refused."""
    lines = tuple(re.findall(r"[^\r\n]*(?:\r\n|\n|\r)|[^\r\n]+$", text))
    entries: list[IniEntry] = []
    section, indent = "", -1
    for line_number, line in enumerate(lines, 1):
        bare = _bare(line)
        if not bare.strip() or bare.lstrip()[0] in "#;":
            continue
        depth = len(bare) - len(bare.lstrip())
        if 0 <= indent < depth:
            entries[-1] = replace(entries[-1], value=f"{entries[-1].value}\n{bare.strip()}")
            continue
        header, entry = _SECTION.fullmatch(bare), _ENTRY.fullmatch(bare)
        if header:
            section, indent = header["name"], -1
        elif entry and section:
            mark = line.find(bare)  # behind a byte-order mark
            at = entry.start("value") + mark, entry.end("value") + mark
            entries.append(IniEntry(section, entry["key"], entry["value"], line_number, at))
            indent = depth
        else:
            what = "a value comes before the first [section]" if entry else "is not key = value"
            raise InputError(source, what, place=f"line {line_number}", remedy="mend or remove it")
    _refuse_twins(entries, source)
    return IniText(source, lines, tuple(entries))


def with_values(ini: IniText, changes: dict[tuple[str, str], str]) -> str:
    """Return the text of the file with some values replaced and nothing else touched; new keys are
    added at the end of their section.
    """
    lines = list(ini.lines)
    new: list[tuple[str, str, str]] = []
    for (section, key), value in changes.items():
        entry = ini.find(key, section=section)
        if entry is None:
            new.append((section, key, value))
            continue
        if "\n" in entry.value:
            why, remedy = "runs on over several lines", "write the value on a single line"
            raise InputError(ini.source, why, place=entry.place, remedy=remedy)
        line, (begin, end) = lines[entry.line - 1], entry.at
        lines[entry.line - 1] = f"{line[:begin]}{value}{line[end:]}"
    for section, key, value in new:
        lines = _with_new_key(lines, ini, section, key, value)
    return "".join(lines)


def _with_new_key(lines: list[str], ini: IniText, section: str, key: str, value: str) -> list[str]:
    """Return the lines with a new entry after the last entry of its section."""
    ending = "\r\n" if any(line.endswith("\r\n") for line in ini.lines) else "\n"
    small = all(entry.key == entry.key.lower() for entry in ini.entries)
    added = f"{key.lower() if small else key} = {value}{ending}"
    inside, last = False, None
    for index, line in enumerate(lines):
        header = _SECTION.fullmatch(_bare(line))
        if header:
            inside = header["name"].lower() == section.lower()
        if inside and line.strip():
            last = index
    if last is None:
        last = len(lines) - 1
        added = f"{ending}[{section}]{ending}{added}"
    before = lines[: last + 1]
    if not before[-1].endswith(("\n", "\r")):
        before[-1] += ending
    return [*before, added, *lines[last + 1 :]]


def _bare(line: str) -> str:
    return line.rstrip("\r\n").removeprefix("\ufeff")


def _refuse_twins(entries: list[IniEntry], source: str) -> None:
    seen: dict[tuple[str, str], int] = {}
    for entry in entries:
        name = (entry.section.lower(), entry.key.lower())
        if name in seen:
            why = f"the same key is already on line {seen[name]}"
            raise InputError(source, why, place=entry.place, remedy="remove a line")
        seen[name] = entry.line
