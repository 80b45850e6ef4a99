"""The diary's file: entries are only added, writers wait, and numbers written leave a way back."""

import subprocess
import sys
from datetime import UTC, datetime

import pytest
from numbers_machine import NumbersMachine
from plumb.diary.file import NAME, append, read_diary, write_and_keep
from plumb.line.memory import kept_before
from plumb.line.sender import Sender
from plumb.text.errors import InputError
from systems import ON_POSIX

NOON = datetime(2026, 5, 1, 12, tzinfo=UTC)


def lines_of(folder):
    return (folder / NAME).read_bytes().splitlines(keepends=True)


def test_entries_come_back_as_they_were_written(tmp_path):
    content = {"rms_mm": 0.1 + 0.2, "marks": [[1.5, -2.0]], "said": 'a "word"\nand 5 µm'}
    append(tmp_path, "fit", content, at=NOON)
    append(tmp_path, "program", {"lines": 3})
    diary = read_diary(tmp_path)
    assert [entry.kind for entry in diary.entries] == ["fit", "program"]
    assert diary.entries[0].content == content and diary.entries[0].at == NOON
    assert diary.entries[1].at.tzinfo is not None
    assert diary.of_kind("program") == diary.entries[1:]
    assert diary.spoilt == ()


@ON_POSIX
def test_a_full_disk_leaves_the_diary_as_it_was(tmp_path):
    """A file may grow to so many bytes and no more, as on a disk that is nearly full."""
    append(tmp_path, "fit", {"rms_mm": 1.0}, at=NOON)
    script = (
        "import resource, sys\n"
        "from plumb.diary.file import append\n"
        "from plumb.text.errors import InputError\n"
        "most, folder = int(sys.argv[1]), sys.argv[2]\n"
        "resource.setrlimit(resource.RLIMIT_FSIZE, (most, most))\n"
        "try: append(folder, 'fit', {'said': 'a' * 1000})\n"
        "except InputError as error: print(error)\n"
    )
    before = (tmp_path / NAME).read_bytes()
    (tmp_path / "new").mkdir()
    for folder, most in ((tmp_path, len(before) + 100), (tmp_path / "new", 100)):
        command = [sys.executable, "-c", script, str(most), folder]
        done = subprocess.run(command, capture_output=True, text=True)
        assert "diary.jsonl: cannot be written" in done.stdout, done.stderr
    assert (tmp_path / NAME).read_bytes() == before
    assert list((tmp_path / "new").iterdir()) == []


@pytest.mark.parametrize("kept", [1, 20, 40, -2, -1])
def test_a_line_cut_anywhere_is_noticed_and_spoils_no_other(tmp_path, kept):
    for number in range(3):
        append(tmp_path, "fit", {"number": number})
    lines = lines_of(tmp_path)
    (tmp_path / NAME).write_bytes(b"".join(lines[:2]) + lines[2][:kept])
    append(tmp_path, "fit", {"number": 3})
    diary = read_diary(tmp_path)
    # Of a line that lacks its end alone nothing is lost.
    whole = [0, 1, 2, 3] if kept == -1 else [0, 1, 3]
    assert [entry.content["number"] for entry in diary.entries] == whole
    assert diary.spoilt == (() if kept == -1 else (3,))


@pytest.mark.parametrize(
    "change", [(b'"number": 1', b'"number": 7'), (b'"kind": "fit"', b'"kind": "fat"')]
)
def test_an_edited_line_does_not_count(tmp_path, change):
    for number in range(3):
        append(tmp_path, "fit", {"number": number})
    lines = lines_of(tmp_path)
    (tmp_path / NAME).write_bytes(lines[0] + lines[1].replace(*change) + lines[2])
    diary = read_diary(tmp_path)
    assert [entry.content["number"] for entry in diary.entries] == [0, 2]
    assert diary.spoilt == (2,)


def test_two_writers_lose_nothing(tmp_path):
    # Entries longer than what a pipe or a file system writes in one go.
    program = (
        "import sys; from plumb.diary.file import append\n"
        "for i in range(25): append(sys.argv[1], 'fit', {'of': sys.argv[2], 'i': i, "
        "'long': 'x' * 100_000})"
    )
    writers = [
        subprocess.Popen([sys.executable, "-c", program, tmp_path, name]) for name in ("a", "b")
    ]
    assert [writer.wait() for writer in writers] == [0, 0]
    diary = read_diary(tmp_path)
    for name in ("a", "b"):
        mine = [entry.content["i"] for entry in diary.entries if entry.content["of"] == name]
        assert mine == list(range(25))
    assert diary.spoilt == ()


def test_a_folder_that_takes_no_file_is_named(tmp_path):
    why = r"diary\.jsonl: cannot be written \(.*\); check the rights"
    with pytest.raises(InputError, match=why):
        append(tmp_path / "none", "fit", {})
    (tmp_path / NAME).mkdir()
    with pytest.raises(InputError, match=r"diary\.jsonl: cannot be read"):
        read_diary(tmp_path)


def written(tmp_path, machine, *lines, back=False):
    path = tmp_path / "machine.toml"
    return write_and_keep(Sender(machine), path, list(lines), back=back)


def test_a_machine_that_took_only_some_numbers_can_have_the_old_back(tmp_path):
    machine = NumbersMachine(forgets=(38,))
    (tmp_path / "machine.toml").touch()
    with pytest.raises(InputError, match=r"holds \$38=0\.0 .*The old numbers are in .*before"):
        written(tmp_path, machine, "$12=2970", "$38=15.5")
    assert machine.numbers[12] == 2970
    lines = kept_before(tmp_path / "machine.toml")
    written(tmp_path, machine, *lines, back=True)
    assert machine.numbers[12] == 2978.4
    noted = read_diary(tmp_path).entries[-1].content
    assert noted["changed"]["$12"] == [2970, 2978.4] and noted["lines"] == lines
    assert kept_before(tmp_path / "machine.toml") == lines
