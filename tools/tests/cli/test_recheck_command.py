"""`plumb recheck`: from a fit to what is said of it later."""

import re
import shutil
from datetime import UTC, datetime
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from plumb.cli.recheck import sentence
from plumb.diary.file import read_diary
from plumb.diary.recheck import Change

EXAMPLE = Path(__file__).resolve().parents[3] / "docs/example"


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    for name in ("groundcontrol.ini", "marks.toml"):
        shutil.copy(EXAMPLE / name, tmp_path)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_a_fit_is_kept_and_held_against_marks(run, ask, folder):
    words = ("groundcontrol.ini", "marks.toml", "--effect", "chain_pitch")
    run("add", *words)
    assert not (folder / "diary.jsonl").exists()
    assert run("add", *words, "-o", "machine.toml")[2] == ""
    (fit,) = read_diary(folder).entries
    assert fit.content["settings"] == (folder / "machine.toml").read_text()

    near = ("--touch=-900.4,250.3:-900,250", "--touch=900.6,-249.8:900,-250")
    code, said, _ = run("recheck", "machine.toml", *near)
    assert code == 0 and re.search(
        r"as the fit of .* left it: errors up to .* are within\s+what it", said
    )
    lost = (near[0], "--touch=900.6,-249.8:900,250")
    code, said, _ = run("recheck", "machine.toml", *lost)
    assert code == 1 and "Touch 2: has y lost its sign?" in said and "Touch 1" not in said
    far = ("--touch=-897.8,243.7:-900,250", "--touch=905.8,-252.6:900,-250")
    code, answer = ask("recheck", "machine.toml", *far)
    assert code == 1 and not answer["holds"] and "Something changed since" in answer["sentence"]
    assert answer["changes"][0]["name"] == "left chain"
    assert answer["changes"][0]["size"] == pytest.approx(6.35, abs=1.0)
    kinds = [entry.kind for entry in read_diary(folder).entries]
    assert kinds == ["fit", "recheck", "recheck", "recheck"]


def test_what_cannot_be_is_refused(run, folder):
    code, _, error = run("recheck", "groundcontrol.ini", "--touch=0,0:0,0")
    assert code == 2 and "two marks are needed" in error
    code, _, error = run("recheck", "groundcontrol.ini", "--touch=0,0:0,0", "--touch=90,0:90,0")
    assert code == 2 and "knows no fit that gave these settings" in error


@pytest.mark.parametrize(
    ("second", "complaint"),
    [
        ("1,2:1,2", "touch 2 is touch 1 again; touch another hole far from it"),
        ("30,39:30,39", "the marks are less than 50 mm apart: they are a single place"),
        ("30,40:30,40", "knows no fit that gave these settings"),
    ],
)
def test_a_place_that_was_touched_twice_is_no_second_place(run, second, complaint):
    code, _, error = run("recheck", "groundcontrol.ini", "--touch=0,0:0,0", f"--touch={second}")
    assert code == 2 and complaint in error


def test_a_recheck_says_each_mark_and_the_four_best_changes(run, ask, folder):
    words = ("groundcontrol.ini", "marks.toml", "--effect", "chain_pitch")
    run("add", *words, "-o", "machine.toml")
    moved = ("--touch=-895.1,250.2:-900,250", "--touch=904.8,-250.1:900,-250")
    code, said, _ = run("recheck", "machine.toml", *moved)
    _, answer = ask("recheck", "machine.toml", *moved)
    sheet = "the sheet has moved by +4.85 +- 0.37 mm along x"
    assert code == 1 and sheet in " ".join(said.split())
    assert answer["changes"][0]["name"] == "sheet x" and answer["changes"][0]["explains"]
    rows = [line.split() for line in said.splitlines() if line.startswith(("1 ", "2 "))]
    assert rows[0][:5] == ["1", "-895.1,", "250.2", "+4.90,", "+0.20"]
    assert rows[1][:5] == ["2", "904.8,", "-250.1", "+4.80,", "-0.10"]
    shown = said[said.index("a single change") :]
    assert "motors right of the middle of the sheet by +4.85 +- 0.37 mm " in shown
    assert sum(line.rstrip().endswith((" yes", " no")) for line in shown.splitlines()) == 4
    along_y = ("--touch=-900,255:-900,250", "--touch=900,-245:900,-250")
    said_of_y = run("recheck", "machine.toml", *along_y)[1]
    assert "5.00 +- 0.37 mm along y" in " ".join(said_of_y.split())
    assert re.search(r"\n(left|right) chain by [+-]0\.\d+ \+- 0\.\d+ % too long ", shown)
    near = ("--touch=-900.4,250.3:-900,250", "--touch=900.6,-249.8:900,-250")
    assert "a single change" not in run("recheck", "machine.toml", *near)[1]


@pytest.mark.parametrize(
    ("name", "size", "sigma", "before", "said"),
    [
        ("motor_gap", -8.8, 0.7, 2978.0, "gap between the motors by -8.80 +- 0.70 mm"),
        (
            "chain_stretch.compliance",
            5e-6,
            1e-6,
            5e-6,
            "chains by +0.50 +- 0.10 mm longer for each metre at 100 N",
        ),
        # Squares of 10 and of 20 mm.
        (
            "chain_plane.gap_squared",
            300.0,
            20.0,
            100.0,
            "sprockets and ring differ by +10.0 +- 0.5 mm in their distance from the sheet",
        ),
    ],
)
def test_a_change_has_the_words_and_the_unit_of_its_number(name, size, sigma, before, said):
    change = Change(name, size, sigma, before, 0.0, explains=True)
    at = datetime(2026, 5, 1, 12, tzinfo=UTC)
    checked = SimpleNamespace(
        holds=False, errors=np.ones((2, 2)), fit=SimpleNamespace(at=at), changes=(change,)
    )
    assert sentence(checked).endswith(f"The likeliest: {said}.")


def test_errors_that_no_single_change_explains_are_said_so(run, folder):
    words = ("groundcontrol.ini", "marks.toml", "--effect", "chain_pitch")
    run("add", *words, "-o", "machine.toml")
    torn = ("--touch=-880,250:-900,250", "--touch=900,-270:900,-250", "--touch=0,20:0,0")
    code, said, _ = run("recheck", "machine.toml", *torn)
    assert code == 1 and "Errors up to 20.00 mm are more than the fit of" in said
    assert "no single change explains them" in " ".join(said.split())
