"""`plumb recover`: home marks, lost places, refusals; `plumb read` of a lost place."""

import json
import re
import subprocess
import sys
import tomllib

import plumb.cli.read as read_command
import pytest
from example_machine import EXAMPLE
from numbers_machine import NumbersMachine
from plumb.cli.main import main
from plumb.diary.file import append, read_diary


@pytest.fixture(autouse=True)
def folder(here):
    (here / "machine.toml").write_text((EXAMPLE / "machine.toml").read_text())
    return here


def test_marks_that_three_commands_keep_at_once_are_all_kept(folder):
    command = [sys.executable, "-m", "plumb.cli.start", "recover", "machine.toml"]
    begun = [
        subprocess.Popen([*command, f"--keep=m{i}=0,{100 * i}"], stdout=subprocess.DEVNULL)
        for i in range(3)
    ]
    assert [each.wait() for each in begun] == [0] * 3
    kept = tomllib.loads((folder / "home.toml").read_text())["mark"]
    assert sorted(kept) == [f"m{i}" for i in range(3)]


def test_a_program_of_ours_is_replaced_and_no_other(run, folder):
    keeping = ("recover", "machine.toml", "--keep=left=-900,250", "-o", "left.nc")
    restoring = ("recover", "machine.toml", "--at", "left", "-o", "back.nc")
    for words in (keeping, restoring):
        assert [run(*words)[0] for _ in range(2)] == [0, 0], words
        (folder / words[-1]).write_text("G21\nG90\n")
        assert run(*words)[0] == 2, "what another wrote"


def test_a_home_mark_is_not_compared_with_itself(run):
    for kept in ("left=-900,250", "twin=-899,252", "right=900,-250"):
        run("recover", "machine.toml", f"--keep={kept}")
    restored = ("recover", "machine.toml", "--at", "left")
    for name in ("left", "twin"):
        code, said, error = run(*restored, f"--touch={name}:-900,250")
        assert code == 2 and said == ""
        assert f"--touch {name}: that is the hole of --at left" in error
        assert "touch another home mark" in error
    code, said, _ = run(*restored, "--touch=right:900,-250")
    assert code == 0 and "Home mark right fits" in said


def test_home_marks_are_kept_listed_and_restored(run, ask, folder):
    assert "no home mark yet" in run("recover", "machine.toml")[1]
    code, said, _ = run("recover", "machine.toml", "--keep=left=-900,250", "-o", "left.nc")
    assert code == 0 and said.count("-900.00, 250.00") == 1
    program = (folder / "left.nc").read_text().splitlines()
    assert program[1:3] == ["G21", "G90"] and program[-3].startswith("G1 X-900.000 Y250.000")
    run("recover", "machine.toml", "--keep=right=900,-250")
    _, answer = ask("recover", "machine.toml")
    assert [mark["name"] for mark in answer["marks"]] == ["left", "right"]
    text = (folder / "home.toml").read_text()
    (folder / "home.toml").write_text(text.replace("[900.0, -250.0]", "[899.0, -250.0]"))
    right = ask("recover", "machine.toml")[1]["marks"][1]
    assert right["place"] == pytest.approx([900, -250]) and right["kept_place"] == [899, -250]
    chains = answer["marks"][0]["chains"]
    code, said, _ = run("recover", "machine.toml", "--at", "left", "-o", "restore.nc")
    assert code == 0
    line = (folder / "restore.nc").read_text().splitlines()[-1]
    assert line == f"B06 L{chains[0]:.3f} R{chains[1]:.3f}"
    assert f"send {line}, and the machine shows -900.00, 250.00." in " ".join(said.split())
    listed = run("recover", "machine.toml")[1].splitlines()
    assert f"L{chains[0]:.3f} R{chains[1]:.3f}" in listed[1]
    said = " ".join(run("recover", "machine.toml", "--keep=low=0,-400")[1].split())
    assert "Make the hole with the program, in what cannot move" in said


@pytest.mark.parametrize(("shown", "code"), [("900.4,-250.7", 0), ("905.1,-247.2", 1)])
def test_a_second_mark_fits_or_not(run, shown, code):
    run("recover", "machine.toml", "--keep=left=-900,250")
    run("recover", "machine.toml", "--keep=right=900,-250")
    done, said, _ = run("recover", "machine.toml", "--at", "left", f"--touch=right:{shown}")
    said = " ".join(said.split())
    assert done == code and ("does not fit" in said) is bool(code)
    # A bit to the right needs more of the left chain and less of the right.
    assert not code or re.search(r"are -[\d.]+ \(left\) and \+", said)


def test_actions_go_into_an_existing_diary(run, folder):
    run("recover", "machine.toml", "--keep=left=-900,250")
    run("recover", "machine.toml", "--at", "left")
    assert read_diary(folder).entries == ()
    append(folder, "fit", {})
    run("recover", "machine.toml", "--at", "left")
    (home,) = read_diary(folder).of_kind("home")
    assert home.content["mark"] == "left" and not home.content["kept"]


@pytest.mark.parametrize(
    ("words", "why"),
    [
        (["recover", "machine.toml", "--touch=left:0,0"], "give --at too"),
        (["recover", "machine.toml", "--at=a", "--touch=0,0:0,0"], "is not NAME:X,Y"),
        (["recover", "machine.toml", "--at", "left"], "no home mark 'left'; there is none yet"),
        (["recover", "machine.toml", "-o", "a.nc"], "there is no program without --keep or --at"),
        (["recover", "machine.toml", "--keep=a=0,0", "--at", "a"], "--keep goes alone"),
        (["recover", "machine.toml", "--keep=a=0,9000"], "home mark a"),
    ],
)
def test_impossible_values_are_refused(run, folder, words, why):
    code, _, error = run(*words)
    assert code == 2 and why in error and error.count("\n") == 1
    assert not (folder / "home.toml").exists()


@pytest.mark.parametrize(
    "text",
    ["[mark.left]\nplace = [1, 2]\n", "[mark.left]\nplace = [1]\nchains = [1, 2]\n", "mark = 5\n"],
)
def test_a_spoilt_file_of_home_marks_is_refused(run, folder, text):
    (folder / "home.toml").write_text(text)
    code, _, error = run("recover", "machine.toml")
    assert code == 2 and re.search(r"home\.toml, (\[mark\.left\]|mark)", error)


CUT_OFF = (
    "ALARM: Position Lost. Power was lost before the position was kept. Last known chain lengths: "
    "1650.12, 1651.98 mm. Set them (B06 L R), or set the chains to their marks (B08)."
)
UNSET = "Chain lengths are not known yet: send your settings, then set the chains."
NOWHERE = "Message: Unable to find valid machine position for chain lengths 0.00, 0.00 . Please set"
FOUND = ["Plumb v1.0.0", "position loaded at:", "0.00", "0.00"]


class Greeting(NumbersMachine):
    """A machine that says something at its start, and has no telemetry."""

    def __init__(self, *said):
        super().__init__()
        self.begins = "".join(line + "\r\n" for line in said).encode()

    def read(self):
        said, self.begins = self.begins + super().read(), b""
        return said

    def answer(self, line):
        return [] if line == "B30" else super().answer(line)


@pytest.fixture
def asked(monkeypatch, capsys):
    """The output of `plumb read` for a machine with a greeting."""

    def ask(*greeting, options=()):
        monkeypatch.setattr(read_command, "port_for", str)
        monkeypatch.setattr(read_command, "SerialPort", lambda path: Greeting(*greeting))
        assert main(["read", *options]) == 0
        return capsys.readouterr().out

    return ask


@pytest.mark.parametrize("lost", [CUT_OFF, UNSET, NOWHERE])
def test_a_lost_place_is_reported_in_the_machines_words(asked, lost):
    said = " ".join(asked("Plumb v1.0.0", lost, "ready").split())
    assert f"The machine does not know where its sled is. It says: {lost}" in said
    assert "plumb recover --at" in said and "B06 or B08" in said and "G10 Z0" in said
    assert "The sled is at" not in said
    answer = json.loads(asked("Plumb v1.0.0", lost, options=["--json"]))
    assert answer["place"] is None and answer["lost"] == lost


def test_a_machine_that_knows_its_place_shows_it(asked):
    said = asked(*FOUND)
    assert "The sled is at x 0.00, y 0.00, the bit at z 0.00 mm." in said
    assert "does not know" not in said
    answer = json.loads(asked(*FOUND, options=["--json"]))
    assert answer["place"] == [0, 0, 0] and answer["lost"] is None
