"""Words of a command line: no option, no number, no program; places and chain lengths."""

import codecs
import re

import numpy as np
import pytest
from example_machine import EXAMPLE, INI
from plumb.cli.main import COMMANDS, GONE
from plumb.settings.files import read_settings
from plumb.settings.machine import write_machine_toml
from plumb.text.files import read_text
from synthetic import TRUE

JOB, SETTINGS, MARKS = (EXAMPLE / name for name in ("pocket.nc", "groundcontrol.ini", "marks.toml"))


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["--lnie", "check"], "there is no option --lnie here; see plumb --help"),
        (["resume", JOB, SETTINGS, "--line", "0"], "--line: '0' is not a whole number from 1 on"),
        (["resume", JOB, SETTINGS, "--line", "two"], "'two' is not a whole number from 1 on"),
        (["check", JOB, SETTINGS, "--start", "1;2"], "'1;2' is not X,Y"),
        (["lab", "--share", "garage"], "name the folder first: plumb lab garage --share"),
    ],
)
def test_a_wrong_word_is_named_and_not_the_words_after_it(run, words, says):
    code, out, complaint = run(*words)
    assert code == 2 and out == "" and says in complaint


@pytest.mark.parametrize("name", GONE)
def test_a_removed_command_names_its_replacement(run, name):
    said = f"there is no command '{name}' any more: {GONE[name]}"
    assert run(name, "--old-option", "1") == (2, "", f"plumb: {said}\n")
    commands = re.findall(r"plumb (\w+)", GONE[name])
    assert name not in COMMANDS and {*commands} <= {*COMMANDS}


@pytest.mark.parametrize(
    ("begin", "says"),
    [
        (b"%PDF-1.4\n1 0 obj", "is a PDF, not a text file"),
        (b"\x89PNG\r\n\x1a\n\0", "is a picture (PNG), not a text file"),
        (b"\xff\xd8\xff\xe0\0", "is a picture (JPEG), not a text file"),
        (b"PK\x03\x04\0", "is an archive (ZIP"),
        (MARKS.read_bytes(), "holds marks, not a program; give a program of G-code"),
        (SETTINGS.read_bytes(), "holds settings of GroundControl, not a program"),
        ((EXAMPLE / "machine.toml").read_bytes(), "holds settings of a machine; give a program"),
        (b'<?xml version="1.0"?>\n<svg/>', "holds a drawing or a page, not a program; let a CAM"),
        (b"  0\nSECTION\n  2\nHEADER\n", "holds a drawing (DXF), not a program; let a CAM"),
        (b'{"Maslow Settings": [{"key": "bedWidth"}]}', "holds settings of WebControl"),
        (b'{"a": 1}', "holds JSON, not a program"),
        (b"\nhello world\n", "line 2: is not G-code (a number is missing behind H)"),
        (b"# A page\n", "line 1: is not G-code (this begins no word: #)"),
    ],
)
@pytest.mark.parametrize("command", ["check", "resume"])
def test_a_file_that_is_not_a_program_is_named_for_what_it_is(run, tmp_path, command, begin, says):
    path = tmp_path / "file.nc"
    path.write_bytes(begin)
    code, out, complaint = run(command, path, SETTINGS, *(["--line", 1] * (command == "resume")))
    assert code == 2 and out == "" and says in complaint and complaint.count("\n") == 1


@pytest.mark.parametrize(
    ("mark", "coding"), [(codecs.BOM_UTF16_LE, "utf-16-le"), (codecs.BOM_UTF16_BE, "utf-16-be")]
)
def test_files_that_notepad_saves_as_unicode_are_read(run, tmp_path, mark, coding):
    for path in (JOB, SETTINGS, MARKS):
        (tmp_path / path.name).write_bytes(mark + path.read_text("utf-8").encode(coding))
        assert read_text(tmp_path / path.name) == path.read_text("utf-8")
    assert read_settings(tmp_path / SETTINGS.name) == read_settings(SETTINGS)
    assert run("check", tmp_path / JOB.name, tmp_path / SETTINGS.name)[0] == 0
    (tmp_path / "half.nc").write_bytes(mark + b"G")
    assert "is not" in run("check", tmp_path / "half.nc", SETTINGS)[2]


def test_a_bare_plumb_shows_its_help(run, capsys):
    with pytest.raises(SystemExit) as end:
        run()
    assert end.value.code == 0 and "usage: plumb" in capsys.readouterr().out


def test_inverse_and_forward_of_our_model_undo_each_other(ask, tmp_path):
    machine = tmp_path / "machine.toml"
    write_machine_toml(machine, TRUE)
    code, answer = ask("inverse", machine, "0,0", "1150,-550", "-900,400")
    assert code == 0 and answer["controller"] == "plumb"
    pairs = [f"{left!r},{right!r}" for left, right in answer["lengths"]]
    code, back = ask("forward", machine, *pairs)
    assert code == 0 and back["found"] == ["yes"] * 3
    places = np.array([[0, 0], [1150, -550], [-900, 400]])
    assert np.array(back["places"]) == pytest.approx(places, abs=1e-4)
    _, board = ask("inverse", machine, "0,0", "1150,-550", "-900,400", "--float32")
    away = np.abs(np.array(board["lengths"]) - answer["lengths"])
    assert 0 < away.max() < 0.002  # as the board computes, in float


def test_a_place_out_of_reach_is_null_and_bad_news(ask, run):
    words = ("inverse", INI, "0,0", "0,5e3", "--controller", "plumb")
    code, answer = ask(*words)
    assert code == 1 and answer["lengths"][1] is None and answer["found"] == ["yes", "out of reach"]
    code, said, _ = run(*words)
    assert code == 1 and said.startswith("1 of 2 places found") and "out of reach" in said
