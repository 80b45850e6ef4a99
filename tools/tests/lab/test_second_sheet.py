"""The check marks and the diary of the lab."""

import math
import shutil
import tomllib

import pytest
from folder import EXAMPLE, asked
from plumb.diary.file import FIT, append


@pytest.fixture
def client(tmp_path):
    for name in ("machine.toml", "marks.toml", "groundcontrol.ini"):
        shutil.copy(EXAMPLE / name, tmp_path)
    (tmp_path / "lab.json").write_text('{"settings": "machine.toml", "marks": ["marks.toml"]}')
    return asked(tmp_path)


def shown(client):
    answer = client.get("/api/check")
    assert answer.status_code == 200, answer.text
    return answer.json()


def type_in(client, offsets):
    form = client.get("/api/readings", params={"file": "check.toml"}).json()
    readings = [
        {"index": mark["index"], "read": [mark["meant"][0] + x, mark["meant"][1] + y]}
        for mark, (x, y) in zip(form["marks"], offsets, strict=True)
    ]
    body = {**{key: form[key] for key in ("file", "digest", "edges")}, "readings": readings}
    answer = client.put("/api/readings", json=body)
    assert answer.status_code == 200, answer.text


def test_planned_cut_read_and_judged(client, tmp_path):
    plan = shown(client)
    assert (plan["is_saved"], len(plan["places"]), plan["sentence"]) == (False, 2, "")
    assert not (tmp_path / "check.toml").exists()
    assert client.post("/api/check").status_code == 200
    assert 'cut_with = "machine.toml"' in (tmp_path / "check.toml").read_text()
    assert "G1" in (tmp_path / "check.nc").read_text()
    assert shown(client)["places"] == plan["places"]
    type_in(client, [(0.3, 0.1), (-0.2, 0.4)])
    good = shown(client)
    assert good["holds"] and good["sentence"].startswith("Promised: within 1.")
    assert "off by 0." in good["sentence"]
    type_in(client, [(0.3, 0.1), (-4, 0.4)])
    bad = shown(client)
    assert not bad["holds"] and "at mark 2" in bad["sentence"]


def test_check_marks_take_no_part_unless_somebody_says_so(client, tmp_path):
    client.post("/api/check")
    type_in(client, [(0.3, 0.1), (-0.2, 0.4)])
    assert client.get("/api/project").json()["choices"]["marks"] == ["marks.toml"]
    names = [file["name"] for file in client.get("/api/readings").json()["files"]]
    assert names == ["marks.toml"]
    before = len(client.get("/api/bench").json()["marks"])
    assert client.post("/api/check/use").status_code == 200
    assert len(client.get("/api/bench").json()["marks"]) == before + 2
    assert shown(client)["is_used"]


def places_in(form):
    """Where the marks of a form were sent [mm]."""
    return [mark["target"] for mark in tomllib.loads(form.read_text())["mark"]]


def test_a_second_round_gets_other_places_and_keeps_the_first(client, tmp_path):
    client.post("/api/check")
    kept = (tmp_path / "check.toml").read_bytes()
    assert client.post("/api/check").status_code == 200
    assert (tmp_path / "check.toml").read_bytes() == kept
    type_in(client, [(0.3, 0.1), (-0.2, 0.4)])
    assert client.post("/api/check").status_code == 200
    assert shown(client)["form"] == "check-2.toml"
    assert (tmp_path / "check.toml").read_bytes() != kept
    first, second = (places_in(tmp_path / name) for name in ("check.toml", "check-2.toml"))
    assert min(math.dist(here, there) for here in first for there in second) > 100


def test_nothing_is_promised_before_a_fit(client, tmp_path):
    (tmp_path / "lab.json").write_text('{"settings": "groundcontrol.ini", "marks": ["marks.toml"]}')
    assert "write a correction first" in shown(client)["trouble"]


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
