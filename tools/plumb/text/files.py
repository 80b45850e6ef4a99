"""Whole text files in and out: read with a clear refusal, written completely or not at all."""

import codecs
import errno
import os
import re
import stat
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from itertools import count
from pathlib import Path, PosixPath, WindowsPath
from typing import Any

import portalocker  # flock where there is one, msvcrt on Windows
from portalocker import LockFlags

from plumb.text.errors import InputError, Source, naming
from plumb.text.values import number_in

# Locks between programs, on Linux, macOS and Windows. The system ends those of a killed program.
#
# All that the systems do differently with open files is here.


# A link is never followed. Windows has no such flag, and lets only administrators make links.
NO_LINKS = getattr(os, "O_NOFOLLOW", 0)
READ_S = 2.0  # [s] within which another program has read a file
AS_IT_IS = getattr(os, "O_BINARY", 0)  # else Windows writes \r\n for \n


@contextmanager
def alone(path: Path) -> Iterator[None]:
    """Until the end, others that ask the same for this file wait. It is made if it is not there."""
    handle = os.open(path, os.O_RDWR | os.O_CREAT | NO_LINKS, 0o600)
    try:
        hold(handle)
        yield
    finally:
        os.close(handle)


def hold(handle: int, *, wait: bool = True) -> None:
    """Lock an open file until it is closed; OSError if another has it and `wait` is false."""
    flags = LockFlags.EXCLUSIVE if wait else LockFlags.EXCLUSIVE | LockFlags.NON_BLOCKING
    try:
        portalocker.lock(handle, flags)
    except portalocker.LockException as error:
        raise OSError(str(error)) from None


def replaced(old: Path, new: str) -> None:
    """Put a file in the place of another. Windows refuses as long as somebody reads that one."""
    end = time.monotonic() + READ_S
    while sys.platform == "win32" and time.monotonic() < end:
        with suppress(PermissionError):
            os.replace(new, old)
            return
        time.sleep(0.01)
    os.replace(new, old)


def close_to_others(handle: int) -> None:
    """Have the kernel refuse to open a terminal again, except for root. POSIX alone."""
    import fcntl
    import termios

    with suppress(OSError):  # what is no terminal knows no such refusal
        fcntl.ioctl(handle, termios.TIOCEXCL)


def is_private(file: os.stat_result) -> bool:
    """Return whether others can neither read a file nor have written it. Windows closes a folder of
    one's own to others.
    """
    return sys.platform == "win32" or (not file.st_mode & 0o077 and file.st_uid == os.getuid())


def reaches_disk(folder: Path) -> None:
    """Return when the names in a folder are on the disk too; Windows does so by itself."""
    if sys.platform != "win32":
        handle = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)


# A link that somebody names at a command line is followed. In a folder that may come from elsewhere
# none is: its path is `Unlinked`, and so is each that is made of it.


MB = 1_000_000
# A file of marks or settings has a few kilobytes; more is some other file picked by mistake.
LARGEST_FILE = 5 * MB
CODE = re.compile(r"(?mi)^\s*(?:n\d+\s*)?[gm]\d{1,3}(?![\w=:])")  # a line of G-code


class ReadOnce(str):
    """The name of a file, with what was in it when it was read: a pipe can be read only once."""

    content = b""


if sys.platform == "win32":
    _SystemPath = WindowsPath
else:
    _SystemPath = PosixPath


class Unlinked(_SystemPath):
    """A path at which no link is followed, in reading and in writing."""


def as_path(path: Source) -> Path:
    """Return the path of a file; Path() would follow links again."""
    return path if isinstance(path, Path) else Path(path)


def opened(path: Source, flags: int) -> int:
    """Return a handle of a file. Raises InputError for a link where none is followed, and
    OSError.
    """
    try:
        return os.open(path, flags | AS_IT_IS | (NO_LINKS * isinstance(path, Unlinked)), 0o644)
    except OSError as error:
        if error.errno == errno.ELOOP:
            remedy = "put the file itself into the folder"
            raise InputError(path, "is a link", remedy=remedy) from None
        raise


def read_bytes(path: Source, *, most: int = LARGEST_FILE) -> bytes:
    """Return the bytes of a file that exists, is not empty and has at most `most` bytes."""
    place = Path(path)
    try:
        if place.is_dir():
            raise InputError(path, "is a folder", remedy="name the file inside it")
        # A device says no size, so one byte more than allowed is asked for.
        content = path.content if isinstance(path, ReadOnce) else b""
        if not content:
            with os.fdopen(opened(path, os.O_RDONLY), "rb") as file:
                content = file.read(most + 1)
        if len(content) > most:
            why = f"is larger than {most // MB} MB"
            raise InputError(path, why, remedy="check that it is the right file")
        if isinstance(path, ReadOnce):
            path.content = content
    except FileNotFoundError:
        raise InputError(path, "there is no such file", remedy="check the name") from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise InputError(path, f"cannot be read ({reason})", remedy="check its rights") from None
    if not content.strip():
        raise InputError(path, "the file is empty", remedy="check that it was saved")
    return content


# How files begin that are no text, and what each is.
NO_TEXT = (
    (b"%PDF", "a PDF"),
    (b"\x89PNG", "a picture (PNG)"),
    (b"\xff\xd8\xff", "a picture (JPEG)"),
    (b"GIF8", "a picture (GIF)"),
    (b"RIFF", "a picture or a film"),
    (b"PK\x03\x04", "an archive (ZIP, or a document of an office program)"),
    (b"\x1f\x8b", "an archive (gzip)"),
    (b"\x7fELF", "a program for a computer"),
)


def text_bytes(path: Source, *, most: int = LARGEST_FILE) -> bytes:
    """Return a file's text in UTF-8, also that of UTF-16, which Notepad calls `Unicode` and whose
    first bytes say so. InputError for what is no text.
    """
    content = read_bytes(path, most=most)
    for begin, what in NO_TEXT:
        if content.startswith(begin):
            raise InputError(path, f"is {what}, not a text file", remedy="name another file")
    if content.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        with suppress(UnicodeDecodeError):
            return content.decode("utf-16").encode()
    if b"\0" in content:
        raise InputError(path, "is not a text file", remedy="save it as plain text, UTF-8")
    return content


def read_text(
    path: Source, *, most: int = LARGEST_FILE, say: Callable[[str], None] | None = None
) -> str:
    """Return the text of a file in UTF-8 or UTF-16, without a byte-order mark.

    say: where it may be text of an old Windows too, hears that it was read so.
    """
    content = text_bytes(path, most=most)
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        if say:
            say(f"{path} is not UTF-8, so it was read as text of Windows (cp1252)")
            return content.decode("cp1252", errors="replace")
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


def parsed(
    path: Source, text: str, parse: Callable[[str], dict[str, Any]], form: str
) -> dict[str, Any]:
    """Return what `parse` makes of a file's text; InputError for what is not valid in that form."""
    try:
        return parse(text)
    except (ValueError, RecursionError) as error:
        why = error if isinstance(error, ValueError) else "brackets in brackets without end"
        raise InputError(path, f"is not valid {form}: {why}", remedy="mend that line") from None


def numbered(stem: str) -> Iterator[str]:
    """Yield a name and its followers, as `machine`, `machine-2` ..."""
    yield stem
    yield from (f"{stem}-{number}" for number in count(2))


def write_whole(path: Source, content: bytes) -> None:
    """Replace a file in one step: a crash leaves the old or the new file, never half."""
    write_all({os.fspath(path): content}, follows=not isinstance(path, Unlinked))


def write_all(files: Mapping[str, bytes], *, follows: bool = True) -> None:
    """Replace several files: if any of them cannot be written, none is. A link is followed, or
    replaced.

    Devices and pipes stay what they are: they get the bytes, just before the files are replaced.
    """
    staged: dict[str, tuple[int | None, str, Path]] = {}
    path = ""
    try:
        poured = [path for path in files if _is_poured_into(path, follows)]
        for path in files:
            if path not in poured:
                target = Path(os.path.realpath(path) if follows else path)
                staged[path] = (*_staged(target, files[path]), target)
        for path in poured:
            with open(path, "wb") as stream:
                stream.write(files[path])
        for path in staged:
            handle, name, target = staged[path]
            if handle is not None:
                # Any folder's handle makes Python follow the link to the file without a name.
                os.link(f"/proc/self/fd/{handle}", name, src_dir_fd=handle)
            replaced(target, name)
    except OSError as error:
        raise InputError(path, f"cannot be written ({error.strerror})") from None
    finally:
        for handle, name, _ in staged.values():
            if handle is not None:
                os.close(handle)
            Path(name).unlink(missing_ok=True)


def _is_poured_into(path: Source, follows: bool) -> bool:
    """Return whether it is a device or a pipe, which takes bytes and cannot be replaced; InputError
    for what takes no result at all.
    """
    try:
        mode = os.stat(path, follow_symlinks=follows).st_mode
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


def _staged(target: Path, content: bytes) -> tuple[int | None, str]:
    """Return the content in an open file, and the name under which it is next to the target.

    Where the system has them, the file gets its name only when it is whole, so that a command that
    is killed leaves nothing behind. Elsewhere it is shut, as Windows asks of a file to be renamed.
    """
    is_nameless = True
    try:
        handle = os.open(target.parent, os.O_TMPFILE | os.O_RDWR, 0o600)
        name = str(target.with_name(f".{target.name}.{os.getpid()}-{handle}"))
    except (AttributeError, OSError):
        is_nameless = False
        handle, name = tempfile.mkstemp(dir=target.parent, prefix=f".{target.name}.")
    is_whole = False
    try:
        with os.fdopen(handle, "wb", closefd=False) as file:
            file.write(content)
            file.flush()
            os.fsync(handle)
        os.chmod(handle if os.chmod in os.supports_fd else name, _mode_for(target))
        is_whole = True
    finally:
        if not (is_whole and is_nameless):
            os.close(handle)
        if not is_whole:
            Path(name).unlink(missing_ok=True)
    return (handle if is_nameless else None), name


def _mode_for(target: Path) -> int:
    """Return the permission bits of the file to be replaced, or those of any new file."""
    if target.exists():
        return stat.S_IMODE(target.stat().st_mode)
    mask = os.umask(0)
    os.umask(mask)
    return 0o666 & ~mask


# Whether a file was written by the lab, so that the next run may replace it.

# How our text files begin: a machine.toml, a grid's program, that of proposed marks, a job's
# outline, a program for known holes, a report.
BEGINNINGS = (
    b"# Settings of one hanging machine, for plumb.",
    b"(Plumb calibration grid)",
    b"(Plumb: ",
    b"(plumb: ",
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
    """Return whether the lab wrote this file, or it is empty."""
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
