"""`plumb calibrate` of marks that fitted settings cut: as it was fitted, or what changed."""

import shutil
from pathlib import Path

import pytest
from example_machine import EXAMPLE
from plumb.diary.file import read_diary
from plumb.marks.form import marks_toml
from plumb.marks.read import Mark, Measurements

NEAR = {(-900, 250): (-900.4, 250.3), (900, -250): (900.6, -249.8)}
FAR = {(-900, 250): (-897.8, 243.7), (900, -250): (905.8, -252.6)}


@pytest.fixture
def checked(here, run):
    """Calibrates a fitted machine with marks by their targets."""
    for name in ("groundcontrol.ini", "marks.toml"):
        shutil.copy(EXAMPLE / name, here)
    run("add", "groundcontrol.ini", "marks.toml", "--effect", "chain_pitch", "-o", "machine.toml")

    def calibrate(marks, by=run, cut_with="machine.toml"):
        read = (Mark(str(i), *mark) for i, mark in enumerate(marks.items(), 1))
        form = marks_toml(Measurements(tuple(read)))
        Path("check.toml").write_text(f'cut_with = "{cut_with}"\n{form}')
        return by("calibrate", "machine.toml", "check.toml")

    return calibrate


def files():
    return sorted(each.name for each in Path().iterdir())


def test_a_machine_is_as_it_was_fitted_or_what_changed_is_named(checked, ask):
    code, said, _ = checked(NEAR)
    kept = files()
    assert code == 0 and "The machine is as it was fitted: by the fit of" in said
    assert "Nothing was written." in said and "a single change" not in said
    rows = [line.split() for line in said.splitlines() if line.startswith(("1 ", "2 "))]
    assert rows[0][:4] == ["1", "-900.4,", "250.3", "-0.40,"]
    assert rows[1][:4] == ["2", "900.6,", "-249.8", "+0.60,"]
    code, answer = checked(FAR, ask)
    assert code == 1 and not answer["holds"] and "Something changed since" in answer["sentence"]
    assert answer["changes"][0]["name"] == "left chain"
    assert answer["changes"][0]["size"] == pytest.approx(6.35, abs=1.0)
    code, said, _ = checked(FAR)
    assert code == 1 and "The likeliest: the left chain is" in " ".join(said.split())
    shown = said[said.index("a single change") :]
    assert sum(line.rstrip().endswith((" yes", " no")) for line in shown.splitlines()) == 4
    assert max(map(len, said.splitlines())) <= 80
    assert files() == kept
    kinds = [entry.kind for entry in read_diary(".").entries]
    assert kinds == ["fit", "recheck", "recheck", "recheck"]


def test_a_machine_that_no_longer_holds_is_fitted_again_where_the_marks_are_enough(checked):
    grid = {(x, y): (x + 5.0, y) for x in (-900, 0, 900) for y in (-400, 0, 400)}
    code, said, _ = checked(grid)
    assert code in (0, 1) and "as it was fitted" not in said and "single change" not in said
    code, said, _ = checked({target: target for target in grid})
    assert code == 0 and "The machine is as it was fitted" in said


@pytest.mark.parametrize("unlike", ["other settings", "no diary", "one place"])
def test_two_marks_that_no_fit_can_judge_are_too_few(checked, unlike):
    marks = {(0, 0): (0, 0), (30, 39): (30, 39)} if unlike == "one place" else NEAR
    if unlike == "no diary":
        Path("diary.jsonl").unlink()
    cut_with = "groundcontrol.ini" if unlike == "other settings" else "machine.toml"
    code, said, refused = checked(marks, cut_with=cut_with)
    assert code == 2 and said == "" and "too few for a diagnosis" in refused
