"""`plumb diary` and `plumb recheck`: from a fit to what is said of it later."""

import re
import shutil
from datetime import UTC, datetime
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from plumb.cli.recheck import sentence
from plumb.diary.file import append, read_diary
from plumb.diary.recheck import Change

EXAMPLE = Path(__file__).resolve().parents[3] / "docs/example"


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    for name in ("groundcontrol.ini", "marks.toml"):
        shutil.copy(EXAMPLE / name, tmp_path)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_a_fit_is_kept_shown_drawn_and_held_against_marks(run, ask, folder):
    words = ("groundcontrol.ini", "marks.toml", "--effect", "chain_pitch")
    run("add", *words)
    assert not (folder / "diary.jsonl").exists()
    assert run("add", *words, "-o", "machine.toml")[2] == ""
    (fit,) = read_diary(folder).entries
    assert fit.content["settings"] == (folder / "machine.toml").read_text()

    code, said, _ = run("diary", "--picture", "diary.svg")
    assert code == 0 and said.startswith("1 fit; the newest leaves 0.94 mm at marks left out")
    assert "left chain 0.18 % too long (0.15 to 0.22)" in said and re.search(
        r"chains too long\s+or too short", said
    )
    picture = (folder / "diary.svg").read_bytes()
    assert picture.startswith(b"<?xml") and picture.count(b'<g id="axes_') == 1 + len(
        fit.content["numbers"]
    )

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

    run("add", *words, "chain_sag", "-o", "machine.toml")
    code, said, _ = run("diary")
    assert said.startswith("2 fits")
    assert "The likeliest: the left chain is" in " ".join(said.split())
    assert max(map(len, said.splitlines())) <= 80


def test_what_cannot_be_is_refused(run, folder):
    code, _, error = run("diary")
    assert code == 2 and "there is no diary; plumb add -o machine.toml begins it" in error
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


def fit_with(low, high, **more):
    """A fit of the diary with one number."""
    number = {"name": "motor_gap", "value": (low + high) / 2, "low": low, "high": high}
    errors = {"before_mm": 4.0, "rms_mm": 0.5, "left_out_mm": 0.75}
    empty = {"machine": "m.toml", "marks": [{}] * 9, "distances": [], "effects": []}
    return {**empty, **errors, "numbers": [{**number, "unit": "mm"}], **more}


def test_what_moved_is_said_first_and_in_its_row(run, ask, folder):
    for day, ends in enumerate([(2977, 2979), (2978, 2980), (2983, 2985)], start=1):
        append(folder, "fit", fit_with(*ends), at=datetime(2026, 5, day, 12, tzinfo=UTC))
        said = " ".join(run("diary")[1].split())
        is_moved = day == 3
        assert ("Moved since the fit before: gap between the motors." in said) is is_moved
        assert (said.count("moved") == 1) is is_moved, "in the row of the number"
    assert "+5.0 mm" in said and "+1.0 mm" not in said
    lines = run("diary")[1].splitlines()
    rows = [line.split() for line in lines if line.startswith("2026-05-")]
    assert [row[:2] for row in rows] == [[f"2026-05-0{day}", "12:00"] for day in (1, 2, 3)]
    assert rows[0][2:] == ["9", "4.00", "0.50", "0.75", "nothing"]
    (head,) = (line for line in lines if line.endswith("added"))
    assert head.index("added") == lines[lines.index(head) + 1].index("nothing")
    _, answer = ask("diary")
    assert [fit["readings"] for fit in answer["fits"]] == [9, 9, 9]
    assert answer["numbers"][0]["moved"] is True
    assert answer["numbers"][0]["points"][2]["value"] == 2984


def test_a_change_has_the_unit_of_its_number(run, folder):
    # The usual sag is 8.1944e-12 1/mm^2.
    for day, sag in enumerate([8.1944e-12, 4 * 8.1944e-12], start=1):
        number = {"name": "chain_sag.weight_ratio_squared", "unit": "1/mm^2", "value": sag}
        numbers = [{**number, "low": 0.81 * sag, "high": 1.21 * sag}]
        at = datetime(2026, 5, day, 12, tzinfo=UTC)
        append(folder, "fit", fit_with(1, 2, numbers=numbers), at=at)
    said = " ".join(run("diary")[1].split())
    assert "chains sag 4.0 times the usual amount (3.2 to 4.8) +3.0 times" in said
    assert "Moved since the fit before: chain sag." in said


def test_other_entries_are_the_last_ten_each_in_its_words(run, folder):
    for number in range(8):
        append(folder, "program", {"program": f"{number}.nc", "whole": number != 7})
    append(folder, "numbers", {"changed": {"$2": [1, 2], "$3": [4, 5]}, "machine": "m.toml"})
    append(folder, "home", {"mark": "left", "kept": True})
    append(folder, "home", {"mark": "left", "kept": False})
    append(folder, "slip", {"sentence": "No chain slipped."})
    code, said, _ = run("diary")
    assert code == 0 and said.startswith("The diary has no fit yet.")
    whats = [line.split(maxsplit=2)[2].strip() for line in said.splitlines() if line[:2] == "20"]
    assert whats == [
        *(f"sent {number}.nc" for number in range(2, 7)),
        "sent 7.nc, not to its end",
        "2 numbers changed by m.toml",
        "home mark left kept",
        "home mark left used",
        "No chain slipped.",
    ]


def test_a_line_that_is_cut_is_said(run, folder):
    append(folder, "fit", fit_with(1, 2))
    (folder / "diary.jsonl").open("a").write('{"digest": "12')
    said = " ".join(run("diary")[1].split())
    assert "diary.jsonl: line 2 is cut or was changed; passed over" in said


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
