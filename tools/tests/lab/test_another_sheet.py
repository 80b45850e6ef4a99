"""Marks on another sheet: how it should lie, what its form says, and what check marks go by."""

import json
import math
import re
import shutil
from dataclasses import replace

import pytest
from folder import EXAMPLE, asked, got, type_in
from plumb import api
from plumb.cure.add import add
from plumb.cure.machine_file import record_of, turn_sentences
from plumb.marks.form import read_form
from plumb.model.predict import known_effects
from plumb.settings.files import read_settings
from plumb.settings.toml import FitRecord, FittedBoard

TURN = 9.996939502150416e-06  # [rad] of the example's sheet, as its machine.toml says
WIDTH = 2438.4  # [mm]


@pytest.fixture
def client(tmp_path):
    for name in ("machine.toml", "marks.toml", "groundcontrol.ini"):
        shutil.copy(EXAMPLE / name, tmp_path)
    return chosen(tmp_path)


def chosen(folder, **more):
    choices = {"settings": "machine.toml", "marks": ["marks.toml"], **more}
    (folder / "lab.json").write_text(json.dumps(choices))
    return asked(folder)


def another_sheet(folder, *, shift=0.0, turn=0.0):
    """The example's marks once more, on another sheet that lies `shift` [mm] farther right, its
    right end `turn` [rad] lower: there the marks are farther from its top edge."""
    text = (EXAMPLE / "marks.toml").read_text()

    def read(match):
        x, y = float(match[1]), float(match[2])
        return f"measured = [{x + turn * y + shift + 0.01:.2f}, {y - turn * x:.2f}]"

    moved = re.sub(r"measured = \[([\d.]+), ([\d.]+)\]", read, text)
    head = 'frame = "sheet-top-left"\n'
    assert head in moved
    (folder / "marks-2.toml").write_text(moved.replace(head, f"{head}new_sheet = true\n"))


def test_the_form_of_another_sheet_says_so(client, tmp_path):
    got(client.post("/api/grid"))
    assert "new_sheet" not in (tmp_path / "marks-2.toml").read_text()
    chosen(tmp_path, new_sheet=True)
    assert not got(client.get("/api/grid"))["is_saved"]
    got(client.post("/api/grid"))
    form = read_form(tmp_path / "marks-2.toml", sheet=(WIDTH, 1219.2), known=known_effects())
    assert form.measurements.rounds[0].new_sheet
    assert (
        got(client.get("/api/grid"))["is_saved"]
        and got(client.get("/api/grid"))["last_form"] == "marks.toml"
    )


def test_the_first_sheet_is_no_other(client, tmp_path):
    chosen(tmp_path, marks=[], new_sheet=True)
    (tmp_path / "marks.toml").unlink()
    assert got(client.get("/api/grid"))["last_form"] == ""
    got(client.post("/api/grid"))
    assert "new_sheet" not in (tmp_path / "marks.toml").read_text()


def test_the_next_sheet_is_turned_back_once(client, tmp_path):
    assert got(client.get("/api/grid"))["sheet_rise"] == pytest.approx(math.tan(TURN) * WIDTH)
    another_sheet(tmp_path)
    chosen(tmp_path, marks=["marks.toml", "marks-2.toml"])
    assert got(client.get("/api/grid"))["sheet_rise"] == 0
    chosen(tmp_path, settings="groundcontrol.ini")
    assert got(client.get("/api/grid"))["sheet_rise"] == 0


def test_by_hand_is_about_the_sheet_that_hangs_there_now(client, tmp_path):
    another_sheet(tmp_path, turn=0.003)
    names = ["marks.toml", "marks-2.toml"]
    inputs = api.read(tmp_path / "groundcontrol.ini", *(tmp_path / name for name in names))
    made = add(inputs, effects=["chain_pitch"])
    first = math.tan(made.after_fit.sheet_rotation) * WIDTH
    assert made.sheet_rise - first == pytest.approx(0.003 * WIDTH, abs=0.5)
    recorded = record_of(made, inputs)
    assert made.sheet_rise == pytest.approx(recorded.sheet_rise(WIDTH))
    (said,) = turn_sentences(made)
    assert f"raise the right end of the next sheet by {made.sheet_rise:.2f} mm" in said


@pytest.mark.parametrize(("turn", "said"), [(0.0, 0), (0.0001, 0), (-0.003, 1)])
def test_by_hand_is_silent_on_a_last_sheet_that_may_hang_straight(client, tmp_path, turn, said):
    another_sheet(tmp_path, turn=turn)
    (tmp_path / "marks-2.toml").rename(tmp_path / "last.toml")
    another_sheet(tmp_path, turn=0.004)
    turned = (tmp_path / "marks-2.toml").read_text().replace("new_sheet = true\n", "")
    (tmp_path / "first.toml").write_text(turned)
    files = [tmp_path / "first.toml", tmp_path / "last.toml"]
    made = add(api.read(tmp_path / "groundcontrol.ini", *files), effects=["chain_pitch"])
    assert len(turn_sentences(made)) == said


def test_the_last_sheet_is_turned_back():
    settings = replace(read_settings(EXAMPLE / "machine.toml"), fitted=None)
    boards = [FittedBoard(str(i), "", settings, (0, 0, turn)) for i, turn in enumerate((0, -0.003))]
    assert FitRecord(5, 1, 1, 1, 0.002).sheet_rise(2000) == pytest.approx(4, abs=0.001)
    record = FitRecord(5, 1, 1, 1, 0.002, boards=tuple(boards))
    assert record.sheet_rise(2000) == pytest.approx(-2, abs=0.001)


def test_check_marks_go_by_the_sheet_that_they_are_on(client, tmp_path):
    client.post("/api/check")
    type_in(client, "check.toml", (0.3, 0))
    before = client.get("/api/check").json()
    assert before["holds"]
    assert [each["form"] for each in before["rounds"]] == ["marks.toml", "check.toml"]
    first, check = (each["off_target"] for each in before["rounds"])
    assert first > 8 and check == pytest.approx(0.3, abs=1e-6)
    assert [each["is_check"] for each in before["rounds"]] == [False, True]
    another_sheet(tmp_path, shift=12)
    chosen(tmp_path, marks=["marks.toml", "marks-2.toml"])
    after = client.get("/api/check").json()
    assert after["marks"] == before["marks"] and after["holds"]
    assert len(after["rounds"]) == 3 and after["rounds"][1]["off_target"] > 12
