"""Choices that change while a request is served: it is no matter to what does not go by them."""

import json

import pytest
from folder import EXAMPLE, example_form, got
from plumb.lab.project import Project

FORM = "marks.toml"


@pytest.fixture
def meanwhile(client, tmp_path, monkeypatch):
    """Somebody with a form chooses inches just before the next save."""
    (tmp_path / FORM).write_text(example_form())
    saves, kept = [], Project.save

    def overtaken(project, files, *, read):
        if not saves:
            choices = tmp_path / "lab.json"
            said = json.loads(choices.read_text())
            choices.write_text(json.dumps({**said, "units": "inch"}))
        saves.append(files)
        return kept(project, files, read=read)

    monkeypatch.setattr(Project, "save", overtaken)
    return saves


def digest(client):
    return client.get("/api/readings").json()["digest"]


def type_a_reading(client):
    row = {"index": 0, "read": [98, 106]}
    body = {"file": FORM, "digest": digest(client), "edges": "top-left", "readings": [row]}
    return client.put("/api/readings", json=body)


def add_a_distance(client):
    distance = {"between": ["2", "4"], "length": 1123.5}
    body = {"file": FORM, "digest": digest(client), "distances": [distance]}
    return client.put("/api/distances", json=body)


def say_how_fine_the_tape_is(client):
    body = {"file": FORM, "digest": digest(client), "finest": 1.0}
    return client.put("/api/fineness", json=body)


def bring_marks(client):
    marks = (EXAMPLE / FORM).read_bytes()
    return client.post("/api/marks", files={"file": (FORM, marks)})


def bring_settings(client):
    settings = (EXAMPLE / "groundcontrol.ini").read_bytes()
    return client.post("/api/settings", files={"file": ("groundcontrol.ini", settings)})


def use_check_marks(client):
    return client.post("/api/check/use")


WAYS = [
    (type_a_reading, {"marks": [FORM]}),
    (add_a_distance, {"marks": [FORM]}),
    (say_how_fine_the_tape_is, {"fineness": 1.0}),
    (bring_marks, {"marks": ["marks-2.toml"]}),
    (bring_settings, {"settings": "groundcontrol.ini"}),
    (use_check_marks, {"marks": ["check.toml"]}),
]


@pytest.mark.parametrize(("save", "chosen"), WAYS, ids=lambda each: getattr(each, "__name__", ""))
def test_a_choice_in_mid_save_is_kept_and_the_save_is_done(
    client, tmp_path, meanwhile, save, chosen
):
    (tmp_path / "check.toml").write_text(example_form())
    got(save(client))
    choices = json.loads((tmp_path / "lab.json").read_text())
    assert choices["units"] == "inch" and len(meanwhile) == 2
    assert {name: choices[name] for name in chosen} == chosen


def test_a_program_goes_by_the_choices_so_others_in_mid_save_are_said(client, meanwhile):
    assert client.post("/api/grid").status_code == 409
