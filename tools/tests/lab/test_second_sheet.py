"""The check marks and the diary of the lab."""

import math
import shutil
import tomllib

import pytest
from folder import EXAMPLE, asked, got, type_in
from plumb.diary.file import FIT, append

FORM = "check.toml"


@pytest.fixture
def client(tmp_path):
    for name in ("machine.toml", "marks.toml", "groundcontrol.ini"):
        shutil.copy(EXAMPLE / name, tmp_path)
    (tmp_path / "lab.json").write_text('{"settings": "machine.toml", "marks": ["marks.toml"]}')
    return asked(tmp_path)


def test_planned_cut_read_and_judged(client, tmp_path):
    plan = got(client.get("/api/check"))
    assert (plan["is_saved"], len(plan["places"]), plan["sentence"]) == (False, 2, "")
    assert not (tmp_path / "check.toml").exists()
    got(client.post("/api/check"))
    assert 'cut_with = "machine.toml"' in (tmp_path / "check.toml").read_text()
    assert "G1" in (tmp_path / "check.nc").read_text()
    assert got(client.get("/api/check"))["places"] == plan["places"]
    type_in(client, FORM, (0.3, 0.1), (-0.2, 0.4))
    good = got(client.get("/api/check"))
    assert good["holds"] and good["sentence"].startswith("Promised: within 1.")
    assert "off from what was promised by 0." in good["sentence"]
    type_in(client, FORM, (0.3, 0.1), (-4, 0.4))
    bad = got(client.get("/api/check"))
    assert not bad["holds"] and "at mark 2" in bad["sentence"]


def test_check_marks_take_no_part_unless_somebody_says_so(client, tmp_path):
    client.post("/api/check")
    type_in(client, FORM, (0.3, 0.1), (-0.2, 0.4))
    assert client.get("/api/project").json()["choices"]["marks"] == ["marks.toml"]
    names = [file["name"] for file in client.get("/api/readings").json()["files"]]
    assert names == ["marks.toml"]
    before = len(got(client.get("/api/bench"))["marks"])
    got(client.post("/api/check/use"))
    assert len(got(client.get("/api/bench"))["marks"]) == before + 2
    assert got(client.get("/api/check"))["is_used"]


def places_in(form):
    """Where the marks of a form were sent [mm]."""
    return [mark["target"] for mark in tomllib.loads(form.read_text())["mark"]]


def test_a_second_round_gets_other_places_and_keeps_the_first(client, tmp_path):
    client.post("/api/check")
    kept = (tmp_path / "check.toml").read_bytes()
    got(client.post("/api/check"))
    assert (tmp_path / "check.toml").read_bytes() == kept
    type_in(client, FORM, (0.3, 0.1), (-0.2, 0.4))
    got(client.post("/api/check"))
    assert got(client.get("/api/check"))["form"] == "check-2.toml"
    assert (tmp_path / "check.toml").read_bytes() != kept
    first, second = (places_in(tmp_path / name) for name in ("check.toml", "check-2.toml"))
    assert min(math.dist(here, there) for here in first for there in second) > 100


def test_nothing_is_promised_before_a_fit(client, tmp_path):
    (tmp_path / "lab.json").write_text('{"settings": "groundcontrol.ini", "marks": ["marks.toml"]}')
    assert "write a correction first" in got(client.get("/api/check"))["trouble"]


def test_the_diary_shows_each_fit_and_numbers_that_moved(client, tmp_path):
    assert client.get("/api/diary").json()["rounds"] == []
    for rms, gap in ((0.9, 2978.0), (0.5, 2984.0)):
        number = {"name": "motor_gap", "unit": "mm", "value": gap, "low": gap - 1, "high": gap + 1}
        content = {
            "machine": "machine.toml",
            "marks": [{}] * 9,
            "distances": [],
            "before_mm": 4.0,
            "rms_mm": rms,
            "left_out_mm": float("nan"),
            "effects": ["chain_sag"],
            "numbers": [number],
        }
        append(tmp_path, FIT, content)
    with open(tmp_path / "diary.jsonl", "a") as file:
        file.write("cut in the mid")
    diary = client.get("/api/diary").json()
    fits = [each["fit"] for each in diary["rounds"]]
    assert [(fit["before_mm"], fit["rms_mm"], fit["left_out_mm"]) for fit in fits] == [
        (4.0, 0.9, None),
        (4.0, 0.5, None),
    ]
    assert diary["rounds"][0]["said"] == "chain sag"
    (course,) = diary["courses"]
    assert (course["noun"], course["has_moved"]) == ("gap between the motors", True)
    assert [point["said"] for point in course["points"]] == ["2978.0", "2984.0"]
    assert diary["spoilt"] == 1
