"""Readings and distances by the routes: each is saved, none is lost, what disagrees is said."""

import json
import re
import shutil

import pytest
from example_machine import EXAMPLE, ROOT
from folder import asked, choose, example_form, got
from plumb.lab.project import Project
from plumb.lab.routes import readings
from plumb.marks.read import read_marks
from synthetic import SHEET


def shown(client, **query):
    return got(client.get("/api/readings", params=query))


def put(client, typed, *, digest, file="marks.toml", edges="top-left"):
    rows = [{"index": index, "read": read} for index, read in typed.items()]
    body = {"file": file, "digest": digest, "edges": edges, "readings": rows}
    return client.put("/api/readings", json=body)


@pytest.mark.parametrize(
    ("edges", "read"),
    [
        ("top-left", [98, 106]),
        ("top-right", [2340.4, 106]),
        ("bottom-left", [98, 1113.2]),
        ("bottom-right", [2340.4, 1113.2]),
    ],
)
def test_readings_count_from_the_chosen_edges(client, tmp_path, edges, read):
    (tmp_path / "marks.toml").write_text(example_form())
    choose(client, edges=edges)
    form = shown(client)
    answer = put(client, {0: read}, digest=form["digest"], edges=form["edges"]).json()
    assert answer["marks"][0]["read"] == pytest.approx(read)
    assert "measured = [98.0, 106.0]" in (tmp_path / "marks.toml").read_text()


def test_a_form_that_changes_while_it_is_shown_is_noticed(client, tmp_path, monkeypatch):
    (tmp_path / "marks.toml").write_text(example_form())
    forms = readings._forms

    def changed_then(project, choices):
        read = forms(project, choices)
        (tmp_path / "marks.toml").write_text(example_form(read=3))
        return read

    with monkeypatch.context() as patched:
        patched.setattr(readings, "_forms", changed_then)
        old = shown(client)
    assert old["marks"][0]["read"] is None
    assert put(client, {0: [99, 99]}, digest=old["digest"]).status_code == 409


def test_a_form_in_inches_keeps_its_inches_and_what_was_typed_as_a_fraction(client, tmp_path):
    text = 'frame = "sheet-top-left"\nunits = "inch"\n'
    text += '[[mark]]\nname = "1"\ntarget = [4, 4]\nmeasured = ["4 1/16", 4.25]\n'
    text += '[[mark]]\nname = "2"\ntarget = [80, 40]\n# measured = [ , ]\n'
    (tmp_path / "marks.toml").write_text(text)
    put(client, {1: [80.1875 * 25.4, 40.5 * 25.4]}, digest=shown(client)["digest"])
    saved = (tmp_path / "marks.toml").read_text()
    assert 'measured = ["4 1/16", 4.25]' in saved
    assert "measured = [80.1875, 40.5]" in saved


def test_a_distance_to_a_name_with_two_places_is_refused(client, tmp_path):
    (tmp_path / "marks.toml").write_text(example_form(read=23))
    digest = shown(client)["digest"]
    distances = [{"between": ["2", "1"], "length": 500.0}]
    body = {"file": "marks.toml", "digest": digest, "distances": distances}
    answer = client.put("/api/distances", json=body)
    assert answer.status_code == 422 and "mark 1 is at two places" in answer.json()["error"]
    assert "[[distance]]" not in (tmp_path / "marks.toml").read_text()


def test_the_fineness_of_the_tape_becomes_its_sigma(client, tmp_path):
    (tmp_path / "marks.toml").write_text(example_form())
    sigmas = {}
    for finest in (1.0, 25.4 / 16, None):
        body = {"file": "marks.toml", "digest": shown(client)["digest"], "finest": finest}
        sigmas[finest] = client.put("/api/fineness", json=body).json()["tape_sigma"]
    assert sigmas == {1.0: 0.49, 25.4 / 16: 0.61, None: None}
    assert "tape_sigma_mm" not in (tmp_path / "marks.toml").read_text()


@pytest.mark.parametrize("name", ["marks.csv", "Calibration Measurements.ini"])
def test_a_picked_file_of_another_form_becomes_a_form_with_the_same_readings(
    client, tmp_path, name
):
    picked = ROOT / "tools/plumb/examples/mibproj" / name
    if name == "marks.csv":
        picked = tmp_path / "picked.csv"
        picked.write_text(
            "name,target_x_mm,target_y_mm,measured_x_mm,measured_y_mm\n"
            "a,0,0,1.5,2\nb,500,0,501,1\nc,0,400,1,402\n"
        )
    answer = client.post("/api/marks", files={"file": (name, picked.read_bytes())}).json()
    before = read_marks(picked, sheet=SHEET)
    after = read_marks(tmp_path / answer["file"], sheet=SHEET)
    assert [mark.name for mark in after.marks] == [mark.name for mark in before.marks]
    assert after.measured == pytest.approx(before.measured)
    assert after.controller == before.controller
    assert client.get("/api/project").json()["choices"]["marks"] == [answer["file"]]


def test_a_file_without_marks_is_refused_in_a_line(client, tmp_path):
    refused = client.post("/api/marks", files={"file": ("holiday.csv", b"sun,sea\n1,2\n")})
    assert refused.status_code == 422
    assert "\n" not in refused.json()["error"]
    assert not (tmp_path / "marks.toml").exists()
    assert not [*tmp_path.glob(".*.csv")]  # no copy of it is left


def test_good_readings_raise_no_doubt_however_few_they_are(client, tmp_path):
    for count in (1, 3, 8):
        (tmp_path / "marks.toml").write_text(example_form(read=count))
        answer = client.get("/api/doubts", params={"file": "marks.toml"}).json()
        assert answer["doubts"] == [], count


def test_how_far_off_the_marks_are_is_said_without_what_disagrees(client, tmp_path):
    form = example_form(read=9)
    (tmp_path / "marks.toml").write_text(form)
    whole = client.get("/api/doubts", params={"file": "marks.toml"}).json()
    first = re.search(r"^measured = \[([\d.]+),", form, re.MULTILINE)
    wrong = form.replace(first[0], f"measured = [{float(first[1]) + 100:.1f},", 1)
    (tmp_path / "marks.toml").write_text(wrong)
    rest = client.get("/api/doubts", params={"file": "marks.toml"}).json()
    assert len(rest["doubts"]) == 1 and "That is without what disagrees." in rest["compared"]
    assert whole["compared"] and "without" not in whole["compared"]


REAL = sorted(
    path.parent
    for path in (ROOT / "tools/plumb/examples").glob("*/SOURCE.md")
    if any(path.parent.glob("*.toml"))
)


@pytest.mark.parametrize("folder", REAL, ids=lambda folder: folder.name)
def test_the_page_opens_what_the_commands_open(folder, tmp_path):
    """Each real machine, as a folder that somebody opens, and as files that he picks."""
    as_folder = tmp_path / "whole"
    shutil.copytree(folder, as_folder)
    forms = got(asked(as_folder).get("/api/project"))
    assert forms["machine"] and not forms["trouble"]
    (tmp_path / "picked").mkdir()
    picked = asked(tmp_path / "picked")
    name = forms["choices"]["settings"]
    with (folder / name).open("rb") as file:
        assert got(picked.post("/api/settings", files={"file": (name, file)}))["machine"]
    for path in folder.glob("*.toml"):
        if path.name != name:
            shown = got(picked.post("/api/marks", files={"file": (path.name, path.read_bytes())}))
            assert any(mark["read"] for mark in shown["marks"]) or shown["distances"]
            assert path.name in forms["choices"]["marks"]
    got(
        picked.get("/api/bench")
        if (folder / "marks.toml").exists()
        else picked.get("/api/rounds/marks")
    )


FORM = "marks.toml"


def test_a_form_counts_its_readings_and_its_distances(client, tmp_path):
    distance = '\n[[distance]]\nbetween = ["2", "4"]\nmm = 1123.5\n'
    (tmp_path / FORM).write_text(example_form(read=3) + distance)
    (counted,) = shown(client)["files"]
    assert (counted["read"], counted["asked"]) == (4, 24)


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


def type_a_reading(client):
    return put(client, {0: [98, 106]}, digest=shown(client)["digest"])


def add_a_distance(client):
    body = {"file": FORM, "digest": shown(client)["digest"]}
    distances = [{"between": ["2", "4"], "length": 1123.5}]
    return client.put("/api/distances", json={**body, "distances": distances})


def say_how_fine_the_tape_is(client):
    body = {"file": FORM, "digest": shown(client)["digest"], "finest": 1.0}
    return client.put("/api/fineness", json=body)


def bring_marks(client):
    marks = (EXAMPLE / FORM).read_bytes()
    return client.post("/api/marks", files={"file": (FORM, marks)})


def bring_settings(client):
    settings = (EXAMPLE / "groundcontrol.ini").read_bytes()
    return client.post("/api/settings", files={"file": ("groundcontrol.ini", settings)})


def use_proof_marks(client):
    return client.post("/api/proof/use")


WAYS = [
    (type_a_reading, {"marks": [FORM]}),
    (add_a_distance, {"marks": [FORM]}),
    (say_how_fine_the_tape_is, {"fineness": 1.0}),
    (bring_marks, {"marks": ["marks-2.toml"]}),
    (bring_settings, {"settings": "groundcontrol.ini"}),
    (use_proof_marks, {"marks": ["proof.toml"]}),
]


@pytest.mark.parametrize(("save", "chosen"), WAYS, ids=lambda each: getattr(each, "__name__", ""))
def test_a_choice_during_a_save_is_kept_and_the_save_completes(
    client, tmp_path, meanwhile, save, chosen
):
    (tmp_path / "proof.toml").write_text(example_form())
    got(save(client))
    choices = json.loads((tmp_path / "lab.json").read_text())
    assert choices["units"] == "inch" and len(meanwhile) == 2
    assert {name: choices[name] for name in chosen} == chosen


def test_a_grid_is_refused_if_the_choices_change_meanwhile(client, meanwhile):
    assert client.post("/api/rounds/marks").status_code == 409
