"""Whole files in and out, and ini files as lines."""

import configparser
import os
import re
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from plumb.text import files as text_files
from plumb.text.errors import InputError
from plumb.text.files import parse_ini, read_text, with_values, write_all, write_whole
from systems import ON_POSIX

EXAMPLE = Path(__file__).resolve().parents[3] / "docs/example"


def test_unreadable_files_are_refused_by_name(tmp_path):
    for name in ("missing.ini", "."):
        with pytest.raises(InputError, match=re.escape(str(tmp_path))):
            read_text(tmp_path / name)
    with pytest.raises(InputError):
        read_text("bad\0name")


@pytest.mark.parametrize(
    ("content", "hint"),
    [
        (b"", "empty"),
        (b" \n\t\n", "empty"),
        (b"\xef\xbb\xbf", "empty"),
        (b"a\0b", "not a text"),
        (b"ok\n\xff\xfe", "line 2: has a character that is not UTF-8"),
    ],
)
def test_unusable_content_is_refused(tmp_path, content, hint):
    path = tmp_path / "file.csv"
    path.write_bytes(content)
    with pytest.raises(InputError, match=hint) as caught:
        read_text(path)
    assert "\n" not in str(caught.value)


def test_a_huge_file_and_a_device_without_an_end_are_refused(tmp_path):
    path = tmp_path / "film.csv"
    path.write_bytes(b"x" * (text_files.LARGEST_FILE + 1))
    for source in (path, "/dev/zero"):
        with pytest.raises(InputError, match="larger than 5 MB"):
            read_text(source)


@pytest.mark.parametrize(
    ("name", "text"), [("marks.toml", "a = " + 3000 * "["), ("webcontrol.json", 100_000 * '{"a":')]
)
def test_brackets_without_end_are_refused_in_one_line(tmp_path, run, name, text):
    (tmp_path / name).write_text(text)
    given = {"webcontrol.json": EXAMPLE / "machine.toml", "marks.toml": EXAMPLE / "marks.toml"}
    settings, marks = {**given, name: tmp_path / name}.values()
    code, said, complaint = run("compare", settings, marks)
    assert (code, said, complaint.count("\n")) == (2, "", 1) and "is not valid" in complaint


@ON_POSIX
def test_a_command_that_is_killed_while_it_writes_leaves_no_file(tmp_path):
    script = (
        "import os, signal\n"
        "os.fsync = lambda handle: os.kill(os.getpid(), signal.SIGKILL)\n"
        "from plumb.cli.main import main\n"
        f"main(['grid', '--output', {str(tmp_path / 'grid.nc')!r}])\n"
    )
    assert subprocess.run([sys.executable, "-c", script]).returncode == -signal.SIGKILL
    assert list(tmp_path.iterdir()) == []


def test_a_failed_write_leaves_the_old_file_and_no_other(tmp_path, monkeypatch):
    path = tmp_path / "machine.toml"
    path.write_text("old")

    def fail(*_):
        raise OSError(28, "No space left on device")

    for name in ("replace", "fsync"):
        with monkeypatch.context() as patch:
            patch.setattr(os, name, fail)
            with pytest.raises(InputError, match="No space left"):
                write_whole(path, b"new")
        assert path.read_text() == "old"
        assert [file.name for file in tmp_path.iterdir()] == ["machine.toml"]


@ON_POSIX
def test_write_keeps_rights_and_follows_links(tmp_path):
    path, link = tmp_path / "real.ini", tmp_path / "link.ini"
    path.write_text("old")
    path.chmod(0o640)
    link.symlink_to(path)
    write_whole(link, b"new")
    assert link.is_symlink()
    assert path.read_text() == "new"
    assert path.stat().st_mode & 0o777 == 0o640


def test_of_several_files_all_are_written_or_none(tmp_path):
    first, second = tmp_path / "first", tmp_path / "second"
    write_all({first: b"1", second: b"2"})
    assert (first.read_bytes(), second.read_bytes()) == (b"1", b"2")
    for impossible in (tmp_path / "nowhere" / "third", tmp_path):
        with pytest.raises(InputError, match=re.escape(str(impossible))):
            write_all({first: b"new", impossible: b"3"})
        assert first.read_bytes() == b"1"
    assert sorted(tmp_path.iterdir()) == [first, second]


TEXT = """; a comment
[Maslow Settings]
comport = COM3
openfile = C:\\100%\\new=old.nc
macro1 = G0 X0
\tG0 Y0
motorSpacingX: 2978.4

[Advanced Settings]
digits = 4
"""


def test_entries_are_those_that_configparser_finds():
    parser = configparser.ConfigParser(interpolation=None)
    parser.read_string(TEXT)
    expected = [(s, k, v) for s in parser.sections() for k, v in parser[s].items()]
    entries = [(e.section, e.key.lower(), e.value) for e in parse_ini(TEXT, source="x").entries]
    assert entries == expected


def test_a_key_in_two_other_sections_is_refused():
    ini = parse_ini("[a]\nk = 1\n[b]\nk = 2\n", source="x.ini")
    with pytest.raises(InputError, match="appears in"):
        ini.find("k", section="c")


@pytest.mark.parametrize("ending", ["\n", "\r\n", "\r"])
@pytest.mark.parametrize("start", ["", "\ufeff"])
def test_only_the_value_changes(ending, start):
    text = start + TEXT.replace("\n", ending).replace("digits = 4", "digits\t=  4  ")
    ini = parse_ini(text, source="x")
    changed = with_values(ini, {("Advanced Settings", "digits"): "5"})
    assert changed == text.replace("digits\t=  4  ", "digits\t=  5  ")
    assert with_values(ini, {}) == text


def test_a_value_on_several_lines_is_not_replaced():
    ini = parse_ini(TEXT, source="x")
    with pytest.raises(InputError, match="several lines"):
        with_values(ini, {("Maslow Settings", "macro1"): "G1"})
