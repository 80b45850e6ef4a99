"""Whole text files in and out: read with a clear refusal, written completely or not at all.

A link that somebody names at a command line is followed. In a folder that may come from elsewhere
none is: `links_refused` says so for all that is opened here, and `opened` is the door.
"""

from __future__ import annotations

import errno
import os
import re
import stat
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from os import PathLike
from pathlib import Path

from plumb.text.errors import InputError

# A file of marks or settings has a few kilobytes; more is some other file picked by mistake.
LARGEST_FILE_BYTES = 5_000_000
_follows: ContextVar[bool] = ContextVar("follows", default=True)
_PIPED: dict[str, bytes] = {}  # what came through pipes, which can be read only once


@contextmanager
def links_refused() -> Iterator[None]:
    """Until the end, no link is followed, in reading and in writing."""
    token = _follows.set(False)
    try:
        yield
    finally:
        _follows.reset(token)


def opened(path: str | PathLike[str], flags: int, *, follows: bool | None = None) -> int:
    """Return a handle of a file. Raises InputError for a link where none is followed, and
    OSError.
    """
    is_followed = _follows.get() if follows is None else follows
    try:
        return os.open(path, flags if is_followed else flags | os.O_NOFOLLOW, 0o644)
    except OSError as error:
        if error.errno == errno.ELOOP:
            remedy = "put the file itself into the folder"
            raise InputError(path, "is a link", remedy=remedy) from None
        raise


def read_bytes(path: str | PathLike[str]) -> bytes:
    """Return the bytes of a file that exists, is not empty and is not absurdly large."""
    place = Path(path)
    try:
        if place.is_dir():
            raise InputError(path, "is a folder", remedy="name the file inside it")
        if place.stat().st_size > LARGEST_FILE_BYTES:
            raise InputError(path, "is larger than 5 MB", remedy="check that it is the right file")
        content = _PIPED.get(str(path)) or _content(path)
        if not place.is_file():
            _PIPED[str(path)] = content
    except FileNotFoundError:
        raise InputError(path, "there is no such file", remedy="check the name") from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise InputError(path, f"cannot be read ({reason})", remedy="check its rights") from None
    if not content.strip():
        raise InputError(path, "the file is empty", remedy="check that it was saved")
    return content


def _content(path: str | PathLike[str]) -> bytes:
    with os.fdopen(opened(path, os.O_RDONLY), "rb") as file:
        return file.read()


def read_text(path: str | PathLike[str]) -> str:
    """Return the text of a UTF-8 file, without a byte-order mark."""
    content = read_bytes(path)
    if b"\0" in content:
        raise InputError(path, "is not a text file", remedy="save it as plain text, UTF-8")
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = content[: error.start].count(b"\n") + 1
        raise InputError(
            path,
            "has a character that is not UTF-8",
            place=f"line {line}",
            remedy="save the file as UTF-8",
        ) from None
    if not text.strip():
        raise InputError(path, "the file is empty", remedy="check that it was saved")
    return text


def write_whole(path: str | PathLike[str], content: bytes) -> None:
    """Replace a file in one step: a crash leaves the old or the new file, never half."""
    write_all({os.fspath(path): content})


def write_all(files: Mapping[str, bytes]) -> None:
    """Replace several files: if any of them cannot be written, none is.

    Devices and pipes stay what they are: they get the bytes, just before the files are replaced.
    """
    staged: dict[str, tuple[str, Path]] = {}
    path = ""
    try:
        poured = [path for path in files if _is_poured_into(path)]
        for path in files:
            if path not in poured:
                target = os.path.realpath(path) if _follows.get() else path
                staged[path] = _staged(Path(target), files[path])
        for path in poured:
            with open(path, "wb") as stream:
                stream.write(files[path])
        for path in staged:
            os.replace(*staged[path])
    except OSError as error:
        raise InputError(path, f"cannot be written ({error.strerror})") from None
    finally:
        for name, _ in staged.values():
            Path(name).unlink(missing_ok=True)


def _is_poured_into(path: str | PathLike[str]) -> bool:
    """Return whether it is a device or a pipe, which takes bytes and cannot be replaced; InputError
    for what takes no result at all.
    """
    try:
        mode = os.stat(path, follow_symlinks=_follows.get()).st_mode
    except FileNotFoundError:
        return False
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise InputError(path, f"cannot be written ({reason})") from None
    if stat.S_ISDIR(mode):
        raise InputError(path, "is a folder", remedy="name a file inside it")
    if stat.S_ISBLK(mode) or stat.S_ISSOCK(mode):
        raise InputError(path, "is a disk or a socket, not a file", remedy="name a file")
    return stat.S_ISFIFO(mode) or stat.S_ISCHR(mode)


def _staged(target: Path, content: bytes) -> tuple[str, Path]:
    """Return the content in a new file next to the target, whose place it takes later."""
    handle, name = tempfile.mkstemp(dir=target.parent, prefix=f".{target.name}.")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        os.chmod(name, _mode_for(target))
    except OSError:
        Path(name).unlink(missing_ok=True)
        raise
    return name, target


def _mode_for(target: Path) -> int:
    """Return the permission bits of the file to be replaced, or those of any new file."""
    if target.exists():
        return stat.S_IMODE(target.stat().st_mode)
    mask = os.umask(0)
    os.umask(mask)
    return 0o666 & ~mask


# Whether a file was written by the lab, so that the next run may replace it.

DEMO_MARKS = b"# Marks of a virtual machine, read by the demo.\n"
# How our text files begin: a machine.toml, a grid's program, that of proposed marks, a job's
# outline, a program for known holes, the page of the bench, the marks of a demo, a report.
BEGINNINGS = (
    b"# Settings of one hanging machine, for plumb.",
    b"(Plumb calibration grid)",
    b"(Plumb: ",
    b"(plumb: ",
    b"# How often the diagnosis is right",
    b"# How often the closed loop finds what is hidden",
    DEMO_MARKS,
    b"<!doctype html>\n<!-- A report of Plumb. -->",
)
MAKER = "Plumb"  # what a picture says of the program that drew it
# Where the forms of a picture say it.
PICTURES = (
    (b"\x89PNG", b"Software\0Plumb"),
    (b"<?xml", b"<dc:title>Plumb</dc:title>"),
    (b"%PDF", b"/Creator (Plumb)"),
)
LINES = re.compile(rb"(\$\d+=[-+.\de]+\n)+")  # for the machine
CLIENT_FILES = ("-groundcontrol.ini", "-webcontrol.json")  # how the names of clients' files end


def picture_metadata(form: str) -> dict[str, str | None]:
    """Return what a picture says of itself; no date, so that the same data give the same bytes."""
    words: dict[str, dict[str, str | None]] = {
        "png": {"Software": MAKER},
        "svg": {"Creator": MAKER, "Date": None},
        "pdf": {"Creator": MAKER, "CreationDate": None},
    }
    return words[form]


def is_ours(path: Path) -> bool:
    """Return whether the lab wrote this file, or nobody wrote anything into it."""
    content = path.read_bytes()
    if not content or content.startswith(BEGINNINGS) or LINES.fullmatch(content):
        return True
    if any(content.startswith(form) and said in content for form, said in PICTURES):
        return True
    return path.name.endswith(CLIENT_FILES) and b"maslow settings" in content.lower()


# An ini file as lines: what it says, and the same lines with single values replaced.
#
# The published programs write these files with Python's ConfigParser (keys in lower case, values
# that may hold a percent sign or run on over indented lines), so its rules are followed.

_ENTRY = re.compile(r"(?P<head>\s*(?P<key>[^=:\s][^=:]*?)\s*[=:][ \t]*)(?P<value>.*?)(?P<tail>\s*)")
_SECTION = re.compile(r"\s*\[(?P<name>[^]]+)\]\s*([#;].*)?")


@dataclass(frozen=True)
class IniEntry:
    """One `key = value` of an ini file, the first of its lines counted from 1."""

    section: str
    key: str
    value: str
    line: int
    runs_on: bool = False  # the value continues on indented lines

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


def read_ini(path: str | PathLike[str]) -> IniText:
    """Return the ini file at a path; bytes that are not UTF-8 survive as surrogates."""
    content = read_bytes(path)
    if b"\0" in content:
        raise InputError(path, "is not a text file", remedy="save it as plain text")
    return parse_ini(content.decode("utf-8", "surrogateescape"), source=str(path))


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
            entries[-1] = _longer(entries[-1], bare)
            continue
        header, entry = _SECTION.fullmatch(bare), _ENTRY.fullmatch(bare)
        if header:
            section, indent = header["name"], -1
        elif entry and section:
            entries.append(IniEntry(section, entry["key"], entry["value"], line_number))
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
        elif entry.runs_on:
            raise InputError(
                ini.source,
                "runs on over several lines",
                place=entry.place,
                remedy="write the value on a single line",
            )
        else:
            line = lines[entry.line - 1]
            bare = _bare(line)
            old = _ENTRY.fullmatch(bare)
            assert old, "the line was parsed as an entry"
            mark = line[: len(line.rstrip("\r\n")) - len(bare)]  # a byte-order mark, kept
            ending = line[len(line.rstrip("\r\n")) :]
            lines[entry.line - 1] = f"{mark}{old['head']}{value}{old['tail']}{ending}"
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


def _longer(entry: IniEntry, more: str) -> IniEntry:
    value = f"{entry.value}\n{more.strip()}"
    return IniEntry(entry.section, entry.key, value, entry.line, runs_on=True)


def _refuse_twins(entries: list[IniEntry], source: str) -> None:
    seen: dict[tuple[str, str], int] = {}
    for entry in entries:
        name = (entry.section.lower(), entry.key.lower())
        if name in seen:
            raise InputError(
                source,
                f"the same key is already on line {seen[name]}",
                place=entry.place,
                remedy="remove a line",
            )
        seen[name] = entry.line
